"""Rows of the measure table: one for a scalar or a part of a vector, several where the kernel has no row.

A force in the axes of a body, a direction that turns with a body and the sum over the members of a set are
composed of the components that the kernel does have.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawn_rows import DrawnRows
from ..geometry.marks import LineMark
from ..geometry.packing import Tables, empty_measure
from ..geometry.parameters import Reader
from ..language.address import Address
from ..language.dimensions import DIMENSIONLESS, FORCE, Dimension
from ..language.leaves import names
from ..language.tree import Name, Node, atan2, cos, norm, sin
from ..model import words
from ..model.words import GROUND
from .contacts import ContactInfo
from .elements import CouplingInfo, DriveInfo, ForceInfo, JointInfo

# Parts of a vector.
PARTS = {
    "x": layout.PM_PART_X,
    "y": layout.PM_PART_Y,
    "norm": layout.PM_PART_NORM,
    "angle": layout.PM_PART_ANGLE,
}
# Measures that the kernel can see from a moving body.
_SEEN_FROM = (
    layout.PM_MEASURE_ANGLE,
    layout.PM_MEASURE_OMEGA,
    layout.PM_MEASURE_POSITION,
    layout.PM_MEASURE_VELOCITY,
)


@dataclass(frozen=True)
class Reading:
    """An expression over measures, and its dimension; `energy`: where that says so, it is no couple."""

    node: Node
    dimension: Dimension
    energy: bool = False


@dataclass(frozen=True)
class Scope:
    """Everything that has a name in a run."""

    joints: Mapping[str, JointInfo]
    couplings: Mapping[str, CouplingInfo]
    contacts: Mapping[str, ContactInfo]
    forces: Mapping[str, ForceInfo]
    events: Mapping[str, int]
    driven: Mapping[str, DriveInfo]
    inactive: frozenset[str]


class MeasureRows:
    """Makes measures of what an address says behind its quantity: part, in, on, about, along, member."""

    def __init__(self, drawn: DrawnRows, reader: Reader, tables: Tables, scope: Scope) -> None:
        self.drawn = drawn
        self.drawing = drawn.drawing
        self.reader = reader
        self.tables = tables
        self.scope = scope

    # ---- vectors ----

    def vector(
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
        self.plain(address, allowed)
        if len(rest) > 1:
            one = replace(address, path=address.path[:-1], along=None)
            reason = (
                f'"{one}" is one number and has no part "{rest[-1]}"; a vector has parts, such as velocity.x'
            )
            raise SceneError(f'"{address}": {reason}')
        if rest and rest[0] not in words.PARTS:
            raise SceneError(f'"{address}": {words.unknown(rest[-1], words.PARTS, "part")}')
        if bool(rest) == (address.along is not None):
            example = (
                "" if rest else f', such as "{replace(address, path=(*address.path, "norm"), along=None)}"'
            )
            parts = f"{', '.join(words.PARTS)}, or along a direction"
            raise SceneError(f'"{address}": a part is wanted: {parts}{example}')
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
            code = layout.PM_PART_ALONG if direction is not None else PARTS[part]
            leaf = self.leaf(kind, a, address, part=code, on=on, value=value, member=member)
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
        leaves = [self.leaf(kind, a, address, part=PARTS[part], on=on, member=member) for kind, a in sources]
        return sum(leaves[1:], leaves[0])

    def _along(self, address: Address) -> Node:
        """The direction behind `along`: an angle, or that of a line, which may turn with its body."""
        text = address.along
        assert text is not None
        owner, name = self.drawing.names.owner(text)
        if name and (owner == GROUND or owner in self.drawing.bodies):
            marks = self.drawing.marks(owner)
            if name not in marks.lines:
                raise SceneError(f'"{address}": {marks.has_no("line", name, marks.lines)}')
            return self.direction_of_line(owner, marks.lines[name], address.in_, str(address))
        return self.reader.number(text, str(address), DIMENSIONLESS)

    def direction_of_line(self, owner: str, line: LineMark, seen_from: str | None, name: str) -> Node:
        if owner == seen_from or (owner == GROUND and seen_from is None):
            return line.angle
        row = self._row(layout.PM_MEASURE_ANGLE, self.drawing.body_index(owner))
        if seen_from is not None:
            row[layout.PM_MEASURE_IN] = self._body_word(seen_from, name)
        return self.tables.measure_leaf(row, name) + line.angle

    def _turns(self, direction: Node) -> bool:
        """Whether a direction depends on the state."""
        return any(
            isinstance(leaf, Name) and self.tables.measure_index(leaf) is not None
            for leaf in names(direction)
        )

    def _angle_of(self, body: str, address: Address) -> Node:
        return self.tables.measure_leaf(
            self._row(layout.PM_MEASURE_ANGLE, self._body_word(body, str(address))), str(address)
        )

    # ---- rows ----

    def weight(self, body: int, address: Address) -> Reading:
        """Mass times g, also where gravity does not act in the plane."""
        return Reading(self.leaf(layout.PM_MEASURE_MASS, body, address) * Name("g"), FORCE)

    def _row(self, kind: int, a: int) -> dict[int, int]:
        return empty_measure(kind) | {layout.PM_MEASURE_A: a}

    def leaf(
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
        return self.drawn.point(ref)

    def _body_word(self, name: str, where: str) -> int:
        try:
            return self.drawing.body_index(name)
        except SceneError as error:
            raise SceneError(f'"{where}": {error.reason}') from None

    def on(self, address: Address, owners: tuple[str, ...]) -> int | None:
        if address.on is None:
            return None
        if address.on not in owners:
            raise SceneError(
                f'"{address}": {address.thing} acts on {" and ".join(owners)}, not on {address.on}'
            )
        return self.drawing.body_index(address.on)

    # ---- words ----

    def quantity(self, address: Address, known: Sequence[str], owner: str) -> str:
        self.ends(address, 1)
        self.plain(address, ())
        return self.word(address, known, owner)

    def word(self, address: Address, known: Sequence[str], owner: str) -> str:
        if not address.path:
            raise SceneError(f'"{address}": a quantity is wanted; {owner} has {", ".join(known)}')
        if address.path[0] in words.CONTACT_CHANGES and len(address.path) > 1:
            condition, count = f"{address.thing} {address.path[0]}", ".".join(address.path[1:])
            reason = f'an event is asked for it: events.NAME = "{condition}", then NAME.{count}'
            raise SceneError(f'"{address}": {reason}')
        if address.path[0] not in known:
            raise SceneError(f'"{address}": {words.unknown(address.path[0], known, "quantity of " + owner)}')
        return address.path[0]

    def ends(self, address: Address, length: int) -> None:
        if len(address.path) > length:
            word = (address.thing, *address.path)[length]
            raise SceneError(f'"{address}": {word} has no parts')

    def plain(self, address: Address, allowed: tuple[str, ...]) -> None:
        """Raises SceneError for in, on, about, along or an index where they mean nothing."""
        given = {"in": address.in_, "on": address.on, "about": address.about, "along": address.along}
        for word, value in given.items():
            if value is not None and word not in allowed:
                raise SceneError(f'"{address}": "{word}" does not go with this quantity')
        has_members = address.thing in self.scope.contacts or address.thing in self.scope.couplings
        if address.member is not None and not has_members:
            raise SceneError(f'"{address}": only contacts have members')

    def need_masses(self, owners: Sequence[str] | Mapping[str, object]) -> None:
        for owner in owners:
            if owner != GROUND and not self.drawn.masses[owner].known:
                raise SceneError(f"the mass of {owner} is needed for this; give bodies.{owner}.mass")
