"""Actions: what an event does when it fires, to rows of the kernel's action table.

`{ add = element }` and `{ remove = element }` name joints, couplings, contacts and forces; an impulse is a
vector at a point, a number on a body, or the work that a couple does on it at once; `{ nudge = side }` says
how an unstable rest or steady motion is left from here on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..geometry.partners import partner
from ..language.dimensions import ANGULAR_IMPULSE, ENERGY, IMPULSE, Dimension
from ..language.leaves import substitute
from ..language.tree import Binary, Name, Node, Number, negative
from ..model import words
from ..model.readers import Value, Vector
from ..model.tables import Action
from ..model.words import GROUND
from .measures import Measures

# What is not known before the forces after the impulse are.
_LATER = frozenset(
    (
        layout.PM_MEASURE_ALPHA,
        layout.PM_MEASURE_ACCELERATION,
        layout.PM_MEASURE_JOINT_FORCE,
        layout.PM_MEASURE_JOINT_COUPLE,
        layout.PM_MEASURE_JOINT_IMPULSE,
        layout.PM_MEASURE_JOINT_NORMAL,
        layout.PM_MEASURE_JOINT_FRICTION,
        layout.PM_MEASURE_JOINT_FRICTION_NEEDED,
        layout.PM_MEASURE_CONTACT_NORMAL,
        layout.PM_MEASURE_CONTACT_FRICTION,
        layout.PM_MEASURE_CONTACT_FRICTION_NEEDED,
        layout.PM_MEASURE_CONTACT_FORCE,
        layout.PM_MEASURE_CONTACT_COUPLE,
        layout.PM_MEASURE_CONTACT_TENSION,
    )
)


class Actions:
    """Adds what events do to the tables."""

    def __init__(self, measures: Measures, tables: Tables) -> None:
        self.measures = measures
        self.scope = measures.scope
        self.tables = tables

    def absent(self, elements: Mapping[str, str]) -> None:
        """Rows of elements that do not hold from the start on; `elements`: name -> key path of its active."""
        for name, where in elements.items():
            self._rows(layout.PM_ACTION_REMOVE, layout.PM_NONE, name, where)

    def add(self, event: int, actions: Sequence[tuple[str, Action]]) -> None:
        """Rows of the actions of one event, given with their key paths.  Raises SceneError."""
        for where, action in actions:
            if action.add is not None:
                self._rows(layout.PM_ACTION_ADD, event, action.add, f"{where}.add")
            elif action.remove is not None:
                self._rows(layout.PM_ACTION_REMOVE, event, action.remove, f"{where}.remove")
            elif action.nudge is not None:
                self._nudge(event, action.nudge, f"{where}.nudge")
            else:
                self._impulse(event, action, where)

    # ---- what comes and goes ----

    def _rows(self, kind: int, event: int, name: str, where: str) -> None:
        table, rows = self._element(name, where)
        if kind == layout.PM_ACTION_REMOVE and table == layout.PM_TABLE_JOINT:
            self._check_axle(rows[0], name, where)
        for one in rows:
            self._row(where, kind, event, table, one)
        if name in self.scope.couplings:
            for one in self.scope.couplings[name].rows.forces:
                self._row(where, kind, event, layout.PM_TABLE_FORCE, one)

    def _check_axle(self, joint: int, name: str, where: str) -> None:
        for belt, found in self.scope.couplings.items():
            if joint in found.rows.rests_on:
                reason = f'"{belt}" needs it: its wheels must keep their distance, for it has a pretension'
                raise SceneError(reason, path=where, value=name)

    def _element(self, name: str, where: str) -> tuple[int, tuple[int, ...]]:
        """Table of an element, and its rows there."""
        scope = self.scope
        if name in scope.joints:
            return layout.PM_TABLE_JOINT, (scope.joints[name].index,)
        if name in scope.contacts:
            return layout.PM_TABLE_CONTACT, scope.contacts[name].indices
        if name in scope.forces:
            return layout.PM_TABLE_FORCE, (scope.forces[name].index,)
        if name in scope.couplings:
            found = scope.couplings[name]
            if found.index is None:
                return layout.PM_TABLE_CONTACT, found.indices
            return layout.PM_TABLE_JOINT, (found.index,)
        if name in scope.inactive:
            raise SceneError(f'"{name}" is not active in this run', path=where, value=name)
        known = (*scope.joints, *scope.couplings, *scope.contacts, *scope.forces)
        raise SceneError(words.unknown(name, known, "element"), path=where, value=name)

    def _nudge(self, event: int, side: str, where: str) -> None:
        program = add_nudge(side, self.measures, self.tables, where)
        self._row(where, layout.PM_ACTION_NUDGE, event, layout.PM_NONE, layout.PM_NONE, program)

    # ---- impulses ----

    def _impulse(self, event: int, action: Action, where: str) -> None:
        assert action.impulse is not None
        place, nothing = f"{where}.impulse", layout.PM_NONE
        if (action.value is None) == (action.work is None):
            raise SceneError("either value or work is wanted", path=where)
        if isinstance(action.value, Vector):
            point = partner(self.measures.drawing, action.impulse, place, "point")
            if point.owner == GROUND:
                raise SceneError("a point of a body is wanted", path=place, value=action.impulse)
            x, y = (
                self.tables.program(node, f"{where}.value")
                for node in self.measures.reader.vector(action.value, f"{where}.value", IMPULSE, self._now)
            )
            row = self.measures.drawn.point(point.ref)
            self._row(where, layout.PM_ACTION_IMPULSE, event, nothing, row, x, y)
            return
        body = self._body(action.impulse, place)
        if action.value is not None:
            node = self._now(action.value, f"{where}.value", ANGULAR_IMPULSE)
            program = self.tables.program(node, f"{where}.value")
            self._row(where, layout.PM_ACTION_ANGULAR, event, nothing, body, program)
        elif action.work is not None:
            program = self.tables.program(self._now(action.work, f"{where}.work", ENERGY), f"{where}.work")
            self._row(where, layout.PM_ACTION_WORK, event, nothing, body, program)

    def _body(self, name: str, where: str) -> int:
        """A body that rotates."""
        drawing = self.measures.drawing
        try:
            if "." in name:
                raise SceneError(
                    "a number is an angular impulse, on a body; at a point a vector is wanted: [x, y] or "
                    "{ polar = [size, angle] }"
                )
            if name == GROUND or not drawing.body_of(name).rotates:
                raise SceneError("a body that rotates is wanted")
        except SceneError as error:
            raise error.at(path=where, value=name) from None
        return drawing.body_index(name)

    def _now(self, written: Value, where: str, wanted: Dimension) -> Node:
        """An expression of parameters and measures at the instant."""
        measures = self.measures
        node = measures.reader.number_of(written, where, wanted, measures.dimension_of)
        lowered = measures.lower(node, where).node

        def look(leaf: Node) -> Node:
            measure = self.tables.measure_index(leaf) if isinstance(leaf, Name) else None
            if measure is not None and self._kind(measure) in _LATER:
                reason = "an impulse cannot depend on forces and accelerations: they follow from it"
                raise SceneError(reason, path=where, value=written)
            return leaf

        return substitute(lowered, look)

    def _kind(self, measure: int) -> int:
        return self.tables.rows[layout.PM_TABLE_MEASURE][measure][layout.PM_MEASURE_KIND]

    def _row(self, where: str, kind: int, event: int, table: int, a: int, *programs: int) -> None:
        x, y = (*programs, layout.PM_NONE, layout.PM_NONE)[:2]
        row = {
            layout.PM_ACTION_KIND: kind,
            layout.PM_ACTION_EVENT: event,
            layout.PM_ACTION_TABLE: table,
            layout.PM_ACTION_A: a,
            layout.PM_ACTION_PROGRAM_X: x,
            layout.PM_ACTION_PROGRAM_Y: y,
        }
        self.tables.add(layout.PM_TABLE_ACTION, row, where)


_VELOCITIES = (layout.PM_MEASURE_OMEGA, layout.PM_MEASURE_VELOCITY)


_LINEAR_PARTS = (layout.PM_PART_NONE, layout.PM_PART_X, layout.PM_PART_Y, layout.PM_PART_ALONG)


def add_nudge(text: str, measures: Measures, tables: Tables, where: str) -> int:
    """The program that becomes > 0 on the side of a condition such as "AB.omega < 0".  Raises SceneError."""
    try:
        return _program(text, measures, tables, where)
    except SceneError as error:
        raise error.at(path=where, value=text) from None


def _program(text: str, measures: Measures, tables: Tables, where: str) -> int:
    node = measures.reader.parameters.parse(text)
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
