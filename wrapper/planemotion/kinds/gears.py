"""Gears: two circles mesh where they touch, or a circle and a rack; axles or a carrier hold their distance.

Teeth with a pressure angle press their wheels apart; those with friction lose power as they slide on each
other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.marks import CircleMark, LineMark
from ..geometry.parameters import is_zero
from ..geometry.partners import Partner, kernel_circle, pairs, partner, side
from ..geometry.push import Push
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, FORCE, IMPULSE, LENGTH, MOMENT
from ..language.tree import ONE, ZERO, Node, binary, cos, select
from ..model.element import Number, Partners, Quantity
from ..model.readers import read_tooth_friction
from .base import Bearing, Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Gears(Coupling):
    word = "gears"
    quantities = {
        "force": Quantity(
            (layout.PM_MEASURE_JOINT_FORCE,), FORCE, vector=True, strand=layout.PM_MEASURE_CONTACT_FORCE
        ),
        "impulse": Quantity(
            (layout.PM_MEASURE_JOINT_IMPULSE,), IMPULSE, vector=True, strand=layout.PM_MEASURE_CONTACT_IMPULSE
        ),
        "couple": Quantity(
            (layout.PM_MEASURE_JOINT_COUPLE,), MOMENT, on=True, strand=layout.PM_MEASURE_CONTACT_COUPLE
        ),
    }
    columns = ("force.x", "force.y")
    partners: Partners
    pressure_angle: Number | None = None
    efficiency: Number | None = None
    friction: Annotated[Bearing | None, BeforeValidator(read_tooth_friction)] = None

    backlash: Number | None = None
    restitution: Number = 0

    def rows(self, to: Writer, path: str) -> CouplingRows:
        a, b = self._pair(to, path)
        if self.backlash is not None and not self._is_zero(to, path):
            return self._flanks(to, a, b, path)
        if "restitution" in self.model_fields_set and self.backlash is None:
            raise SceneError("teeth without backlash do not strike each other", path=f"{path}.restitution")
        index = self._mesh(to, a, b, path)
        self._rub(to, a, b, index, path)
        return CouplingRows(index, (), ((a.owner, b.owner),))

    def _is_zero(self, to: Writer, path: str) -> bool:
        """Without backlash one flank or the other always pushes.  One that varies is told by the kernel."""
        assert self.backlash is not None
        return is_zero(to.reader.number(self.backlash, f"{path}.backlash", LENGTH))

    def _pair(self, to: Writer, path: str) -> tuple[Partner, Partner]:
        """A wheel, and another one or a rack."""

        def read(text: str, where: str, index: int) -> Partner:
            return partner(to.drawing, text, where, *(("circle", "line")[: index + 1]))

        return pairs(self.partners, f"{path}.gears", read)

    def _mesh(self, to: Writer, a: Partner, b: Partner, path: str) -> int:
        where = f"{path}.pressure_angle"
        angle = (
            None
            if self.pressure_angle is None
            else to.reader.number(self.pressure_angle, where, DIMENSIONLESS)
        )
        wheel = kernel_circle(to.drawn, a)
        if isinstance(b.mark, LineMark):
            rack = to.drawn.line(b.owner, b.mark, b.where)
            pressure = ZERO if angle is None else angle, where
            return to.joint(layout.PM_JOINT_RACK, wheel, rack, path, second=pressure)
        kind = layout.PM_JOINT_GEARS if angle is None else layout.PM_JOINT_TEETH
        value = side(to.drawing, a, b), f"{path}.gears"
        other = kernel_circle(to.drawn, b)
        return to.joint(
            kind, wheel, other, path, value=value, second=None if angle is None else (angle, where)
        )

    def _flanks(self, to: Writer, a: Partner, b: Partner, path: str) -> CouplingRows:
        """A contact for each flank; the first pushes a along the tangent, left of the line from b to a."""
        where = f"{path}.backlash"
        assert self.backlash is not None
        backlash = to.reader.number(self.backlash, where, LENGTH)
        angle = self._angle(to, path)
        row = dict.fromkeys(range(layout.PM_CONTACT_COLUMNS), layout.PM_NONE)
        row |= {
            layout.PM_CONTACT_A: kernel_circle(to.drawn, a),
            layout.PM_CONTACT_RESTITUTION: to.tables.value(
                to.reader.number(self.restitution, f"{path}.restitution", DIMENSIONLESS),
                f"{path}.restitution",
            ),
            **self._friction_of_flanks(to, a, b, path),
            layout.PM_CONTACT_SLACK: to.tables.value(0.5 * backlash * cos(angle), where),
            layout.PM_CONTACT_PRESSURE: to.tables.value(angle, f"{path}.pressure_angle"),
            layout.PM_CONTACT_LAW: layout.PM_LAW_NEWTON,
            layout.PM_CONTACT_PAINLEVE: layout.PM_PAINLEVE_STOPS,
            layout.PM_CONTACT_CAPTURE: layout.PM_CAPTURE_NONE,
            layout.PM_CONTACT_SENSE_B: 1,
        }
        if isinstance(b.mark, LineMark):
            row[layout.PM_CONTACT_KIND] = layout.PM_CONTACT_RACK
            row[layout.PM_CONTACT_B] = to.drawn.line(b.owner, b.mark, b.where)
        else:
            row[layout.PM_CONTACT_KIND] = layout.PM_CONTACT_TEETH
            row[layout.PM_CONTACT_B] = kernel_circle(to.drawn, b)
            row[layout.PM_CONTACT_SIDE] = to.tables.value(side(to.drawing, a, b), f"{path}.gears")
        indices = tuple(
            to.tables.add(
                layout.PM_TABLE_CONTACT, row | {layout.PM_CONTACT_SENSE_A: flank}, f"{path}[{number}]"
            )
            for number, flank in ((1, 1), (2, -1))
        )
        return CouplingRows(None, indices, ((a.owner, b.owner),) * 2)

    def _friction_of_flanks(self, to: Writer, a: Partner, b: Partner, path: str) -> dict[int, int]:
        """A coefficient, and the lever at which the teeth slide."""
        rubbing = self._rubbing(to, a, b, path)
        if rubbing is None:
            return {layout.PM_CONTACT_FRICTION: layout.PM_FRICTION_SMOOTH}
        mu, lever, where = rubbing
        return {
            layout.PM_CONTACT_FRICTION: layout.PM_FRICTION_COULOMB,
            layout.PM_CONTACT_STATIC: to.tables.value(mu, where),
            layout.PM_CONTACT_KINETIC: to.tables.value(mu, where),
            layout.PM_CONTACT_LEVER: to.tables.value(lever, where),
        }

    def _angle(self, to: Writer, path: str) -> Node:
        if self.pressure_angle is None:
            return ZERO
        return to.reader.number(self.pressure_angle, f"{path}.pressure_angle", DIMENSIONLESS)

    @property
    def acts_by_couple(self) -> bool:
        return self.efficiency is not None or self.friction is not None

    def _rub(self, to: Writer, a: Partner, b: Partner, index: int, path: str) -> None:
        """The couple between the wheels that goes with the force of the teeth."""
        rubbing = self._rubbing(to, a, b, path)
        if rubbing is not None:
            mu, lever, where = rubbing
            values = ((ZERO, where), (mu * lever, where))
            to.force(layout.PM_FORCE_FRICTION, index, index, where, values=values)

    def _rubbing(self, to: Writer, a: Partner, b: Partner, path: str) -> tuple[Node, Node, str] | None:
        """A coefficient, its lever, and the key that they come from."""
        if self.friction is not None and self.efficiency is not None:
            raise SceneError("give friction or efficiency, not both", path=f"{path}.efficiency")
        if self.friction is not None:
            where = f"{path}.friction"
            mu = to.reader.number(self.friction.mu, f"{where}.mu", DIMENSIONLESS)
            lever = to.reader.number(self.friction.radius, f"{where}.radius", LENGTH)
        elif self.efficiency is not None:
            where = f"{path}.efficiency"
            mu, lever = ONE, self._arm(to, a, b, self._share(to, where), path)
        else:
            return None
        for one in (a, b):
            if isinstance(one.mark, CircleMark) and not to.rotates(one.owner):
                raise SceneError(f'"{one.owner}" does not rotate: its teeth do not slide', path=where)
        return mu, lever, where

    def _share(self, to: Writer, where: str) -> Node:
        assert self.efficiency is not None
        share = to.reader.number(self.efficiency, where, DIMENSIONLESS)
        if not 0 < to.tables.default_value(to.tables.value(share, where)) <= 1:
            raise SceneError("it must be above 0 and at most 1", path=where, value=self.efficiency)
        return share

    def _arm(self, to: Writer, a: Partner, b: Partner, efficiency: Node, path: str) -> Node:
        """Where a drives b on fixed axles: the work that goes out, of that which goes in, is
        (1 - s_b c / R_b) / (1 + s_a c / R_a) with c the couple by the force at the pitch circles; s is -1 of
        the greater one if the other is inside it, else 1, and a rack has no 1 / R_b."""
        share = efficiency * _curvature(a)
        if isinstance(b.mark, LineMark):
            total = share
        else:
            where = side(to.drawing, a, b)
            sign_a = select(binary("<", where, -1.5), -1.0, 1.0)
            sign_b = select(binary("<", abs(where + 1.0), 0.5), -1.0, 1.0)
            total = sign_a * share + sign_b * _curvature(b)
        arm = (ONE - efficiency) / total
        if self.pressure_angle is None:
            return arm
        return arm * cos(to.reader.number(self.pressure_angle, f"{path}.pressure_angle", DIMENSIONLESS))

    def draw(self, sketch: Sketch, where: str) -> Place:
        """The pitch circles, and a mark where they touch."""
        a, b = self._drawn(sketch, where)
        for one, other in ((a, b), (b, a)):
            if isinstance(one.mark, CircleMark):
                sketch.pen.pitch_circle(sketch.of_partner(one, other), sketch.radius(one))
        at = self._touch(sketch, a, b)
        sketch.pen.dot(at)
        return at

    def pushes(self, sketch: Sketch, where: str) -> tuple[Push, ...]:
        at = self._touch(sketch, *self._drawn(sketch, where))
        return (Push((at, at)),)

    def _drawn(self, sketch: Sketch, where: str) -> tuple[Partner, Partner]:
        first, second = sketch.read(self.partners, where, "circle", "line")
        return first, second

    def _touch(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        return (sketch.touching(a, b) if isinstance(b.mark, LineMark) else sketch.between_circles(a, b))[0]


def _curvature(one: Partner) -> Node:
    assert isinstance(one.mark, CircleMark)
    return ONE / one.mark.radius
