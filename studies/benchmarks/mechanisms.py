"""Scenes as trees of rods with loops that are closed: what the engines among the peers are given.

Rods hang on the ground or on each other by pins; a loop is closed by a pin between two points, the last of
them perhaps of a piston that slides along the level through the origin.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

# Stands for a point without mass where an engine wants a body, kg.
NO_MASS = 1e-9


@dataclass(frozen=True)
class Rod:
    """A rod on a pin at `at` (of the ground, m) or at the end of rod number `parent`; `angle` (rad), `omega`
    (rad/s) from the level; `particle`: its mass is at its far end."""

    length: float
    mass: float
    angle: float
    omega: float
    at: tuple[float, float] = (0.0, 0.0)
    parent: int | None = None
    particle: bool = False

    @property
    def mass_center(self) -> float:
        """From its pin, m."""
        return self.length if self.particle else self.length / 2

    @property
    def inertia(self) -> float:
        """About the mass centre, kg m^2; a particle keeps the least that engines take."""
        return NO_MASS if self.particle else self.mass * self.length**2 / 12


@dataclass(frozen=True)
class Mechanism:
    """`closed`: pairs of rods whose far ends coincide; `piston`: (rod, mass) of what slides along the level;
    `tip_asked`: the answer is where the last rod ends, else the angle of the first."""

    rods: tuple[Rod, ...]
    end_time: float
    closed: tuple[tuple[int, int], ...] = ()
    piston: tuple[int, float] | None = None
    tip_asked: bool = False

    def tip(self, angles: Sequence[float]) -> list[float]:
        """Where rods in series end, m."""
        return [
            sum(rod.length * part(a) for rod, a in zip(self.rods, angles, strict=True))
            for part in (math.cos, math.sin)
        ]

    def pin(self, i: int) -> tuple[float, float]:
        """Where rod i hangs at the start, m."""
        rod = self.rods[i]
        return rod.at if rod.parent is None else self.end(rod.parent)

    def end(self, i: int) -> tuple[float, float]:
        """Where the far end of rod i is at the start, m."""
        rod = self.rods[i]
        x, y = self.pin(i)
        return x + rod.length * math.cos(rod.angle), y + rod.length * math.sin(rod.angle)

    def end_velocity(self, i: int) -> tuple[float, float]:
        """Velocity of the far end of rod i at the start, m/s."""
        rod = self.rods[i]
        u, v = (0.0, 0.0) if rod.parent is None else self.end_velocity(rod.parent)
        reach = rod.length * rod.omega
        return u - reach * math.sin(rod.angle), v + reach * math.cos(rod.angle)

    def velocity(self, i: int) -> tuple[float, float]:
        """Velocity of the mass centre of rod i at the start, m/s."""
        rod = self.rods[i]
        u, v = (0.0, 0.0) if rod.parent is None else self.end_velocity(rod.parent)
        reach = rod.mass_center * rod.omega
        return u - reach * math.sin(rod.angle), v + reach * math.cos(rod.angle)


def double_pendulum() -> Mechanism:
    return Mechanism((Rod(1, 1, 0, 0), Rod(1, 1, 0, 0, parent=0)), 5.0, tip_asked=True)


def slider_crank() -> Mechanism:
    angle, omega, a, length = math.pi / 4, 10.0, 0.1, 0.3
    phi = -math.asin(a / length * math.sin(angle))
    rate = -a / length * math.cos(angle) * omega / math.cos(phi)
    rods = (Rod(a, 0.2, angle, omega), Rod(length, 0.2, phi, rate, parent=0))
    return Mechanism(rods, 10.0, piston=(1, 0.4))


def simple_pendulum() -> Mechanism:
    return Mechanism((Rod(1, 1, math.pi, 0, particle=True),), 10.0, tip_asked=True)


def four_bars(n: int) -> Mechanism:
    cranks = [Rod(1, 1, math.pi / 2, -1, at=(float(i), 0)) for i in range(n + 1)]
    couplers = [Rod(1, 1, 0, 0, parent=i) for i in range(n)]
    return Mechanism((*cranks, *couplers), 10.0, closed=tuple((n + 1 + i, i + 1) for i in range(n)))
