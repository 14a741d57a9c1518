"""Rolling without slip or parting: a circle on a line, a curve, or another circle from outside or inside."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.curves import CurveMark
from ..geometry.marks import LineMark
from ..geometry.partners import Partner, kernel_circle, side
from ..geometry.push import Push
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, FORCE
from ..model.element import Quantity
from .base import Joint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Rolling(Joint):
    word = "rolling"
    marks = (("circle",), ("line", "circle", "curve"))
    quantities = {
        "normal": Quantity((layout.PM_MEASURE_JOINT_NORMAL,), FORCE),
        "friction": Quantity((layout.PM_MEASURE_JOINT_FRICTION,), FORCE),
        "friction_needed": Quantity((layout.PM_MEASURE_JOINT_FRICTION_NEEDED,), DIMENSIONLESS),
    }
    columns = ("force.x", "force.y", "normal", "friction")

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        circle = kernel_circle(to.drawn, a)
        if isinstance(b.mark, LineMark):
            line = to.drawn.line(b.owner, b.mark, b.where)
            return JointRow(layout.PM_JOINT_ROLLING_LINE, circle, line)
        if isinstance(b.mark, CurveMark):
            return JointRow(
                layout.PM_JOINT_ROLLING_CURVE, circle, to.drawn.curve(b.owner, b.mark, b.mark_path)
            )
        other = kernel_circle(to.drawn, b)
        return JointRow(layout.PM_JOINT_ROLLING_CIRCLE, circle, other, (side(to.drawing, a, b), path))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        push = self.pushes(sketch, a, b)
        assert push.turn is not None
        sketch.pen.rolls(push.places[0], push.turn)
        return push.places[0]

    def pushes(self, sketch: Sketch, a: Partner, b: Partner) -> Push:
        at, _ = sketch.touching(a, b)
        if isinstance(b.mark, LineMark):
            turn = sketch.number(b.mark.angle) + sketch.angle(b.owner)
        elif isinstance(b.mark, CurveMark):
            turn = sketch.along_curve(b.owner, b.mark, at)[1]
        else:
            _, center = sketch.both(a, b)
            turn = math.atan2(at[1] - center[1], at[0] - center[0]) + math.pi / 2
        return Push((at, at), turn)
