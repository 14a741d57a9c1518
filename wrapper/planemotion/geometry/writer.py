"""What the kinds of joints, couplings and forces write their rows with: names to rows, numbers to values."""

from __future__ import annotations

from collections.abc import Sequence

from .. import _layout as layout
from ..base.errors import SceneError
from ..language.dimensions import POWER, Dimension
from ..language.leaves import names
from ..language.tree import Node
from ..model.readers import Value
from ..model.words import GROUND
from .drawn_rows import DrawnRows
from .motion import MotionPrograms, Waiting, reads_motion
from .packing import Tables, empty_measure, over_time
from .parameters import Reader
from .partners import Partner, pairs, partner


class Writer:
    """The tables of a run under construction, and the readers of what stands in an element."""

    def __init__(self, drawn: DrawnRows, reader: Reader, tables: Tables) -> None:
        self.drawn = drawn
        self.drawing = drawn.drawing
        self.reader = reader
        self.tables = tables
        self.motion = MotionPrograms(tables)

    # ---- partners ----

    def points(self, names: tuple[str, ...], path: str) -> tuple[Partner, Partner]:
        """Two points of different bodies."""
        return pairs(names, path, lambda text, where, _index: partner(self.drawing, text, where, "point"))

    def circles(self, names: tuple[str, ...], path: str) -> tuple[Partner, Partner]:
        """Two circles of different bodies."""
        return pairs(names, path, lambda text, where, _index: partner(self.drawing, text, where, "circle"))

    def bodies(self, names: tuple[str, ...], path: str) -> tuple[str, str]:
        """Two different bodies that rotate; one may be the ground."""
        first, second = (self.body(name, f"{path}[{index}]") for index, name in enumerate(names))
        if first == second:
            raise SceneError("two different bodies are wanted", path=path)
        return first, second

    def body(self, name: str, where: str) -> str:
        """A body that rotates, or the ground."""
        try:
            if not self.rotates(name):
                raise SceneError("a particle does not rotate; a body with an inertia is wanted")
        except SceneError as error:
            raise error.at(path=where, value=name) from None
        return name

    def rotates(self, name: str) -> bool:
        """Whether it is more than a particle.  Raises SceneError if there is no such body."""
        return name == GROUND or self.drawing.body_of(name).rotates

    # ---- numbers ----

    def over_time(self, written: Value, where: str, wanted: Dimension) -> Node:
        """A number that may depend on t."""
        return over_time(self.reader, self.tables, written, where, wanted)

    def over_motion(self, written: Value, where: str, wanted: Dimension) -> Node:
        """A number that may depend on t and on the motion: what it says of that is read at the end."""
        text = written.strip().removeprefix("~") if isinstance(written, str) else written
        node = self.reader.parameters.parse(text, where)
        if not reads_motion(node, self.reader.parameters.nodes):
            return self.over_time(written, where, wanted)
        return self.motion.leaf(Waiting(node, written, where, wanted))

    def is_steady(self, *numbers: Node) -> bool:
        """Whether they depend on parameters alone."""
        leaves = {leaf for node in numbers for leaf in names(node)}
        return all(str(leaf) in self.reader.parameters.nodes for leaf in leaves)

    def own(self, kind: int, where: str) -> Node:
        """A measure of the force whose row is added next."""
        return self.measured(kind, len(self.tables.rows[layout.PM_TABLE_FORCE]), where)

    def power(self, written: Value | None, where: str, **others: object) -> Node:
        """The power of a force or couple in W, as an expression: it goes the way of the motion, or against it
        (power < 0).  Raises SceneError if one of the `others` is given beside it."""
        assert written is not None
        for key, other in others.items():
            if other is not None:
                raise SceneError(f"give power or {key}, not both", path=where)
        return self.over_motion(written, where, POWER)

    def measured(self, kind: int, a: int, where: str, part: int = layout.PM_PART_NONE) -> Node:
        """A measure of the motion: of a point, or of a body."""
        row = empty_measure(kind) | {layout.PM_MEASURE_A: a, layout.PM_MEASURE_PART: part}
        return self.tables.measure_leaf(row, where)

    # ---- rows ----

    def joint(
        self,
        kind: int,
        a: int,
        b: int,
        path: str,
        *,
        value: tuple[Node, str] | None = None,
        second: tuple[Node, str] | None = None,
        programs: Sequence[Node] = (),
    ) -> int:
        """Adds a row of the joint table: kind, partners, numbers with their key paths, prescribed rates."""
        columns = (layout.PM_JOINT_PROGRAM_X, layout.PM_JOINT_PROGRAM_Y)
        row = {layout.PM_JOINT_KIND: kind, layout.PM_JOINT_A: a, layout.PM_JOINT_B: b}
        row |= dict.fromkeys(columns, layout.PM_NONE)
        for number, given in ((layout.PM_JOINT_VALUE, value), (layout.PM_JOINT_VALUE_2, second)):
            row[number] = layout.PM_NONE if given is None else self.tables.value(*given)
        for column, program in zip(columns, programs, strict=False):
            row[column] = self.tables.program(program, path)
        return self.tables.add(layout.PM_TABLE_JOINT, row, path)

    def force(
        self,
        kind: int,
        a: int,
        b: int,
        path: str,
        *,
        values: Sequence[tuple[Node, str]] = (),
        programs: Sequence[tuple[Node, str]] = (),
        option: int = 0,
    ) -> int:
        """Adds a row of the force table: kind, partners, numbers and programs with their key paths."""
        row = dict.fromkeys(range(layout.PM_FORCE_COLUMNS), layout.PM_NONE)
        row |= {layout.PM_FORCE_KIND: kind, layout.PM_FORCE_A: a, layout.PM_FORCE_B: b}
        row[layout.PM_FORCE_OPTION] = option
        for column, value in zip((layout.PM_FORCE_VALUE_1, layout.PM_FORCE_VALUE_2), values, strict=False):
            row[column] = self.tables.value(*value)
        columns = (layout.PM_FORCE_PROGRAM_X, layout.PM_FORCE_PROGRAM_Y)
        index = len(self.tables.rows[layout.PM_TABLE_FORCE])
        for column, program in zip(columns, programs, strict=False):
            row[column] = self.motion.program(*program, index, column)
        return self.tables.add(layout.PM_TABLE_FORCE, row, path)
