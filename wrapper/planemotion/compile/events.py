"""Instants: events with their triggers, and what ends the run.

A condition is a comparison ("A = B", "A > B", "A < B"), "X every d", a change of a contact ("floor
strikes") or of a joint with friction ("guide slips"), "start", "rest" or "BODY rests".  A bare condition in
`until` makes an event without a name.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

from .. import _layout as layout
from ..base.errors import Faults, SceneError, nearest
from ..geometry.packing import Tables
from ..language.address import DOTTED
from ..language.dimensions import TIME
from ..language.homogeneity import dimension
from ..language.leaves import substitute
from ..language.tree import Binary, Name, Node, Number
from ..model import words
from ..model.tables import Event
from .elements import CouplingInfo
from .measures import Measures

_CHANGE = re.compile(
    rf"(\S+)\s+({'|'.join((*words.CONTACT_CHANGES, *words.CORD_CHANGES, 'rests', 'happens'))})"
)
_EVERY = re.compile(r"(.+?)\s+every\s+(.+)")
# Of the number of a firing: what an index of the kernel can hold.
_DIGITS = 9
_FIRING = re.compile(rf"({DOTTED})(?:\s+(\d+))?")
_CONTACT_TRIGGER = {
    "strikes": layout.PM_TRIGGER_STRIKE,
    "opens": layout.PM_TRIGGER_OPEN,
    "slips": layout.PM_TRIGGER_SLIP,
    "sticks": layout.PM_TRIGGER_STICK,
}
_JOINT_TRIGGER = {"slips": layout.PM_TRIGGER_JOINT_SLIP, "sticks": layout.PM_TRIGGER_JOINT_STICK}
_COMPARISON = {"=": layout.PM_TRIGGER_CROSS, ">": layout.PM_TRIGGER_RISE, "<": layout.PM_TRIGGER_FALL}


def firing(text: str, events: Mapping[str, int], where: str) -> tuple[int, int | None] | None:
    """Event and number of "blow" or "blow 3"; None if the text names no event.

    for a number that no counter holds."""
    match = _FIRING.fullmatch(text.strip())
    if match is None or match[1] not in events:
        return None
    if len(match[2] or "") > _DIGITS:
        raise SceneError(f"firings are counted with at most {_DIGITS} digits", path=where, value=text)
    return events[match[1]], int(match[2]) if match[2] is not None else None


class Instants:
    """Adds events, triggers and the end of the run to the tables."""

    def __init__(
        self,
        events: Mapping[str, int],
        measures: Measures,
        tables: Tables,
        watched: Callable[[Node, str], Node],
    ) -> None:
        """`watched`: what is looked at of an expression all along."""
        self.events = events
        self.measures = measures
        self.tables = tables
        self.watched = watched

    def add_events(self, events: Mapping[str, Event]) -> None:
        """Triggers of the named events; their rows are there already."""
        Faults().make(events, self._add_event)

    def _add_event(self, name: str, event: Event) -> None:
        for index, text in enumerate(event.when):
            where = f"events.{name}" if len(event.when) == 1 else f"events.{name}[{index}]"
            self._trigger(text, self.events[name], where)

    def add_until(self, groups: Sequence[Sequence[str]]) -> None:
        """The run ends when every instant of one group has come."""
        instants = sum(len(group) for group in groups)
        number = 0
        for index, group in enumerate(groups):
            for text in group:
                where = "until" if instants == 1 else f"until[{number}]"
                event, nth = self._instant(text, where)
                row = {layout.PM_UNTIL_GROUP: index, layout.PM_UNTIL_EVENT: event, layout.PM_UNTIL_NTH: nth}
                self.tables.add(layout.PM_TABLE_UNTIL, row, where)
                number += 1

    def _instant(self, text: str, where: str) -> tuple[int, int]:
        """Event and number of its firing; a bare condition becomes an event of its own."""
        found = firing(text, self.events, where)
        if found is not None:
            event, nth = found
            if nth == 0:
                raise SceneError("firings are counted from 1", path=where, value=text)
            return event, nth or 1
        event = add_event(self.tables, where)
        try:
            self._trigger(text, event, where)
        except SceneError as error:
            if _FIRING.fullmatch(text.strip()) and text.strip() not in ("start", "rest"):
                word = text.split()[0]
                reason = words.unknown(word, self.events, "event") + '; a condition is, say, "t = 2 s"'
                raise SceneError(reason, path=where, value=text) from None
            raise error
        return event, 1

    def _trigger(self, text: str, event: int, where: str) -> None:
        try:
            kind, program, a = self._condition(text.strip(), where)
        except SceneError as error:
            raise error.at(path=where, value=text) from None
        for one in a:
            row = {
                layout.PM_TRIGGER_KIND: kind,
                layout.PM_TRIGGER_EVENT: event,
                layout.PM_TRIGGER_PROGRAM: program,
                layout.PM_TRIGGER_A: one,
            }
            self.tables.add(layout.PM_TABLE_TRIGGER, row, where)

    def _condition(self, text: str, where: str) -> tuple[int, int, tuple[int, ...]]:
        """Kind, program and partners of the triggers of a condition."""
        nothing = layout.PM_NONE
        if text == "start":
            return layout.PM_TRIGGER_START, nothing, (nothing,)
        if text == "rest":
            return layout.PM_TRIGGER_REST, nothing, (nothing,)
        change = _CHANGE.fullmatch(text)
        if change is not None:
            return self._change(change[1], change[2])
        every = _EVERY.fullmatch(text)
        if every is not None:
            return layout.PM_TRIGGER_EVERY, self._every(every[1], every[2], where), (nothing,)
        self._check_word(text)
        node = self.measures.reader.parameters.parse(text)
        if not isinstance(node, Binary) or node.operator not in _COMPARISON:
            raise SceneError(self._wanted(node))
        dimension(node, self.measures.dimension_of)
        difference = self.measures.lower(node.left, where).node - self.measures.lower(node.right, where).node
        self._moves(difference)
        program = self.tables.program(self.watched(difference, where), where)
        return _COMPARISON[node.operator], program, (nothing,)

    def _check_word(self, text: str) -> None:
        """Raises SceneError for "BODY rolls" or "CONTACT touches": with the words that there are."""
        thing, _, word = text.partition(" ")
        contacts, bodies = self.measures.scope.contacts, self.measures.drawing.bodies
        if not word.strip().isidentifier() or not (thing in contacts or thing in bodies):
            return
        guess = nearest(word.strip(), words.CONTACT_CHANGES)
        if thing in contacts:
            reason = f"a contact {', '.join(words.CONTACT_CHANGES)}"
            raise SceneError(reason + (f': did you mean "{thing} {guess}"?' if guess else ""))
        reason = f'a body only rests: "{thing} rests"; a contact {", ".join(words.CONTACT_CHANGES)}'
        near = [name for name, contact in contacts.items() if thing in contact.owners]
        raise SceneError(reason + (f', such as "{near[0]} {guess or "strikes"}"' if near else ""))

    def _wanted(self, node: Node) -> str:
        if isinstance(node, Binary) and node.operator in ("<=", ">="):
            return f"an event fires on a crossing; write {node.operator[0]}"
        if isinstance(node, Binary) and node.operator == "or":
            return "write a list of conditions instead of or"
        if isinstance(node, Number) and node.dimension == TIME:
            return f'a time is no condition: write "t = {node}"'
        return (
            'a condition is wanted: "A = B", "A > B", "A < B", "X every d", "CONTACT strikes", '
            '"start", "rest" or "BODY rests"'
        )

    def _change(self, thing: str, change: str) -> tuple[int, int, tuple[int, ...]]:
        nothing = layout.PM_NONE
        if change == "happens":
            raise SceneError('"happens" is a condition of [find]; here the name of the event stands alone')
        if change in words.CORD_CHANGES:
            return self._cord_change(thing, change)
        if change == "rests":
            return layout.PM_TRIGGER_REST, nothing, (self.measures.drawing.body_index(thing),)
        if thing in self.measures.scope.joints:
            return self._joint_change(thing, change)
        if thing in self.measures.scope.couplings:
            return self._coupling_change(thing, change)
        contacts = self.measures.scope.contacts
        name, bracket, index = (thing, "", "") if thing in contacts else thing.partition("[")
        if name not in contacts:
            if name in self.measures.scope.inactive:
                raise SceneError(f'"{name}" is not active in this run')
            raise SceneError(words.unknown(name, contacts, "contact"))
        contact = contacts[name]
        if contact.captures and change not in words.CAPTURE_CHANGES:
            reason = f'what "{name}" captures stays at its place; it {" or ".join(words.CAPTURE_CHANGES)}'
            raise SceneError(reason)
        indices = contact.indices
        if bracket:
            if not contact.is_set:
                raise words.not_built("events of one member of a row")
            member = int(index.rstrip("]"))
            if not 0 <= member < len(indices):
                raise SceneError(f"the members are [0] to [{len(indices) - 1}]")
            indices = (indices[member],)
        return _CONTACT_TRIGGER[change], nothing, indices

    def _joint_change(self, thing: str, change: str) -> tuple[int, int, tuple[int, ...]]:
        joint = self.measures.scope.joints[thing]
        if change not in _JOINT_TRIGGER:
            raise SceneError(f"a joint is always closed; it {' or '.join(_JOINT_TRIGGER)}")
        if not joint.rubs:
            raise SceneError(f'the joint "{thing}" has no friction: it neither sticks nor stops slipping')
        return _JOINT_TRIGGER[change], layout.PM_NONE, (joint.index,)

    def _coupling_change(self, thing: str, change: str) -> tuple[int, int, tuple[int, ...]]:
        """Triggers of rims that a cord may slip on, of a belt, or of both flanks of gears with backlash."""
        found = self.measures.scope.couplings[thing]
        if found.kind == "cord" and change in words.RIM_CHANGES:
            return self._rim_change(thing, change, found)
        if found.kind == "belt" and change in words.RIM_CHANGES:
            return self._belt_change(thing, change, found)
        if found.kind == "cord" or not found.indices or change not in words.CAPTURE_CHANGES:
            raise SceneError(f"{found.kind} do not {change[:-1] if change.endswith('s') else change}")
        return _CONTACT_TRIGGER[change], layout.PM_NONE, found.indices

    def _rim_change(self, thing: str, change: str, cord: CouplingInfo) -> tuple[int, int, tuple[int, ...]]:
        """Triggers of all rims that a cord may slip on."""
        if not cord.rims:
            raise SceneError(
                f'the cord "{thing}" grips its rims: it neither slips nor sticks; give it friction'
            )
        return _CONTACT_TRIGGER[change], layout.PM_NONE, cord.rims

    def _belt_change(self, thing: str, change: str, belt: CouplingInfo) -> tuple[int, int, tuple[int, ...]]:
        if not belt.may_slip or belt.index is None:
            raise SceneError(
                f'the belt "{thing}" grips: it neither slips nor sticks; give it pretension and friction'
            )
        return _JOINT_TRIGGER[change], layout.PM_NONE, (belt.index,)

    def _cord_change(self, thing: str, change: str) -> tuple[int, int, tuple[int, ...]]:
        """Triggers of all strands of a cord."""
        scope = self.measures.scope
        if thing in scope.inactive:
            raise SceneError(f'"{thing}" is not active in this run')
        cords = {name: one for name, one in scope.couplings.items() if one.kind == "cord"}
        if thing not in cords:
            raise SceneError(words.unknown(thing, cords, "cord"))
        kind = layout.PM_TRIGGER_OPEN if change == "slackens" else layout.PM_TRIGGER_STRIKE
        return kind, layout.PM_NONE, cords[thing].indices

    def _every(self, measure: str, step: str, where: str) -> int:
        """The program that reaches an integer at each multiple."""
        quantity, size = self.measures.lower(measure, where), self.measures.lower(step, where)
        if quantity.dimension != size.dimension:
            reason = f"{measure} is {quantity.dimension.phrase}, {step} is {size.dimension.phrase}"
            raise SceneError(f"{reason}; they must be of one kind")
        self._moves(quantity.node)
        return self.tables.program(self.watched(quantity.node / size.node, where), where)

    def _moves(self, node: Node) -> None:
        """Raises SceneError if a condition has nothing of the motion in it."""
        found: list[Node] = []

        def look(leaf: Node) -> Node:
            found.append(leaf)
            return leaf

        substitute(node, look)
        if not any(isinstance(leaf, Name) and self.tables.measure_index(leaf) is not None for leaf in found):
            hint = ""
            if "t" in self.measures.reader.parameters.nodes and Name("t") in found:
                hint = '; t is a parameter of this scene, the time is called "time"'
            raise SceneError(f"nothing in this condition changes with the motion{hint}")


def add_event(
    tables: Tables, path: str, nth: int | None = None, *, effect: int = layout.PM_EFFECT_NONE
) -> int:
    """A row of the event table."""
    row = {layout.PM_EVENT_NTH: nth or 0, layout.PM_EVENT_EFFECT: effect}
    return tables.add(layout.PM_TABLE_EVENT, row, path)
