"""What an animation shows beside bodies: traces, arrows, blows, events, energies; and how fast it goes.

The player of a page, GIF and MP4 all show what stands here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..engine.history import AFTER
from ..language.units import factor
from ..model.words import unknown
from ..pen.symbols import Place
from ..pictures.known import STILL
from .carried import ALONE, GROUND, Anchor, signs_of
from .moving import ENERGIES, Motion, Room
from .shows import USUALLY, Shows
from .timing import Timing

# Of an arrow that is as long as arrows are at most, but for a few, and of the longest, in inches.
_ARROW, _MOST = 1.0, 1.7
# Of the forces of a run, so many are not larger than the arrow of that length shows.
_USUAL = {"velocity": 1.0, "force": 0.98, "impulse": 1.0}
# A way has a corner at least where its carrier has turned so far, in rad; at most so many between instants.
_TURN, _CORNERS = 0.1, 200


@dataclass
class Arrow:
    """What has a direction [instants], SI, by name, and where it is drawn."""

    name: str
    at: Anchor
    x: Floats
    y: Floats

    @property
    def sizes(self) -> Floats:
        return np.hypot(self.x, self.y)


class Beside:
    """Of a motion, what `shows` asks for.  Raises SceneError for a trace of a point that no body has.

    `signs`, `followed`: of carried.py; `traces`: points with their names; `events`: rows after them, and
    names; `arrows`: velocities, forces and impulses."""

    def __init__(self, motion: Motion, shows: Shows = USUALLY) -> None:
        self.motion = motion
        self.shows = shows
        self.signs, self.followed = signs_of(motion)
        self.traces = _traced(motion, shows)
        self.events = list(_events(motion))
        self.arrows = {
            "velocity": list(_velocities(motion)),
            "force": list(_loads(motion, self.signs, "force")),
            "impulse": list(_loads(motion, self.signs, "impulse")),
        }
        times = motion.recorded.time
        rows = [row for row, _ in self.events]
        self.timing = Timing(float(times[-1]), times[rows], "slow" in shows.words)

    @property
    def energies(self) -> dict[str, Floats]:
        """Kinetic, potential and total energy [instants] in J, as far as there are."""
        columns = self.motion.recorded.columns
        return {kind: columns[f"energy.{kind}"] for kind in ENERGIES if f"energy.{kind}" in columns}

    @cached_property
    def inch_of(self) -> dict[str, float]:
        """Of each kind of arrow what has the length of an inch: in m/s, N, N s."""
        return {kind: _usual(arrows, _USUAL[kind]) / _ARROW for kind, arrows in self.arrows.items()}

    def told(self) -> dict[str, Any]:
        """How arrows and the view are, as the player reads it."""
        view = {"follows": self.motion.follows, "view": self.motion.view}
        return {**view, "inch_of": {**self.inch_of, "most": _MOST}}

    def place(self, anchor: Anchor, time: float) -> Place:
        """Where something hangs at a time, in the unit of the picture."""
        carrier, x, y = anchor
        if carrier == GROUND:
            return x, y
        if carrier == ALONE:
            return self.followed.at(int(x), time)
        gx, gy, turn = list(self.motion.poses_at(time).values())[int(carrier)]
        metre, c, s = factor(self.motion.unit)[0], math.cos(turn), math.sin(turn)
        return gx / metre + c * x - s * y, gy / metre + s * x + c * y

    def arrow(self, kind: str, one: Arrow, time: float) -> tuple[float, float]:
        """How far an arrow goes at a time, in inches."""
        x, y = (self.motion.value_at(part, time) / self.inch_of[kind] for part in (one.x, one.y))
        cut = min(1.0, _MOST / max(math.hypot(x, y), 1e-9))
        return x * cut, y * cut

    @cached_property
    def ways(self) -> dict[str, Floats]:
        """Of each traced point its whole way: times and places [n, 3]."""
        return {
            name: np.array([(time, *self.place(anchor, time)) for time in self._corners(anchor)])
            for name, anchor in self.traces
        }

    def room_at(self, time: float) -> Room:
        """Lower left and upper right of what is seen at a time."""
        if not self.motion.follows:
            return self.motion.room
        metre = factor(self.motion.unit)[0]
        middle = np.mean([pose[:2] for pose in self.motion.poses_at(time).values()], axis=0) / metre
        return middle - 0.5 * self.motion.view, middle + 0.5 * self.motion.view

    def _corners(self, anchor: Anchor) -> Floats:
        times, body = self.motion.recorded.time, int(anchor[0])
        names = list(self.motion.drawing.bodies)
        angle = self.motion.recorded.columns.get(f"{names[body]}.angle") if body >= 0 else None
        if angle is None or len(times) < 2:
            return times
        turns = np.abs(np.diff(angle)) / _TURN
        counts = 1 + np.minimum(np.nan_to_num(turns), _CORNERS).astype(int)
        parts = [np.linspace(times[i], times[i + 1], count, endpoint=False) for i, count in enumerate(counts)]
        return np.concatenate([*parts, times[-1:]])


def _events(motion: Motion) -> Iterator[tuple[int, str]]:
    """What happened, by the row after it; the start is none."""
    recorded = motion.recorded
    for row in np.flatnonzero(recorded.mark == AFTER):
        name = recorded.events[row]
        if name and row:
            yield int(row), name


def _traced(motion: Motion, shows: Shows) -> list[tuple[str, Anchor]]:
    """The points whose ways are drawn: those that are named, else all bodies that are particles."""
    sketch, bodies = motion.sketch(0), motion.drawing.bodies
    if not shows.traces:
        return [(name, [i, 0.0, 0.0]) for i, (name, body) in enumerate(bodies.items()) if not body.rotates]
    found = []
    for text in shows.traces:
        name, point = motion.drawing.names.owner(text)
        if name not in bodies:
            raise SceneError(unknown(name, bodies, "body"), path="trace", value=text)
        points = motion.drawing.marks(name).points
        if (point or "G") not in points:
            raise SceneError(unknown(point, points, f"point of {name}"), path="trace", value=text)
        found.append((text, [list(bodies).index(name), *sketch.own_place(name, points[point or "G"])]))
    return found


def _velocities(motion: Motion) -> Iterator[Arrow]:
    """Of the mass centres; none where it is but the rounding of what moves fastest."""
    arrows = []
    size, fastest = motion.size * factor(motion.unit)[0], 0.0
    for i, name in enumerate(motion.drawing.bodies):
        x, y, omega = (
            np.nan_to_num(motion.recorded.columns.get(f"{name}.{part}", np.zeros(1)))
            for part in ("velocity.x", "velocity.y", "omega")
        )
        arrows.append(Arrow(name, [i, 0.0, 0.0], x, y))
        fastest = max(fastest, float(arrows[-1].sizes.max()), size * float(np.abs(omega).max()))
    for one in arrows:
        moves = one.sizes > STILL * fastest
        yield Arrow(one.name, one.at, one.x * moves, one.y * moves)


def _loads(motion: Motion, signs: Sequence[Mapping[str, Any]], word: str) -> Iterator[Arrow]:
    """Forces or impulses of elements at the places where their names stand, and when there are any."""
    anchors = {sign["text"]: sign["at"][0] for sign in signs if sign["kind"] == "name"}
    recorded = motion.recorded
    for address in recorded.columns:
        name = address.removesuffix(f".{word}.x")
        if name == address or name not in anchors:
            continue
        x, y = (np.nan_to_num(recorded.columns[f"{name}.{word}.{part}"]) for part in ("x", "y"))
        if word == "impulse":
            x, y = (values * (recorded.mark == AFTER) for values in (x, y))
        size = float(np.hypot(x, y).max(initial=0.0))
        if size > 0 and math.isfinite(size):
            yield Arrow(name, anchors[name], x, y)


def _usual(arrows: Sequence[Arrow], part: float) -> float:
    """What that part of all sizes that are not 0 does not exceed; 1 if there is none."""
    sizes = np.concatenate([one.sizes for one in arrows]) if arrows else np.zeros(0)
    sizes = np.sort(sizes[(sizes > 0) & np.isfinite(sizes)])
    return float(sizes[min(len(sizes) - 1, int(part * len(sizes)))]) if len(sizes) else 1.0
