"""A run as what a player needs: signs with the bodies that carry them, and the motion of these.

Each place of a sign is fixed on the ground or on a body, which is seen by drawing the scene at several
instants of the run and looking where the place stays; what stays nowhere (a tangent point, the place of a
contact) is followed.  Between two recorded instants the player moves bodies along straight lines and turns
them evenly: the recording has so many that nothing is off by more than a pixel.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.arrays import Floats
from ..compile.flatten import FlatScene, flatten
from ..compile.histories import HistoryColumns
from ..engine import call, recording
from ..engine.history import AFTER
from ..engine.kernel import status_name
from ..engine.outcome import History
from ..geometry.drawing import Drawing
from ..language.units import factor
from ..pictures.scene import SceneDrawing, drawing_of, plane_of, title_of, usual_length
from ..reading.scene import HasData, SceneData
from .pack import packed, packed_coarsely
from .signs import Sign, SignSketch

# Pixels to an inch of the picture on a screen.
_PIXELS = 100.0
# Recorded instants at most, but for those of events; what needs more is recorded less exactly.
_MOST_ROWS = 1500
_COARSER = 2.0  # times
_TIMES = 8
# Instants at which places are looked at to see where they stay, and at which the extent is.
_LOOKS = 16
_EXTENTS = 48
# Instants at which is followed what stays nowhere.
_FOLLOWED = 300
# Of the picture: a place that moves less stays.
_STAYS = 1e-6
# Of the range of the energies: what a line may miss.
_ENERGY = 1 / 300
_ENERGIES = ("kinetic", "potential", "total")

Poses = Mapping[str, tuple[float, float, float]]
Room = tuple[np.ndarray, np.ndarray]


@dataclass
class Motion:
    """A recorded run that can be drawn at any of its instants."""

    data: SceneData
    flat: FlatScene
    drawing: Drawing
    recorded: History
    unit: str
    room: Room

    def poses(self, row: int) -> dict[str, tuple[float, float, float]]:
        """Of each body, SI, at a recorded instant."""
        return {name: _pose(self.recorded, name, row) for name in self.drawing.bodies}

    def poses_at(self, time: float) -> dict[str, tuple[float, float, float]]:
        """Between two recorded instants, along straight lines; at a jump after it."""
        row = int(np.searchsorted(self.recorded.time, time, side="right")) - 1
        after = min(row + 1, len(self.recorded.time) - 1)
        span = float(self.recorded.time[after] - self.recorded.time[row])
        part = (time - float(self.recorded.time[row])) / span if span > 0 else 0.0
        a, b = self.poses(row), self.poses(after)
        return {
            name: (
                x + part * (b[name][0] - x),
                y + part * (b[name][1] - y),
                turn + part * (b[name][2] - turn),
            )
            for name, (x, y, turn) in a.items()
        }

    def sketch(self, row: int) -> SignSketch:
        """At a recorded instant; nothing is drawn yet."""
        return SignSketch(self.drawing, self.poses(row), self.unit, self.room)

    def signs(self, row: int) -> list[Sign]:
        """The signs of what moves at a recorded instant."""
        sketch = self.sketch(row)
        SceneDrawing(self.data, sketch).draw_moving()
        return sketch.signs.signs

    def rows(self, most: int) -> list[int]:
        """At most so many recorded instants, over the whole run."""
        count = len(self.recorded.time)
        return sorted({round(row) for row in np.linspace(0, count - 1, min(most, count))})


def record(scene: HasData, run: str | None = None) -> Motion:
    """Runs a scene (one of its [runs]; default: the first) and records what moves.

    Raises SceneError for a fault in it, SimulationError if nothing can be recorded.
    """
    flat = flatten(scene, run, history=HistoryColumns.shown)
    drawing = drawing_of(scene.data, flat.run, call.found(flat))
    unit = usual_length(scene.data)
    motion = Motion(
        scene.data, flat, drawing, call.trace(flat, flat.defaults), unit, (np.zeros(2), np.ones(2))
    )
    motion.room = _room(motion)
    bends = _bends(motion)
    for _ in range(_TIMES):
        motion.recorded = recording.thinned(recording.record(flat, bends=bends), bends)
        between = np.count_nonzero(motion.recorded.mark == 0)
        if between <= _MOST_ROWS:
            break
        bends = {name: _COARSER * bend for name, bend in bends.items()}
    return motion


def _pose(recorded: History, body: str, row: int) -> tuple[float, float, float]:
    angle = recorded.columns.get(f"{body}.angle")
    x, y = (float(recorded.columns[f"{body}.{part}"][row]) for part in ("x", "y"))
    return x, y, 0.0 if angle is None else float(angle[row])


def _room(motion: Motion) -> Room:
    """Lower left and upper right of all that is ever seen, in the unit of the picture."""
    found = []
    for row in motion.rows(_EXTENTS):
        found.append(motion.sketch(row).extent())
    low = np.min([low for low, _ in found], axis=0)
    high = np.max([high for _, high in found], axis=0)
    for axis, part in enumerate(("x", "y")):  # between those instants bodies go farther
        far = [
            motion.recorded.columns[f"{name}.{part}"] / factor(motion.unit)[0]
            for name in motion.drawing.bodies
        ]
        low[axis] = min(low[axis], *(float(np.nanmin(values)) for values in far))
        high[axis] = max(high[axis], *(float(np.nanmax(values)) for values in far))
    return low, high


def _bends(motion: Motion) -> dict[str, float]:
    """What lines may miss of places and angles: a pixel; of energies a part of their range."""
    sketch = motion.sketch(0)
    pixel = sketch.pen.inch / _PIXELS
    bends = {}
    for name in motion.drawing.bodies:
        bends[f"{name}.x"] = bends[f"{name}.y"] = pixel * sketch.factor
        bends[f"{name}.angle"] = pixel / sketch.reach(name)
    energies = [f"energy.{kind}" for kind in _ENERGIES if f"energy.{kind}" in motion.recorded.columns]
    far = max((float(np.ptp(motion.recorded.columns[name])) for name in energies), default=0.0)
    bends |= {name: _ENERGY * far for name in energies if far > 0}
    return bends


# ---- the document ----


def document(motion: Motion) -> dict[str, Any]:
    """What the player is given, as JSON has it."""
    recorded, sketch = motion.recorded, motion.sketch(0)
    followed = _Followed(motion)
    signs = list(_signs(motion, followed))
    low, high = sketch.low, sketch.high
    return {
        "title": title_of(motion.data),
        "note": _note(motion),
        "unit": motion.unit,
        "box": [*map(float, low), *map(float, high)],
        "inch": sketch.pen.inch,
        "size": _size(motion),
        "t": packed(recorded.time),
        "bodies": [_body(motion, name, sketch.factor) for name in motion.drawing.bodies],
        "signs": signs,
        "followed": followed.document(),
        "events": list(_events(motion)),
        "energies": _energies(recorded),
        "forces": _arrows(motion, signs, "force"),
        "impulses": _arrows(motion, signs, "impulse"),
    }


def _size(motion: Motion) -> float:
    """How large the scene is at its start, in the unit of the picture."""
    low, high = motion.sketch(0).extent()
    return float((high - low).max())


def _note(motion: Motion) -> str:
    status = status_name(motion.recorded.status)
    notes = [plane_of(motion.data), *([f"run {motion.flat.run}"] if motion.flat.run else [])]
    return ", ".join([*notes, *([f"ended early: {status}"] if status != "ok" else [])])


def _body(motion: Motion, name: str, metre: float) -> dict[str, Any]:
    columns = motion.recorded.columns
    turns = f"{name}.angle" in columns
    return {
        "name": name,
        "x": packed_coarsely(columns[f"{name}.x"] / metre),
        "y": packed_coarsely(columns[f"{name}.y"] / metre),
        "angle": packed(columns[f"{name}.angle"]) if turns else None,
        "vx": packed_coarsely(columns[f"{name}.velocity.x"]),
        "vy": packed_coarsely(columns[f"{name}.velocity.y"]),
    }


class _Followed:
    """Places that stay nowhere, at some instants of the run."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self.places: list[tuple[int, int]] = []  # sign and place in it

    def add(self, sign: int, place: int) -> int:
        """The number of a place that is followed."""
        self.places.append((sign, place))
        return len(self.places) - 1

    def document(self) -> dict[str, Any] | None:
        if not self.places:
            return None
        rows = self.motion.rows(_FOLLOWED)
        drawn = [self.motion.signs(row) for row in rows]
        ways = np.array([[signs[i].places[k] for signs in drawn] for i, k in self.places])
        return {
            "t": packed(self.motion.recorded.time[rows]),
            "x": [packed_coarsely(way[:, 0]) for way in ways],
            "y": [packed_coarsely(way[:, 1]) for way in ways],
        }


def _signs(motion: Motion, followed: _Followed) -> Iterator[dict[str, Any]]:
    """The signs, each place with the number of its carrier (-1: the ground, -2: it is followed)."""
    ground = motion.sketch(0)
    SceneDrawing(motion.data, ground).draw_ground()
    for sign in ground.signs.signs:
        yield _told(sign, [[-1, _short(x), _short(y)] for x, y in sign.places])
    rows = motion.rows(_LOOKS)
    looks = [motion.signs(row) for row in rows]
    carriers = _Carriers(motion, rows)
    for number, sign in enumerate(looks[0]):
        places: list[list[float]] = []
        for k in range(len(sign.places)):
            way = np.array([look[number].places[k] for look in looks])
            carrier, own = carriers.of(way)
            if carrier == -2:
                places.append([-2, followed.add(number, k), 0])
            else:
                places.append([carrier, _short(own[0]), _short(own[1])])
        yield _told(sign, places)


def _told(sign: Sign, places: list[list[float]]) -> dict[str, Any]:
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
        """The carrier of a place that goes along `way` [instants, 2], and its place there [2]; -2: none."""
        if np.ptp(way, axis=0).max() <= self.near:
            return -1, way[0]
        for body, pose in enumerate(self.poses):
            x, y = (way - pose[:, :2]).T
            c, s = np.cos(pose[:, 2]), np.sin(pose[:, 2])
            own = np.column_stack([c * x + s * y, c * y - s * x])
            if np.ptp(own, axis=0).max() <= self.near:
                return body, own[0]
        return -2, way[0]


def _events(motion: Motion) -> Iterator[dict[str, Any]]:
    """What happened, with the row after it; instants without a name only if something jumped."""
    recorded = motion.recorded
    for row in np.flatnonzero(recorded.mark == AFTER):
        name = recorded.events[row]
        if name and row:
            yield {"row": int(row), "name": name}


def _energies(recorded: History) -> dict[str, Any]:
    return {
        kind: packed_coarsely(recorded.columns[f"energy.{kind}"])
        for kind in _ENERGIES
        if f"energy.{kind}" in recorded.columns
    }


def _arrows(motion: Motion, signs: Sequence[Mapping[str, Any]], word: str) -> list[dict[str, Any]]:
    """Forces or impulses of elements at the places where their names stand, and when there are any."""
    anchors = {sign["text"]: sign["at"][0] for sign in signs if sign["kind"] == "name"}
    recorded, found = motion.recorded, []
    for address in recorded.columns:
        name, _, quantity = address.partition(".")
        if quantity != f"{word}.x" or name not in anchors:
            continue
        x, y = (np.nan_to_num(recorded.columns[f"{name}.{word}.{part}"]) for part in ("x", "y"))
        if word == "impulse":
            x, y = (values * (recorded.mark == AFTER) for values in (x, y))
        size = float(np.hypot(x, y).max(initial=0.0))
        if size > 0 and math.isfinite(size):
            found.append(
                {"name": name, "at": anchors[name], "x": packed_coarsely(x), "y": packed_coarsely(y)}
            )
    return found
