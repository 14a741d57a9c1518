"""Equations of the scenes derived by hand, in least coordinates: what the solvers among the peers are given.

A model is a system y' = rhs(y) with events and what happens at them.  `m` is the module that has sin, cos and
sqrt: math for numbers, heyoka for expressions.  `p` holds the parameters of the case, SI, in the order of the
problem's names.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

INCH = 0.0254
FOOT = 0.3048
G_US = 32.2 * FOOT
G_SI = 9.81
SPHERE_RADIUS = 10 * INCH
SPHERE_CONTACT = 1.4  # moment of inertia about a point of the rim over m r^2
# A sphere that rolls back past this angle short of the next bar has turned round, rad.
TURNED_ROUND = 1e-9
# The sphere starts this far past the top of the first bar, which is an event, rad.
OFF_TOP = 1e-14
# No run of these scenes has as many events: a solver that finds more finds the same one again and again.
MOST_EVENTS = 10_000
# Flights of the ball begin this far above the floor, so that the root they start at is not found again, m.
LIFT = 1e-15
# Slower blows than this are not followed by a solver that knows no limit of infinitely many, m/s.
SLOWEST_BLOW = 1e-6


@dataclass(frozen=True)
class Event:
    """A root of `value(m, y, p)` passed in `direction` (+1 rising, -1 falling); one that is not `terminal` is
    only told to the model."""

    value: Callable[[Any, Any, Any], Any]
    direction: int
    terminal: bool


@dataclass
class Log:
    """What a run has gathered: answers, and counts that a model keeps for itself."""

    answers: list[float] = field(default_factory=list)
    count: int = 0
    climbing: bool = False
    events: int = 0


class Model:
    """One system; `end_time` in s, or None where an event ends it."""

    end_time: float | None = None
    dimension = 2
    events: tuple[Event, ...] = ()

    def parameters(self, case: Sequence[float]) -> list[float]:
        """p of a case."""
        return list(case)

    def start(self, p: Sequence[float]) -> list[float]:
        raise NotImplementedError

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        raise NotImplementedError

    def go_on(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        """The state from which the run goes on after event `number`; None: it has ended.

        Raises RuntimeError for a run that does not end.
        """
        log.events += 1
        if log.events > MOST_EVENTS:
            raise RuntimeError(f"more than {MOST_EVENTS} events")
        return self.react(log, number, t, y, p)

    def react(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        """What `go_on` does for this model."""
        raise NotImplementedError

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        """The answers in the order of the problem, from the log and the last state."""
        return log.answers


class DoublePendulum(Model):
    """Two slender rods of 1 m and 1 kg; angles from the level."""

    end_time = 5.0
    dimension = 4

    def start(self, p: Sequence[float]) -> list[float]:
        return [0.0, 0.0, 0.0, 0.0]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        a, b, wa, wb = y
        c, s = m.cos(a - b), m.sin(a - b)
        m11, m22, m12 = 4 / 3, 1 / 3, 0.5 * c
        f1 = -1.5 * G_SI * m.cos(a) - 0.5 * s * wb * wb
        f2 = -0.5 * G_SI * m.cos(b) + 0.5 * s * wa * wa
        det = m11 * m22 - m12 * m12
        return [wa, wb, (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det]

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        return [math.cos(y[0]) + math.cos(y[1]), math.sin(y[0]) + math.sin(y[1])]


class SliderCrank(Model):
    """Crank 0.1 m, rod 0.3 m, masses 0.2, 0.2 and 0.4 kg; the crank's angle is the coordinate."""

    end_time = 10.0

    def start(self, p: Sequence[float]) -> list[float]:
        return [math.pi / 4, 10.0]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        a, length, m1, m2, m3 = 0.1, 0.3, 0.2, 0.2, 0.4
        s, c = m.sin(y[0]), m.cos(y[0])
        root = m.sqrt(length * length - a * a * s * s)
        phi = a * c / root  # rate of the rod's angle per unit rate of the crank
        dphi = (-a * s * root + a * c * a * a * s * c / root) / (root * root)
        x2, y2 = -a * s - a * s * phi / 2, a * c / 2
        dx2, dy2 = -a * c - (a * c * phi + a * s * dphi) / 2, -a * s / 2
        x3, dx3 = -a * s - a * s * phi, -a * c - a * c * phi - a * s * dphi
        inertia = m1 * a * a / 3 + m2 * (x2 * x2 + y2 * y2) + m2 * length * length / 12 * phi * phi
        inertia = inertia + m3 * x3 * x3
        slope = 2 * (m2 * (x2 * dx2 + y2 * dy2) + m2 * length * length / 12 * phi * dphi + m3 * x3 * dx3)
        weight = G_SI * a / 2 * (m1 + m2) * c
        return [y[1], -(0.5 * slope * y[1] * y[1] + weight) / inertia]

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        return [y[0]]


class Pendulum(Model):
    """A body about a level axis: angle'' = -k cos(angle), from the level."""

    end_time = 10.0

    def __init__(self, k: float, angle: float, omega: float) -> None:
        self.k, self.angle, self.omega = k, angle, omega

    def start(self, p: Sequence[float]) -> list[float]:
        return [self.angle, self.omega]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        return [y[1], -self.k * m.cos(y[0])]


class SimplePendulum(Pendulum):
    """IFToMM A01: a particle 1 m from the pin, let go from the level on the left."""

    def __init__(self) -> None:
        super().__init__(G_SI, math.pi, 0.0)

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        return [math.cos(y[0]), math.sin(y[0])]


class FourBars(Pendulum):
    """IFToMM A02 with N couplers, one coordinate: N + 1 cranks turn as one, couplers only translate."""

    def __init__(self, n: int) -> None:
        inertia, moment = (n + 1) / 3 + n, (n + 1) / 2 + n
        super().__init__(G_SI * moment / inertia, math.pi / 2, -1.0)
        self.inertia, self.moment = inertia, G_SI * moment

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        return [y[0], self.energy(y)]

    @property
    def start_energy(self) -> float:
        return self.energy(self.start(()))

    def energy(self, y: Sequence[float]) -> float:
        """In J, with the level through the pins as zero."""
        return self.inertia * y[1] ** 2 / 2 + self.moment * math.sin(y[0])


class Linkage(Model):
    """17.C5: bars of 30 in; one coordinate, the angle below the level; T = m (L omega)^2 (1/3 + sin^2)."""

    length = 30 * INCH
    marks_deg = (10, 20, 30, 40, 50, 60, 70, 80, 89)

    def __init__(self) -> None:
        self.events = tuple(self._mark(mark) for mark in self.marks_deg)

    def _mark(self, degrees: float) -> Event:
        angle = math.radians(degrees)
        return Event(lambda m, y, p: y[0] - angle, 1, degrees == self.marks_deg[-1])

    def start(self, p: Sequence[float]) -> list[float]:
        return [0.0, 0.0]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        s, c = m.sin(y[0]), m.cos(y[0])
        return [y[1], (G_US / self.length * c - 2 * s * c * y[1] * y[1]) / (2 / 3 + 2 * s * s)]

    def react(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        log.answers.append(y[1])
        if number < len(self.marks_deg) - 1:
            return list(y)
        log.answers += [2 * self.length * math.sin(y[0]) * y[1], t]
        return None


class Collar(Model):
    """A hoop (0.3 m, 2 kg) rolls one turn with a collar; p = (d, mass_ratio), the turn is the coordinate."""

    radius, mass, omega_below = 0.3, 2.0, 15.0
    events = (
        Event(lambda m, y, p: y[0] - math.pi, 1, False),
        Event(lambda m, y, p: y[0] - 2 * math.pi, 1, True),
    )

    def start(self, p: Sequence[float]) -> list[float]:
        return [0.0, self.omega_below]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        d, collar = p[0], p[1] * self.mass
        s, c = m.sin(y[0]), m.cos(y[0])
        r = self.radius
        inertia = 2 * self.mass * r * r + collar * (r * r + d * d - 2 * r * d * c)
        return [y[1], -collar * d * s * (G_SI + r * y[1] * y[1]) / inertia]

    def react(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        log.answers.append(t if number else y[1])
        return None if number else list(y)


class SphereOverBars(Model):
    """17.C3: a sphere turns about one bar after another, p = (d, omega0, half the angle from
    bar to bar); the angle past the bar is the coordinate."""

    events = (
        Event(lambda m, y, p: y[0] - p[2], 1, True),
        Event(lambda m, y, p: y[0] + p[2] + TURNED_ROUND, -1, True),
        Event(lambda m, y, p: y[0], 1, False),
    )

    def parameters(self, case: Sequence[float]) -> list[float]:
        return [*case, math.asin(case[0] / (2 * SPHERE_RADIUS))]

    def start(self, p: Sequence[float]) -> list[float]:
        return [OFF_TOP, p[1]]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        return [y[1], G_US / (SPHERE_CONTACT * SPHERE_RADIUS) * m.sin(y[0])]

    def react(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        if number == 2:
            if log.climbing:
                log.count += 1
                log.climbing = False
                if log.count == 1:
                    log.answers.append(y[1])
            return list(y)
        after = y[1] * (0.4 + math.cos(2 * p[2])) / SPHERE_CONTACT
        if number == 1 or after <= 0:
            return None
        log.climbing = True
        return [-p[2], after]

    def answers(self, log: Log, y: Sequence[float]) -> list[float]:
        return [log.answers[0] if log.answers else math.nan, float(log.count)]


class Ball(Model):
    """A ball falls from 1 m and keeps 0.9 of its speed at each blow, as long as a solver can follow."""

    height, restitution = 1.0, 0.9
    events = (Event(lambda m, y, p: y[0], -1, True),)

    def start(self, p: Sequence[float]) -> list[float]:
        return [self.height, 0.0]

    def rhs(self, m: Any, y: Any, p: Any) -> list[Any]:
        return [y[1], -G_SI + 0.0 * y[0]]

    def react(
        self, log: Log, number: int, t: float, y: Sequence[float], p: Sequence[float]
    ) -> list[float] | None:
        if log.count == 0:
            log.answers.append(t)
        log.count += 1
        after = -self.restitution * y[1]
        if after > SLOWEST_BLOW:
            return [LIFT, after]
        log.answers.append(t)
        return None
