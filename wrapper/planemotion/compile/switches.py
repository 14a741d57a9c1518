"""What a force reads of the motion: how it is made a program, and where that switches.

Where a comparison, abs, min or max changes sides a phase ends, and meanwhile the program reads the side that
holds: within a phase a force is smooth.
"""

from __future__ import annotations

from collections.abc import Sequence

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.motion import Waiting
from ..geometry.packing import Tables, empty_measure
from ..language.address import Address
from ..language.homogeneity import require
from ..language.leaves import names, operands, with_operands
from ..language.lookup import Lookup
from ..language.tree import ONE, ZERO, Binary, Call, Name, Node, Number, binary, call, select
from .events import add_event
from .measures import Measures

# Measures that are known only when all forces are.
_AFTER_FORCES = frozenset(
    getattr(layout, f"PM_MEASURE_{word}")
    for word in (
        "ALPHA",
        "ACCELERATION",
        "JOINT_FORCE",
        "JOINT_COUPLE",
        "JOINT_IMPULSE",
        "JOINT_NORMAL",
        "JOINT_FRICTION",
        "JOINT_FRICTION_NEEDED",
        "CONTACT_NORMAL",
        "CONTACT_FRICTION",
        "CONTACT_FRICTION_NEEDED",
        "CONTACT_FORCE",
        "CONTACT_COUPLE",
        "CONTACT_IMPULSE",
        "CONTACT_TENSION",
        "CONTACT_TENSION_IMPULSE",
        "FORCE_FORCE",
        "FORCE_COUPLE",
        "FORCE_POWER",
        "FORCE_ENERGY",
        "LOST",
    )
)
_OF_EVENT = (layout.PM_MEASURE_EVENT_COUNT, layout.PM_MEASURE_EVENT_TIME)


def _finite(node: Node, as_written: Node) -> Node:
    """A function that has no value everywhere: of its operand by the side that holds, but as it is written
    where that side has none.

    A step goes on by its side until it is seen to switch: max(x, 0)^1.5 is then 0 where x^1.5 is no number.
    """
    first, *others = operands(node)
    if first == as_written:
        return node
    match node:
        case Binary(right=Number(value_si=power)) if power == round(power):
            return node
        case Call(function="asin" | "acos"):
            has_value = binary("<=", call("abs", first), ONE)
        case _:
            has_value = binary(">=", first, ZERO)
    return with_operands(node, [select(has_value, first, as_written), *others])


class Switches:
    """Reads what forces say of the motion; where that switches, a phase ends."""

    def __init__(self, measures: Measures, tables: Tables) -> None:
        self.measures = measures
        self.tables = tables
        self._sides: dict[Node, Node] = {}
        self._pieces: dict[tuple[tuple[float, ...], str, Node], Node] = {}

    def read(self, waiting: Waiting) -> Node:
        """The expression over the kernel's leaves.  Raises SceneError for another dimension, or for what is
        known only when all forces are."""
        try:
            require(waiting.node, waiting.wanted, self.measures.dimension_of)
            for leaf in sorted(names(waiting.node), key=str):
                self._check(leaf)
        except SceneError as error:
            raise error.at(path=waiting.where, value=waiting.written) from None
        return self.measures.lower(waiting.node, waiting.where).node

    def _check(self, leaf: Name | Address) -> None:
        if str(leaf) in self.measures.reader.parameters.nodes:
            return
        for row in self.tables.measure_rows(self.measures.reading(leaf).node):
            if row[layout.PM_MEASURE_KIND] in _AFTER_FORCES:
                raise SceneError(
                    f'"{leaf}" is known only when all forces are; a force may read positions, velocities, '
                    "stretches, gaps, slips and counts of events"
                )

    def program(self, node: Node, where: str) -> Node:
        """The same; what switches by the motion reads the side of its switch, where a phase ends."""
        for row in self.tables.measure_rows(node):
            if row[layout.PM_MEASURE_KIND] in _OF_EVENT:
                event, column = row[layout.PM_MEASURE_A], layout.PM_EVENT_EFFECT
                self.tables.put(layout.PM_TABLE_EVENT, event, column, layout.PM_EFFECT_COUNT)
        return self._by_sides(node, where)

    def _by_sides(self, node: Node, where: str) -> Node:
        """With the sides of switches in the place of operations that switch by the motion."""
        as_written = operands(node)
        node = with_operands(node, [self._by_sides(one, where) for one in as_written])
        if not self._moves(node):
            return node
        match node:
            case Binary(operator="^") | Call(function="sqrt" | "log" | "asin" | "acos"):
                return _finite(node, as_written[0])
            case Binary(operator="<" | "<="):
                return self._side(node.right, node.left, where)
            case Binary(operator=">" | ">="):
                return self._side(node.left, node.right, where)
            case Call(function="abs"):
                (inner,) = node.arguments
                return inner * (2.0 * self._side(inner, ZERO, where) - 1.0)
            case Call(function="min" | "max"):
                first, *others = node.arguments
                for other in others:
                    greater = self._side(first, other, where)
                    a, b = (first, other) if node.function == "max" else (other, first)
                    first = greater * a + (1.0 - greater) * b  # one of them, without rounding
                return first
            case Lookup():
                return self._by_piece(node, where)
            case Call(function="floor"):
                trigger = (layout.PM_TRIGGER_EVERY, node.arguments[0])
                self._event((trigger,), where, layout.PM_EFFECT_COUNT)
        return node

    def watched(self, node: Node, where: str) -> Node:
        """An expression that is looked at all along, and whose tables are read at more than parameters: each
        by the piece that holds for a phase."""
        node = with_operands(node, [self.watched(one, where) for one in operands(node)])
        if isinstance(node, Lookup) and node.read == "value" and any(self.tables.measure_rows(node)):
            return self._by_piece(node, where)
        return node

    def _by_piece(self, node: Lookup, where: str) -> Node:
        """The table by its piece: a phase ends where that does."""
        if node.read != "value":
            return node
        x, table = node.arguments[0], node.table
        key = (table.knots, table.beyond, x)
        if key not in self._pieces:
            event = add_event(self.tables, f"{where} at {table.name}", effect=layout.PM_EFFECT_PIECE)
            row = empty_measure(layout.PM_MEASURE_EVENT_SIDE) | {layout.PM_MEASURE_A: event}
            piece = self.tables.measure_leaf(row, where)
            low, high = (Lookup(table, (number,), "knot") for number in (piece, piece + 1.0))
            self._trigger(event, layout.PM_TRIGGER_FALL, x - low, where)
            self._trigger(event, layout.PM_TRIGGER_RISE, x - high, where)
            reading = {
                layout.PM_READING_EVENT: event,
                layout.PM_READING_TABLE: self.tables.piecewise(table),
                layout.PM_READING_PROGRAM: self.tables.program(x, where),
            }
            self.tables.add(layout.PM_TABLE_READING, reading, where)
            self._pieces[key] = piece
        return Lookup(table, (x, self._pieces[key]), "piece")

    def _side(self, a: Node, b: Node, where: str) -> Node:
        """1 where a > b, else 0."""
        switch = a - b
        for sign, known in ((1, switch), (-1, b - a)):
            if known in self._sides:
                return self._sides[known] if sign > 0 else 1.0 - self._sides[known]
        rise, fall = (layout.PM_TRIGGER_RISE, switch), (layout.PM_TRIGGER_FALL, switch)
        event = self._event((rise, fall), where, layout.PM_EFFECT_SWITCH)
        row = empty_measure(layout.PM_MEASURE_EVENT_SIDE) | {layout.PM_MEASURE_A: event}
        self._sides[switch] = self.tables.measure_leaf(row, where)
        return self._sides[switch]

    def _event(self, triggers: Sequence[tuple[int, Node]], where: str, effect: int) -> int:
        name = f"{where} switches"
        event = add_event(self.tables, name, effect=effect)
        for kind, node in triggers:
            self._trigger(event, kind, node, name)
        return event

    def _trigger(self, event: int, kind: int, node: Node, name: str) -> None:
        row = {
            layout.PM_TRIGGER_KIND: kind,
            layout.PM_TRIGGER_EVENT: event,
            layout.PM_TRIGGER_PROGRAM: self.tables.program(node, name),
            layout.PM_TRIGGER_A: layout.PM_NONE,
        }
        self.tables.add(layout.PM_TABLE_TRIGGER, row, name)

    def _moves(self, node: Node) -> bool:
        """Whether it changes by more than the time, whose switches the kernel knows, and what events tell."""
        still = (layout.PM_MEASURE_TIME, *_OF_EVENT, layout.PM_MEASURE_EVENT_SIDE)
        return any(row[layout.PM_MEASURE_KIND] not in still for row in self.tables.measure_rows(node))
