"""Kinds of blows: balls in a row between walls, a ball on a free rod."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from itertools import pairwise

from tests.stress.kinds.drawn import Drawn

RADIUS = 0.05  # m
CLOSE = 1e-9  # s: the order of two blows so close to each other is an edge
MANY = 300  # blows: rounding has grown too far


@dataclass
class Row:
    """Balls on a line between a wall at 0 and another one; `blows`: by gap, the walls' among them."""

    mass: list[float]
    x: list[float]
    v: list[float]
    wall: float
    e: float
    blows: list[int]
    edge: bool = False

    def go(self, end: float) -> None:
        """Blow by blow in the order of their times."""
        t = 0.0
        while not self.edge:
            after, gap = self._next()
            self.edge = abs(t + after - end) < CLOSE or sum(self.blows) > MANY
            if t + after > end:
                break
            self._move(after)
            self._strike(gap)
            t += after
        self._move(end - t)

    def _next(self) -> tuple[float, int]:
        """In which time the next blow comes, and at which gap."""
        x, v, r = self.x, self.v, RADIUS
        left = [x[0] - r, *(b - a - 2 * r for a, b in pairwise(x)), self.wall - x[-1] - r]
        rate = [-v[0], *(a - b for a, b in pairwise(v)), v[-1]]
        gaps = enumerate(zip(left, rate, strict=True))
        times = sorted((max(gap, 0.0) / speed, j) for j, (gap, speed) in gaps if speed > 0)
        self.edge = self.edge or (len(times) > 1 and times[1][0] - times[0][0] < CLOSE)
        return times[0] if times else (math.inf, 0)

    def _move(self, time: float) -> None:
        self.x = [x + v * time for x, v in zip(self.x, self.v, strict=True)]

    def _strike(self, gap: int) -> None:
        self.blows[gap] += 1
        if gap in (0, len(self.v)):
            self.v[max(gap - 1, 0)] *= -self.e
            return
        a, b = self.mass[gap - 1], self.mass[gap]
        push = (1 + self.e) * a * b / (a + b) * (self.v[gap - 1] - self.v[gap])
        self.v[gap - 1] -= push / a
        self.v[gap] += push / b


def balls_in_a_row(draw: random.Random) -> Drawn:
    """Between two walls, along an axis of the scene or any other line."""
    n, e, end = draw.randint(1, 4), draw.choice([1.0, draw.uniform(0.6, 1)]), draw.uniform(0.2, 4)
    masses = [10 ** draw.uniform(-1, 1) for _ in range(n)]
    speeds = [draw.uniform(-3, 3) for _ in range(n)]
    steps = [2 * RADIUS + draw.uniform(0.1, 1) for _ in range(n + 1)]
    starts = [sum(steps[: i + 1]) - RADIUS for i in range(n)]
    row = Row(masses, list(starts), list(speeds), sum(steps) - RADIUS, e, [0] * (n + 1))
    row.go(end)
    # Off the axes rounding throws each ball aside, and each blow makes some twenty times of that.
    tilt = draw.choice([0.0, 90.0, draw.uniform(0, 360) if sum(row.blows) < 8 else 0.0])
    aside = {0.0: ("1", "0"), 90.0: ("0", "1")}
    c, s = aside.get(tilt, (f"cos({tilt!r} deg)", f"sin({tilt!r} deg)"))

    def along(size: float, unit: str) -> str:
        return f'["({size!r} {unit})*{c}", "({size!r} {unit})*{s}"]'

    marks = ["ground.a", *(f"b{i}.rim" for i in range(n)), "ground.b"]
    lines = [
        f'until = "t = {end!r} s"',
        'plane = "horizontal"',
        f'ground.lines.a = {{ through = [0, 0], angle = "{tilt - 90!r} deg" }}',
        f'ground.lines.b = {{ through = {along(row.wall, "m")}, angle = "{tilt + 90!r} deg" }}',
    ]
    for i in range(n):
        at, speed = along(starts[i], "m"), along(speeds[i], "m/s")
        lines.append(f'bodies.b{i} = {{ disk = "{RADIUS} m", mass = "{masses[i]!r} kg", at = {at} }}')
        lines.append(f"start.b{i}.velocity = {speed}")
        lines.append(f'ask.x{i} = "b{i}.position.x*{c} + b{i}.position.y*{s}"')
        lines.append(f'ask.v{i} = "b{i}.velocity.x*{c} + b{i}.velocity.y*{s}"')
    for j in range(n + 1):
        one, other = (marks[1], marks[0]) if j == 0 else (marks[j], marks[j + 1])
        lines.append(f'contacts.c{j} = {{ touch = ["{one}", "{other}"], restitution = {e!r} }}')
        lines.append(f'events.e{j} = "c{j} strikes"\nask.n{j} = "e{j}.count"')
    truth: dict[str, float] = {f"n{j}": row.blows[j] for j in range(n + 1)}
    truth |= {f"x{i}": row.x[i] for i in range(n)} | {f"v{i}": row.v[i] for i in range(n)}
    size = 10.0 * (1 + sum(row.blows))
    return Drawn("\n".join(lines), truth, dict.fromkeys(truth, size), row.edge)


def ball_on_a_rod(draw: random.Random) -> Drawn:
    """A free rod at rest is struck across at some place: impulse P = (1 + e) v / (1/m + 1/M + b^2/I)."""
    length, m, mass, e = (
        draw.uniform(0.3, 3),
        10 ** draw.uniform(-1, 1),
        10 ** draw.uniform(-1, 1),
        draw.uniform(0, 1),
    )
    b, v, gap = draw.uniform(-0.48, 0.48) * length, 10 ** draw.uniform(-1, 1), draw.uniform(0.1, 1)
    inertia, r = mass * length**2 / 12, 0.02
    push = (1 + e) * v / (1 / m + 1 / mass + b**2 / inertia)
    end = (gap - r) / v * draw.uniform(1.02, 1.2)
    text = f"""
until = "t = {end!r} s"
plane = "horizontal"
bodies.rod = {{ rod = ["A", "B"], length = "{length!r} m", mass = "{mass!r} kg", angle = "90 deg" }}
bodies.p = {{ disk = "{r} m", mass = "{m!r} kg", at = ["{-gap!r} m", "{b!r} m"] }}
start.p.velocity = ["{v!r} m/s", 0]
contacts.c = {{ touch = ["p.rim", "rod.axis"], restitution = {e!r} }}
events.hit = "c strikes"
[ask]
v = "p.velocity.x"
u = "rod.velocity.x"
omega = "rod.omega"
n = "hit.count"
lost = "energy.lost"
push = {{ of = "c.impulse.norm", at = "hit" }}
"""
    u, omega = push / mass, -push * b / inertia
    v1 = v - push / m
    lost = 0.5 * m * v**2 - 0.5 * m * v1**2 - 0.5 * mass * u**2 - 0.5 * inertia * omega**2
    truth = {"v": v1, "u": u, "omega": omega, "n": 1, "lost": lost, "push": push}
    return Drawn(text, truth, {"v": v, "omega": v / length * 10, "lost": m * v**2})
