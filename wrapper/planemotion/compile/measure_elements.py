"""What an address reads of a joint, coupling, contact, force or event."""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.marks import LineMark
from ..language.address import Address
from ..language.dimensions import (
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    IMPULSE,
    LENGTH,
    MOMENT,
    POWER,
    TIME,
    VELOCITY,
    Dimension,
)
from ..language.tree import Node, call, cos, negative, sin
from ..model import words
from ..model.element import Quantity
from .contacts import ContactInfo
from .elements import CouplingInfo, ForceInfo, JointInfo
from .measure_rows import PARTS, MeasureRows, Reading

_CONTACT: dict[str, tuple[int, Dimension]] = {
    "gap": (layout.PM_MEASURE_CONTACT_GAP, LENGTH),
    "closed": (layout.PM_MEASURE_CONTACT_CLOSED, DIMENSIONLESS),
    "slip": (layout.PM_MEASURE_CONTACT_SLIP, VELOCITY),
    "normal": (layout.PM_MEASURE_CONTACT_NORMAL, FORCE),
    "friction": (layout.PM_MEASURE_CONTACT_FRICTION, FORCE),
    "friction_needed": (layout.PM_MEASURE_CONTACT_FRICTION_NEEDED, DIMENSIONLESS),
}
# How the members of a set are taken together; slip has no meaning there.
_OVER_SET: dict[str, str] = {
    "gap": "min",
    "closed": "+",
    "normal": "+",
    "friction": "+",
    "friction_needed": "max",
}
# Reported with the sign of the first partner.
_SIGNED = ("slip", "friction")
_FORCE: dict[str, tuple[int, Dimension | None]] = {
    "couple": (layout.PM_MEASURE_FORCE_COUPLE, MOMENT),
    "work": (layout.PM_MEASURE_FORCE_WORK, ENERGY),
    "power": (layout.PM_MEASURE_FORCE_POWER, POWER),
    "stretch": (layout.PM_MEASURE_FORCE_STRETCH, None),
    "stretch_rate": (layout.PM_MEASURE_FORCE_RATE, None),
    "energy": (layout.PM_MEASURE_FORCE_ENERGY, ENERGY),
}


class ElementMeasures:
    """Makes measures of addresses such as "pin.force.x" and "floor.gap"."""

    def __init__(self, rows: MeasureRows) -> None:
        self.rows = rows

    def joint(self, address: Address, joint: JointInfo) -> Reading:
        quantity = self.rows.word(address, words.JOINT_QUANTITIES, f"a {joint.kind}")
        on = self.rows.on(address, joint.owners)
        if quantity not in ("impulse", "couple"):
            self.rows.need_masses(joint.owners)
        if quantity in ("force", "impulse"):
            kind = layout.PM_MEASURE_JOINT_FORCE if quantity == "force" else layout.PM_MEASURE_JOINT_IMPULSE
            found = FORCE if quantity == "force" else IMPULSE
            return self.rows.vector(
                address, address.path[1:], [(kind, joint.index)], found, ("in", "on", "along"), on
            )
        self.rows.ends(address, 1)
        if quantity == "couple":
            self.rows.plain(address, ("on",))
            return Reading(
                self.rows.leaf(layout.PM_MEASURE_JOINT_COUPLE, joint.index, address, on=on), MOMENT
            )
        self.rows.plain(address, ())
        if quantity in joint.joint.quantities:
            source = joint.joint.quantities[quantity]
            return Reading(self.rows.leaf(source.kinds[0], joint.index, address), source.dimension)
        if quantity == "power" and self._is_driven(joint.index):
            return Reading(self.rows.leaf(layout.PM_MEASURE_JOINT_POWER, joint.index, address), POWER)
        if quantity == "normal" and isinstance(joint.partners[1].mark, LineMark):
            return Reading(self._across_line(address, joint), FORCE)
        raise SceneError(f'"{address}": a {joint.kind} has no {quantity}; it has force, couple, impulse')

    def _is_driven(self, index: int) -> bool:
        row = self.rows.tables.rows[layout.PM_TABLE_JOINT][index]
        return row[layout.PM_JOINT_PROGRAM_X] != layout.PM_NONE

    def _across_line(self, address: Address, joint: JointInfo) -> Node:
        """The force on the point towards the line's free side, on its left."""
        line = joint.partners[1]
        assert isinstance(line.mark, LineMark)
        direction = self.rows.direction_of_line(line.owner, line.mark, None, str(address))
        kind = layout.PM_MEASURE_JOINT_FORCE
        x, y = (self.rows.leaf(kind, joint.index, address, part=PARTS[part]) for part in ("x", "y"))
        return y * cos(direction) - x * sin(direction)

    def coupling(self, address: Address, coupling: CouplingInfo) -> Reading:
        quantities = coupling.coupling.quantities
        source = quantities[self.rows.word(address, tuple(quantities), f"a {coupling.kind}")]
        if coupling.indices:
            return self._strands(address, coupling, source)
        assert coupling.index is not None
        if source.vector:
            if address.member is not None:
                raise SceneError(f'"{address}": {coupling.kind} have no members')
            on = self.rows.on(address, coupling.bodies)
            rows = [(source.kinds[0], coupling.index)]
            return self.rows.vector(
                address, address.path[1:], rows, source.dimension, ("in", "on", "along"), on
            )
        self.rows.ends(address, 1)
        self.rows.plain(address, ("on",) if source.on else ())
        if source.of_rims and not coupling.may_slip:
            raise SceneError(f'"{address}": {address.thing} grips; with pretension and friction it may slip')
        on = self.rows.on(address, coupling.bodies) if source.on else None
        kind = source.kinds[self._span(address, len(source.kinds))]
        return Reading(self.rows.leaf(kind, coupling.index, address, on=on), source.dimension)

    def _strands(self, address: Address, cord: CouplingInfo, source: Quantity) -> Reading:
        """A quantity of a strand; a force of all strands that end at one of the partners."""
        if source.vector:
            return self._of_strands(address, cord, source)
        self.rows.ends(address, 1)
        if source.on:
            return self._couple_of_flanks(address, cord, source)
        self.rows.plain(address, ())
        if source.of_rims:
            return self._of_rim(address, cord, source)
        span = cord.spans[self._span(address, len(cord.spans))]
        if source.rim is not None and span.member != layout.PM_NONE:
            leaf = self.rows.leaf(source.rim, span.index, address, member=span.member)
        else:
            leaf = self.rows.leaf(_of_strand(source), span.index, address, part=source.part)
        return Reading(leaf, source.dimension)

    def _couple_of_flanks(self, address: Address, gears: CouplingInfo, source: Quantity) -> Reading:
        """The couple of the friction of teeth, whichever flank pushes."""
        self.rows.plain(address, ("on",))
        on = self.rows.on(address, gears.bodies)
        leaves = [self.rows.leaf(_of_strand(source), index, address, on=on) for index in gears.indices]
        return Reading(sum(leaves[1:], leaves[0]), source.dimension)

    def _of_rim(self, address: Address, cord: CouplingInfo, source: Quantity) -> Reading:
        """A quantity of a rim that a cord may slip on; of several, in their order."""
        if not cord.rims:
            raise SceneError(f'"{address}": {address.thing} grips its rims; with friction it may slip')
        index = cord.rims[self._span(address, len(cord.rims), "rim")]
        return Reading(self.rows.leaf(source.kinds[0], index, address), source.dimension)

    def _of_strands(self, address: Address, cord: CouplingInfo, source: Quantity) -> Reading:
        """The force of a cord on one of its partners: by all strands that end there."""
        on = address.on or cord.bodies[0]
        if on not in cord.bodies:
            raise SceneError(f'"{address}": {address.thing} acts on {" and ".join(cord.bodies)}, not on {on}')
        strands = [span.index for span, pair in zip(cord.spans, cord.owners, strict=True) if on in pair]
        rows = [(_of_strand(source), index) for index in dict.fromkeys(strands)]
        body = self.rows.drawing.body_index(on)
        return self.rows.vector(
            address, address.path[1:], rows, source.dimension, ("in", "on", "along"), body
        )

    def _span(self, address: Address, count: int, what: str = "strand") -> int:
        """Which strand, or rim, is meant, from 0."""
        if address.member is None:
            if count == 1:
                return 0
            name = f"{address.thing}.{address.path[0]}"
            raise SceneError(f'"{address}": which {what}? there are {name}[1] to [{count}]')
        if not 1 <= address.member <= count:
            raise SceneError(f'"{address}": the {what}s are [1] to [{count}]')
        return address.member - 1

    def contact(self, address: Address, contact: ContactInfo) -> Reading:
        known = words.CAPTURE_QUANTITIES if contact.captures else words.CONTACT_QUANTITIES
        quantity = self.rows.word(
            address, known, "a contact that captures" if contact.captures else "a contact"
        )
        indices, member = self._members(address, contact)
        if quantity in ("force", "impulse"):
            kind = (
                layout.PM_MEASURE_CONTACT_FORCE if quantity == "force" else layout.PM_MEASURE_CONTACT_IMPULSE
            )
            found = FORCE if quantity == "force" else IMPULSE
            on = self.rows.on(address, contact.owners)
            if on is None and contact.swapped:
                on = self.rows.drawing.body_index(contact.owners[0])
            sources = [(kind, index) for index in indices]
            return self.rows.vector(
                address, address.path[1:], sources, found, ("in", "on", "along"), on, member
            )
        self.rows.ends(address, 1)
        if quantity == "couple":
            return self._of_capture(address, contact, indices, member)
        self.rows.plain(address, ())
        kind, found = _CONTACT[quantity]
        leaves = [self.rows.leaf(kind, index, address, member=member) for index in indices]
        node = leaves[0]
        if len(leaves) > 1:
            if quantity not in _OVER_SET:
                raise SceneError(
                    f'"{address}": name a member of the set, such as {address.thing}[0].{quantity}'
                )
            together = _OVER_SET[quantity]
            node = sum(leaves[1:], leaves[0]) if together == "+" else call(together, *leaves)
        return Reading(negative(node) if contact.turned and quantity in _SIGNED else node, found)

    def _of_capture(
        self, address: Address, contact: ContactInfo, indices: tuple[int, ...], member: int
    ) -> Reading:
        """The couple that keeps what was caught as one body from turning."""
        self.rows.plain(address, ("on",))
        if not contact.holds_direction:
            raise SceneError(
                f'"{address}": it captures as a pin, which has no couple; capture = "body" has one'
            )
        on = self.rows.on(address, contact.owners)
        if on is None and contact.swapped:
            on = self.rows.drawing.body_index(contact.owners[0])
        kind = layout.PM_MEASURE_CONTACT_COUPLE
        leaves = [self.rows.leaf(kind, index, address, member=member, on=on) for index in indices]
        return Reading(sum(leaves[1:], leaves[0]), MOMENT)

    def _members(self, address: Address, contact: ContactInfo) -> tuple[tuple[int, ...], int]:
        """Kernel contacts, and the member of a row, that the index in brackets selects."""
        member = address.member
        if member is None:
            return contact.indices, layout.PM_NONE
        if contact.is_row:
            return contact.indices, member
        if not contact.is_set:
            raise SceneError(f'"{address}": only the contacts of a set or a row have members')
        if not 0 <= member < len(contact.indices):
            raise SceneError(f'"{address}": the members are [0] to [{len(contact.indices) - 1}]')
        return (contact.indices[member],), layout.PM_NONE

    def force(self, address: Address, force: ForceInfo) -> Reading:
        quantity = self.rows.word(address, words.FORCE_QUANTITIES, "a force")
        if quantity == "force":
            on = self.rows.on(address, force.owners)
            kind = layout.PM_MEASURE_FORCE_FORCE
            return self.rows.vector(
                address, address.path[1:], [(kind, force.index)], FORCE, ("in", "on", "along"), on
            )
        self.rows.ends(address, 1)
        self.rows.plain(address, ())
        kind, found = _FORCE[quantity]
        if quantity == "energy" and not force.stores:
            raise SceneError(f'"{address}": it has no potential; ask for its work')
        if found is None:
            found = DIMENSIONLESS if force.rotary else LENGTH
            found = found / TIME if quantity == "stretch_rate" else found
        leaf = self.rows.leaf(kind, force.index, address)
        return Reading(leaf - force.free if quantity == "stretch" and force.free is not None else leaf, found)

    def event(self, address: Address, event: int) -> Reading:
        quantity = self.rows.word(address, words.EVENT_QUANTITIES, "an event")
        self.rows.ends(address, 1)
        self.rows.plain(address, ())
        count = quantity == "count"
        kind = layout.PM_MEASURE_EVENT_COUNT if count else layout.PM_MEASURE_EVENT_TIME
        return Reading(self.rows.leaf(kind, event, address), DIMENSIONLESS if count else TIME)


def _of_strand(source: Quantity) -> int:
    return source.kinds[0] if source.strand is None else source.strand
