"""Finds: from [find] to the kernel's tables, and back to words what a find has to say.

A condition is a comparison of asks, parameters and measures at the end of the run, or "EVENT happens".
`A = B` becomes the difference, whose root is looked for; `A > B` the difference, whose root bounds where it
holds.
What can only be yes or no (an event, a count, a closed contact, conditions joined by and, or, not) is an
outcome, whose change is bisected.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..geometry.parameters import Reader
from ..language.dimensions import DIMENSIONLESS
from ..language.homogeneity import dimension
from ..language.leaves import names
from ..language.tree import Binary, Name, Node, Number, Unary
from ..model.readers import Value
from ..model.tables import Find
from ..model.words import unknown
from .asks import Asks
from .events import firing
from .measures import Measures

_HAPPENS = re.compile(r"(.+?)\s+happens")
_MARGIN = {
    ">": layout.PM_CONDITION_POSITIVE,
    "<": layout.PM_CONDITION_POSITIVE,
    ">=": layout.PM_CONDITION_NOT_NEGATIVE,
    "<=": layout.PM_CONDITION_NOT_NEGATIVE,
}
# Measures that are whole numbers: a comparison of them is yes or no.
_WHOLE = (layout.PM_MEASURE_CONTACT_CLOSED, layout.PM_MEASURE_EVENT_COUNT)
_GOALS = {
    None: layout.PM_FIND_VALUE,
    "greatest": layout.PM_FIND_GREATEST,
    "least": layout.PM_FIND_LEAST,
}
_MOST = layout.PM_FIND_MOST_CONDITIONS


@dataclass(frozen=True)
class FindCondition:
    """A condition as written, and what its reading is: the difference of its sides in `unit` (SI), or yes and
    no (`unit` is None)."""

    text: str
    path: str
    unit: str | None


@dataclass(frozen=True)
class FlatFind:
    """What turns the numbers of a find back into words.

    `path`: "find" or "runs.NAME.find"; `vary`: names of the sought parameters; `bounds`: indices of the
    values of each one's bounds; `goal`: "greatest", "least" or None, of what `of` says.
    """

    path: str
    vary: tuple[str, ...]
    bounds: tuple[tuple[int, int], ...]
    conditions: tuple[FindCondition, ...]
    goal: str | None
    of: str | None


class Finds:
    """Adds a find to the tables."""

    def __init__(
        self, events: Mapping[str, int], asks: Asks, measures: Measures, reader: Reader, tables: Tables
    ) -> None:
        self.events = events
        self.asks = asks
        self.measures = measures
        self.reader = reader
        self.tables = tables

    def add(self, find: Find, path: str) -> FlatFind:
        """Adds the rows of a find.  Raises SceneError for a wrong bound, condition or goal."""
        bounds = tuple(
            self._vary(name, pair, find, f"{path}.vary.{name}") for name, pair in find.vary.items()
        )
        if len(find.where) > _MOST:
            reason = f"{len(find.where)} conditions; at most {_MOST} are possible"
            raise SceneError(reason, path=f"{path}.where")
        with self.measures.answered(self.asks.answers()):
            conditions = tuple(
                self._condition(text, find, _place(path, find, index))
                for index, text in enumerate(find.where)
            )
            goal, of = self._goal(find, path)
        self._check_count(find, path)
        return FlatFind(path, tuple(find.vary), bounds, conditions, goal, of)

    # ---- parameters ----

    def _vary(self, name: str, pair: tuple[Value, Value], find: Find, path: str) -> tuple[int, int]:
        parameters = self.reader.parameters
        wanted = parameters.dimensions[name]
        nodes = [
            self.reader.number(value, f"{path}[{i}]", wanted if wanted is not None else DIMENSIONLESS)
            for i, value in enumerate(pair)
        ]
        for i, node in enumerate(nodes):
            if self.reader.depends_on(node) & set(find.vary):
                raise SceneError(
                    "a bound cannot depend on what is sought", path=f"{path}[{i}]", value=pair[i]
                )
        if self.reader.default(nodes[0]) >= self.reader.default(nodes[1]):
            reason = f"the lower bound {pair[0]} must be less than the upper bound {pair[1]}"
            raise SceneError(reason, path=path)
        low, high = (self.tables.new_value(node, path) for node in nodes)
        row = {
            layout.PM_VARY_PARAMETER: parameters.independent.index(name),
            layout.PM_VARY_LOW: low,
            layout.PM_VARY_HIGH: high,
        }
        self.tables.add(layout.PM_TABLE_VARY, row, path)
        return low, high

    # ---- conditions ----

    def _condition(self, text: str, find: Find, path: str) -> FindCondition:
        try:
            kind, node, unit = self._read(text.strip(), path)
            self._depends(node, find)
        except SceneError as error:
            raise error.at(path=path, value=text) from None
        row = {
            layout.PM_CONDITION_KIND: kind,
            layout.PM_CONDITION_PROGRAM: self.tables.program(node, path),
        }
        self.tables.add(layout.PM_TABLE_CONDITION, row, path)
        return FindCondition(text, path, unit)

    def _read(self, text: str, path: str) -> tuple[int, Node, str | None]:
        """Kind, expression of the reading, and its unit unless it is yes or no."""
        happens = _HAPPENS.fullmatch(text)
        if happens is not None:
            return layout.PM_CONDITION_HOLDS, self._count(happens[1], path), None
        node = self.measures.reader.parameters.parse(text)
        if not _is_truth(node):
            raise SceneError(
                'a condition is wanted: "A = B", "A > B", "A < B", several of them joined by and, or, not; '
                'or "EVENT happens"'
            )
        dimension(node, self.measures.dimension_of)
        if isinstance(node, Binary) and (node.operator == "=" or node.operator in _MARGIN):
            left, right = self.measures.lower(node.left, path), self.measures.lower(node.right, path)
            if not self._is_whole(left.node) or not self._is_whole(right.node):
                more = right if left.dimension == DIMENSIONLESS else left
                unit = more.dimension.unit or "1"
                if node.operator == "=":
                    return layout.PM_CONDITION_ZERO, left.node - right.node, unit
                greater = node.operator.startswith(">")
                difference = left.node - right.node if greater else right.node - left.node
                return _MARGIN[node.operator], difference, unit
        return layout.PM_CONDITION_HOLDS, self.measures.lower(node, path).node, None

    def _count(self, name: str, path: str) -> Node:
        """Whether an event has fired, or has fired so often, as a number that is not 0."""
        found = firing(name, self.events, path)
        if found is None:
            raise SceneError(unknown(name.split()[0], self.events, "event"))
        nth = found[1]
        if nth == 0:
            raise SceneError("firings are counted from 1")
        count = self.measures.lower(f"{name.split()[0]}.count", "find").node
        return count if nth is None else Binary(">=", count, Number(float(nth)))

    def _is_whole(self, node: Node) -> bool:
        """Whether only whole numbers come out, so that a comparison cannot be met by and by."""
        match node:
            case Number():
                return node.value_si.is_integer()
            case Binary(operator="+" | "-" | "*"):
                return self._is_whole(node.left) and self._is_whole(node.right)
        index = self.tables.measure_index(node)
        if index is None:
            return False
        return self.tables.rows[layout.PM_TABLE_MEASURE][index][layout.PM_MEASURE_KIND] in _WHOLE

    def _depends(self, node: Node, find: Find) -> None:
        """Raises SceneError if a condition cannot change with the run."""
        parameters = self.reader.parameters.nodes
        for leaf in names(node):
            if not isinstance(leaf, Name) or leaf.text not in parameters:
                return  # a measure or an answer
            if self.reader.depends_on(leaf) & set(find.vary):
                return
        raise SceneError("nothing in this condition changes with what is varied")

    # ---- goal ----

    def _goal(self, find: Find, path: str) -> tuple[str | None, str | None]:
        """The row of the find itself."""
        word = find.goal
        program, of = layout.PM_NONE, None
        if word is not None:
            written = getattr(find, word)
            of = str(written)
            node = self.measures.lower(written, f"{path}.{word}").node
            if not (isinstance(node, Name) and node.text in find.vary):
                self._depends(node, find)
                program = self.tables.program(node, f"{path}.{word}")
        row = {
            layout.PM_FIND_GOAL: _GOALS[word],
            layout.PM_FIND_PROGRAM: program,
            layout.PM_FIND_SAMPLES: find.intervals,
        }
        self.tables.add(layout.PM_TABLE_FIND, row, f"{path}.{word or 'where'}")
        return word, of

    def _check_count(self, find: Find, path: str) -> None:
        """As many equations as there are unknowns, unless something is to be extreme."""
        rows = self.tables.rows[layout.PM_TABLE_CONDITION]
        zeros = sum(row[layout.PM_CONDITION_KIND] == layout.PM_CONDITION_ZERO for row in rows)
        if len(find.vary) == 2:
            if zeros != 2 or find.goal is not None:
                reason = "two parameters need two conditions A = B in where, and no greatest or least"
                raise SceneError(reason, path=path)
            return
        if zeros > 1:
            raise SceneError("one parameter can meet one condition A = B", path=f"{path}.where")
        program = self.tables.rows[layout.PM_TABLE_FIND][0][layout.PM_FIND_PROGRAM]
        if zeros == 0 and find.goal is None:
            reason = (
                "many values may do that; add greatest or least (of an ask or of the parameter), or a "
                "condition A = B"
            )
            raise SceneError(reason, path=f"{path}.where")
        if zeros == 0 and program == layout.PM_NONE and not find.where:
            reason = f"the {find.goal} value is its bound; say under which condition: where"
            raise SceneError(reason, path=f"{path}.{find.goal}")


def _place(path: str, find: Find, index: int) -> str:
    return f"{path}.where" if len(find.where) == 1 else f"{path}.where[{index}]"


def _is_truth(node: Node) -> bool:
    """Whether the expression is yes or no."""
    match node:
        case Binary(operator="and" | "or"):
            return _is_truth(node.left) and _is_truth(node.right)
        case Unary(operator="not"):
            return _is_truth(node.operand)
        case Binary():
            return node.operator in ("=", "!=", *_MARGIN)
    return False
