"""Numbers of forces that depend on the motion: read when all that has a name is known.

An element is read before there are measures of it and of the others.  What it says of the motion is a leaf
that waits; a program with such a leaf has its place in the row of the force, and is made at the end.  So is
one with a measure of the element itself: it may switch.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import Faults
from ..language.address import Address
from ..language.dimensions import Dimension
from ..language.leaves import Leaf, names, substitute
from ..language.tree import Name, Node
from ..model.readers import Value
from ..model.words import SCENE_QUANTITIES
from .packing import Tables

_WAITS = "?"


@dataclass(frozen=True)
class Waiting:
    """An expression as it is written, what it is for, and the dimension it must have."""

    node: Node
    written: Value
    where: str
    wanted: Dimension


class MotionPrograms:
    """What waits, and the programs that it is a part of."""

    def __init__(self, tables: Tables) -> None:
        self._tables = tables
        self._waiting: list[Waiting] = []
        self._late: list[tuple[int, int, Node, str]] = []

    def leaf(self, waiting: Waiting) -> Node:
        """What stands for an expression until it is read."""
        self._waiting.append(waiting)
        return Name(f"{_WAITS}{len(self._waiting) - 1}")

    def program(self, node: Node, where: str, row: int, column: int) -> int:
        """The program of an expression for a column of a force; 0 for one that waits, or that may switch by
        what the element itself reads of the motion."""
        if not waits(node) and not self._reads_motion(node):
            return self._tables.program(node, where)
        self._late.append((row, column, node, where))
        return 0

    def _reads_motion(self, node: Node) -> bool:
        """Whether it reads a measure of more than the time."""
        kinds = (row[layout.PM_MEASURE_KIND] for row in self._tables.measure_rows(node))
        return any(kind != layout.PM_MEASURE_TIME for kind in kinds)

    def finish(self, read: Callable[[Waiting], Node], program: Callable[[Node, str], Node]) -> None:
        """Makes what waits.

        `read` gives an expression over the kernel's leaves, `program` what becomes of a whole one.

        Raises SceneError for a fault in any of them."""
        faults = Faults()
        known: dict[str, Node] = {}
        for number, waiting in enumerate(self._waiting):
            with faults.noted():
                known[f"{_WAITS}{number}"] = read(waiting)
        faults.tell()
        for row, column, node, where in self._late:
            whole = program(substitute(node, lambda leaf: known.get(str(leaf), leaf)), where)
            self._tables.put(layout.PM_TABLE_FORCE, row, column, self._tables.program(whole, where))


def waits(node: Node) -> bool:
    """Whether some of it waits."""
    return any(str(leaf).startswith(_WAITS) for leaf in names(node))


def reads_motion(node: Node, parameters: Collection[str]) -> bool:
    """Whether it names a measure of the motion: something other than parameters and the time t."""
    return any(_is_measure(leaf) and str(leaf) not in parameters and str(leaf) != "t" for leaf in names(node))


def _is_measure(leaf: Leaf) -> bool:
    return isinstance(leaf, Address) or leaf.text in SCENE_QUANTITIES
