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
        """An arrow to the point, along the force at t = 0; dotted, from below, where the motion tells it."""
        if len(self.partners) == 2:
            return sketch.across(self.partners, where, partial(_towards_each_other, sketch))
        (point,) = sketch.read(self.partners, where, "point")
        at = sketch.of_partner(point, point)
        known = self._direction(sketch)
        tail = sketch.pen.tail(at, *(known or (0.0, 1.0)))
        sketch.pen.arrow(tail, at, linestyle="-" if known else ":")
        return tail

    def _direction(self, sketch: Sketch) -> tuple[float, float] | None:
        """None for one of given power, or that the motion tells."""
        if not isinstance(self.value, Vector):
            return None
        first, second = (sketch.at_start(part) for part in (self.value.first, self.value.second))
        if (first is None and second == 0) or (first == 0 and second is None):
            first, second = (0.0 if part == 0 else 1.0 for part in (first, second))
        if first is None or second is None or first == second == 0:
            return None
        x, y = (first * math.cos(second), first * math.sin(second)) if self.value.polar else (first, second)
        if self.turns_with is None:
            return x, y
        turn = sketch.angle(self.turns_with)
        return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)


def _towards_each_other(sketch: Sketch, a: Place, b: Place) -> None:
    """Arrows from two points towards each other."""
    for tail, other in ((a, b), (b, a)):
        tip = (tail[0] + _ARROW * (other[0] - tail[0]), tail[1] + _ARROW * (other[1] - tail[1]))
        sketch.pen.arrow(tail, tip)
