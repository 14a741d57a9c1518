"""A slider: a point on a line, whose body may keep its direction; its place along the line may be driven."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.marks import LineMark
from ..geometry.partners import Partner, one_point
from ..geometry.push import Push
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from ..language.dimensions import FORCE, LENGTH
from ..language.tree import Node
from ..model.element import Number, Quantity
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
    position: Number | None = None

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        assert isinstance(b.mark, LineMark)
        point = one_point(to.drawn, a)
        line = to.drawn.line(b.owner, b.mark, b.where)
        # A particle has no direction that could be kept.
        free, fixed = layout.PM_JOINT_SLIDER, layout.PM_JOINT_SLIDER_FIXED
        programs: tuple[Node, ...] = ()
        if self.position is not None:
            free, fixed = layout.PM_JOINT_SLIDER_PLACE, layout.PM_JOINT_SLIDER_FIXED_PLACE
            programs = (to.over_time(self.position, f"{path}.position", LENGTH),)
        if self.turning or not to.rotates(a.owner):
            return JointRow(free, point, line, programs=programs)
        held = to.drawing.angle(a.owner) - to.drawing.angle(b.owner)
        return JointRow(fixed, point, line, (held, f"{path}.turning"), programs)

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
