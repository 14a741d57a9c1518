"""A spring between two points; it may only pull or only push."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from .. import _layout as layout
from ..geometry.marks import distance
from ..geometry.partners import drawn_pair, point_pair
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import LENGTH, STIFFNESS
from ..language.tree import ZERO, Node, binary, call
from ..model.element import Number
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place

_ONLY = {None: layout.PM_SPRING_BOTH, "pull": layout.PM_SPRING_PULL, "push": layout.PM_SPRING_PUSH}


class Spring(Force):
    word = "spring"
    bounded = {(layout.PM_FORCE_SPRING, layout.PM_FORCE_VALUE_1): ("stiffness", "N/m")}
    stiffness: Number
    free_length: Number | None = None  # as drawn
    only: Literal["push", "pull"] | None = None

    def row(self, to: Writer, path: str) -> ForceRow:
        a, b = to.points(self.partners, f"{path}.spring")
        stiffness = to.over_motion(self.stiffness, f"{path}.stiffness", STIFFNESS)
        if self.free_length is not None:
            free = to.over_time(self.free_length, f"{path}.free_length", LENGTH)
        else:
            free = distance(*drawn_pair(to.drawing, a, b))
        points, owners = point_pair(to.drawn, a, b), (a.owner, b.owner)
        if not to.is_steady(stiffness, free):
            stretch = to.own(layout.PM_MEASURE_FORCE_STRETCH, path) - free
            pull = self._one_sided(stiffness * stretch, stretch)
            programs = ((pull, f"{path}.stiffness"),)
            return ForceRow(layout.PM_FORCE_LINE, *points, owners=owners, programs=programs, free=free)
        return ForceRow(
            layout.PM_FORCE_SPRING,
            *points,
            owners=owners,
            stores=True,
            values=((stiffness, f"{path}.stiffness"), (free, f"{path}.free_length")),
            option=_ONLY[self.only],
            programs=self._sides(to, path),
        )

    def _sides(self, to: Writer, path: str) -> tuple[tuple[Node, str], ...]:
        """What ends a phase where a spring that only pulls or pushes begins or ceases to act."""
        if self.only is None:
            return ()
        return ((binary(">", to.own(layout.PM_MEASURE_FORCE_STRETCH, path), ZERO), path),)

    def _one_sided(self, pull: Node, stretch: Node) -> Node:
        """The same where it acts, else 0."""
        if self.only is None:
            return pull
        slack = binary("<" if self.only == "pull" else ">", stretch, ZERO)
        return call("select", slack, ZERO, pull)

    def draw(self, sketch: Sketch, where: str) -> Place:
        return sketch.across(self.partners, where, sketch.pen.spring)
