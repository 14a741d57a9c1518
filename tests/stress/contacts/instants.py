"""The instant at which a throw ends without going on: what the laws of contact allow there, by enumeration.

Poses and velocities are those of the run just before it; contacts, their rates and loads are found anew from
the shapes alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

import planemotion
from planemotion.compile.flatten import flatten
from planemotion.engine.call import trace
from tests.scenes import G
from tests.stress.contacts import course
from tests.stress.contacts.laws import Array, Problem, Rates, allowed, motions
from tests.stress.contacts.rest import corners, gyration2
from tests.stress.contacts.throws import Throw
from tests.stress.contacts.verdict import left

TOUCHES = 1e-8  # m
STAYS = 1e-8  # m/s: neither strikes nor parts nor slips
STEP = 1e-6  # s: of differences, which are exact to its square
MOST = 6  # contacts: 4 times as many modes each


@dataclass(frozen=True)
class Touch:
    """A corner of a body (of a disk its rim) on a wall, or on a side of another body."""

    body: int
    corner: int
    wall: int = -1
    other: int = -1
    side: int = -1


@dataclass(frozen=True)
class Instant:
    """pose, velocity [bodies, 3]."""

    throw: Throw
    pose: Array
    velocity: Array

    @property
    def mass(self) -> Array:
        return np.array([[b.mass, b.mass, b.mass * gyration2(b)] for b in self.throw.bodies]).ravel()


def last(throw: Throw) -> Instant:
    """Where its run ends."""
    flat = flatten(planemotion.load_text(throw.text()).data, history=True)
    seen = trace(flat, flat.defaults).columns
    names = [f"b{i}" for i in range(len(throw.bodies))]
    return Instant(
        throw,
        np.array([[seen[f"{b}.{word}"][-1] for word in ("x", "y", "angle")] for b in names]),
        np.array(
            [[seen[f"{b}.{word}"][-1] for word in ("velocity.x", "velocity.y", "omega")] for b in names]
        ),
    )


# ---- who touches ----
def _frame(throw: Throw, pose: Array, at: Touch) -> tuple[Array, Array, Array]:
    """Place of a touch, normal away from what is touched, a place on that."""
    body = throw.bodies[at.body]
    if at.wall >= 0:
        wall = throw.walls[at.wall]
        normal = np.array([-np.sin(wall.angle), np.cos(wall.angle)])
        base = np.array([wall.x, wall.y])
    else:
        shape = corners(throw.bodies[at.other], tuple(pose[at.other]))
        base, end = shape[at.side], shape[(at.side + 1) % len(shape)]
        along = (end - base) / np.linalg.norm(end - base)
        normal = np.array([along[1], -along[0]])
    place = corners(body, tuple(pose[at.body]))[at.corner]
    return place - (body.size[0] * normal if body.kind == "disk" else 0), normal, base


def _on_side(throw: Throw, pose: Array, at: Touch) -> bool:
    place, _, base = _frame(throw, pose, at)
    shape = corners(throw.bodies[at.other], tuple(pose[at.other]))
    side = shape[(at.side + 1) % len(shape)] - base
    along = float((place - base) @ side) / float(side @ side)
    return -1e-9 <= along <= 1 + 1e-9


def _all(throw: Throw) -> Iterator[Touch]:
    for i, body in enumerate(throw.bodies):
        count = {"plate": 4, "rod": 2, "disk": 1}[body.kind]
        yield from (Touch(i, c, wall=k) for c in range(count) for k in range(len(throw.walls)))
    for a, b in throw.pairs:
        for i, k in ((a, b), (b, a)):
            yield from (Touch(i, c, other=k, side=s) for c in range(4) for s in range(4))


def touches(x: Instant) -> list[Touch]:
    found = []
    for at in _all(x.throw):
        place, normal, base = _frame(x.throw, x.pose, at)
        near = abs(float((place - base) @ normal)) <= TOUCHES
        if near and (at.wall >= 0 or _on_side(x.throw, x.pose, at)):
            found.append(at)
    return found


# ---- rates ----
def _rows(throw: Throw, pose: Array, at: Touch) -> Array:
    """[2, 3 bodies]: velocity of the touch along normal and tangent, by those of the bodies."""
    place, normal, _ = _frame(throw, pose, at)
    rows = np.zeros((2, len(pose), 3))
    for body, way in ((at.body, 1), (at.other, -1)):
        if body < 0:
            continue
        x, y = place - pose[body, :2]
        for row, along in enumerate((normal, np.array([normal[1], -normal[0]]))):
            rows[row, body] = way * np.array([*along, x * along[1] - y * along[0]])
    return rows.reshape(2, -1)


def _drift(x: Instant, v: Array, at: Touch) -> Array:
    """[2] accelerations at a touch where the bodies have none."""
    step = STEP * v.reshape(x.pose.shape)
    ahead, behind = (_rows(x.throw, x.pose + way * step, at) @ v for way in (1, -1))
    return (ahead - behind) / (2 * STEP)


def problem(x: Instant, at: list[Touch]) -> Problem:
    n = len(at)
    jacobian = np.array([_rows(x.throw, x.pose, one) for one in at]).reshape(n, 2, x.pose.size)
    some = np.ones(n)
    return Problem(x.mass, jacobian, x.throw.friction * some, x.throw.restitution * some, x.velocity.ravel())


def going_on(x: Instant, at: list[Touch], v: Array) -> list[Array]:
    """All accelerations that the laws allow at velocities v, from those of free fall."""
    p = problem(x, at)
    u = p.jacobian @ v
    closed = [i for i in range(len(p)) if abs(u[i, 0]) <= STAYS]
    fall = np.tile([0, -G, 0], len(x.pose))
    drift = np.array([p.jacobian[i] @ fall + _drift(x, v, one) for i, one in enumerate(at)])
    slides = [0 if abs(u[i, 1]) <= STAYS else int(np.sign(u[i, 1])) for i in closed]
    return allowed(p, Rates(closed, drift, slides))


# ---- what the run said ----
CONFIRMED, REFUTED, NOT_COUNTED = "confirmed", "refuted", "not counted"
TOLD = ("not_unique", "painleve", "no_motion")
BLOWS = 20  # one after the other at the instant


def recounted(x: Instant, status: str) -> str:
    """Whether several motions, or none, go on from there, as the run has told by one of TOLD."""
    at = touches(x)
    if len(at) > MOST:
        return NOT_COUNTED
    p = problem(x, at)
    plastic = replace(p, restitution=0 * p.restitution)  # so are slow blows, and limited ones
    counts = [_count(x, at, way) for way in (p, plastic)]
    said = any(count > 1 if status == "not_unique" else count == 0 for count in counts)
    return CONFIRMED if said else REFUTED


def _count(x: Instant, at: list[Touch], p: Problem) -> int:
    """How many motions there are: of the first blow that has not one, or those that go on after the last."""
    v = p.before
    for _ in range(BLOWS):
        rates = p.jacobian[:, 0] @ v
        if not (rates < -STAYS).any():
            return len(going_on(x, at, v))
        stays = [i for i, rate in enumerate(rates) if rate <= STAYS]
        blow = replace(
            p,
            jacobian=p.jacobian[stays],
            friction=p.friction[stays],
            restitution=p.restitution[stays],
            before=v,
        )
        after = left(blow, x.throw.law)
        if after is None:
            return _count_blow(blow, x.throw.law)
        v = after
    return 1


def _count_blow(blow: Problem, law: str) -> int:
    if law == "newton":
        return len(motions(blow))
    return {course.NO_MOTION: 0, course.SEVERAL: 2}.get(course.follow(blow, law).why, 1)
