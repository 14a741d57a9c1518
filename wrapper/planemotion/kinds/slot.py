"""A slot: a point on a circle, for the kernel a link of the length of its radius, or on a curve."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.curves import CurveMark
from ..geometry.marks import CircleMark
from ..geometry.partners import Partner, one_point
from ..geometry.push import Push
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from ..language.dimensions import FORCE
from ..model.element import Quantity
from .base import RubbingJoint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Slot(RubbingJoint):
    word = "slot"
    marks = (("point",), ("circle", "curve"))
    quantities = {"friction": Quantity((layout.PM_MEASURE_JOINT_FRICTION,), FORCE)}

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        point = one_point(to.drawn, a)
        if isinstance(b.mark, CurveMark):
            return JointRow(layout.PM_JOINT_SLOT, point, to.drawn.curve(b.owner, b.mark, b.mark_path))
        assert isinstance(b.mark, CircleMark)
        middle = to.drawing.from_mass_center(b.owner, b.mark.center)
        center = to.drawn.point_at(b.owner, middle, b.where)
        return JointRow(layout.PM_JOINT_LINK, point, center, (b.mark.radius, path))

    def pushes(self, sketch: Sketch, a: Partner, b: Partner) -> Push:
        at = sketch.of_partner(a, b)
        return Push((at, at), self._direction(sketch, a, b))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        at = sketch.of_partner(a, b)
        sketch.pen.block(at, self._direction(sketch, a, b))
        sketch.pen.pin(at)
        return at

    def _direction(self, sketch: Sketch, a: Partner, b: Partner) -> float:
        """Of the slot where the point is."""
        if isinstance(b.mark, CurveMark):
            return sketch.along_curve(b.owner, b.mark, sketch.of_partner(a, b))[1]
        at, center = sketch.both(a, b)
        return math.atan2(at[1] - center[1], at[0] - center[0]) + math.pi / 2
