"""Gears: two circles mesh where they touch; axles or a carrier keep them at their distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.partners import kernel_circle, side
from ..geometry.push import Push
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import FORCE, IMPULSE
from ..model.element import Partners, Quantity
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Gears(Coupling):
    word = "gears"
    quantities = {
        "force": Quantity((layout.PM_MEASURE_JOINT_FORCE,), FORCE, vector=True),
        "impulse": Quantity((layout.PM_MEASURE_JOINT_IMPULSE,), IMPULSE, vector=True),
    }
    columns = ("force.x", "force.y")
    partners: Partners

    def rows(self, to: Writer, path: str) -> CouplingRows:
        where = f"{path}.gears"
        a, b = to.circles(self.partners, where)
        value = side(to.drawing, a, b), where
        circles = kernel_circle(to.drawn, a), kernel_circle(to.drawn, b)
        index = to.joint(layout.PM_JOINT_GEARS, *circles, path, value=value)
        return CouplingRows(index, (), ((a.owner, b.owner),))

    def draw(self, sketch: Sketch, where: str) -> Place:
        """Both pitch circles, and a mark where they touch."""
        a, b = sketch.read(self.partners, where, "circle")
        for one, center in zip((a, b), sketch.both(a, b), strict=True):
            sketch.pen.pitch_circle(center, sketch.radius(one))
        at = sketch.between_circles(a, b)[0]
        sketch.pen.dot(at)
        return at

    def pushes(self, sketch: Sketch, where: str) -> tuple[Push, ...]:
        a, b = sketch.read(self.partners, where, "circle")
        at = sketch.between_circles(a, b)[0]
        return (Push((at, at)),)
