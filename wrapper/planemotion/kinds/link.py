"""A massless link: two points keep their distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.marks import distance
from ..geometry.partners import Partner, drawn_pair, point_pair
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from ..language.dimensions import LENGTH
from ..model.element import Number
from .base import Joint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Link(Joint):
    word = "link"
    length: Number | None = None  # as drawn

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        where = f"{path}.length"
        if self.length is not None:
            length = to.reader.number(self.length, where, LENGTH)
        else:
            length = distance(*drawn_pair(to.drawing, a, b))
        return JointRow(layout.PM_JOINT_LINK, *point_pair(to.drawn, a, b), (length, where))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        ends = sketch.both(a, b)
        for end, one in zip(ends, (a, b), strict=True):
            if one.is_ground:
                sketch.pen.support(end)
        sketch.pen.link(*ends)
        return sketch.middle(*ends)
