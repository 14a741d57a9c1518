"""The kernel's tables while they are made: rows, programs, values and measures, each kept once.

The expressions that go into them have leaves of four kinds, all of them `Name`: parameters by their name,
values ("#3") and measures ("@7") by the index that they have here, answers ("!2") by their column.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import numpy.typing as npt

from .. import _layout as layout
from ..language.code import ConstantPool, Instruction, emit
from ..language.dimensions import TIME, Dimension
from ..language.leaves import Leaf, evaluate, names, substitute
from ..language.lookup import Piecewise
from ..language.tree import Name, Node, Number
from ..model.readers import Value
from .checks import Checks
from .parameters import Parameters, Reader

Row = Mapping[int, int]
_VALUE = "#"
_MEASURE = "@"
_ANSWER = "!"
_BEYOND = {
    "stop": layout.PM_BEYOND_NONE,
    "hold": layout.PM_BEYOND_HOLD,
    "extend": layout.PM_BEYOND_EXTEND,
    "repeat": layout.PM_BEYOND_REPEAT,
    "zero": layout.PM_BEYOND_ZERO,
}


class Tables:
    """Grows by `add`, `value`, `program` and `measure`; `pack` gives the arrays."""

    def __init__(self, parameters: Parameters) -> None:
        self.parameters = parameters
        self.rows: dict[int, list[tuple[int, ...]]] = {table: [] for table in range(layout.PM_TABLES)}
        self.names: dict[int, list[str]] = {table: [] for table in range(layout.PM_TABLES)}
        self.constants = ConstantPool()
        self.constants.index(0.0)
        self._values: dict[Node, int] = {}
        self._nodes: list[Node] = []
        self._positive: dict[Node, None] = {}
        self._defaults: list[float] = []
        self._needs: list[frozenset[str]] = []
        self._programs: dict[Node, int] = {}
        self._measures: dict[tuple[int, ...], int] = {}
        self._piecewise: dict[Piecewise, int] = {}
        self._column = {name: index for index, name in enumerate(parameters.independent)}
        # Dependent parameters come first, so that every other value may use them.
        self._dependent: dict[str, int] = {}
        for name in parameters.order:
            if name not in self._column:
                self._dependent[name] = self.value(parameters.nodes[name], f"parameters.{name}")

    def add(self, table: int, row: Row, name: str) -> int:
        """Appends a row, given as column -> entry, and returns its index; `name` is its key path."""
        columns = sorted(row)
        assert columns == list(range(len(row))), f"table {table}: columns {columns}"
        self.rows[table].append(tuple(row[column] for column in columns))
        self.names[table].append(name)
        return len(self.rows[table]) - 1

    def put(self, table: int, index: int, column: int, entry: int) -> None:
        """Another entry in a row that is there."""
        row = self.rows[table][index]
        self.rows[table][index] = (*row[:column], entry, *row[column + 1 :])

    def value(self, node: Node, where: str) -> int:
        """Index of the value of an expression; equal expressions share one."""
        if node not in self._values:
            self._values[node] = self.new_value(node, where)
        return self._values[node]

    def new_value(self, node: Node, where: str) -> int:
        """Index of a value of its own, next to the one made before."""
        row = {layout.PM_VALUE_PROGRAM: self.program(node, where)}
        self._nodes.append(node)
        self._defaults.append(self._at_defaults(node))
        self._needs.append(frozenset().union(*(self.needs_of(str(leaf)) for leaf in names(node))))
        return self.add(layout.PM_TABLE_VALUE, row, where)

    def leaf(self, node: Node, where: str) -> Node:
        """The expression as a leaf that stands for its value; numbers and leaves stay as they are."""
        if isinstance(node, Number | Name):
            return node
        return Name(f"{_VALUE}{self.value(node, where)}")

    def program(self, node: Node, where: str = "") -> int:
        """Index of the program of an expression; equal expressions share one."""
        if node not in self._programs:
            first = len(self.rows[layout.PM_TABLE_CODE])
            code = emit(node, self._instruction, self.constants, self.piecewise)
            for op, arg in code:
                self.add(layout.PM_TABLE_CODE, {layout.PM_CODE_OP: op, layout.PM_CODE_ARG: arg}, where)
            row = {layout.PM_PROGRAM_FIRST: first, layout.PM_PROGRAM_LENGTH: len(code)}
            self._programs[node] = self.add(layout.PM_TABLE_PROGRAM, row, where)
        return self._programs[node]

    def node_of(self, program: int) -> Node:
        """The expression of a program."""
        return next(node for node, index in self._programs.items() if index == program)

    def piecewise(self, table: Piecewise) -> int:
        """Index of a table of values."""
        if table not in self._piecewise:
            coefficients = [one for piece in table.coefficients for one in piece]
            row = {
                layout.PM_PIECEWISE_FIRST: self.constants.block([*table.knots, *coefficients]),
                layout.PM_PIECEWISE_KNOTS: len(table.knots),
                layout.PM_PIECEWISE_DEGREE_OF: table.degree,
                layout.PM_PIECEWISE_BEYOND: _BEYOND[table.beyond],
            }
            name = f"tables.{table.name.partition('.')[0]}"
            self._piecewise[table] = self.add(layout.PM_TABLE_PIECEWISE, row, name)
        return self._piecewise[table]

    def measure(self, row: Row, name: str) -> int:
        """Index of a measure; equal measures share one."""
        key = tuple(row[column] for column in sorted(row))
        if key not in self._measures:
            self._measures[key] = self.add(layout.PM_TABLE_MEASURE, row, name)
        return self._measures[key]

    def measure_leaf(self, row: Row, name: str) -> Node:
        """The leaf that stands for a measure."""
        return Name(f"{_MEASURE}{self.measure(row, name)}")

    def answer_leaf(self, column: int) -> Node:
        """The leaf that stands for a column of the answers, once the run has ended."""
        return Name(f"{_ANSWER}{column}")

    def measure_index(self, node: Node) -> int | None:
        """The measure that a leaf stands for; None if it is anything else."""
        is_measure = isinstance(node, Name) and node.text.startswith(_MEASURE)
        return int(node.text[1:]) if is_measure and isinstance(node, Name) else None

    def measure_rows(self, node: Node) -> Iterator[tuple[int, ...]]:
        """The rows of the measures in an expression."""
        for leaf in names(node):
            index = self.measure_index(leaf)
            if index is not None:
                yield self.rows[layout.PM_TABLE_MEASURE][index]

    def default_value(self, index: int) -> float:
        """A value at the defaults of the parameters, SI."""
        return self._defaults[index]

    def depends_on(self, index: int) -> frozenset[str]:
        """The independent parameters that a value depends on."""
        return self._needs[index]

    def default(self, node: Node) -> float:
        """The value of an expression without measures at the parameters' defaults, SI, for a decision."""
        self.parameters.decided.update(*(self.needs_of(str(leaf)) for leaf in names(node)))
        return self._at_defaults(node)

    def is_positive(self, node: Node) -> bool:
        """Whether an expression without measures is positive, as it must be at other values, too."""
        self._positive[node] = None
        return self._at_defaults(node) > 0

    def checks(self) -> Checks:
        """What must be positive at whatever values the parameters have."""
        needed: set[str] = set()
        waiting = [str(leaf) for node in self._positive for leaf in names(node)]
        while waiting:
            leaf = waiting.pop()
            if leaf not in needed and leaf not in self._column:
                needed.add(leaf)
                waiting += map(str, names(self._node(leaf)))
        order = (*self.parameters.order, *(f"{_VALUE}{index}" for index in range(len(self._nodes))))
        return Checks(
            tuple(self._positive), tuple((leaf, self._node(leaf)) for leaf in order if leaf in needed)
        )

    def _node(self, leaf: str) -> Node:
        """What the leaf of a value stands for."""
        return self._nodes[int(leaf[1:])] if leaf.startswith(_VALUE) else self.parameters.nodes[leaf]

    def _at_defaults(self, node: Node) -> float:
        def look_up(leaf: Leaf) -> float:
            text = str(leaf)
            return (
                self._defaults[int(text[1:])] if text.startswith(_VALUE) else self.parameters.defaults[text]
            )

        return evaluate(node, look_up)

    def needs_of(self, leaf: str) -> frozenset[str]:
        """The independent parameters behind the leaf of a value."""
        if leaf in self._column:
            return frozenset((leaf,))
        return self._needs[int(leaf[1:]) if leaf.startswith(_VALUE) else self._dependent[leaf]]

    def pack(self) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.float64]]:
        """The kernel's `table` [n] (directory, then rows) and `constant` [constants] (SI)."""
        directory: list[int] = []
        body: list[int] = []
        for table in range(layout.PM_TABLES):
            directory += [2 * layout.PM_TABLES + len(body), len(self.rows[table])]
            body += [entry for row in self.rows[table] for entry in row]
        return np.array(directory + body, dtype=np.int32), np.array(self.constants.values, dtype=np.float64)

    def _instruction(self, leaf: Leaf) -> Instruction:
        text = str(leaf)
        if text.startswith(_VALUE):
            return layout.PM_OP_VALUE, int(text[1:])
        if text.startswith(_MEASURE):
            return layout.PM_OP_MEASURE, int(text[1:])
        if text.startswith(_ANSWER):
            return layout.PM_OP_ANSWER, int(text[1:])
        if text in self._column:
            return layout.PM_OP_PARAMETER, self._column[text]
        return layout.PM_OP_VALUE, self._dependent[text]


def empty_measure(kind: int) -> dict[int, int]:
    """A row of the measure table of which nothing but the kind is said."""
    row = dict.fromkeys(range(layout.PM_MEASURE_COLUMNS), layout.PM_NONE)
    row[layout.PM_MEASURE_KIND] = kind
    row[layout.PM_MEASURE_PART] = layout.PM_PART_NONE
    return row


def over_time(reader: Reader, tables: Tables, written: Value, where: str, wanted: Dimension) -> Node:
    """An expression of parameters and t, with t made the measure of time.  Raises SceneError."""

    def resolve(leaf: Leaf) -> Dimension | None:
        return TIME if leaf == Name("t") else reader.parameters.dimension_of(leaf)

    node = reader.number_of(written, where, wanted, resolve)
    if Name("t") not in names(node):
        return node
    time = tables.measure_leaf(empty_measure(layout.PM_MEASURE_TIME), where)
    return substitute(node, lambda leaf: time if leaf == Name("t") else leaf)


def at_start(reader: Reader, written: Value, where: str, wanted: Dimension) -> Node:
    """The same expression at t = 0, over parameters alone.  Raises SceneError."""

    def resolve(leaf: Leaf) -> Dimension | None:
        return TIME if leaf == Name("t") else reader.parameters.dimension_of(leaf)

    node = reader.number_of(written, where, wanted, resolve)
    return substitute(node, lambda leaf: Number(0.0) if leaf == Name("t") else leaf)
