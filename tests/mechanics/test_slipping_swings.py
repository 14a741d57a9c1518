"""Weights that swing on a cord over a rough peg, beside Cartesian equations integrated by scipy.

Each strand is a line from a mass to its tangent point; the wrap changes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy import integrate

from tests.mechanics.test_slipping_cords import ASKS, Vector
from tests.scenes import ROUTES, G, answers, close

SWING = """
until = "t = {time} s"
parameters = {{ mu = {static}, mu_k = {kinetic}, m = "{m} kg", M = "{M} kg" }}
ground.circles.peg = {{ radius = "0.2 m", center = [0, "3 m"] }}
bodies.A = {{ mass = "m", at = ["-0.9 m", "1.2 m"] }}
bodies.B = {{ mass = "M", at = ["0.7 m", "0.8 m"] }}
[couplings.cable]
cord = ["A", "ground.peg cw", "B"]
turns = {turns}
friction = {{ static = "mu", kinetic = "mu_k" }}
[start]
A.velocity = ["{v[0]!r} m/s", "{v[1]!r} m/s"]
B.velocity = ["{v[2]!r} m/s", "{v[3]!r} m/s"]
{asks}
ax = "A.x"
ay = "A.y"
bx = "B.x"
by = "B.y"
"""
CENTRE, R = np.array([0, 3.0]), 0.2


def across(u: Vector) -> Vector:
    return np.array([-u[1], u[0]])


def strand(p: Vector, side: int) -> tuple[float, Vector]:
    """Length and direction from a mass to its tangent point on the left (1) or right (-1) of the peg."""
    d = CENTRE - p
    length = math.sqrt(d @ d - R * R)
    return length, (length * d + R * side * across(d)) / (d @ d)


@dataclass
class Swing:
    m: float
    M: float
    static: float
    kinetic: float
    time: float
    turns: int = 0
    v: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)

    def start(self) -> Vector:
        """Its velocities are made such that the cord stays taut."""
        y = np.array([-0.9, 1.2, 0.7, 0.8, *self.v])
        (_, u), (_, w) = strand(y[:2], 1), strand(y[2:4], -1)
        rate = (u @ y[4:6] + w @ y[6:]) / 2
        y[4:] -= rate * np.concatenate([u, w])
        self.v = tuple(map(float, y[4:]))
        return y

    def look(self, y: Vector, sense: int) -> tuple[Vector, float, float, float, float]:
        """Accelerations, both tensions, the wrap and the slip."""
        (l1, u1), (l2, u2) = strand(y[:2], 1), strand(y[2:4], -1)
        g = np.array([0, -G])
        wrap = (math.atan2(u1[1], u1[0]) - math.atan2(-u2[1], -u2[0])) % (
            2 * math.pi
        ) + 2 * math.pi * self.turns
        needed = [
            -(u @ g) + (v @ across(u)) ** 2 / length for u, v, length in ((u1, y[4:6], l1), (u2, y[6:], l2))
        ]
        if sense == 0:
            one, other = self.m * needed[0], self.M * needed[1]
        else:
            factor = math.exp(sense * self.kinetic * wrap)
            one = sum(needed) / (1 / self.m + factor / self.M)
            other = factor * one
        a = np.concatenate([g + one / self.m * u1, g + other / self.M * u2])
        return a, float(one), float(other), wrap, float(u1 @ y[4:6] - u2 @ y[6:]) / 2

    def holds_or(self, y: Vector) -> int:
        _, one, other, wrap, _ = self.look(y, 0)
        most = math.exp(self.static * wrap)
        return 0 if one <= most * other and other <= most * one else 1 if other > one else -1

    def after(self) -> tuple[dict[str, float], int]:
        """What is asked, and how many pieces its motion has."""
        y, t, pieces = self.start(), 0.0, 0
        slip = self.look(y, 0)[-1]
        sense = int(np.sign(slip)) if abs(slip) > 1e-12 else self.holds_or(y)
        while t < self.time:
            solved = integrate.solve_ivp(
                lambda _, x, s=sense: np.concatenate([x[4:], self.look(x, s)[0]]),
                (t, self.time), y, method="DOP853", rtol=2e-13, atol=1e-14, events=self.ends(sense),
            )  # fmt: skip
            t, y, pieces = float(solved.t[-1]), solved.y[:, -1], pieces + 1
            last, sense = sense, self.holds_or(y) if sense else 1 if len(solved.t_events[0]) else -1
        _, one, other, _wrap, end = self.look(y, last)
        asked = ("T1", "T2", "slip", "ax", "ay", "bx", "by")
        return dict(zip(asked, (one, other, end, *map(float, y[:4])), strict=True)), pieces

    def ends(self, sense: int) -> list[Callable[[float, Vector], float]]:
        def room(way: int) -> Callable[[float, Vector], float]:
            def left(_: float, x: Vector) -> float:
                one, other, wrap = self.look(x, 0)[1:4]
                most = math.exp(self.static * wrap)
                return most * one - other if way > 0 else most * other - one

            return left

        found: list[Any] = (
            [room(1), room(-1)] if sense == 0 else [lambda _, x: sense * self.look(x, sense)[-1]]
        )
        for one in found:
            one.terminal, one.direction = True, -1
        return found


SWINGS = [
    (Swing(1, 2, 0.3, 0.3, 0.6), 1),  # holds
    (Swing(1, 4, 0.1, 0.1, 0.5, turns=1), 1),  # slips
    (Swing(1, 1.6, 0.2, 0.2, 1.2), 2),
    (Swing(2, 1, 0.25, 0.25, 1.0, v=(1.0, 0.0, -1.0, 0.0)), 3),
    (Swing(1.1, 1.6, 0.16, 0.14, 1.0, v=(0.5, -0.2, 1.1, 0.4)), 3),
    (Swing(1.9, 1.4, 0.14, 0.09, 1.0, v=(-0.6, 0.8, -1.4, -1.0)), 3),
]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("one", "pieces"), SWINGS)
def test_weights_swing_on_a_rough_peg(route: str, one: Swing, pieces: int) -> None:
    wanted, found_pieces = one.after()
    found = answers(SWING.format(**vars(one), asks=ASKS), route)
    assert found == pytest.approx(wanted, rel=close(route), abs=close(route))
    assert found_pieces == pieces
