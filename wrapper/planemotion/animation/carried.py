"""The signs of a motion with what carries them: the ground, a body, or nothing, then their ways are followed.

Each place of a sign is fixed on the ground or on a body, which is seen by drawing the scene at several
instants of the run and looking where the place stays; what stays nowhere (a tangent point, the place of a
contact) is followed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..base.arrays import Floats
from ..language.units import factor
from ..pictures.scene import SceneDrawing
from .moving import Motion
from .signs import Sign

# Carrier (the number of a body; GROUND; ALONE: then the number of a way and 0), and the place there, in the
# unit of the picture.
Anchor = list[float]
GROUND, ALONE = -1, -2
# Instants at which places are looked at to see where they stay.
_LOOKS = 16
# Instants at which is followed what stays nowhere.
_FOLLOWED = 300
# Of the picture: a place that moves less stays.
_STAYS = 1e-6


@dataclass
class Followed:
    """Places that stay nowhere: `times` [n] of a run, and what is drawn then."""

    times: Floats
    draw: Callable[[], Sequence[Sequence[Sign]]]
    places: list[tuple[int, int]] = field(default_factory=list)  # sign and place in it

    def add(self, sign: int, place: int) -> int:
        """The number of the way of a place."""
        self.places.append((sign, place))
        return len(self.places) - 1

    @cached_property
    def ways(self) -> list[Floats]:
        """Of each place its way [n, 2]; asked for when all places are there."""
        if not self.places:
            return []
        drawn = self.draw()
        return [np.array([signs[i].places[k] for signs in drawn]) for i, k in self.places]

    def at(self, number: int, time: float) -> tuple[float, float]:
        """A place at a time."""
        way = self.ways[number]
        return float(np.interp(time, self.times, way[:, 0])), float(np.interp(time, self.times, way[:, 1]))


def signs_of(motion: Motion) -> tuple[list[dict[str, Any]], Followed]:
    """The signs with their carriers, and the ways of what is carried by none."""
    rows = motion.rows(_FOLLOWED)
    followed = Followed(motion.recorded.time[rows], lambda: [motion.signs(row) for row in rows])
    return list(_signs(motion, followed)), followed


def _signs(motion: Motion, followed: Followed) -> Iterator[dict[str, Any]]:
    """The signs, each place with the number of its carrier (GROUND, or ALONE)."""
    ground = motion.sketch(0)
    SceneDrawing(motion.data, ground).draw_ground()
    for sign in ground.signs.signs:
        yield _told(sign, [[GROUND, _short(x), _short(y)] for x, y in sign.places])
    rows = motion.rows(_LOOKS)
    looks = [motion.signs(row) for row in rows]
    carriers = _Carriers(motion, rows)
    for number, sign in enumerate(looks[0]):
        places: list[Anchor] = []
        for k in range(len(sign.places)):
            way = np.array([look[number].places[k] for look in looks])
            carrier, own = carriers.of(way)
            if carrier == ALONE:
                places.append([ALONE, followed.add(number, k), 0])
            else:
                places.append([carrier, _short(own[0]), _short(own[1])])
        yield _told(sign, places)


def _told(sign: Sign, places: list[Anchor]) -> dict[str, Any]:
    told: dict[str, Any] = {"kind": sign.kind, "at": places, "stroke": sign.stroke, "order": sign.order}
    for key in ("size", "fill", "text"):
        if getattr(sign, key):
            told[key] = getattr(sign, key)
    if sign.width != 1.0:
        told["width"] = sign.width
    if sign.dashes:
        told["dashes"] = sign.dashes
    return told


def _short(number: float) -> float:
    return float(f"{number:.6g}")


class _Carriers:
    """Where places stay: on the ground, or on which body, at some instants of the run."""

    def __init__(self, motion: Motion, rows: Sequence[int]) -> None:
        metre = factor(motion.unit)[0]
        self.near = _STAYS * float(np.max(motion.room[1] - motion.room[0]))
        self.poses = [
            np.array([motion.poses(row)[name] for row in rows]) / (metre, metre, 1.0)
            for name in motion.drawing.bodies
        ]

    def of(self, way: Floats) -> tuple[int, Floats]:
        """The carrier of a place that goes along `way` [instants, 2], and its place there; ALONE: none."""
        if np.ptp(way, axis=0).max() <= self.near:
            return GROUND, way[0]
        for body, pose in enumerate(self.poses):
            x, y = (way - pose[:, :2]).T
            c, s = np.cos(pose[:, 2]), np.sin(pose[:, 2])
            own = np.column_stack([c * x + s * y, c * y - s * x])
            if np.ptp(own, axis=0).max() <= self.near:
                return body, own[0]
        return ALONE, way[0]
