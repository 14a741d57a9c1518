"""Nudges: the side to which an unstable rest or an unstable steady motion is left, as a program."""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..language.parser import parse
from ..language.tree import Binary, Node, Number, negative
from .measures import Measures

_VELOCITIES = (layout.PM_MEASURE_OMEGA, layout.PM_MEASURE_VELOCITY)
_LINEAR_PARTS = (layout.PM_PART_NONE, layout.PM_PART_X, layout.PM_PART_Y, layout.PM_PART_ALONG)


def add_nudge(text: str, measures: Measures, tables: Tables, where: str) -> int:
    """The program that becomes > 0 on the side of a condition such as "AB.omega < 0".  Raises SceneError."""
    try:
        return _program(text, measures, tables, where)
    except SceneError as error:
        raise error.at(path=where, value=text) from None


def _program(text: str, measures: Measures, tables: Tables, where: str) -> int:
    node = parse(text)
    if not isinstance(node, Binary) or node.operator not in ("<", ">") or not _is_nothing(node.right):
        raise SceneError('a side is wanted: a velocity < 0 or > 0, such as "AB.omega < 0"')
    left = measures.lower(node.left, where).node
    index = tables.measure_index(left)
    row = None if index is None else tables.rows[layout.PM_TABLE_MEASURE][index]
    if (
        row is None
        or row[layout.PM_MEASURE_KIND] not in _VELOCITIES
        or row[layout.PM_MEASURE_PART] not in _LINEAR_PARTS
    ):
        raise SceneError("only a velocity can have a side: omega of a body, velocity.x or .y of a point")
    return tables.program(left if node.operator == ">" else negative(left), where)


def _is_nothing(node: Node) -> bool:
    return isinstance(node, Number) and node.value_si == 0
