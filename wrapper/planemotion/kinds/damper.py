"""A damper between two points, or a rotary one between two bodies: the unit of its rate tells."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.motion import reads_motion
from ..geometry.partners import point_pair
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import DAMPING, MOMENT, TIME, Dimension
from ..language.homogeneity import dimension
from ..model.element import Number
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place

_ROTARY = MOMENT * TIME


class Damper(Force):
    word = "damper"
    bounded = {
        (layout.PM_FORCE_DAMPER, layout.PM_FORCE_VALUE_1): ("rate", "N*s/m"),
        (layout.PM_FORCE_ROTARY_DAMPER, layout.PM_FORCE_VALUE_1): ("rate", "N*m*s"),
    }
    rate: Number | None = None

    def row(self, to: Writer, path: str) -> ForceRow:
        where = f"{path}.rate"
        if self.rate is None:
            raise SceneError("a rate is wanted", path=where)
        # Bare names are bodies or their mass centres.
        if self._bare and self._unit(to, where) == _ROTARY:
            owners = to.bodies(self.partners, f"{path}.damper")
            kind, wanted = layout.PM_FORCE_ROTARY_DAMPER, _ROTARY
            a, b = (to.drawing.body_index(owner) for owner in owners)
        else:
            ends = to.points(self.partners, f"{path}.damper")
            owners = ends[0].owner, ends[1].owner
            kind, wanted = layout.PM_FORCE_DAMPER, DAMPING
            a, b = point_pair(to.drawn, *ends)
        rate = to.over_motion(self.rate, where, wanted)
        if not to.is_steady(rate):
            size = rate * to.own(layout.PM_MEASURE_FORCE_RATE, path)
            rotary = kind == layout.PM_FORCE_ROTARY_DAMPER
            kind = layout.PM_FORCE_COUPLE if rotary else layout.PM_FORCE_LINE
            programs = ((-size if rotary else size, where),)
            return ForceRow(kind, a, b, owners, programs=programs, rotary=rotary)
        return ForceRow(kind, a, b, owners, ((rate, where),), rotary=kind == layout.PM_FORCE_ROTARY_DAMPER)

    def _unit(self, to: Writer, where: str) -> Dimension | None:
        """The dimension of its rate."""
        node = to.reader.parameters.parse(self.rate, where)
        if reads_motion(node, to.reader.parameters.nodes):
            reason = (
                "whether it is rotary cannot be told from a rate that depends on the motion: give points, "
                'such as "AB.G", or a couple'
            )
            raise SceneError(reason, path=where, value=self.rate)
        return dimension(
            node, lambda leaf: TIME if str(leaf) == "t" else to.reader.parameters.dimension_of(leaf)
        )

    @property
    def _bare(self) -> bool:
        return not any("." in one for one in self.partners)

    def draw(self, sketch: Sketch, where: str) -> Place:
        if self._bare:
            return sketch.spiral(self.partners, where)
        return sketch.across(self.partners, where, sketch.pen.damper)
