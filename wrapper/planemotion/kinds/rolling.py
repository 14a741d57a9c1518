"""Rolling without slip or parting: a circle on a line, a curve, or another circle from outside or
inside; a closed curve on another or on a line.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.curves import CurveMark
from ..geometry.marks import CircleMark, LineMark
from ..geometry.pairs import kernel_curve
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
    marks = (("circle", "curve"), ("line", "circle", "curve"))
    quantities = {
        "normal": Quantity((layout.PM_MEASURE_JOINT_NORMAL,), FORCE),
        "friction": Quantity((layout.PM_MEASURE_JOINT_FRICTION,), FORCE),
        "friction_needed": Quantity((layout.PM_MEASURE_JOINT_FRICTION_NEEDED,), DIMENSIONLESS),
    }
    columns = ("force.x", "force.y", "normal", "friction")

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        if isinstance(a.mark, CurveMark):
            return self._on_another(to, a, b, path)
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

    def _on_another(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        """A closed curve on another or on a line; the kernel has the line, or what has no knots, first."""
        if isinstance(b.mark, CircleMark):
            reason = "a curve rolls on another curve or a line; of a circle and a curve name the circle first"
            raise SceneError(reason, path=f"{path}.rolling")
        for one in (a, b):
            if isinstance(one.mark, CurveMark) and not one.mark.closed:
                raise SceneError("curves that roll on each other are closed", path=one.where)
            if isinstance(one.mark, LineMark) and one.mark.extent is not None:
                reason = 'a curve rolls on a line without ends; on an edge it touches with friction = "rough"'
                raise SceneError(reason, path=one.where)
        first, second = (b, a) if isinstance(b.mark, LineMark) else (a, b)
        whole = kernel_curve(to.drawn, first, whole=True)
        return JointRow(layout.PM_JOINT_ROLLING_CURVES, whole, kernel_curve(to.drawn, second))

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
