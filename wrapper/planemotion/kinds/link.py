"""A massless link: two points keep their distance, or one that is given over t."""

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
        points = point_pair(to.drawn, a, b)
        if self.length is None:
            return JointRow(layout.PM_JOINT_LINK, *points, (distance(*drawn_pair(to.drawing, a, b)), where))
        length = to.over_time(self.length, where, LENGTH)
        if to.is_steady(length):
            return JointRow(layout.PM_JOINT_LINK, *points, (length, where))
        return JointRow(layout.PM_JOINT_LENGTH, *points, programs=(length,))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        ends = sketch.both(a, b)
        for end, one in zip(ends, (a, b), strict=True):
            if one.is_ground:
                sketch.pen.support(end)
        sketch.pen.link(*ends)
        return sketch.middle(*ends)
