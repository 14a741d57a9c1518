"""A tight belt round two circles, open or crossed: it does not slip."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..geometry.partners import kernel_circle
from ..geometry.push import Push
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import FORCE
from ..language.tree import Number
from ..model.element import Partners, Quantity
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch, Strand
    from ..pen.symbols import Place


class Belt(Coupling):
    word = "belt"
    # A row for each strand: the one that leaves the first circle counterclockwise, and the other.
    quantities = {
        "tension": Quantity((layout.PM_MEASURE_JOINT_NORMAL, layout.PM_MEASURE_JOINT_FRICTION), FORCE)
    }
    columns = ("tension[1]", "tension[2]")
    partners: Partners
    crossed: bool = False

    def rows(self, to: Writer, path: str) -> CouplingRows:
        a, b = to.circles(self.partners, f"{path}.belt")
        value = Number(-1.0 if self.crossed else 1.0), f"{path}.crossed"
        circles = kernel_circle(to.drawn, a), kernel_circle(to.drawn, b)
        index = to.joint(layout.PM_JOINT_BELT, *circles, path, value=value)
        return CouplingRows(index, (), ((a.owner, b.owner),))

    def draw(self, sketch: Sketch, where: str) -> Place:
        first, second = self._strands(sketch, where)
        at = sketch.strand(*first)
        sketch.strand(*second)
        return at

    def pushes(self, sketch: Sketch, where: str) -> tuple[Push, ...]:
        return tuple(Push(sketch.strand_ends(*strand)) for strand in self._strands(sketch, where))

    def _strands(self, sketch: Sketch, where: str) -> tuple[Strand, Strand]:
        """The one that leaves the first circle counterclockwise, and the other."""
        a, b = sketch.read(self.partners, where, "circle")
        return ((a, True), (b, not self.crossed)), ((a, False), (b, self.crossed))
