"""A run over time, true between its steps: on a grid of times, or so that straight lines are true to it.

The states are those of the kernel's own dense output (kernel/events/history.c).  Without a grid the run is
recorded twice: the first record shows how far each kind of quantity goes, the second has so many instants
that a line from one to the next misses none of them by more than a part of that.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.errors import StudyError
from ..compile.flatten import FlatScene
from . import call
from .history import AFTER, BEFORE
from .outcome import History

# What a straight line may miss, of the range of all that has the same unit: a pixel of a picture this high.
PIXEL = 1 / 1000
# Of the size of the scene, and of what crosses it in the whole run: less is no motion.
_NOTHING = 1e-6
# Of the greatest number of a unit: a range below it is rounding.
_ROUNDING = 1e-9
# Of the greatest speed: what changes by more at an instant has jumped.
_JUMP = 1e-9
# A column that turns back at so many of its instants is rounding: steps resolve what moves.
_TURNS = 0.5


def record(
    flat: FlatScene,
    param: npt.ArrayLike | None = None,
    *,
    every: float | None = None,
    bends: Mapping[str, float] | None = None,
) -> History:
    """The history of one case with the columns of `flat.trace`, SI, and its events by name.

    `param` [parameters] defaults to the scene's own values.  `every`: at these times, s; None: at as many as
    straight lines need to be true to a thousandth of the range of all columns with the same unit, or to
    `bends` of the columns in it, in their SI units, and however far of the others.  Raises SimulationError
    if nothing can be recorded, StudyError if it would be too much.
    """
    given = flat.defaults if param is None else param
    if every is not None:
        if not every > 0:
            raise StudyError(f"a history every {every:g} s; a time above zero is wanted")
        return _named(flat, call.trace(flat, given, every=every))
    if bends is None:
        first = call.trace(flat, given)
        size = call.check(flat, given).number["size"]
        bends = {name: PIXEL * far for name, far in _ranges(first, flat.trace, size).items()}
    order = {**flat.instants, **flat.trace}
    allowed = [bends.get(name, np.inf) if name in flat.trace else np.inf for name in order]
    return _named(flat, call.trace(flat, given, bends=allowed))


def thinned(recorded: History, bends: Mapping[str, float]) -> History:
    """Only the instants that straight lines need to miss no more than half of what `bends` allows.

    Before and after an event there are rows as before, but one where nothing jumps.
    """
    scaled = np.column_stack(
        [recorded.columns[name] / bends[name] for name in bends if name in recorded.columns]
    )
    stays = _kept_at_events(recorded)
    kept = [0]
    last = len(recorded.time) - 1
    while kept[-1] < last:
        first = end = kept[-1]
        while (
            end < last
            and (end == first or not stays[end])
            and _is_straight(recorded.time, scaled, first, end + 1)
        ):
            end += 1
        kept.append(max(end, first + 1))
    return replace(
        recorded,
        time=recorded.time[kept],
        columns={name: values[kept] for name, values in recorded.columns.items()},
        mark=recorded.mark[kept],
        events=tuple(recorded.events[row] for row in kept),
    )


def _kept_at_events(recorded: History) -> npt.NDArray[np.bool_]:
    """The rows that stay: after an event, and before one that changes something."""
    stays = recorded.mark == AFTER
    table = np.column_stack(list(recorded.columns.values()))
    size = np.nanmax(np.abs(table), axis=0)
    for row in np.flatnonzero(recorded.mark == BEFORE):
        change = np.abs(table[row + 1] - table[row]) if row + 1 < len(table) else size
        stays[row] = bool(np.any(change > _ROUNDING * size))
    return stays


def _is_straight(time: Floats, scaled: Floats, first: int, end: int) -> bool:
    """Whether the rows between two lie on the line over time from one to the other, to half of one."""
    if end - first < 2:
        return True
    span = time[end] - time[first]
    part = ((time[first + 1 : end] - time[first]) / span if span > 0 else np.zeros(end - first - 1))[:, None]
    line = scaled[first] + part * (scaled[end] - scaled[first])
    return bool(np.nanmax(np.abs(line - scaled[first + 1 : end]), initial=0.0) <= 0.5)


def _ranges(first: History, shown: Mapping[str, tuple[int, str]], size: float) -> dict[str, float]:
    """Of each column how far those of its unit go; infinite where that is rounding."""
    duration = float(np.nanmax(first.time, initial=0.0)) or 1.0
    least = {"m": size, "m/s": size / duration, "1": 1.0, "rad": 1.0, "rad/s": 1.0 / duration}
    found: dict[str, float] = {}
    for unit in set(first.units.values()):
        columns = [
            values for name, values in first.columns.items() if name in shown and first.units[name] == unit
        ]
        finite = [values[np.isfinite(values)] for values in columns]
        ranges = [float(np.ptp(values)) for values in finite if len(values) and not _is_rounding(values)]
        size_of = max((float(np.abs(values).max()) for values in finite if len(values)), default=0.0)
        widest = max(ranges, default=0.0)
        floor = max(_NOTHING * least.get(unit, 0.0), _ROUNDING * size_of)
        found[unit] = widest if widest > floor else np.inf
    return {name: found[unit] for name, unit in first.units.items()}


def _is_rounding(values: Floats) -> bool:
    """Whether a column goes up and down from instant to instant."""
    steps = np.diff(values)
    steps = steps[steps != 0]
    turns = np.count_nonzero(steps[1:] * steps[:-1] < 0)
    return len(steps) > 8 and bool(turns > _TURNS * len(steps))


# ---- instants ----


def _named(flat: FlatScene, recorded: History) -> History:
    """With the names of what happened, and without the columns that tell it."""
    events = [""] * len(recorded.time)
    for row in map(int, np.flatnonzero(recorded.mark == AFTER)):
        before = row - 1 if row and recorded.mark[row - 1] == BEFORE else None
        name = ", ".join(_happened(flat, recorded, before, row))
        events[row] = name
        if before is not None:
            events[before] = name
    columns = {name: recorded.columns[name] for name in flat.trace}
    units = {name: recorded.units[name] for name in flat.trace}
    return replace(recorded, columns=columns, units=units, events=tuple(events))


def _happened(flat: FlatScene, recorded: History, before: int | None, after: int) -> Iterator[str]:
    """Events that fired, then contacts that were struck, closed or opened.  `before`: None at the start."""
    columns = recorded.columns

    def changed(name: str) -> float:
        later = float(columns[name][after])
        earlier = float(columns[name][before]) if before is not None else 0.0
        return 0.0 if later == earlier else later - earlier  # counts of a whole series of blows are infinite

    for name in _things(flat, "count"):
        if changed(f"{name}.count") > 0:
            yield name
    if before is None:
        return
    jumped = any(
        abs(changed(name)) > _JUMP * np.nanmax(np.abs(columns[name]))
        for name in flat.instants
        if _is_speed(name)
    )
    for name in _things(flat, "closed"):
        parts = [
            columns[f"{name}.impulse.{part}"][after]
            for part in ("x", "y")
            if f"{name}.impulse.{part}" in columns
        ]
        closes = changed(f"{name}.closed")
        if jumped and any(part != 0 for part in parts):
            yield name
        elif closes and before:  # what touches as the run begins does not come to it
            yield f"{name} {'closes' if closes > 0 else 'opens'}"


def _things(flat: FlatScene, word: str) -> Iterator[str]:
    """What has this quantity among `flat.instants`."""
    for name in flat.instants:
        thing, _, quantity = name.rpartition(".")
        if quantity == word:
            yield thing


def _is_speed(name: str) -> bool:
    return name.endswith((".velocity.x", ".velocity.y", ".omega"))
