"""Measures: from addresses to the kernel's measure table.

An address becomes an expression over measures: most are one row of the table; what the kernel has no row for
(a force in the axes of a body, a direction that turns, the sum over the members of a set) is composed of
several.  `Measures.lower` does so for every leaf of an expression and checks its dimensions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from .. import _layout as layout
from ..base.errors import SceneError, nearest
from ..geometry.drawing import Drawing
from ..geometry.marks import LineMark
from ..geometry.packing import Tables
from ..geometry.parameters import Reader
from ..geometry.pose import GROUND, PointRef
from ..language.address import Address
from ..language.dimensions import (
    ACCELERATION,
    ANGULAR_ACCELERATION,
    ANGULAR_MOMENTUM,
    ANGULAR_VELOCITY,
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    IMPULSE,
    INERTIA,
    LENGTH,
    MASS,
    MOMENT,
    POWER,
    TIME,
    VELOCITY,
    Dimension,
)
from ..language.homogeneity import dimension
from ..language.leaves import Leaf, substitute
from ..language.parser import parse
from ..language.tree import Name, Node, call, cos, negative, sin
from ..model import words
from ..model.element import Quantity
from ..model.readers import Value
from .contacts import ContactInfo
from .couplings import CouplingInfo
from .forces import ForceInfo
from .joints import JointInfo
from .measure_rows import PARTS, MeasureRows, Reading, Scope

# Scalar of a body: measure kind, dimension, words that may follow.
_BODY: dict[str, tuple[int, Dimension, tuple[str, ...]]] = {
    "angle": (layout.PM_MEASURE_ANGLE, DIMENSIONLESS, ("in",)),
    "turned": (layout.PM_MEASURE_TURNED, DIMENSIONLESS, ()),
    "omega": (layout.PM_MEASURE_OMEGA, ANGULAR_VELOCITY, ("in",)),
    "alpha": (layout.PM_MEASURE_ALPHA, ANGULAR_ACCELERATION, ()),
    "mass": (layout.PM_MEASURE_MASS, MASS, ()),
    "inertia": (layout.PM_MEASURE_INERTIA, INERTIA, ("about",)),
    "kinetic_energy": (layout.PM_MEASURE_KINETIC, ENERGY, ()),
    "angular_momentum": (layout.PM_MEASURE_ANGULAR_MOMENTUM, ANGULAR_MOMENTUM, ("about",)),
}
_POINT_VECTOR: dict[str, tuple[int, Dimension, tuple[str, ...]]] = {
    "position": (layout.PM_MEASURE_POSITION, LENGTH, ("in", "along")),
    "moved": (layout.PM_MEASURE_MOVED, LENGTH, ("along",)),
    "velocity": (layout.PM_MEASURE_VELOCITY, VELOCITY, ("in", "along")),
    "acceleration": (layout.PM_MEASURE_ACCELERATION, ACCELERATION, ("along",)),
}
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
_ENERGY: dict[str, int] = {
    "kinetic": layout.PM_MEASURE_KINETIC,
    "potential": layout.PM_MEASURE_POTENTIAL,
    "total": layout.PM_MEASURE_TOTAL,
    "lost": layout.PM_MEASURE_LOST,
}
_SPIN: dict[str, tuple[int, Dimension]] = {
    "omega": (layout.PM_MEASURE_SPIN_OMEGA, ANGULAR_VELOCITY),
    "angle": (layout.PM_MEASURE_SPIN_ANGLE, DIMENSIONLESS),
    "momentum": (layout.PM_MEASURE_SPIN_MOMENTUM, ANGULAR_MOMENTUM),
    "inertia": (layout.PM_MEASURE_SPIN_INERTIA, INERTIA),
}
_FORCE: dict[str, tuple[int, Dimension | None]] = {
    "couple": (layout.PM_MEASURE_FORCE_COUPLE, MOMENT),
    "work": (layout.PM_MEASURE_FORCE_WORK, ENERGY),
    "power": (layout.PM_MEASURE_FORCE_POWER, POWER),
    "stretch": (layout.PM_MEASURE_FORCE_STRETCH, None),
    "energy": (layout.PM_MEASURE_FORCE_ENERGY, ENERGY),
}


class Measures(MeasureRows):
    """The measures of a run; `scope` says what has a name."""

    def __init__(self, drawing: Drawing, reader: Reader, tables: Tables, scope: Scope) -> None:
        super().__init__(drawing, reader, tables, scope)
        self._readings: dict[Leaf, Reading] = {}
        self._answers: Mapping[str, Reading] = {}

    @contextmanager
    def answered(self, answers: Mapping[str, Reading]) -> Iterator[None]:
        """Meanwhile names of asks stand for their answers."""
        self._answers = answers
        try:
            yield
        finally:
            self._answers = {}

    # ---- expressions ----

    def lower(self, written: Value | Node, where: str) -> Reading:
        """An expression over measures and parameters, made one over the kernel's leaves.

        The dimension of a plain 0, which fits any, is given as dimensionless.
        """
        node = written if isinstance(written, Node) else parse(written, where=where)
        try:
            found = dimension(node, self.dimension_of)
            lowered = substitute(
                node, lambda leaf: self.reading(leaf).node if self._is_measure(leaf) else leaf
            )
        except SceneError as error:
            # The address at fault is named in the reason, which is needless where it is all that is written.
            reason = error.reason.removeprefix(f'"{written}": ')
            shown = None if isinstance(written, Node) else written
            raise SceneError(reason, path=error.path or where, value=error.value or shown) from None
        return Reading(lowered, found if found is not None else DIMENSIONLESS)

    def dimension_of(self, leaf: Leaf) -> Dimension | None:
        """The dimension of a parameter or of a measure."""
        return (
            self.reading(leaf).dimension
            if self._is_measure(leaf)
            else self.reader.parameters.dimension_of(leaf)
        )

    def _is_measure(self, leaf: Leaf) -> bool:
        if isinstance(leaf, Address):
            return True
        if leaf.text in self.reader.parameters.nodes:
            return False  # also a parameter called t: the time is then called time
        return leaf.text in words.SCENE_QUANTITIES or leaf.text in self._answers

    def reading(self, leaf: Leaf) -> Reading:
        """What an address stands for.  Raises SceneError naming the word that is wrong."""
        if isinstance(leaf, Name) and leaf.text in self._answers:
            return self._answers[leaf.text]
        if leaf not in self._readings:
            address = leaf if isinstance(leaf, Address) else Address(leaf.text)
            self._readings[leaf] = self._read(address)
        return self._readings[leaf]

    # ---- things ----

    def _read(self, address: Address) -> Reading:
        thing = address.thing
        if thing in words.SCENE_QUANTITIES:
            return self._scene(address)
        if thing in self.drawing.bodies or thing == GROUND:
            return self._body(address)
        if thing in self.scope.joints:
            return self._joint(address, self.scope.joints[thing])
        if thing in self.scope.couplings:
            return self._coupling(address, self.scope.couplings[thing])
        if thing in self.scope.contacts:
            return self._contact(address, self.scope.contacts[thing])
        if thing in self.scope.forces:
            return self._force(address, self.scope.forces[thing])
        if thing in self.scope.events:
            return self._event(address, self.scope.events[thing])
        if thing in self.scope.inactive:
            raise SceneError(f'"{thing}" is not active in this run')
        known = (*self.drawing.bodies, *self.scope.joints, *self.scope.couplings, *self.scope.contacts)
        known = (*known, *self.scope.forces)
        known = (*known, *self.scope.events, GROUND, *words.SCENE_QUANTITIES)
        raise SceneError(words.unknown(thing, known, "name"))

    def _scene(self, address: Address) -> Reading:
        match address.thing:
            case "t" | "time":
                self._ends(address, 0)
                self._plain(address, ())
                return Reading(self._leaf(layout.PM_MEASURE_TIME, layout.PM_NONE, address), TIME)
            case "energy":
                quantity = self._quantity(address, words.ENERGIES, "the scene's energy")
                return Reading(self._leaf(_ENERGY[quantity], layout.PM_NONE, address), ENERGY)
            case "spin":
                if not self.tables.rows[layout.PM_TABLE_SPIN]:
                    raise SceneError(f'"{address}": the scene has no [spin]')
                kind, found = _SPIN[self._quantity(address, words.SPIN_QUANTITIES, "the spin")]
                return Reading(self._leaf(kind, layout.PM_NONE, address), found)
            case "weight":
                self._ends(address, 0)
                self._plain(address, ())
                self._need_masses(self.drawing.bodies)
                return self._weight(layout.PM_NONE, address)
            case "momentum":
                self._need_masses(self.drawing.bodies)
                kind = layout.PM_MEASURE_MOMENTUM
                return self._vector(address, address.path, [(kind, layout.PM_NONE)], IMPULSE, ("along",))
        self._ends(address, 0)
        self._plain(address, ("about",))
        self._need_masses(self.drawing.bodies)
        leaf = self._leaf(layout.PM_MEASURE_ANGULAR_MOMENTUM, layout.PM_NONE, address)
        return Reading(leaf, ANGULAR_MOMENTUM)

    def _body(self, address: Address) -> Reading:
        owner, path = address.thing, address.path
        if not path:
            raise SceneError(f'"{address}": a quantity is wanted, such as {owner}.x')
        if path[0] in words.BODY_QUANTITIES and owner != GROUND:
            return self._of_body(address, owner)
        if path[0] in words.POINT_QUANTITIES:
            if owner == GROUND:
                raise SceneError(f'"{address}": a point of the ground is wanted before {path[0]}')
            return self._of_point(address, PointRef(owner, "G"), path)
        marks = self.drawing.marks(owner)
        if path[0] not in marks.points:
            quantities = (*words.POINT_QUANTITIES, *(words.BODY_QUANTITIES if owner != GROUND else ()))
            guess = nearest(path[0], [*marks.points, *quantities])
            hint = f' (did you mean "{guess}"?)' if guess else ""
            raise SceneError(marks.has_no("point or quantity", path[0], marks.points) + hint)
        if len(path) < 2 or path[1] not in words.POINT_QUANTITIES:
            word = path[1] if len(path) > 1 else ""
            wanted = ", ".join(words.POINT_QUANTITIES)
            reason = (
                words.unknown(word, words.POINT_QUANTITIES, "quantity of a point")
                if word
                else f"{wanted} is wanted"
            )
            raise SceneError(f'"{address}": {reason}')
        return self._of_point(address, PointRef(owner, path[0]), path[1:])

    def _of_body(self, address: Address, owner: str) -> Reading:
        quantity = address.path[0]
        index = self.drawing.body_index(owner)
        if quantity in ("mass", "weight", "momentum"):
            self._need_masses((owner,))
        if quantity == "weight":
            self._ends(address, 1)
            self._plain(address, ())
            return self._weight(index, address)
        if quantity in ("momentum", "pole"):
            kind = layout.PM_MEASURE_MOMENTUM if quantity == "momentum" else layout.PM_MEASURE_POLE
            found = IMPULSE if quantity == "momentum" else LENGTH
            return self._vector(address, address.path[1:], [(kind, index)], found, ("along",))
        kind, found, allowed = _BODY[quantity]
        self._ends(address, 1)
        self._plain(address, allowed)
        return Reading(self._leaf(kind, index, address), found)

    def _of_point(self, address: Address, ref: PointRef, path: tuple[str, ...]) -> Reading:
        """A quantity of a point; `path` begins with its word."""
        index = self.drawing.point(ref)
        quantity = path[0]
        if quantity in ("x", "y"):
            return self._vector(address, path, [(layout.PM_MEASURE_POSITION, index)], LENGTH, ("in",))
        if quantity == "speed":
            kind = layout.PM_MEASURE_VELOCITY
            return self._vector(address, ("norm", *path[1:]), [(kind, index)], VELOCITY, ("in",))
        if quantity == "path":
            self._ends(address, len(address.path) - len(path) + 1)
            self._plain(address, ())
            return Reading(self._leaf(layout.PM_MEASURE_PATH, index, address), LENGTH)
        kind, found, allowed = _POINT_VECTOR[quantity]
        return self._vector(address, path[1:], [(kind, index)], found, allowed)

    def _joint(self, address: Address, joint: JointInfo) -> Reading:
        quantity = self._word(address, words.JOINT_QUANTITIES, f"a {joint.kind}")
        on = self._on(address, joint.owners)
        if quantity not in ("impulse", "couple"):
            self._need_masses(joint.owners)
        if quantity in ("force", "impulse"):
            kind = layout.PM_MEASURE_JOINT_FORCE if quantity == "force" else layout.PM_MEASURE_JOINT_IMPULSE
            found = FORCE if quantity == "force" else IMPULSE
            return self._vector(
                address, address.path[1:], [(kind, joint.index)], found, ("in", "on", "along"), on
            )
        self._ends(address, 1)
        if quantity == "couple":
            self._plain(address, ("on",))
            return Reading(self._leaf(layout.PM_MEASURE_JOINT_COUPLE, joint.index, address, on=on), MOMENT)
        self._plain(address, ())
        if quantity in joint.joint.quantities:
            source = joint.joint.quantities[quantity]
            return Reading(self._leaf(source.kinds[0], joint.index, address), source.dimension)
        if quantity == "normal" and isinstance(joint.partners[1].mark, LineMark):
            return Reading(self._across_line(address, joint), FORCE)
        raise SceneError(f'"{address}": a {joint.kind} has no {quantity}; it has force, couple, impulse')

    def _across_line(self, address: Address, joint: JointInfo) -> Node:
        """The force on the point towards the line's free side, on its left."""
        line = joint.partners[1]
        assert isinstance(line.mark, LineMark)
        direction = self._direction_of_line(line.owner, line.mark, None, str(address))
        kind = layout.PM_MEASURE_JOINT_FORCE
        x, y = (self._leaf(kind, joint.index, address, part=PARTS[part]) for part in ("x", "y"))
        return y * cos(direction) - x * sin(direction)

    def _coupling(self, address: Address, coupling: CouplingInfo) -> Reading:
        quantities = coupling.coupling.quantities
        source = quantities[self._word(address, tuple(quantities), f"a {coupling.kind}")]
        if coupling.indices:
            return self._strands(address, coupling, source)
        assert coupling.index is not None
        if source.vector:
            if address.member is not None:
                raise SceneError(f'"{address}": {coupling.kind} have no members')
            on = self._on(address, coupling.bodies)
            rows = [(source.kinds[0], coupling.index)]
            return self._vector(address, address.path[1:], rows, source.dimension, ("in", "on", "along"), on)
        self._ends(address, 1)
        self._plain(address, ("on",) if source.on else ())
        on = self._on(address, coupling.bodies) if source.on else None
        kind = source.kinds[self._span(address, len(source.kinds))]
        return Reading(self._leaf(kind, coupling.index, address, on=on), source.dimension)

    def _strands(self, address: Address, cord: CouplingInfo, source: Quantity) -> Reading:
        """A quantity of a strand; a force of all strands that end at one of the partners."""
        if source.vector:
            return self._of_strands(address, cord, source)
        self._ends(address, 1)
        self._plain(address, ())
        kind, index = source.kinds[0], cord.indices[self._span(address, len(cord.indices))]
        return Reading(self._leaf(kind, index, address, part=source.part), source.dimension)

    def _of_strands(self, address: Address, cord: CouplingInfo, source: Quantity) -> Reading:
        """The force of a cord on one of its partners: by all strands that end there."""
        on = address.on or cord.bodies[0]
        if on not in cord.bodies:
            raise SceneError(f'"{address}": {address.thing} acts on {" and ".join(cord.bodies)}, not on {on}')
        strands = [i for i, pair in zip(cord.indices, cord.owners, strict=True) if on in pair]
        rows = [(source.kinds[0], index) for index in strands]
        body = self.drawing.body_index(on)
        return self._vector(address, address.path[1:], rows, source.dimension, ("in", "on", "along"), body)

    def _span(self, address: Address, count: int) -> int:
        """Which strand is meant, from 0."""
        if address.member is None:
            if count == 1:
                return 0
            name = f"{address.thing}.{address.path[0]}"
            raise SceneError(f'"{address}": which strand? there are {name}[1] to [{count}]')
        if not 1 <= address.member <= count:
            raise SceneError(f'"{address}": the strands are [1] to [{count}]')
        return address.member - 1

    def _contact(self, address: Address, contact: ContactInfo) -> Reading:
        known = words.CAPTURE_QUANTITIES if contact.captures else words.CONTACT_QUANTITIES
        quantity = self._word(address, known, "a contact that captures" if contact.captures else "a contact")
        indices, member = self._members(address, contact)
        if quantity in ("force", "impulse"):
            kind = (
                layout.PM_MEASURE_CONTACT_FORCE if quantity == "force" else layout.PM_MEASURE_CONTACT_IMPULSE
            )
            found = FORCE if quantity == "force" else IMPULSE
            on = self._on(address, contact.owners)
            if on is None and contact.swapped:
                on = self.drawing.body_index(contact.owners[0])
            sources = [(kind, index) for index in indices]
            return self._vector(address, address.path[1:], sources, found, ("in", "on", "along"), on, member)
        self._ends(address, 1)
        self._plain(address, ())
        kind, found = _CONTACT[quantity]
        leaves = [self._leaf(kind, index, address, member=member) for index in indices]
        node = leaves[0]
        if len(leaves) > 1:
            if quantity not in _OVER_SET:
                raise SceneError(
                    f'"{address}": name a member of the set, such as {address.thing}[0].{quantity}'
                )
            together = _OVER_SET[quantity]
            node = sum(leaves[1:], leaves[0]) if together == "+" else call(together, *leaves)
        return Reading(negative(node) if contact.swapped and quantity in _SIGNED else node, found)

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

    def _force(self, address: Address, force: ForceInfo) -> Reading:
        quantity = self._word(address, words.FORCE_QUANTITIES, "a force")
        if quantity == "force":
            on = self._on(address, force.owners)
            kind = layout.PM_MEASURE_FORCE_FORCE
            return self._vector(
                address, address.path[1:], [(kind, force.index)], FORCE, ("in", "on", "along"), on
            )
        self._ends(address, 1)
        self._plain(address, ())
        kind, found = _FORCE[quantity]
        if found is None:
            found = DIMENSIONLESS if force.rotary else LENGTH
        return Reading(self._leaf(kind, force.index, address), found)

    def _event(self, address: Address, event: int) -> Reading:
        quantity = self._word(address, words.EVENT_QUANTITIES, "an event")
        self._ends(address, 1)
        self._plain(address, ())
        count = quantity == "count"
        kind = layout.PM_MEASURE_EVENT_COUNT if count else layout.PM_MEASURE_EVENT_TIME
        return Reading(self._leaf(kind, event, address), DIMENSIONLESS if count else TIME)
