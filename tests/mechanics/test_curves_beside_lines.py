"""Ellipses on lines without ends: rolling, bouncing until they roll, and a plank that rests on one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import planemotion
from tests.scenes import ROUTES, G, close


@dataclass(frozen=True)
class Wheel:
    """An ellipse with half axes a and b, round a place `off` from the mass centre (m); mass 1 kg."""

    a: float
    b: float
    off: tuple[float, float]
    inertia: float

    def reach(self, angle: float) -> tuple[float, float, float]:
        """How far it reaches below its mass centre at an angle, and two derivatives.

        They are those of the support function h(beta) by the direction in its axes, beta = -90 deg - angle.
        """
        c, s = math.cos(-math.pi / 2 - angle), math.sin(-math.pi / 2 - angle)
        h = math.hypot(self.a * c, self.b * s)
        change = self.b**2 - self.a**2
        first = change * s * c / h
        second = (change * (c * c - s * s) - first * first) / h
        along, across = self.off[0] * c + self.off[1] * s, -self.off[0] * s + self.off[1] * c
        return h + along, first + across, second - along

    def rolled(
        self, state: tuple[float, float, float], time: tuple[float, float], slope: float
    ) -> tuple[float, float, float]:
        """The way along a line that descends, the angle and the angular velocity after a time without slip.

        The mass centre is at (h', h) from the place of contact: v = omega (-h, -h'), J = m (h^2 + h'^2) + I.
        """

        def rate(_: float, x: np.ndarray) -> list[float]:
            h, first, second = self.reach(x[1] + slope)
            inertia = h * h + first * first + self.inertia
            turning = -2 * first * (h + second)
            pull = G * (math.cos(slope) * first - math.sin(slope) * h)
            return [-x[2] * h, x[2], (pull - turning * x[2] ** 2 / 2) / inertia]

        end = solve_ivp(rate, time, list(state), method="DOP853", rtol=1e-13, atol=1e-14)
        way, angle, omega = end.y[:, -1]
        return float(way), float(angle), float(omega)


EGG = Wheel(0.4, 0.25, (0.05, 0.02), 0.04)


def scene(wheel: Wheel, line: str, how: str, start: str, until: float, route: str = "auto") -> str:
    return f"""
    until = "t = {until!r} s"
    solve.route = "{route}"
    ground.lines.road = {line}
    bodies.egg.mass = "1 kg"
    bodies.egg.inertia = "{wheel.inertia!r} kg*m^2"
    bodies.egg.curves.shell = {{ ellipse = ["{wheel.a!r} m", "{wheel.b!r} m"], at = ["{wheel.off[0]:.17g} m", "{wheel.off[1]:.17g} m"], side = "right" }}
    {how}
    {start}
    ask.x = {{ of = "egg.x", unit = "m" }}
    ask.y = {{ of = "egg.y", unit = "m" }}
    ask.angle = {{ of = "egg.angle", unit = "rad" }}
    """  # noqa: E501


HELD = {
    "joint": 'joints.c = { rolling = ["egg.shell", "ground.road"] }',
    "contact": 'contacts.c = { touch = ["egg.shell", "ground.road"], friction = "rough" }',
    "exchanged": 'contacts.c = { touch = ["ground.road", "egg.shell"], friction = "rough" }',
}


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("how", HELD)
def test_an_elliptic_wheel_rolls_down_a_slope(how: str, route: str) -> None:
    slope, angle = math.radians(10), 0.4
    h, first, _ = EGG.reach(angle + slope)
    x, y = -first * math.cos(slope) + h * math.sin(slope), first * math.sin(slope) + h * math.cos(slope)
    start = f"""
    bodies.egg.at = ["{x!r} m", "{y!r} m"]
    bodies.egg.angle = "{angle!r} rad"
    start.egg.omega = "-4 rad/s"
    """
    got: Any = planemotion.load_text(
        scene(EGG, '{ through = [0, 0], angle = "-10 deg" }', HELD[how], start, 0.7, route)
    ).run()
    assert got.status == "ok"
    way, turned, _ = EGG.rolled((-first, angle, -4.0), (0, 0.7), slope)
    h, _, _ = EGG.reach(turned + slope)
    place = np.array(
        [way * math.cos(slope) + h * math.sin(slope), -way * math.sin(slope) + h * math.cos(slope)]
    )
    assert got["angle"] == pytest.approx(turned, abs=close(route))
    assert np.array([got["x"], got["y"]]) == pytest.approx(place, abs=close(route))


@pytest.mark.parametrize("how", HELD)
def test_friction_is_that_of_a_disk_in_its_place(how: str) -> None:
    """Of two curves each has its own direction: exchanged, they have the same friction."""
    place = f'["{0.3 * math.sin(math.radians(10))!r} m", "{0.3 * math.cos(math.radians(10))!r} m"]'
    start = f'bodies.egg.at = {place}\nask.F = {{ of = "c.friction", unit = "N" }}'
    shell = scene(
        Wheel(0.3, 0.3, (0.0, 0.0), 0.04), '{ through = [0, 0], angle = "-10 deg" }', HELD[how], start, 0.1
    )
    curve = 'curves.shell = { ellipse = ["0.3 m", "0.3 m"], at = ["0 m", "0 m"], side = "right" }'
    assert curve in shell
    disk = shell.replace(curve, 'circles.shell = { radius = "0.3 m" }')
    disk = disk.replace('["ground.road", "egg.shell"]', '["egg.shell", "ground.road"]')
    wanted: Any = planemotion.load_text(disk).run()["F"]
    assert planemotion.load_text(shell).run()["F"] == pytest.approx(wanted, rel=1e-9)
    assert abs(wanted) > 0.1


# ---- bouncing until it rolls ----


def bounced(wheel: Wheel, e: float, x: list[float], until: float) -> tuple[float, float, float] | None:
    """x, y, angle of what falls on a rough floor, from those and their rates; None: it does not come to roll.

    Parabolas, and at each blow u_t = 0, u_n = -e u_n.  What bounces by less than 1e-6 m/s rolls: gravity
    has ended its velocity within 1e-6 s.
    """
    state, t, n = np.array(x), 0.0, 0

    def strike(rebound: float) -> None:
        high, side, _ = wheel.reach(state[2])
        arm = np.array([high, side])  # the velocity at the floor of a unit of omega
        u = state[3:5] + state[5] * arm
        change = np.linalg.solve(
            np.eye(2) + np.outer(arm, arm) / wheel.inertia, [-u[0], -(1 + rebound) * u[1]]
        )
        state[3:5] += change
        state[5] += arm @ change / wheel.inertia

    while True:

        def gap(h: float, state: np.ndarray = state) -> float:
            return float(state[1] + state[4] * h - G * h * h / 2 - wheel.reach(state[2] + state[5] * h)[0])

        leaves = state[4] + state[5] * wheel.reach(state[2])[1]
        if n and leaves < 1e-6:
            break
        step = min(2e-3, leaves / G / 20) if n else 2e-3
        h = step
        while gap(h) > 0:
            h += step
            if t + h > until:
                return None
        h = brentq(gap, h - step if h > step else step / 1000, h, xtol=1e-17)
        state[:3] += h * state[3:]
        state[1] -= G * h * h / 2
        state[4] -= G * h
        strike(e)
        t, n = t + h, n + 1
    strike(0)
    start = (-wheel.reach(state[2])[1], float(state[2]), float(state[5]))
    way, angle, _ = wheel.rolled(start, (t, until), 0)
    return float(state[0]) + way - start[0], wheel.reach(angle)[0], angle


@pytest.mark.parametrize("line", ["{ through = [0, 0] }", '{ from = ["-20 m", 0], to = ["40 m", 0] }'])
@pytest.mark.parametrize("seed", range(8))
def test_an_ellipse_bounces_until_it_rolls(seed: int, line: str) -> None:
    """The errors told cover what the end of the series loses, on a floor and on a far longer edge."""
    rng = np.random.default_rng(seed)
    e = float(rng.choice([0.1, 0.3, 0.5]))
    a, b = (float(one) for one in rng.uniform(0.2, 0.4, 2))
    off = (float(rng.uniform(-0.2, 0.2) * a), float(rng.uniform(-0.2, 0.2) * b))
    wheel = Wheel(a, b, off, (a * a + b * b) / 4)
    x = [
        0.0,
        1.0,
        float(rng.uniform(-3, 3)),
        *(float(one) for one in rng.uniform(-1, 1, 2)),
        float(rng.uniform(-2, 2)),
    ]
    wanted = bounced(wheel, e, x, 1.5)
    assert wanted is not None
    start = f"""
    bodies.egg.at = [0, "1 m"]
    bodies.egg.angle = "{x[2]!r} rad"
    start.egg = {{ velocity = ["{x[3]!r} m/s", "{x[4]!r} m/s"], omega = "{x[5]!r} rad/s" }}
    """
    how = f'contacts.c = {{ touch = ["egg.shell", "ground.road"], friction = "rough", restitution = {e} }}'
    got: Any = planemotion.load_text(scene(wheel, line, how, start, 1.5)).run()
    assert got.status == "ok"
    for key, value in zip(("x", "y", "angle"), wanted, strict=True):
        assert abs(got[key] - value) <= 5 * got.asks[key].error + 1e-12
        assert got[key] == pytest.approx(value, abs=1e-9)


# ---- a line of a body ----


@pytest.mark.parametrize("route", ROUTES)
def test_a_plank_without_ends_rocks_on_a_drum(route: str) -> None:
    """A line that moves: without slip its place of contact goes on along it by r times the angle."""
    r, inertia, high = 0.5, 0.3, 0.1
    text = f"""
    until = "t = 1.3 s"
    solve.route = "{route}"
    ground.curves.drum = {{ ellipse = ["{r} m", "{r} m"], side = "right" }}
    bodies.plank = {{ mass = "1 kg", inertia = "{inertia} kg*m^2", at = [0, "{r + high} m"], lines.below = {{ through = [0, "-{high} m"], angle = "180 deg" }} }}
    contacts.c = {{ touch = ["plank.below", "ground.drum"], friction = "rough" }}
    start.plank.omega = "1 rad/s"
    ask.angle = {{ of = "plank.angle", unit = "rad" }}
    ask.E = {{ of = "energy.total", unit = "J" }}
    """  # noqa: E501

    def rate(_: float, x: np.ndarray) -> list[float]:
        # G = r n + high n - r a t, n = (-sin a, cos a): from the contact (-r a, high) in its axes
        a, w = x
        j = (r * a) ** 2 + high**2 + inertia
        fall = (r + high) * -math.sin(a) + r * math.sin(a) + r * a * math.cos(a)
        return [w, (-G * fall - r * r * a * w * w) / j]

    end = solve_ivp(rate, (0, 1.3), [0, 1], method="DOP853", rtol=1e-13, atol=1e-14).y[0, -1]
    got: Any = planemotion.load_text(text).run()
    assert got.status == "ok"
    assert got["angle"] == pytest.approx(end, abs=close(route))
