"""Measures: from addresses to the kernel's measure table.

An address becomes an expression over measures: most are one row of the table; what the kernel has no row for
(a force in the axes of a body, a direction that turns, the sum over the members of a set) is composed of
several.  `Measures.lower` does so for every leaf of an expression and checks its dimensions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from . import _layout as layout
from . import words
from .address import Address
from .contacts import ContactInfo
from .drawing import GROUND, Drawing, PointRef
from .errors import SceneError
from .expression import Leaf, dimension, parse, require
from .forces import ForceInfo
from .joints import JointInfo
from .marks import LineMark
from .node import Name, Node, atan2, call, cos, negative, norm, sin
from .parameters import Reader, unknown
from .scene import Value
from .substitute import substitute
from .tables import Tables
from .units import (
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


@dataclass(frozen=True)
class Reading:
    """What an address stands for: an expression over measures and its dimension."""

    node: Node
    dimension: Dimension


@dataclass(frozen=True)
class Scope:
    """Everything that has a name in a run."""

    joints: Mapping[str, JointInfo]
    contacts: Mapping[str, ContactInfo]
    forces: Mapping[str, ForceInfo]
    events: Mapping[str, int]
    inactive: frozenset[str]


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
_OVER_SET: dict[str, str] = {"gap": "min", "closed": "+", "normal": "+", "friction": "+", "friction_needed": "max"}
# Reported with the sign of the first partner.
_SIGNED = ("slip", "friction")
_ENERGY: dict[str, int] = {
    "kinetic": layout.PM_MEASURE_KINETIC,
    "potential": layout.PM_MEASURE_POTENTIAL,
    "total": layout.PM_MEASURE_TOTAL,
    "lost": layout.PM_MEASURE_LOST,
}
_FORCE: dict[str, tuple[int, Dimension | None]] = {
    "couple": (layout.PM_MEASURE_FORCE_COUPLE, MOMENT),
    "work": (layout.PM_MEASURE_FORCE_WORK, ENERGY),
    "power": (layout.PM_MEASURE_FORCE_POWER, POWER),
    "stretch": (layout.PM_MEASURE_FORCE_STRETCH, None),
    "energy": (layout.PM_MEASURE_FORCE_ENERGY, ENERGY),
}
_PART = {
    "x": layout.PM_PART_X,
    "y": layout.PM_PART_Y,
    "norm": layout.PM_PART_NORM,
    "angle": layout.PM_PART_ANGLE,
}


class Measures:
    """The measures of a run; `scope` says what has a name."""

    def __init__(self, drawing: Drawing, reader: Reader, tables: Tables, scope: Scope) -> None:
        self.drawing = drawing
        self.reader = reader
        self.tables = tables
        self.scope = scope
        self._readings: dict[Leaf, Reading] = {}

    # ---- expressions ----

    def lower(self, written: Value | Node, where: str) -> Reading:
        """An expression over measures and parameters, made one over the kernel's leaves.

        The dimension of a plain 0, which fits any, is given as dimensionless.
        """
        node = written if isinstance(written, Node) else parse(written, where=where)
        try:
            found = dimension(node, self.dimension_of)
            lowered = substitute(node, lambda leaf: self.reading(leaf).node if self._is_measure(leaf) else leaf)
        except SceneError as error:
            raise error.at(path=where, value=None if isinstance(written, Node) else written) from None
        return Reading(lowered, found if found is not None else DIMENSIONLESS)

    def lower_as(self, written: Value, where: str, wanted: Dimension) -> Node:
        """The same for an expression whose dimension is given."""
        node = parse(written, where=where)
        try:
            require(node, wanted, self.dimension_of)
        except SceneError as error:
            raise error.at(path=where, value=written) from None
        return self.lower(node, where).node

    def dimension_of(self, leaf: Leaf) -> Dimension | None:
        """The dimension of a parameter or of a measure."""
        return self.reading(leaf).dimension if self._is_measure(leaf) else self.reader.parameters.dimension_of(leaf)

    def _is_measure(self, leaf: Leaf) -> bool:
        return isinstance(leaf, Address) or leaf.text in words.SCENE_QUANTITIES

    def reading(self, leaf: Leaf) -> Reading:
        """What an address stands for.  Raises SceneError naming the word that is wrong."""
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
        if thing in self.scope.contacts:
            return self._contact(address, self.scope.contacts[thing])
        if thing in self.scope.forces:
            return self._force(address, self.scope.forces[thing])
        if thing in self.scope.events:
            return self._event(address, self.scope.events[thing])
        if thing in self.scope.inactive:
            raise SceneError(f'"{thing}" is not active in this run')
        known = (*self.drawing.bodies, *self.scope.joints, *self.scope.contacts, *self.scope.forces)
        known = (*known, *self.scope.events, GROUND, *words.SCENE_QUANTITIES)
        raise SceneError(unknown(thing, known, "name"))

    def _scene(self, address: Address) -> Reading:
        match address.thing:
            case "t":
                self._plain(address, ())
                return Reading(self._leaf(layout.PM_MEASURE_TIME, layout.PM_NONE, address), TIME)
            case "energy":
                quantity = self._quantity(address, words.ENERGIES, "the scene's energy")
                return Reading(self._leaf(_ENERGY[quantity], layout.PM_NONE, address), ENERGY)
            case "weight":
                self._plain(address, ())
                self._need_masses(self.drawing.bodies)
                return self._weight(layout.PM_NONE, address)
            case "momentum":
                self._need_masses(self.drawing.bodies)
                kind = layout.PM_MEASURE_MOMENTUM
                return self._vector(address, address.path, [(kind, layout.PM_NONE)], IMPULSE, ("along",))
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
            known = [*marks.points, *words.POINT_QUANTITIES, *(words.BODY_QUANTITIES if owner != GROUND else ())]
            what = "the ground" if owner == GROUND else f'body "{owner}"'
            raise SceneError(f"{what}: {unknown(path[0], known, 'point or quantity')}")
        if len(path) < 2 or path[1] not in words.POINT_QUANTITIES:
            word = path[1] if len(path) > 1 else ""
            wanted = ", ".join(words.POINT_QUANTITIES)
            reason = unknown(word, words.POINT_QUANTITIES, "quantity of a point") if word else f"{wanted} is wanted"
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
            return self._vector(address, address.path[1:], [(kind, joint.index)], found, ("in", "on", "along"), on)
        self._ends(address, 1)
        if quantity == "couple":
            self._plain(address, ("on",))
            return Reading(self._leaf(layout.PM_MEASURE_JOINT_COUPLE, joint.index, address, on=on), MOMENT)
        self._plain(address, ())
        if joint.kind == "slider" and quantity == "normal":
            return Reading(self._slider_normal(address, joint), FORCE)
        if joint.kind != "rolling":
            raise SceneError(f'"{address}": a {joint.kind} has no {quantity}; it has force, couple, impulse')
        kind = {
            "normal": layout.PM_MEASURE_JOINT_NORMAL,
            "friction": layout.PM_MEASURE_JOINT_FRICTION,
            "friction_needed": layout.PM_MEASURE_JOINT_FRICTION_NEEDED,
        }[quantity]
        found = DIMENSIONLESS if quantity == "friction_needed" else FORCE
        return Reading(self._leaf(kind, joint.index, address), found)

    def _slider_normal(self, address: Address, joint: JointInfo) -> Node:
        """The force on the point towards the line's free side, on its left."""
        line = joint.partners[1]
        assert isinstance(line.mark, LineMark)
        direction = self._direction_of_line(line.owner, line.mark, None, str(address))
        kind = layout.PM_MEASURE_JOINT_FORCE
        x, y = (self._leaf(kind, joint.index, address, part=_PART[part]) for part in ("x", "y"))
        return y * cos(direction) - x * sin(direction)

    def _contact(self, address: Address, contact: ContactInfo) -> Reading:
        quantity = self._word(address, words.CONTACT_QUANTITIES, "a contact")
        indices, member = self._members(address, contact)
        if quantity in ("force", "impulse"):
            kind = layout.PM_MEASURE_CONTACT_FORCE if quantity == "force" else layout.PM_MEASURE_CONTACT_IMPULSE
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
                raise SceneError(f'"{address}": name a member of the set, such as {address.thing}[0].{quantity}')
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
            return self._vector(address, address.path[1:], [(kind, force.index)], FORCE, ("in", "on", "along"), on)
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

    # ---- vectors ----

    def _vector(
        self,
        address: Address,
        rest: tuple[str, ...],
        sources: Sequence[tuple[int, int]],
        found: Dimension,
        allowed: tuple[str, ...],
        on: int | None = None,
        member: int = layout.PM_NONE,
    ) -> Reading:
        """A part of a vector that is the sum of the `sources` (kind, a); `rest` is what follows its word."""
        self._plain(address, allowed)
        if len(rest) > 1 or (rest and rest[0] not in words.PARTS):
            raise SceneError(f'"{address}": {unknown(rest[-1], words.PARTS, "part")}')
        if bool(rest) == (address.along is not None):
            raise SceneError(f'"{address}": a part is wanted: {", ".join(words.PARTS)}, or along a direction')
        part = rest[0] if rest else "along"
        result = DIMENSIONLESS if part == "angle" else found
        # The kernel sees positions and velocities from a moving body; forces only have to be turned.
        seen = sources[0][0] in (layout.PM_MEASURE_POSITION, layout.PM_MEASURE_VELOCITY)
        direction = self._along(address) if part == "along" else None
        fixed = direction is None or not self._turns(direction)
        if len(sources) == 1 and (address.in_ is None or seen) and fixed:
            kind, a = sources[0]
            value = layout.PM_NONE
            if direction is not None:
                value = self.tables.value(direction, str(address))
            code = layout.PM_PART_ALONG if direction is not None else _PART[part]
            leaf = self._leaf(kind, a, address, part=code, on=on, value=value, member=member)
            return Reading(leaf, result)
        x, y = (self._component(address, sources, one, on, member) for one in ("x", "y"))
        if address.in_ is not None and not seen:
            angle = self._angle_of(address.in_, address)
            x, y = x * cos(angle) + y * sin(angle), y * cos(angle) - x * sin(angle)
        match part:
            case "x":
                return Reading(x, result)
            case "y":
                return Reading(y, result)
            case "norm":
                return Reading(norm(x, y), result)
            case "angle":
                return Reading(atan2(y, x), result)
        assert direction is not None
        return Reading(x * cos(direction) + y * sin(direction), result)

    def _component(
        self, address: Address, sources: Sequence[tuple[int, int]], part: str, on: int | None, member: int
    ) -> Node:
        leaves = [self._leaf(kind, a, address, part=_PART[part], on=on, member=member) for kind, a in sources]
        return sum(leaves[1:], leaves[0])

    def _along(self, address: Address) -> Node:
        """The direction behind `along`: an angle, or that of a line, which may turn with its body."""
        text = address.along
        assert text is not None
        owner, _, name = text.partition(".")
        if name and (owner == GROUND or owner in self.drawing.bodies):
            marks = self.drawing.marks(owner)
            if name not in marks.lines:
                raise SceneError(f'"{address}": {marks.has_no("line", name, marks.lines)}')
            return self._direction_of_line(owner, marks.lines[name], address.in_, str(address))
        return self.reader.number(text, str(address), DIMENSIONLESS)

    def _direction_of_line(self, owner: str, line: LineMark, seen_from: str | None, name: str) -> Node:
        if owner == seen_from or (owner == GROUND and seen_from is None):
            return line.angle
        row = self._row(layout.PM_MEASURE_ANGLE, self.drawing.body_index(owner))
        if seen_from is not None:
            row[layout.PM_MEASURE_IN] = self._body_word(seen_from, name)
        return self.tables.measure_leaf(row, name) + line.angle

    def _turns(self, direction: Node) -> bool:
        """Whether a direction depends on the state."""
        found: list[Leaf] = []

        def look(leaf: Leaf) -> Node:
            found.append(leaf)
            return leaf

        substitute(direction, look)
        return any(isinstance(leaf, Name) and self.tables.measure_index(leaf) is not None for leaf in found)

    def _angle_of(self, body: str, address: Address) -> Node:
        return self.tables.measure_leaf(self._row(layout.PM_MEASURE_ANGLE, self._body_word(body, str(address))), str(address))

    # ---- rows ----

    def _weight(self, body: int, address: Address) -> Reading:
        """Mass times g, also where gravity does not act in the plane."""
        return Reading(self._leaf(layout.PM_MEASURE_MASS, body, address) * Name("g"), FORCE)

    def _row(self, kind: int, a: int) -> dict[int, int]:
        row = {column: layout.PM_NONE for column in range(layout.PM_MEASURE_COLUMNS)}
        row[layout.PM_MEASURE_KIND] = kind
        row[layout.PM_MEASURE_A] = a
        row[layout.PM_MEASURE_PART] = layout.PM_PART_NONE
        return row

    def _leaf(
        self,
        kind: int,
        a: int,
        address: Address,
        *,
        part: int = layout.PM_PART_NONE,
        on: int | None = None,
        value: int = layout.PM_NONE,
        member: int = layout.PM_NONE,
    ) -> Node:
        """The leaf of a measure; `in` and `about` are taken from the address."""
        row = self._row(kind, a)
        row[layout.PM_MEASURE_PART] = part
        row[layout.PM_MEASURE_VALUE] = value
        row[layout.PM_MEASURE_MEMBER] = member
        if on is not None:
            row[layout.PM_MEASURE_ON] = on
        if address.in_ is not None and kind in _SEEN_FROM:
            row[layout.PM_MEASURE_IN] = self._body_word(address.in_, str(address))
        if address.about is not None:
            row[layout.PM_MEASURE_ABOUT] = self._about(address)
        return self.tables.measure_leaf(row, str(address))

    def _about(self, address: Address) -> int:
        assert address.about is not None
        ref = self.drawing.point_ref(address.about)
        if not ref.name:
            raise SceneError(f'"{address}": a point of the ground is wanted, such as ground.O')
        return self.drawing.point(ref)

    def _body_word(self, name: str, where: str) -> int:
        try:
            return self.drawing.body_index(name)
        except SceneError as error:
            raise SceneError(f'"{where}": {error.reason}') from None

    def _on(self, address: Address, owners: tuple[str, ...]) -> int | None:
        if address.on is None:
            return None
        if address.on not in owners:
            raise SceneError(f'"{address}": {address.thing} acts on {" and ".join(owners)}, not on {address.on}')
        return self.drawing.body_index(address.on)

    # ---- words ----

    def _quantity(self, address: Address, known: Sequence[str], owner: str) -> str:
        self._ends(address, 1)
        self._plain(address, ())
        return self._word(address, known, owner)

    def _word(self, address: Address, known: Sequence[str], owner: str) -> str:
        if not address.path:
            raise SceneError(f'"{address}": a quantity is wanted; {owner} has {", ".join(known)}')
        if address.path[0] not in known:
            raise SceneError(f'"{address}": {unknown(address.path[0], known, "quantity of " + owner)}')
        return address.path[0]

    def _ends(self, address: Address, length: int) -> None:
        if len(address.path) > length:
            raise SceneError(f'"{address}": {address.path[length - 1]} has no parts')

    def _plain(self, address: Address, allowed: tuple[str, ...]) -> None:
        """Raises SceneError for in, on, about, along or an index where they mean nothing."""
        given = {"in": address.in_, "on": address.on, "about": address.about, "along": address.along}
        for word, value in given.items():
            if value is not None and word not in allowed:
                raise SceneError(f'"{address}": "{word}" does not go with this quantity')
        if address.member is not None and address.thing not in self.scope.contacts:
            raise SceneError(f'"{address}": only contacts have members')

    def _need_masses(self, owners: Sequence[str] | Mapping[str, object]) -> None:
        for owner in owners:
            if owner != GROUND and not self.drawing.masses[owner].known:
                raise SceneError(f"the mass of {owner} is needed for this; give bodies.{owner}.mass")


_SEEN_FROM = (
    layout.PM_MEASURE_ANGLE,
    layout.PM_MEASURE_OMEGA,
    layout.PM_MEASURE_POSITION,
    layout.PM_MEASURE_VELOCITY,
)

