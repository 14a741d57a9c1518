"""A force applied at a point: a vector, in axes of the scene or a body, or of given power.

Between two points it is a number, along their connection.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.partners import partner, point_pair
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import FORCE
from ..language.tree import Node
from ..model.element import Number, Text
from ..model.readers import Value, Vector, read_point_or_two, read_value_or_vector
from ..model.words import GROUND
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


# Of the distance of two points: the length of the arrows of a force between them.
_ARROW = 0.4


class AppliedForce(Force):
    word = "force"
    resists = False
    partners: Annotated[tuple[str, ...], BeforeValidator(read_point_or_two)]
    value: Annotated[Value | Vector, BeforeValidator(read_value_or_vector)] | None = None
    power: Number | None = None
    turns_with: Text | None = None

    def row(self, to: Writer, path: str) -> ForceRow:
        return self._at_point(to, path) if len(self.partners) == 1 else self._between(to, path)

    def _between(self, to: Writer, path: str) -> ForceRow:
        """Two points that it draws together; it drives them apart where it is negative."""
        a, b = to.points(self.partners, f"{path}.force")
        where = f"{path}.value"
        for key, given in (("power", self.power), ("turns_with", self.turns_with)):
            if given is not None:
                raise SceneError("a force between two points has a value alone", path=f"{path}.{key}")
        if self.value is None or isinstance(self.value, Vector):
            raise SceneError("a number is wanted: the force that draws the two points together", path=where)
        pull = to.over_motion(self.value, where, FORCE)
        owners, points = (a.owner, b.owner), point_pair(to.drawn, a, b)
        return ForceRow(layout.PM_FORCE_LINE, *points, owners=owners, programs=((pull, where),))

    def _at_point(self, to: Writer, path: str) -> ForceRow:
        text, where = self.partners[0], f"{path}.force"
        point = partner(to.drawing, text, where, "point")
        if point.owner == GROUND:
            raise SceneError("a point of a body is wanted", path=where, value=text)
        a, axes = to.drawn.point(point.ref), GROUND
        if self.power is not None:
            key = "power"
            x, y = self._along_the_motion(to, path, a)
        else:
            key = "value"
            if not isinstance(self.value, Vector):
                reason = "a vector is wanted: [x, y] or { polar = [size, angle] }"
                raise SceneError(reason, path=f"{path}.value", value=self.value)
            if self.turns_with is not None:
                axes = to.body(self.turns_with, f"{path}.turns_with")
            x, y = to.reader.vector(self.value, f"{path}.value", FORCE, to.over_motion)
        return ForceRow(
            layout.PM_FORCE_APPLIED,
            a,
            to.drawing.body_index(axes),
            owners=(point.owner,),
            programs=((x, f"{path}.{key}"), (y, f"{path}.{key}")),
        )

    def _along_the_motion(self, to: Writer, path: str, point: int) -> tuple[Node, Node]:
        """P v / v^2."""
        where = f"{path}.power"
        given = to.power(self.power, where, value=self.value, turns_with=self.turns_with)
        parts = (layout.PM_PART_X, layout.PM_PART_Y)
        x, y = (to.measured(layout.PM_MEASURE_VELOCITY, point, where, part) for part in parts)
        size = x * x + y * y
        return given * x / size, given * y / size

    def draw(self, sketch: Sketch, where: str) -> Place:
        """An arrow to the point, along the force as far as it is known; else dotted, from below."""
        if len(self.partners) == 2:
            return sketch.across(self.partners, where, partial(_towards_each_other, sketch))
        (point,) = sketch.read(self.partners, where, "point")
        at = sketch.of_partner(point, point)
        known = _seen(sketch, where) or self._direction(sketch)
        tail = sketch.pen.tail(at, *(known or (0.0, 1.0)))
        sketch.pen.arrow(tail, at, linestyle="-" if known else ":")
        return tail

    def _direction(self, sketch: Sketch) -> tuple[float, float] | None:
        """At t = 0.  None for one of given power, or that the motion tells."""
        if not isinstance(self.value, Vector):
            return None
        parts = self.value.first, self.value.second
        first, second = (sketch.at_start(part) for part in parts)
        varies = [not sketch.is_constant(part) for part in parts]
        if self.value.polar:
            first = first or (1.0 if varies[0] else first)
        elif not first and not second and sum(varies) == 1:  # along the part that is not always 0
            first, second = map(float, varies)
        if first is None or second is None or first == second == 0:
            return None
        x, y = (first * math.cos(second), first * math.sin(second)) if self.value.polar else (first, second)
        if self.turns_with is None:
            return x, y
        turn = sketch.angle(self.turns_with)
        return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)


def _seen(sketch: Sketch, where: str) -> tuple[float, float] | None:
    """The force of a run at this instant; None if it is not known, or none."""
    name = where.removeprefix("forces.")
    x, y = (sketch.known.get(f"{name}.force.{part}", 0.0) for part in ("x", "y"))
    return (x, y) if math.isfinite(x + y) and (x, y) != (0.0, 0.0) else None


def _towards_each_other(sketch: Sketch, a: Place, b: Place) -> None:
    """Arrows from two points towards each other."""
    for tail, other in ((a, b), (b, a)):
        tip = (tail[0] + _ARROW * (other[0] - tail[0]), tail[1] + _ARROW * (other[1] - tail[1]))
        sketch.pen.arrow(tail, tip)
