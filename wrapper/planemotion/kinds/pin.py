"""A pin: two points coincide."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.partners import Partner, point_pair
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from .base import BearingJoint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Pin(BearingJoint):
    word = "pin"

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        return JointRow(layout.PM_JOINT_PIN, *point_pair(to.drawn, a, b))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        at, there = sketch.both(a, b)
        support = there if b.is_ground else at
        if a.is_ground or b.is_ground:
            sketch.pen.support(support)
        sketch.pen.pin(at)
        sketch.pen.open_joint(at, there)
        return at
