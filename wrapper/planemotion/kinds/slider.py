"""A slider: a point on a line, whose body may keep its direction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.marks import LineMark
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


class Slider(RubbingJoint):
    word = "slider"
    marks = (("point",), ("line",))
    quantities = {"friction": Quantity((layout.PM_MEASURE_JOINT_FRICTION,), FORCE)}
    columns = ("force.x", "force.y", "couple")
    turning: bool = True

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        assert isinstance(b.mark, LineMark)
        point = one_point(to.drawn, a)
        line = to.drawn.line(b.owner, b.mark, b.where)
        # A particle has no direction that could be kept.
        if self.turning or not to.rotates(a.owner):
            return JointRow(layout.PM_JOINT_SLIDER, point, line)
        held = to.drawing.angle(a.owner) - to.drawing.angle(b.owner)
        return JointRow(layout.PM_JOINT_SLIDER_FIXED, point, line, (held, f"{path}.turning"))

    @property
    def holds_direction(self) -> bool:
        return not self.turning

    def pushes(self, sketch: Sketch, a: Partner, b: Partner) -> Push:
        assert isinstance(b.mark, LineMark)
        at = sketch.of_partner(a, b)
        return Push((at, at), sketch.number(b.mark.angle) + sketch.angle(b.owner))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        assert isinstance(b.mark, LineMark)
        at = sketch.of_partner(a, b)
        sketch.pen.block(at, sketch.number(b.mark.angle) + sketch.angle(b.owner))
        sketch.pen.pin(at)
        return at
