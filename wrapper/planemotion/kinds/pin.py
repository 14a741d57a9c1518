"""A pin: two points coincide; the angle of its bodies may be driven."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.partners import Partner, point_pair
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS
from ..model.element import Number
from .base import BearingJoint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Pin(BearingJoint):
    word = "pin"
    angle: Number | None = None

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        points = point_pair(to.drawn, a, b)
        if self.angle is None:
            return JointRow(layout.PM_JOINT_PIN, *points)
        where = f"{path}.angle"
        if not (to.rotates(a.owner) and to.rotates(b.owner)):
            raise SceneError("a particle does not rotate; leave out angle", path=where)
        angle = to.over_time(self.angle, where, DIMENSIONLESS)
        return JointRow(layout.PM_JOINT_PIN_ANGLE, *points, programs=(angle,))

    @property
    def holds_direction(self) -> bool:
        return self.angle is not None

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        at, there = sketch.both(a, b)
        support = there if b.is_ground else at
        if a.is_ground or b.is_ground:
            sketch.pen.support(support)
        sketch.pen.pin(at)
        sketch.pen.open_joint(at, there)
        return at
