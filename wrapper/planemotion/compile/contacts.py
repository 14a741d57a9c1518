"""Contacts: from two marks that may touch to rows of the kernel's contact table.

The kernel wants a circle (of radius 0: a point) first and a line, circle, curve or row second; what is
written the other way round is exchanged, and `ContactInfo.swapped` tells the measures, which report on the
first partner as written.  A set of points becomes one row for each member.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.curves import CurveMark
from ..geometry.drawn_rows import DrawnRows
from ..geometry.friction import friction_law
from ..geometry.marks import LineMark, RowMark
from ..geometry.packing import Tables, over_time
from ..geometry.pairs import is_pair, is_swapped, kernel_curve
from ..geometry.parameters import Reader
from ..geometry.partners import Partner, different, kernel_circle, side, touching
from ..language.dimensions import DIMENSIONLESS, STIFFNESS, VELOCITY
from ..language.tree import Number
from ..model.readers import Value
from ..model.tables import Contact
from ..model.words import GROUND

_ROUND = ("circle", "point")
_CAPTURES = {
    "none": layout.PM_CAPTURE_NONE,
    "pin": layout.PM_CAPTURE_POINT,
    "body": layout.PM_CAPTURE_BODY,
}


@dataclass(frozen=True)
class ContactInfo:
    """What measures and events need to know of a contact.

    `indices`: its rows, one for each member of a set; `owners`: of the first and second partner as written;
    `swapped`: the kernel has them the other way round; `turned`: and counts slip and friction along the same
    direction (each of two curves has its own, against the other's); `is_row`: the members are those of a row;
    `is_set`: the members are the rows of `indices`; `captures`: what arrives stays; `holds_direction`:
    and does not turn against what it stays at.
    """

    indices: tuple[int, ...]
    owners: tuple[str, str]
    swapped: bool
    turned: bool
    is_row: bool
    is_set: bool
    captures: bool
    holds_direction: bool


_PAINLEVE = {"stop": layout.PM_PAINLEVE_STOPS, "impact": layout.PM_PAINLEVE_STRIKES}


class Contacts:
    """Adds contacts to the tables."""

    def __init__(self, drawn: DrawnRows, reader: Reader, tables: Tables) -> None:
        self.drawn = drawn
        self.drawing = drawn.drawing
        self.reader = reader
        self.tables = tables

    def add(self, name: str, contact: Contact) -> ContactInfo:
        """Adds the rows of one contact.  Raises SceneError for marks that cannot touch each other."""
        path = f"contacts.{name}"
        first, second = touching(self.drawing, contact.partners, f"{path}.touch")
        for one in (first, second):
            self._check(one)
        a, b = first, second
        swapped = is_swapped(a, b)
        if swapped:
            a, b = b, a
        is_set = a.kind == "set"
        members = self._members(a)
        laws = self._laws(contact, path)
        rows = []
        for member, one in enumerate(members):
            row = {**self._geometry(one, b, contact, path, swapped), **laws}
            label = f"{path}[{member}]" if is_set else path
            rows.append(self.tables.add(layout.PM_TABLE_CONTACT, row, label))
        owners = (first.owner, second.owner)
        captures = contact.capture != "none"
        turns = all(one.is_ground or self.drawing.bodies[one.owner].rotates for one in (first, second))
        whole = contact.capture == "body" and turns
        turned = swapped and not is_pair(first, second)
        return ContactInfo(tuple(rows), owners, swapped, turned, b.kind == "row", is_set, captures, whole)

    def _check(self, one: Partner) -> None:
        if one.anywhere:
            reason = "a mark of the ground is wanted, such as ground.floor"
            raise SceneError(reason, path=one.where, value=GROUND)

    def _members(self, one: Partner) -> list[Partner]:
        """The points of a set; anything else by itself."""
        if one.kind != "set":
            return [one]
        assert isinstance(one.mark, tuple)
        return [replace(one, kind="point", name=point, mark=None) for point in one.mark]

    def _geometry(self, a: Partner, b: Partner, contact: Contact, path: str, swapped: bool) -> dict[int, int]:
        """Kind, partners and side of a row."""
        if is_pair(a, b):
            return self._curves(a, b, contact, path)
        if a.kind not in _ROUND or b.kind == "set":
            raise SceneError(
                f"a {a.kind} and a {b.kind} do not touch; first a circle, a point or a plate's corners, or a "
                "curve or an edge beside a curve",
                path=f"{path}.touch",
            )
        different(a, b)
        points = a.kind == "point" and b.kind == "point"
        if contact.normal is not None and not points:
            raise SceneError("only two points need a normal", path=f"{path}.normal", value=contact.normal)
        if contact.surface_speed is not None and (swapped or b.kind != "line"):
            reason = "the second mark must be a line to have a surface that runs along it"
            raise SceneError(reason, path=f"{path}.surface_speed", value=contact.surface_speed)
        side_value = layout.PM_NONE
        ends: tuple[int, ...] = (layout.PM_NONE, layout.PM_NONE)
        if b.kind == "line":
            assert isinstance(b.mark, LineMark)
            kind, other = layout.PM_CONTACT_LINE, self.drawn.line(b.owner, b.mark, b.where)
            if b.mark.extent is not None:
                kind = layout.PM_CONTACT_SEGMENT
                ends = tuple(self.tables.value(end, b.where) for end in b.mark.extent)
        elif b.kind == "curve":
            assert isinstance(b.mark, CurveMark)
            self._captures_nothing(contact, path)
            kind, other = layout.PM_CONTACT_CURVE, self.drawn.curve(b.owner, b.mark, b.mark_path)
        elif b.kind == "row":
            assert isinstance(b.mark, RowMark)
            if a.kind == "point":
                raise SceneError(
                    "a circle is wanted to touch a row of points", path=a.where, value=str(a.ref)
                )
            kind, other = layout.PM_CONTACT_PATTERN, self.drawn.row(b.mark, b.where)
        elif points and contact.capture != "none" and contact.normal is None:
            kind, other = layout.PM_CONTACT_POINT, kernel_circle(self.drawn, b)
        elif points:
            kind, other = layout.PM_CONTACT_LINE, self._line_through(a, b, contact.normal, path)
        else:
            kind, other = layout.PM_CONTACT_CIRCLE, kernel_circle(self.drawn, b)
            side_value = self.tables.value(side(self.drawing, a, b), f"{path}.touch")
        return {
            layout.PM_CONTACT_KIND: kind,
            layout.PM_CONTACT_A: kernel_circle(self.drawn, a),
            layout.PM_CONTACT_B: other,
            layout.PM_CONTACT_SIDE: side_value,
            layout.PM_CONTACT_FROM: ends[0],
            layout.PM_CONTACT_TO: ends[1],
        }

    def _curves(self, a: Partner, b: Partner, contact: Contact, path: str) -> dict[int, int]:
        """Two curves, of which the first may be an edge."""
        different(a, b)
        self._captures_nothing(contact, path)
        for key in ("normal", "surface_speed"):
            if getattr(contact, key) is not None:
                raise SceneError(f"two curves have no {key}", path=f"{path}.{key}")
        return {
            layout.PM_CONTACT_KIND: layout.PM_CONTACT_CURVES,
            layout.PM_CONTACT_A: kernel_curve(self.drawn, a, whole=True),
            layout.PM_CONTACT_B: kernel_curve(self.drawn, b),
            layout.PM_CONTACT_SIDE: layout.PM_NONE,
            layout.PM_CONTACT_FROM: layout.PM_NONE,
            layout.PM_CONTACT_TO: layout.PM_NONE,
        }

    def _captures_nothing(self, contact: Contact, path: str) -> None:
        if contact.capture != "none":
            reason = "a curve captures nothing: a line, a circle or a point does"
            raise SceneError(reason, path=f"{path}.capture", value=contact.capture)

    def _line_through(self, a: Partner, b: Partner, normal: Value | None, path: str) -> int:
        """The second of two points acts as a line through it, whose free side the normal points to."""
        if normal is None:
            reason = (
                'two points need a normal: the direction of the second one\'s free side, such as "90 deg"; '
                "or they capture"
            ) + "".join(map(self._sides, (a, b)))
            raise SceneError(reason, path=f"{path}.normal")
        direction = self.reader.number(normal, f"{path}.normal", DIMENSIONLESS)
        along = direction - Number(math.pi / 2) - self.drawing.angle(b.owner)
        return self.drawn.line(b.owner, LineMark(self.drawing.marks(b.owner).point(b.name), along), b.where)

    def _sides(self, one: Partner) -> str:
        """Of a body that was named alone: its lines and circles, which were perhaps meant."""
        if one.name not in ("G", "center"):
            return ""
        marks = self.drawing.marks(one.owner)
        sides = " or ".join(f"{one.owner}.{name}" for name in (*marks.lines, *marks.circles))
        return f'; "{one.owner}" alone is one point: did you mean {sides}?' if sides else ""

    def _laws(self, contact: Contact, path: str) -> dict[int, int]:
        """Restitution and friction of a row."""
        restitution = self.reader.number(contact.restitution, f"{path}.restitution", DIMENSIONLESS)
        where = f"{path}.friction"
        friction = friction_law(self.reader, contact.friction, where)
        return {
            layout.PM_CONTACT_RESTITUTION: self.tables.value(restitution, f"{path}.restitution"),
            **friction.columns(self.tables, where),
            layout.PM_CONTACT_SPEED: self._surface_speed(contact, path),
            layout.PM_CONTACT_SLACK: layout.PM_NONE,
            layout.PM_CONTACT_SENSE_A: 1,
            layout.PM_CONTACT_SENSE_B: 1,
            layout.PM_CONTACT_CAPTURE: _CAPTURES[contact.capture],
            layout.PM_CONTACT_TANGENTIAL: self._tangential(contact, friction.law, path),
            layout.PM_CONTACT_LAW: layout.pm_law[f"PM_LAW_{contact.law.upper()}"],
            layout.PM_CONTACT_PAINLEVE: _PAINLEVE[contact.painleve],
            layout.PM_CONTACT_STIFFNESS: self._stiffness(contact, path),
            layout.PM_CONTACT_PRESSURE: layout.PM_NONE,
            layout.PM_CONTACT_RIM: layout.PM_NONE,
            layout.PM_CONTACT_SENSE_RIM: layout.PM_NONE,
            layout.PM_CONTACT_TURNS: layout.PM_NONE,
            layout.PM_CONTACT_LEVER: layout.PM_NONE,
        }

    def _stiffness(self, contact: Contact, path: str) -> int:
        """The value of the stiffness beside those of other contacts."""
        if contact.stiffness is None:
            return layout.PM_NONE
        where = f"{path}.stiffness"
        return self.tables.value(self.reader.number(contact.stiffness, where, STIFFNESS), where)

    def _tangential(self, contact: Contact, law: int, path: str) -> int:
        """The value of the restitution along the contact; none where there is no friction."""
        if contact.tangential is None or law == layout.PM_FRICTION_SMOOTH:
            return layout.PM_NONE
        where = f"{path}.tangential"
        return self.tables.value(self.reader.number(contact.tangential, where, DIMENSIONLESS), where)

    def _surface_speed(self, contact: Contact, path: str) -> int:
        """The program of the speed with which the surface of a line runs."""
        if contact.surface_speed is None:
            return layout.PM_NONE
        where = f"{path}.surface_speed"
        return self.tables.program(
            over_time(self.reader, self.tables, contact.surface_speed, where, VELOCITY), where
        )
