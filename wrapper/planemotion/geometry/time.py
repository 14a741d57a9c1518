"""Values that may depend on the time: expressions over the parameters and t."""

from __future__ import annotations

from .. import _layout as layout
from ..language.dimensions import TIME, Dimension
from ..language.leaves import Leaf, names, substitute
from ..language.tree import Name, Node
from ..model.readers import Value
from .packing import Tables
from .parameters import Reader


def over_time(reader: Reader, tables: Tables, written: Value, where: str, wanted: Dimension) -> Node:
    """An expression of parameters and t, with t made the measure of time.  Raises SceneError."""

    def resolve(leaf: Leaf) -> Dimension | None:
        return TIME if leaf == Name("t") else reader.parameters.dimension_of(leaf)

    node = reader.number_of(written, where, wanted, resolve)
    if Name("t") not in names(node):
        return node
    time = tables.measure_leaf(empty_measure(layout.PM_MEASURE_TIME), where)
    return substitute(node, lambda leaf: time if leaf == Name("t") else leaf)


def empty_measure(kind: int) -> dict[int, int]:
    """A row of the measure table of which nothing but the kind is said."""
    row = dict.fromkeys(range(layout.PM_MEASURE_COLUMNS), layout.PM_NONE)
    row[layout.PM_MEASURE_KIND] = kind
    row[layout.PM_MEASURE_PART] = layout.PM_PART_NONE
    return row
