"""Joints: from partners and options to rows of the kernel's joint table."""

from __future__ import annotations

from dataclasses import dataclass

from . import _layout as layout
from .drawing import GROUND, Drawing
from .errors import SceneError
from .marks import CircleMark, LineMark, distance
from .node import ZERO, Node, binary, call, select
from .parameters import Reader
from .partners import (
    Partner,
    circle_place,
    drawn_pair,
    kernel_circle,
    pairs,
    partner,
    point_pair,
)
from .scene import Bearing, Joint
from .tables import Tables
from .units import DIMENSIONLESS, LENGTH, MOMENT

# Kinds of marks that the partners of each kind of joint are.
_WANTED: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "pin": (("point",), ("point",)),
    "slider": (("point",), ("line",)),
    "slot": (("point",), ("circle",)),
    "link": (("point",), ("point",)),
    "weld": (("point",), ("point",)),
    "rolling": (("circle",), ("line", "circle")),
}


@dataclass(frozen=True)
class JointInfo:
    """What measures and events need to know of a joint: its row, kind, partners (first, second), friction."""

    index: int
    kind: str
    partners: tuple[Partner, Partner]
    rubs: bool

    @property
    def owners(self) -> tuple[str, str]:
        return self.partners[0].owner, self.partners[1].owner


# Part of the radius from which on a point counts as drawn on a circle.
_ON_CIRCLE = 1 - 1e-6

# Kind, a, b and value (with its key path) of a row.
_Row = tuple[int, int, int, tuple[Node, str] | None]


class Joints:
    """Adds joints to the tables, one method for each kind; each gives kind, a, b and value of its row."""

    def __init__(self, drawing: Drawing, reader: Reader, tables: Tables) -> None:
        self.drawing = drawing
        self.reader = reader
        self.tables = tables

    def add(self, name: str, joint: Joint) -> JointInfo:
        """Adds the row of one joint.  Raises SceneError for partners that do not fit its kind."""
        path = f"joints.{name}"
        wanted = _WANTED[joint.kind]
        first, second = pairs(
            joint.partners,
            f"{path}.{joint.kind}",
            lambda text, where, index: partner(self.drawing, text, where, *wanted[index]),
        )
        try:
            kind, a, b, value = getattr(self, f"_{joint.kind}")(first, second, joint, path)
        except SceneError as error:
            raise error.at(path=path) from None
        row = {
            layout.PM_JOINT_KIND: kind,
            layout.PM_JOINT_A: a,
            layout.PM_JOINT_B: b,
            layout.PM_JOINT_VALUE: layout.PM_NONE if value is None else self.tables.value(*value),
            layout.PM_JOINT_PROGRAM_X: layout.PM_NONE,
            layout.PM_JOINT_PROGRAM_Y: layout.PM_NONE,
        }
        index = self.tables.add(layout.PM_TABLE_JOINT, row, path)
        rubs = "friction" in joint.model_fields_set
        if rubs:
            self._rub(joint, index, (first, second), f"{path}.friction")
        return JointInfo(index, joint.kind, (first, second), rubs)

    def _rub(self, joint: Joint, index: int, partners: tuple[Partner, Partner], path: str) -> None:
        """The row of the friction of a joint: a part of given size, and one that goes with its load."""
        own: Node = ZERO
        by_load: Node = ZERO
        if joint.kind == "pin" and not all(self._turns(one.owner) for one in partners):
            raise SceneError("a particle does not turn: its pin has no friction", path=path)
        if isinstance(joint.friction, Bearing):
            if joint.kind != "pin":
                raise SceneError(f"a {joint.kind} has no radius; give the coefficient", path=path)
            mu = self.reader.number(joint.friction.mu, f"{path}.mu", DIMENSIONLESS)
            by_load = mu * self.reader.number(joint.friction.radius, f"{path}.radius", LENGTH)
        elif joint.kind == "pin":
            own = self.reader.number(joint.friction, path, MOMENT)
        else:
            by_load = self.reader.number(joint.friction, path, DIMENSIONLESS)
        row = dict.fromkeys(range(layout.PM_FORCE_COLUMNS), layout.PM_NONE)
        row |= {
            layout.PM_FORCE_KIND: layout.PM_FORCE_FRICTION,
            layout.PM_FORCE_A: index,
            layout.PM_FORCE_B: index,
            layout.PM_FORCE_VALUE_1: self.tables.value(own, path),
            layout.PM_FORCE_VALUE_2: self.tables.value(by_load, path),
            layout.PM_FORCE_OPTION: 0,
        }
        self.tables.add(layout.PM_TABLE_FORCE, row, path)

    def _pin(self, a: Partner, b: Partner, _joint: Joint, _path: str) -> _Row:
        return layout.PM_JOINT_PIN, *point_pair(self.drawing, a, b), None

    def _slider(self, a: Partner, b: Partner, joint: Joint, path: str) -> _Row:
        assert isinstance(b.mark, LineMark)
        if a.anywhere:
            raise SceneError("a point of a body or of the ground is wanted", path=a.where, value=GROUND)
        point = self.drawing.point(a.ref)
        line = self.drawing.line(b.owner, b.mark, b.where)
        # A particle has no direction that could be kept.
        if joint.turning or not self._turns(a.owner):
            return layout.PM_JOINT_SLIDER, point, line, None
        held = self.drawing.angle(a.owner) - self.drawing.angle(b.owner)
        return layout.PM_JOINT_SLIDER_FIXED, point, line, (held, f"{path}.turning")

    def _slot(self, a: Partner, b: Partner, _joint: Joint, path: str) -> _Row:
        assert isinstance(b.mark, CircleMark)
        if a.anywhere:
            raise SceneError("a point of a body or of the ground is wanted", path=a.where, value=GROUND)
        center = self.drawing.point_at(
            b.owner, self.drawing.from_mass_center(b.owner, b.mark.center), b.where
        )
        return layout.PM_JOINT_LINK, self.drawing.point(a.ref), center, (b.mark.radius, path)

    def _link(self, a: Partner, b: Partner, joint: Joint, path: str) -> _Row:
        if joint.length is not None:
            length = self.reader.number(joint.length, f"{path}.length", LENGTH)
        else:
            length = distance(*drawn_pair(self.drawing, a, b))
        return layout.PM_JOINT_LINK, *point_pair(self.drawing, a, b), (length, f"{path}.length")

    def _weld(self, a: Partner, b: Partner, _joint: Joint, path: str) -> _Row:
        for one in (a, b):
            if one.name not in ("", "G"):
                reason = "bodies are welded as drawn; name the body only"
                raise SceneError(reason, path=one.where, value=str(one.ref))
        turning = [self._turns(one.owner) for one in (a, b)]
        if not any(turning):
            raise SceneError("two particles would have to turn; give one of the bodies an inertia", path=path)
        # The place where both are held: the mass centre of the one that does not turn, else of the first.
        held = b if (turning[0] and not turning[1]) or a.owner == GROUND else a
        position = self.drawing.position(held.ref)
        point_a, point_b = (
            self.drawing.point_at(one.owner, self.drawing.to_body(one.owner, position), path)
            for one in (a, b)
        )
        if not all(turning):
            return layout.PM_JOINT_PIN, point_a, point_b, None
        angle = self.drawing.angle(a.owner) - self.drawing.angle(b.owner)
        return layout.PM_JOINT_WELD, point_a, point_b, (angle, path)

    def _rolling(self, a: Partner, b: Partner, _joint: Joint, path: str) -> _Row:
        circle = kernel_circle(self.drawing, a)
        if isinstance(b.mark, LineMark):
            return layout.PM_JOINT_ROLLING_LINE, circle, self.drawing.line(b.owner, b.mark, b.where), None
        other = kernel_circle(self.drawing, b)
        return layout.PM_JOINT_ROLLING_CIRCLE, circle, other, (side(self.drawing, a, b), path)

    def _turns(self, owner: str) -> bool:
        return owner == GROUND or self.drawing.bodies[owner].turns


def side(drawing: Drawing, a: Partner, b: Partner) -> Node:
    """1 if two circles are drawn outside each other, -1 if a is inside b, -2 if b is inside a.

    The distance of the centres tells: tangent circles have Ra + Rb outside and |Ra - Rb| inside, so that the
    greater radius lies in the middle of both.  A point is outside a circle that it is drawn on.
    """
    radius_a, radius_b = _radius(a), _radius(b)
    greater = call("max", radius_a, radius_b)
    if "point" in (a.kind, b.kind):
        greater = _ON_CIRCLE * greater
    apart = distance(circle_place(drawing, a), circle_place(drawing, b))
    inside = select(binary("<", radius_a, radius_b), -1.0, -2.0)
    return select(binary("<", apart, greater), inside, 1.0)


def _radius(one: Partner) -> Node:
    if one.kind == "point":
        return ZERO
    assert isinstance(one.mark, CircleMark)
    return one.mark.radius
