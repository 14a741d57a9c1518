"""Forces and couples of given power: they go the way of the motion, or against it (power < 0)."""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import SceneError
from ..language.dimensions import POWER
from ..language.tree import Node
from ..model.readers import Value
from .time import empty_measure
from .writer import Writer


def power(to: Writer, written: Value | None, where: str, **others: object) -> Node:
    """What a force does in each second.  Raises SceneError if one of the `others` is given beside it."""
    assert written is not None
    for key, other in others.items():
        if other is not None:
            raise SceneError(f"give power or {key}, not both", path=where)
    return to.over_time(written, where, POWER)


def measured(to: Writer, kind: int, a: int, where: str, part: int = layout.PM_PART_NONE) -> Node:
    """A measure of the motion: of a point, or of a body."""
    row = empty_measure(kind) | {layout.PM_MEASURE_A: a, layout.PM_MEASURE_PART: part}
    return to.tables.measure_leaf(row, where)
