"""A recorded run that can be drawn at any of its instants.

Between two recorded instants bodies move along straight lines and turn evenly: the recording has so many that
nothing is off by more than a pixel.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.arrays import Floats
from ..compile.flatten import FlatScene, flatten
from ..compile.histories import HistoryColumns
from ..engine import call, recording
from ..engine.outcome import History
from ..geometry.drawing import Drawing
from ..language.units import factor
from ..pictures.known import at_row
from ..pictures.scene import SceneDrawing, drawing_of, usual_length
from ..reading.scene import HasData, SceneData
from .signs import Sign, SignSketch

# Pixels to an inch of the picture on a screen.
_PIXELS = 100.0
# Recorded instants at most, but for those of events; what needs more is recorded less exactly.
_MOST_ROWS = 1500
_COARSER = 2.0  # times
_TIMES = 8
# Instants at which the extent is looked at.
_EXTENTS = 48
# Times as large as the scene at its start: then the view follows the motion, and shows so much.
_FAR, _VIEW = 40.0, 2.5
# Of the range of the energies: what a line may miss.
_ENERGY = 1 / 300
ENERGIES = ("kinetic", "potential", "total")

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

    def between(self, time: float) -> tuple[int, int, float]:
        """The recorded instants before and after a time, and the part of the way; at a jump after it."""
        row = int(np.searchsorted(self.recorded.time, time, side="right")) - 1
        after = min(row + 1, len(self.recorded.time) - 1)
        span = float(self.recorded.time[after] - self.recorded.time[row])
        return row, after, (time - float(self.recorded.time[row])) / span if span > 0 else 0.0

    def value_at(self, values: Floats, time: float) -> float:
        """Of values [instants] what a line between two of them says."""
        row, after, part = self.between(time)
        return float(values[row] + part * (values[after] - values[row]))

    def poses_at(self, time: float) -> dict[str, tuple[float, float, float]]:
        """Between two recorded instants, along straight lines; at a jump after it."""
        row, after, part = self.between(time)
        a, b = self.poses(row), self.poses(after)
        return {
            name: (
                x + part * (b[name][0] - x),
                y + part * (b[name][1] - y),
                turn + part * (b[name][2] - turn),
            )
            for name, (x, y, turn) in a.items()
        }

    def known_at(self, time: float) -> dict[str, float]:
        """All that was recorded, between two recorded instants along straight lines."""
        return {name: self.value_at(values, time) for name, values in self.recorded.columns.items()}

    def sketch(self, row: int) -> SignSketch:
        """At a recorded instant; nothing is drawn yet."""
        view = self.view if self.follows else math.inf
        known = at_row(self.recorded, row)
        return SignSketch(self.drawing, self.poses(row), self.unit, self.room, view, known)

    def signs(self, row: int) -> list[Sign]:
        """The signs of what moves at a recorded instant."""
        sketch = self.sketch(row)
        SceneDrawing(self.data, sketch).draw_moving()
        return sketch.signs.signs

    def extent(self, row: int) -> Room:
        """Lower left and upper right at a recorded instant, in the unit of the picture."""
        return SignSketch(self.drawing, self.poses(row), self.unit, self.room).extent()

    @cached_property
    def size(self) -> float:
        """How large the scene is at its start, in the unit of the picture."""
        low, high = self.extent(0)
        return float((high - low).max())

    @property
    def follows(self) -> bool:
        """Whether the picture of the whole run is much larger than what moves: then the view follows that."""
        low, high = self.room
        return float((high - low).max()) > _FAR * self.size

    @property
    def view(self) -> float:
        """How much a view that follows shows, in the unit of the picture."""
        return _VIEW * self.size

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
        found.append(motion.extent(row))
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
    energies = [f"energy.{kind}" for kind in ENERGIES if f"energy.{kind}" in motion.recorded.columns]
    far = max((float(np.ptp(motion.recorded.columns[name])) for name in energies), default=0.0)
    bends |= {name: _ENERGY * far for name in energies if far > 0}
    return bends
