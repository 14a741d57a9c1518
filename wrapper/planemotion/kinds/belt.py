"""A tight belt round two circles, open or crossed: it grips them, or with friction it slips.

With its tension at rest, T_0 in either strand, it runs on fixed axles.  T_1 + T_2 stays, and the axles carry
2 T_0 cos(alpha), alpha the angle of a strand with the line of centres.  It slips on the circle that it wraps
less, by an angle theta, where T_1 = T_2 e^(mu theta) or the reverse: it drives with 2 T_0 tanh(mu theta / 2)
at most.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.axles import Axles, axles
from ..geometry.marks import CircleMark
from ..geometry.partners import Partner, kernel_circle
from ..geometry.push import Push
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, FORCE, VELOCITY
from ..language.tree import ONE, ZERO, Node, call, sqrt
from ..model.element import Number, Partners, Quantity
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch, Strand
    from ..pen.symbols import Place


class _Course(NamedTuple):
    """How a belt runs round its circles."""

    wrap: Node  # the smaller one
    cosine: Node  # of the angle of a strand with the line of centres


class Belt(Coupling):
    word = "belt"
    # A row for each strand: the one that leaves the first circle counterclockwise, and the other.
    quantities = {
        "tension": Quantity((layout.PM_MEASURE_JOINT_NORMAL, layout.PM_MEASURE_JOINT_FRICTION), FORCE),
        "slip": Quantity((layout.PM_MEASURE_JOINT_SLIP,), VELOCITY, of_rims=True),
    }
    columns = ("tension[1]", "tension[2]")
    partners: Partners
    crossed: bool = False
    pretension: Number | None = None
    friction: Number | None = None

    def rows(self, to: Writer, path: str) -> CouplingRows:
        a, b = to.circles(self.partners, f"{path}.belt")
        circles = kernel_circle(to.drawn, a), kernel_circle(to.drawn, b)
        value = -ONE if self.crossed else ONE, f"{path}.crossed"
        if self.pretension is not None:
            return self._tightened(to, a, b, circles, value, path)
        if self.friction is not None:
            reason = "what a belt drives with before it slips goes with its tension at rest; give pretension"
            raise SceneError(reason, path=f"{path}.friction", value=self.friction)
        index = to.joint(layout.PM_JOINT_BELT, *circles, path, value=value)
        return CouplingRows(index, (), ((a.owner, b.owner),))

    def _tightened(
        self,
        to: Writer,
        a: Partner,
        b: Partner,
        circles: tuple[int, int],
        value: tuple[Node, str],
        path: str,
    ) -> CouplingRows:
        """Its joint, what it draws the axles together with, and the friction that it drives by."""
        assert self.pretension is not None
        where = f"{path}.pretension"
        tension = to.reader.number(self.pretension, where, FORCE)
        held = axles(to, a, b, f"{path}.belt")
        course = self._course(to, a, b, held, path)
        slips = self.friction is not None
        kind = layout.PM_JOINT_BELT_SLIPS if slips else layout.PM_JOINT_BELT_GRIPS
        index = to.joint(kind, *circles, path, value=value, second=(tension, where))
        rims = to.tables.rows[layout.PM_TABLE_CIRCLE]
        hub, other = (rims[one][layout.PM_CIRCLE_POINT] for one in circles)
        together = 2 * tension * course.cosine, where
        pull = to.force(layout.PM_FORCE_LINE, hub, other, where, programs=(together,))
        if slips:
            where = f"{path}.friction"
            most = 2 * tension * call("tanh", self._coefficient(to, where) * course.wrap / 2)
            to.force(layout.PM_FORCE_FRICTION, index, index, where, values=((most, where), (ZERO, where)))
        owners = ((a.owner, b.owner),)
        return CouplingRows(index, (), owners, forces=(pull,), rests_on=held.joints, may_slip=slips)

    def _coefficient(self, to: Writer, where: str) -> Node:
        assert self.friction is not None
        mu = to.reader.number(self.friction, where, DIMENSIONLESS)
        if to.tables.default_value(to.tables.value(mu, where)) < 0:
            raise SceneError("it must not be negative", path=where, value=self.friction)
        return mu

    def _course(self, to: Writer, a: Partner, b: Partner, held: Axles, path: str) -> _Course:
        """Circles that a belt cannot run round are told at the start."""
        assert isinstance(a.mark, CircleMark)
        assert isinstance(b.mark, CircleMark)
        across = a.mark.radius + b.mark.radius if self.crossed else abs(a.mark.radius - b.mark.radius)
        sine = to.tables.leaf(call("min", across / held.distance, 1.0), f"{path}.belt")
        angle = call("asin", sine)
        wrap = math.pi + 2 * angle if self.crossed else math.pi - 2 * angle
        return _Course(wrap, sqrt(1 - sine * sine))

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
