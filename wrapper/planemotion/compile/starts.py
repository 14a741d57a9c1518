"""Start values: what is written about positions and velocities at t = 0, as rows of the start table.

A written position or angle of a body binds only where a joint holds the body: there the assembly moves
others.  A body on its own stays as drawn.  What is marked `~` or left out gives no row.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawing import PointRef
from ..geometry.drawn_rows import DrawnRows
from ..geometry.packing import Tables
from ..geometry.parameters import Reader, is_guess
from ..language.address import Address, parse_address
from ..language.tree import Node
from ..model.readers import Value, Vector
from .measure_rows import Reading
from .measures import Measures
from .spin import START_OMEGA

_LEVELS = {
    layout.PM_MEASURE_ANGLE: layout.PM_START_POSITION,
    layout.PM_MEASURE_POSITION: layout.PM_START_POSITION,
    layout.PM_MEASURE_OMEGA: layout.PM_START_VELOCITY,
    layout.PM_MEASURE_VELOCITY: layout.PM_START_VELOCITY,
}
_LINEAR_PARTS = (layout.PM_PART_NONE, layout.PM_PART_X, layout.PM_PART_Y, layout.PM_PART_ALONG)


class Starts:
    """Adds start rows to the tables."""

    def __init__(
        self,
        drawn: DrawnRows,
        reader: Reader,
        measures: Measures,
        tables: Tables,
        *,
        at_rest: bool = False,
    ) -> None:
        self.drawn = drawn
        self.at_rest = at_rest
        self.drawing = drawn.drawing
        self.reader = reader
        self.measures = measures
        self.tables = tables

    def add(self, written: Mapping[str, Value | Vector], fastened: Collection[str]) -> None:
        """Rows of drawn poses of fastened bodies, then those of [start]."""
        for name in self.drawing.bodies:
            if name in fastened:
                self._add_pose(name)
        for address, value in written.items():
            if address == START_OMEGA:
                continue  # no velocity of a body: spin.py has taken it
            try:
                self._add_written(address, value)
            except SceneError as error:
                shown = None if isinstance(value, Vector) else value
                raise error.at(path=f"start.{address}", value=shown) from None

    def _add_pose(self, name: str) -> None:
        pose = self.drawing.pose(name)
        path = f"bodies.{name}.at"
        for placed in pose.placed[:1]:
            point = self.drawn.point(PointRef(name, placed.point))
            parts = (layout.PM_PART_X, layout.PM_PART_Y)
            for part, value, exact in zip(parts, placed.position, placed.exact, strict=True):
                if exact:
                    self._row(layout.PM_MEASURE_POSITION, point, part, value, path)
        if pose.angle_exact and self.drawing.bodies[name].rotates:
            index = self.drawing.body_index(name)
            self._row(layout.PM_MEASURE_ANGLE, index, layout.PM_PART_NONE, pose.angle, f"bodies.{name}.angle")

    def _row(self, kind: int, a: int, part: int, value: Node, path: str) -> None:
        measure = dict.fromkeys(range(layout.PM_MEASURE_COLUMNS), layout.PM_NONE)
        measure[layout.PM_MEASURE_KIND] = kind
        measure[layout.PM_MEASURE_A] = a
        measure[layout.PM_MEASURE_PART] = part
        self._start(_LEVELS[kind], self.tables.measure(measure, path), value, path)

    def _start(self, level: int, measure: int, value: Node, path: str) -> None:
        row = {
            layout.PM_START_LEVEL: level,
            layout.PM_START_MEASURE: measure,
            layout.PM_START_VALUE: self.tables.value(value, path),
        }
        self.tables.add(layout.PM_TABLE_START, row, path)

    def _add_written(self, text: str, value: Value | Vector) -> None:
        address = parse_address(text, self.drawing.names)
        path = f"start.{text}"
        if address.thing in self.measures.scope.inactive:
            return  # it is not there in this run; another run has it
        if not isinstance(value, Vector):
            self._add_scalar(self.measures.reading(address), value, path)
            return
        for part, size in zip(("x", "y"), self._components(address, value, path), strict=True):
            reading = self.measures.reading(replace(address, path=(*address.path, part)))
            self._add_node(reading.node, size, path)

    def _components(self, address: Address, value: Vector, path: str) -> tuple[Node, Node]:
        if is_guess(value.first) or is_guess(value.second):
            raise SceneError(_GUESSED)
        wanted = self.measures.reading(replace(address, path=(*address.path, "x"))).dimension
        return self.reader.vector(value, path, wanted)

    def _add_scalar(self, reading: Reading, value: Value, path: str) -> None:
        if is_guess(value):
            raise SceneError(_GUESSED)
        self._add_node(reading.node, self.reader.number(value, path, reading.dimension), path)

    def _add_node(self, node: Node, value: Node, path: str) -> None:
        measure = self.tables.measure_index(node)
        row = None if measure is None else self.tables.rows[layout.PM_TABLE_MEASURE][measure]
        level = None if row is None else _LEVELS.get(row[layout.PM_MEASURE_KIND])
        if (
            row is None
            or measure is None
            or level is None
            or row[layout.PM_MEASURE_PART] not in _LINEAR_PARTS
        ):
            reason = (
                "it cannot be given at the start; what can: angle, omega, "
                "and of a point x, y, along, velocity, velocity.x and velocity.y"
            )
            raise SceneError(reason)
        if self.at_rest and level == layout.PM_START_VELOCITY:
            raise SceneError("an equilibrium is at rest; leave the velocity out, or start.equilibrium")
        self._start(level, measure, value, path)


_GUESSED = "not built yet: guesses among the start values; a guess is written at the body, as at or angle"
