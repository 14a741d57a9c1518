"""A torsion spring between two bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, MOMENT
from ..model.element import Number
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Torsion(Force):
    word = "torsion"
    bounded = {(layout.PM_FORCE_TORSION, layout.PM_FORCE_VALUE_1): ("stiffness", "N*m")}
    stiffness: Number
    free_angle: Number | None = None  # as drawn

    def row(self, to: Writer, path: str) -> ForceRow:
        owners = to.bodies(self.partners, f"{path}.torsion")
        # N*m for each radian: a moment.
        stiffness = to.over_motion(self.stiffness, f"{path}.stiffness", MOMENT)
        if self.free_angle is not None:
            free = to.over_time(self.free_angle, f"{path}.free_angle", DIMENSIONLESS)
        else:
            free = to.drawing.angle(owners[0]) - to.drawing.angle(owners[1])
        a, b = (to.drawing.body_index(owner) for owner in owners)
        if not to.is_steady(stiffness, free):
            couple = stiffness * (free - to.own(layout.PM_MEASURE_FORCE_STRETCH, path))
            programs = ((couple, f"{path}.stiffness"),)
            return ForceRow(
                layout.PM_FORCE_COUPLE, a, b, owners=owners, programs=programs, free=free, rotary=True
            )
        return ForceRow(
            layout.PM_FORCE_TORSION,
            a,
            b,
            owners=owners,
            stores=True,
            values=((stiffness, f"{path}.stiffness"), (free, f"{path}.free_angle")),
            rotary=True,
        )

    def draw(self, sketch: Sketch, where: str) -> Place:
        return sketch.spiral(self.partners, where)
