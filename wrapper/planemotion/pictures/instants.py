"""A scene as it is at an instant of its run: at a time, or when something happens."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from ..base.errors import SceneError
from ..compile.asks import just_after
from ..compile.flatten import FlatScene, flatten
from ..compile.histories import HistoryColumns
from ..engine import call, recording
from ..engine.history import AFTER, BEFORE
from ..engine.outcome import History
from ..language.units import NUMBER, seconds_of
from ..reading.scene import HasData
from .known import at_row
from .scene import Pose, Start, drawing_of, start_of

# How a time begins, and no name.
_NUMBER = re.compile(rf"\s*[+-]?\s*{NUMBER}")
# The rows at the ends of a run.
_ENDS = {"start": 0, "end": -1}


def instant_of(scene: HasData, at: str, run: str | None = None) -> Start:
    """What is drawn of a run (default: the first) at an instant: "0.3 s", "strike", "before strike 2", "end".

    Names are those of events, and of contacts that are struck.  Raises SceneError for a fault in the scene,
    and for an instant that the run does not come to, SimulationError if nothing can be recorded.
    """
    start = start_of(scene, run)
    if start.fault:
        return start
    flat = flatten(scene, run, history=HistoryColumns.shown)
    recorded, row = row_at(flat, at)
    poses, velocities = (
        {name: _three(recorded, row, name, words) for name in start.drawing.bodies}
        for words in (("x", "y", "angle"), ("velocity.x", "velocity.y", "omega"))
    )
    drawing = drawing_of(scene.data, flat.run, call.found(flat))
    time = f"t = {recorded.time[row]:.6g} s"
    return replace(
        start,
        drawing=drawing,
        poses=poses,
        velocities=velocities,
        known=at_row(recorded, row),
        when=time if _seconds(at) is not None else f"{at.strip()}, {time}",
    )


def _three(recorded: History, row: int, name: str, words: tuple[str, str, str]) -> Pose:
    """Quantities of a body; 0 where it has none."""
    columns = (recorded.columns.get(f"{name}.{word}") for word in words)
    x, y, turn = (0.0 if column is None else float(column[row]) for column in columns)
    return x, y, turn


def row_at(flat: FlatScene, at: str) -> tuple[History, int]:
    """The run and its row at a time, just after an event or before it.  Errors as of `instant_of`."""
    seconds = _seconds(at)
    return _at_event(flat, at) if seconds is None else _at_time(flat, at, seconds)


def _seconds(at: str) -> float | None:
    """A time; None where it is a name."""
    if not _NUMBER.match(at):
        return None
    seconds = seconds_of(at, "at", 'a time such as "0.3 s", or an event, is wanted')
    if seconds < 0:
        raise SceneError("a run begins at 0 s", path="at", value=at)
    return seconds


def _at_time(flat: FlatScene, at: str, seconds: float) -> tuple[History, int]:
    """The run and its row at a time: the first of a grid whose second time is that one."""
    recorded = recording.record(flat, every=seconds or None, bends={} if seconds == 0 else None)
    row = int(np.searchsorted(recorded.time, seconds))
    if row == len(recorded.time):
        raise SceneError(f"the run ends before it, at {recorded.time[-1]:.6g} s", path="at", value=at)
    return recorded, row


def _at_event(flat: FlatScene, at: str) -> tuple[History, int]:
    """The run and its row at its start or end, or when something has happened for the nth time.

    "strike" is just after it, "before strike" just before."""
    recorded = recording.record(flat, bends={})
    if at.strip() in _ENDS:
        return recorded, _ENDS[at.strip()]
    first, _, rest = at.strip().partition(" ")
    side, named = (BEFORE, rest) if is_before(at) else (AFTER, at)
    name, _, number = named.strip().partition(" ")
    rows = [row for row in np.flatnonzero(recorded.mark == side) if name in _happened(recorded, int(row))]
    nth = int(number) if number.strip().isdigit() else 0 if number else 1
    if not 1 <= nth <= len(rows):
        happened = sorted({name for row in range(len(recorded.events)) for name in _happened(recorded, row)})
        known = ", ".join([*happened, *_ENDS])
        none = f"nothing of that name happens in the run; there is {known}"
        often = f"the run has {len(rows)} of these" if rows else none
        if first == "after" and rest:
            often = just_after(rest)
        raise SceneError(often, path="at", value=at)
    return recorded, int(rows[nth - 1])


def _happened(recorded: History, row: int) -> list[str]:
    """Names of what happened there."""
    return [name for name in recorded.events[row].split(", ") if name]


def is_before(at: str) -> bool:
    """Whether it is the instant just before an event."""
    return at.strip().startswith("before ")
