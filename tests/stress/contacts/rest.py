"""What must hold where thrown bodies have come to, from their poses alone.

Nothing overlaps, no energy has come from nowhere, and what rests is in equilibrium under its weights and
forces in the cones of friction.
"""

from __future__ import annotations

import itertools

import numpy as np
from scipy.optimize import nnls

from tests.scenes import G
from tests.stress.contacts.laws import Array
from tests.stress.contacts.throws import Throw, Thrown, Wall

NEAR = 1e-6  # m: touching
BALANCED = 1e-6  # of the weights
STILL = 1e-12  # of the kinetic energy before
Pose = tuple[float, float, float]


def faults(throw: Throw, poses: list[Pose], kinetic: float) -> list[str]:
    """What does not hold, in words."""
    shapes = [corners(body, pose) for body, pose in zip(throw.bodies, poses, strict=True)]
    found = []
    if any(
        _under(shape, body, wall)
        for shape, body in zip(shapes, throw.bodies, strict=True)
        for wall in throw.walls
    ):
        found.append("a body is under a wall")
    if any(_overlap(shapes[i], shapes[k]) > NEAR for i, k in throw.pairs):
        found.append("two bodies overlap")
    gained = _energy(throw, poses, kinetic) - _energy_before(throw)
    if gained > 1e-8 * abs(_energy_before(throw)):
        found.append(f"{gained:.2g} J have come from nowhere")
    if throw.until == "rest":
        found += [] if kinetic <= STILL * _moving_before(throw) else ["it moves"]
        left = unbalanced(throw, poses, shapes)
        found += [] if left <= BALANCED else [f"{left:.2g} of the weights are not held"]
    return found


def corners(body: Thrown, pose: Pose) -> Array:
    """[n, 2] counterclockwise; of a disk its centre."""
    if body.kind == "plate":
        w, h = 0.5 * body.size[0], 0.5 * body.size[1]
        own = np.array([[-w, -h], [w, -h], [w, h], [-w, h]])
    elif body.kind == "rod":
        own = np.array([[-0.5 * body.size[0], 0], [0.5 * body.size[0], 0]])
    else:
        own = np.zeros((1, 2))
    s, c = np.sin(pose[2]), np.cos(pose[2])
    return own @ np.array([[c, s], [-s, c]]) + np.array(pose[:2])


def _heights(shape: Array, wall: Wall) -> Array:
    heights: Array = (shape - np.array([wall.x, wall.y])) @ np.array(
        [-np.sin(wall.angle), np.cos(wall.angle)]
    )
    return heights


def _under(shape: Array, body: Thrown, wall: Wall) -> bool:
    radius = body.size[0] if body.kind == "disk" else 0
    return bool((_heights(shape, wall) < radius - NEAR).any())


def _sides(shape: Array) -> tuple[Array, Array]:
    """Unit vectors along the sides, and outward normals, [n, 2] each."""
    along = np.roll(shape, -1, axis=0) - shape
    along = along / np.linalg.norm(along, axis=1)[:, None]
    return along, np.stack([along[:, 1], -along[:, 0]], axis=1)


def _overlap(a: Array, b: Array) -> float:
    """How deep two convex shapes lie in each other: the least over all normals; negative: apart."""
    depths = []
    for one, other in ((a, b), (b, a)):
        _, normals = _sides(one)
        depths += [float((one @ n).max() - (other @ n).min()) for n in normals]
    return min(depths)


def _energy(throw: Throw, poses: list[Pose], kinetic: float) -> float:
    return kinetic + sum(body.mass * G * pose[1] for body, pose in zip(throw.bodies, poses, strict=True))


def _moving_before(throw: Throw) -> float:
    return sum(
        0.5
        * body.mass
        * (body.velocity[0] ** 2 + body.velocity[1] ** 2 + gyration2(body) * body.velocity[2] ** 2)
        for body in throw.bodies
    )


def _energy_before(throw: Throw) -> float:
    return _energy(throw, [body.pose for body in throw.bodies], _moving_before(throw))


def gyration2(body: Thrown) -> float:
    if body.kind == "plate":
        return (body.size[0] ** 2 + body.size[1] ** 2) / 12
    return body.size[0] ** 2 / (12 if body.kind == "rod" else 2)


# ---- equilibrium ----
def _wrenches(
    throw: Throw, poses: list[Pose], place: Array, normal: Array, on: int, against: int | None
) -> list[Array]:
    """Unit loads on both edges of the cone of friction at a place: on a body, and back on another."""
    tangent = np.array([normal[1], -normal[0]])
    found = []
    for sign in (1, -1):
        force = normal + sign * throw.friction * tangent
        load = np.zeros((len(poses), 3))
        for body, way in ((on, 1), (against, -1)):
            if body is not None:
                arm = place - np.array(poses[body][:2])
                load[body] += way * np.array([*force, arm[0] * force[1] - arm[1] * force[0]])
        found.append(load.ravel())
    return found


def unbalanced(throw: Throw, poses: list[Pose], shapes: list[Array]) -> float:
    """Of the weights, what no loads at the places of touch can hold."""
    loads: list[Array] = []
    for (i, shape), wall in itertools.product(enumerate(shapes), throw.walls):
        normal = np.array([-np.sin(wall.angle), np.cos(wall.angle)])
        for place in shape[np.abs(_heights(shape, wall)) <= NEAR]:
            loads += _wrenches(throw, poses, place, normal, i, None)
    for i, k in [*throw.pairs, *((k, i) for i, k in throw.pairs)]:
        for place, side in itertools.product(shapes[i], range(len(shapes[k]))):
            along, normals = _sides(shapes[k])
            from_begin = place - shapes[k][side]
            length = float(np.linalg.norm(shapes[k][side - len(shapes[k]) + 1] - shapes[k][side]))
            if abs(from_begin @ normals[side]) <= NEAR and -NEAR <= from_begin @ along[side] <= length + NEAR:
                loads += _wrenches(throw, poses, place, normals[side], i, k)
    weight = np.array([[0, body.mass * G, 0] for body in throw.bodies]).ravel()
    if not loads:
        return 1.0
    _, left = nnls(np.array(loads).T, weight)
    return float(left / np.abs(weight).sum())
