"""A damper between two points, or a rotary one between two bodies: the unit of its rate tells."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.partners import point_pair
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import DAMPING, MOMENT, TIME
from ..language.homogeneity import dimension
from ..language.parser import parse
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
        found = dimension(parse(self.rate, where=where), to.reader.parameters.dimension_of)
        if self._bare and found == _ROTARY:
            owners = to.bodies(self.partners, f"{path}.damper")
            kind, wanted = layout.PM_FORCE_ROTARY_DAMPER, _ROTARY
            a, b = (to.drawing.body_index(owner) for owner in owners)
        else:
            ends = to.points(self.partners, f"{path}.damper")
            owners = ends[0].owner, ends[1].owner
            kind, wanted = layout.PM_FORCE_DAMPER, DAMPING
            a, b = point_pair(to.drawn, *ends)
        rate = to.reader.number(self.rate, where, wanted)
        return ForceRow(kind, a, b, owners, ((rate, where),), rotary=kind == layout.PM_FORCE_ROTARY_DAMPER)

    @property
    def _bare(self) -> bool:
        return not any("." in one for one in self.partners)

    def draw(self, sketch: Sketch, where: str) -> Place:
        if self._bare:
            return sketch.spiral(self.partners, where)
        return sketch.across(self.partners, where, sketch.pen.damper)
