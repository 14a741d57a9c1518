"""Whether the end of a run can come at all: an end at a time is known before anything is computed."""

from __future__ import annotations

from collections.abc import Collection

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..language.leaves import evaluate, names
from ..reading.scene import SceneData

# Of the time at which a condition on time comes true: what the condition may miss zero by there.
_STRAIGHT = 1e-9


def check_ends(tables: Tables, data: SceneData, open_parameters: Collection[str]) -> None:
    """Raises SceneError if `until` names times only, each before the start or beyond the limit of time.

    Times that depend on `open_parameters`, which a sweep or a find chooses, are left to the run.  A limit
    that is given is meant.
    """
    limit = layout.PM_MAX_TIME if data.solve.max_time is None else float("inf")
    hopeless: dict[int, tuple[int, str]] = {}
    rows = tables.rows[layout.PM_TABLE_UNTIL]
    for number, row in enumerate(rows):
        reason = _why_never(tables, row[layout.PM_UNTIL_EVENT], limit, open_parameters)
        if reason:
            hopeless.setdefault(row[layout.PM_UNTIL_GROUP], (number, reason))
    if not rows or len(hopeless) < len(data.until):
        return
    number, reason = next(iter(hopeless.values()))
    written = [text for group in data.until for text in group][number]
    raise SceneError(reason, path=tables.names[layout.PM_TABLE_UNTIL][number], value=written)


def _why_never(tables: Tables, event: int, limit: float, open_parameters: Collection[str]) -> str:
    """Why an event at times alone does not come within the run; "" if it does, or if that is not known."""
    triggers = [row for row in tables.rows[layout.PM_TABLE_TRIGGER] if row[layout.PM_TRIGGER_EVENT] == event]
    reasons = [_why_not(tables, row, limit, open_parameters) for row in triggers]
    return reasons[0] if reasons and all(reasons) else ""


def _why_not(tables: Tables, row: tuple[int, ...], limit: float, open_parameters: Collection[str]) -> str:
    found = _line(tables, row, open_parameters)
    if found is None:
        return ""
    due, slope = found
    kind = row[layout.PM_TRIGGER_KIND]
    if (kind == layout.PM_TRIGGER_RISE and slope < 0) or (kind == layout.PM_TRIGGER_FALL and slope > 0):
        return "time only grows: this is true from the start and never becomes so; turn the sign round"
    if due < 0:
        return f"this is at t = {due:g} s, and a run begins at t = 0 s"
    if due > limit:
        return (
            f"this is at t = {due:g} s, but a run ends at {limit} s where solve.max_time is not given; "
            f'give solve.max_time = "{due:g} s", or more'
        )
    return ""


def _line(
    tables: Tables, row: tuple[int, ...], open_parameters: Collection[str]
) -> tuple[float, float] | None:
    """When a condition that is a straight line in time is zero, and its slope; None for any other."""
    if row[layout.PM_TRIGGER_KIND] > layout.PM_TRIGGER_FALL:
        return None
    node = tables.node_of(row[layout.PM_TRIGGER_PROGRAM])
    leaves = {leaf: tables.measure_index(leaf) for leaf in names(node)}
    if any(
        index is None and tables.needs_of(str(leaf)) & set(open_parameters) for leaf, index in leaves.items()
    ):
        return None
    measures = [tables.rows[layout.PM_TABLE_MEASURE][index] for index in leaves.values() if index is not None]
    if any(measure[layout.PM_MEASURE_KIND] != layout.PM_MEASURE_TIME for measure in measures):
        return None

    def at(time: float) -> float:
        return evaluate(node, lambda leaf: time if leaves[leaf] is not None else tables.default(leaf))

    here, slope = at(0.0), at(1.0) - at(0.0)
    if not measures or slope == 0 or slope != slope:
        return None
    due = -here / slope
    straight = abs(at(due)) <= _STRAIGHT * max(abs(here), abs(slope * due), abs(slope))
    return (due, slope) if straight else None
