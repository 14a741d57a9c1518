"""Bodies that are thrown and come to rest: crates, rods, disks, stacks, dominoes, a crate in a gutter.

Each throw is run as it is, mirrored, with its contacts in reversed order, and now and then on other routes:
the answers must be the same within the errors that they tell (thrown.py).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

Random = np.random.Generator


@dataclass(frozen=True)
class Wall:
    """A line through a point; bodies are on its left."""

    x: float = 0
    y: float = 0
    angle: float = 0


@dataclass(frozen=True)
class Thrown:
    """A body; `size`: width, height of a plate, length of a rod, radius of a disk; pose of its centre."""

    kind: str
    size: tuple[float, ...]
    mass: float
    pose: tuple[float, float, float]
    velocity: tuple[float, float, float]


@dataclass(frozen=True)
class Throw:
    """All that is thrown at once; `pairs`: numbers of bodies that may meet."""

    kind: str
    bodies: tuple[Thrown, ...]
    walls: tuple[Wall, ...]
    pairs: tuple[tuple[int, int], ...]
    friction: float
    restitution: float
    law: str
    until: str = "rest"

    def mirrored(self) -> Throw:
        return replace(
            self,
            bodies=tuple(
                replace(
                    one,
                    pose=(-one.pose[0], one.pose[1], -one.pose[2]),
                    velocity=(-one.velocity[0], one.velocity[1], -one.velocity[2]),
                )
                for one in self.bodies
            ),
            walls=tuple(Wall(-one.x, one.y, -one.angle) for one in self.walls),
        )

    def text(self, *, turned: bool = False, route: str = "") -> str:
        """Its scene; `turned`: the contacts in reversed order."""
        contacts = [*self._on_walls(), *self._between()]
        names = [f"b{i}" for i in range(len(self.bodies))]
        asks = [f'{n}_{q} = "{n}.{w}"' for n in names for q, w in (("x", "x"), ("y", "y"), ("a", "angle"))]
        walls = [
            f'w{i} = {{ through = ["{one.x!r} m", "{one.y!r} m"], angle = "{one.angle!r} rad" }}'
            for i, one in enumerate(self.walls)
        ]
        return "\n".join(
            [
                f'until = "{self.until}"',
                "[ground.lines]",
                *walls,
                "[bodies]",
                *(f"{name} = {_body(one)}" for name, one in zip(names, self.bodies, strict=True)),
                "[contacts]",
                *(f"c{i} = {one}" for i, one in enumerate(reversed(contacts) if turned else contacts)),
                "[start]",
                *(f"{name} = {_start(one)}" for name, one in zip(names, self.bodies, strict=True)),
                "[solve]",
                'max_cpu = "20 s"',
                *([f'route = "{route}"'] if route else []),
                "[ask]",
                *asks,
                'kinetic = "energy.kinetic"',
            ]
        )

    def _contact(self, one: str, other: str) -> str:
        return (
            f'{{ touch = ["{one}", "{other}"], friction = {self.friction!r}, '
            f'restitution = {self.restitution!r}, law = "{self.law}" }}'
        )

    def _on_walls(self) -> list[str]:
        return [
            self._contact(f"b{i}.{mark}", f"ground.w{k}")
            for i, one in enumerate(self.bodies)
            for mark in _MARKS[one.kind]
            for k in range(len(self.walls))
        ]

    def _between(self) -> list[str]:
        return [
            self._contact(f"b{a}.corners", f"b{b}.{edge}")
            for i, k in self.pairs
            for a, b in ((i, k), (k, i))
            for edge in ("bottom", "right", "top", "left")
        ]


_MARKS = {"plate": ("corners",), "rod": ("A", "B"), "disk": ("rim",)}


def _body(one: Thrown) -> str:
    form = {
        "plate": lambda: (
            f'plate = ["{one.size[0]!r} m", "{one.size[1]!r} m"], corners = ["A", "B", "C", "D"]'
        ),
        "rod": lambda: f'rod = ["A", "B"], length = "{one.size[0]!r} m"',
        "disk": lambda: f'disk = "{one.size[0]!r} m"',
    }[one.kind]()
    x, y, angle = one.pose
    return f'{{ {form}, mass = "{one.mass!r} kg", at = ["{x!r} m", "{y!r} m"], angle = "{angle!r} rad" }}'


def _start(one: Thrown) -> str:
    u, v, omega = one.velocity
    return f'{{ velocity = ["{u!r} m/s", "{v!r} m/s"], omega = "{omega!r} rad/s" }}'


# ---- what is thrown ----
def _law(rng: Random) -> str:
    return str(rng.choice(["newton", "newton", "newton", "poisson", "stronge"]))


def _friction(rng: Random) -> float:
    return float(rng.choice([0.05, 0.2, 0.5, 0.9, round(rng.uniform(0.02, 1), 2)]))


def _restitution(rng: Random) -> float:
    return float(rng.choice([0, 0, 0.3, 0.5, round(rng.uniform(0, 0.8), 2)]))


def _flight(rng: Random, height: float, speed: float = 3) -> tuple[tuple[float, ...], tuple[float, ...]]:
    pose = (0.0, float(rng.uniform(height, 2 * height)), float(rng.uniform(-np.pi, np.pi)))
    return pose, (
        float(rng.uniform(-speed, speed)),
        float(rng.uniform(-speed, 0)),
        float(rng.uniform(-10, 10)),
    )


def _one(
    rng: Random, kind: str, form: str, size: tuple[float, ...], walls: tuple[Wall, ...], until: str
) -> Throw:
    pose, velocity = _flight(rng, 1.0)
    body = Thrown(form, size, float(rng.uniform(0.5, 5)), pose, velocity)  # type: ignore[arg-type]
    return Throw(kind, (body,), walls, (), _friction(rng), _restitution(rng), _law(rng), until)


def box(rng: Random) -> Throw:
    return _one(rng, "box", "plate", tuple(map(float, rng.uniform(0.05, 0.5, 2))), (Wall(),), "rest")


def rod(rng: Random) -> Throw:
    return _one(rng, "rod", "rod", (float(rng.uniform(0.2, 1)),), (Wall(),), "rest")


def disk(rng: Random) -> Throw:
    slope = float(rng.uniform(-0.3, 0.3))
    return _one(rng, "disk", "disk", (float(rng.uniform(0.05, 0.4)),), (Wall(angle=slope),), "t = 3 s")


def incline(rng: Random) -> Throw:
    """A box on a slope: it stays or slides on."""
    slope = float(rng.uniform(-0.6, 0.6))
    return _one(
        rng, "incline", "plate", tuple(map(float, rng.uniform(0.05, 0.5, 2))), (Wall(angle=slope),), "t = 3 s"
    )


def gutter(rng: Random) -> Throw:
    """Between two walls that lean outwards."""
    right, left = float(rng.uniform(0.2, 1.2)), float(rng.uniform(0.2, 1.2))
    walls = (Wall(angle=right), Wall(angle=-left))
    return _one(rng, "gutter", "plate", tuple(map(float, rng.uniform(0.05, 0.4, 2))), walls, "rest")


def stack(rng: Random) -> Throw:
    """Three boxes dropped on each other."""
    bodies, y, x = [], 0.0, 0.0
    for _ in range(3):
        w, h = map(float, rng.uniform(0.15, 0.5, 2))
        tilt = float(rng.choice([0, rng.uniform(-0.1, 0.1)]))
        y += float(rng.uniform(0.01, 0.1)) + 0.5 * h + 0.1 * w
        x += float(rng.uniform(-0.05, 0.05))
        speed = float(rng.uniform(-0.5, 0.5)), float(rng.uniform(-0.5, 0)), float(rng.uniform(-1, 1))
        bodies.append(Thrown("plate", (w, h), float(rng.uniform(0.5, 5)), (x, y, tilt), speed))
        y += 0.5 * h + 0.1 * w
    pairs = ((0, 1), (0, 2), (1, 2))
    return Throw("stack", tuple(bodies), (Wall(),), pairs, _friction(rng), 0.5 * _restitution(rng), "newton")


def dominoes(rng: Random) -> Throw:
    """A row of four; the first is pushed."""
    width, height = float(rng.uniform(0.02, 0.05)), float(rng.uniform(0.15, 0.3))
    gap = float(rng.uniform(0.3, 0.7)) * height
    bodies = [
        Thrown("plate", (width, height), 0.1, (i * (width + gap), 0.5 * height, 0.0), (0.0, 0.0, 0.0))
        for i in range(4)
    ]
    push = float(rng.uniform(2, 6))  # about its lower right corner
    bodies[0] = replace(bodies[0], velocity=(0.5 * push * height, 0.5 * push * width, -push))
    pairs = ((0, 1), (1, 2), (2, 3), (0, 2), (1, 3))
    friction, restitution = float(rng.uniform(0.2, 0.9)), float(rng.choice([0, 0.2]))
    return Throw("dominoes", tuple(bodies), (Wall(),), pairs, friction, restitution, "newton")


KINDS: tuple[Callable[[Random], Throw], ...] = (box, rod, disk, incline, gutter, stack, dominoes)


def throw(number: int) -> Throw:
    """The throw of this number: mostly of one body."""
    rng = np.random.default_rng([17, number])
    return KINDS[rng.choice(len(KINDS), p=[0.4, 0.15, 0.1, 0.1, 0.15, 0.07, 0.03])](rng)
