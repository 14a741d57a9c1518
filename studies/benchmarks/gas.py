"""Disks in a box, blow by blow, in many digits: the truth of drawn scenes.

Between two blows all disks fall alike, so that two of them meet where a quadratic vanishes; a blow reverses
the normal part of the relative velocity and leaves e of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import mpmath as mp

WALLS = ("left", "right", "floor", "roof")


@dataclass
class Disk:
    """m, kg, m and m/s; `at` and `velocity` as they were drawn, `place` and `speed` in many digits."""

    radius: float
    mass: float
    at: list[float]
    velocity: list[float]

    def __post_init__(self) -> None:
        self.place = [mp.mpf(u) for u in self.at]
        self.speed = [mp.mpf(u) for u in self.velocity]


class Gas:
    def __init__(self, disks: list[Disk], width: float, restitution: float, gravity: float) -> None:
        self.disks, self.width = disks, mp.mpf(width)
        self.e, self.g = mp.mpf(restitution), mp.mpf(gravity)

    def to_wall(self, disk: Disk, wall: int) -> mp.mpf:
        """s until the disk strikes the wall, infinite if it does not."""
        axis, far = divmod(wall, 2)
        v = disk.speed[axis]
        g = self.g if axis else mp.mpf(0)
        gap = self.width - disk.radius - disk.place[axis] if far else disk.place[axis] - disk.radius
        if far:
            under = v * v - 2 * g * gap
            return 2 * gap / (v + mp.sqrt(under)) if v > 0 and under >= 0 else mp.inf
        if g == 0:
            return -gap / v if v < 0 else mp.inf
        root = mp.sqrt(v * v + 2 * g * max(gap, 0))
        return (v + root) / g if v > 0 else 2 * gap / (root - v)

    def to_meet(self, a: Disk, b: Disk) -> mp.mpf:
        apart = [x - y for x, y in zip(a.place, b.place, strict=True)]
        rate = [x - y for x, y in zip(a.speed, b.speed, strict=True)]
        closing = sum(x * v for x, v in zip(apart, rate, strict=True))
        square, reach = sum(v * v for v in rate), mp.mpf(a.radius) + mp.mpf(b.radius)
        rest = sum(x * x for x in apart) - reach**2
        under = closing**2 - square * rest
        if closing >= 0 or under < 0:
            return mp.inf
        return rest / (mp.sqrt(under) - closing)

    def next(self) -> tuple[mp.mpf, int, int]:
        """When, which disk, and which other (-1 and below: the walls)."""
        coming = []
        for i, a in enumerate(self.disks):
            coming += [(self.to_wall(a, wall), i, -1 - wall) for wall in range(len(WALLS))]
            coming += [(self.to_meet(a, b), i, k) for k, b in enumerate(self.disks[:i])]
        return min(coming)

    def go(self, time: mp.mpf) -> None:
        for disk in self.disks:
            disk.place[0] += disk.speed[0] * time
            disk.place[1] += disk.speed[1] * time - self.g * time**2 / 2
            disk.speed[1] -= self.g * time

    def strike(self, i: int, other: int) -> None:
        a = self.disks[i]
        if other < 0:
            a.speed[(-1 - other) // 2] *= -self.e
            return
        b = self.disks[other]
        reach = mp.mpf(a.radius) + mp.mpf(b.radius)
        normal = [(x - y) / reach for x, y in zip(a.place, b.place, strict=True)]
        rate = sum((x - y) * n for x, y, n in zip(a.speed, b.speed, normal, strict=True))
        impulse = -(1 + self.e) * rate / (1 / mp.mpf(a.mass) + 1 / mp.mpf(b.mass))
        a.speed = [v + impulse * n / a.mass for v, n in zip(a.speed, normal, strict=True)]
        b.speed = [v - impulse * n / b.mass for v, n in zip(b.speed, normal, strict=True)]

    def run(self, time: float, blows: int = 200) -> bool:
        """Lets it move; whether that took no more than so many blows."""
        left = mp.mpf(time)
        for _ in range(blows):
            after, i, other = self.next()
            if after >= left:
                self.go(left)
                return True
            self.go(after)
            self.strike(i, other)
            left -= after
        return False

    def energy(self) -> mp.mpf:
        return sum(
            disk.mass * (sum(v * v for v in disk.speed) / 2 + self.g * disk.place[1]) for disk in self.disks
        )
