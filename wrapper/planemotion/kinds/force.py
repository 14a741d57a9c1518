"""A force applied at a point: a vector over time, in axes of the scene or a body, or of given power."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawing import GROUND
from ..geometry.partners import partner
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import FORCE
from ..language.tree import Node
from ..model.element import Number, Text
from ..model.readers import Value, Vector, read_one, read_value_or_vector
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class AppliedForce(Force):
    word = "force"
    resists = False
    partners: Annotated[tuple[str, ...], BeforeValidator(read_one)]
    value: Annotated[Value | Vector, BeforeValidator(read_value_or_vector)] | None = None
    power: Number | None = None
    turns_with: Text | None = None

    def row(self, to: Writer, path: str) -> ForceRow:
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
                raise SceneError(reason, path=f"{path}.value")
            if self.turns_with is not None:
                axes = to.body(self.turns_with, f"{path}.turns_with")
            x, y = to.reader.vector(self.value, f"{path}.value", FORCE, to.over_time)
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
        """An arrow to the point, along the direction of the force at t = 0; of given power, from below."""
        (point,) = sketch.read(self.partners, where, "point")
        at = sketch.of_partner(point, point)
        x, y = (0.0, 1.0) if self.value is None else self._direction(sketch)
        tail = sketch.pen.tail(at, x, y)
        sketch.pen.arrow(tail, at)
        return tail

    def _direction(self, sketch: Sketch) -> tuple[float, float]:
        assert isinstance(self.value, Vector)
        first, second = (sketch.at_start(part) for part in (self.value.first, self.value.second))
        x, y = (first * math.cos(second), first * math.sin(second)) if self.value.polar else (first, second)
        if self.turns_with is None:
            return x, y
        turn = sketch.angle(self.turns_with)
        return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
