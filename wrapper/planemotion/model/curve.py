"""Curves as marks: what a scene writes of one."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from .element import Number, Pair, Table, Text
from .readers import Vector, read_vector

# Curves that have a name, each with its sizes.
CURVES = ("ellipse", "arc", "parabola", "cycloid", "involute")


def read_points(written: Any) -> tuple[Vector, ...]:
    """Points [[x, y], ...]."""
    if not isinstance(written, list | tuple):
        raise ValueError('a list of points is wanted, such as [["0 m", "1 m"], ["1 m", "0 m"]]')
    return tuple(map(read_vector, written))


Points = Annotated[tuple[Vector, ...], BeforeValidator(read_points)]


class Curve(Table):
    """A smooth curve: expressions x and y of s, one that has a name, or one through points.

    `places` is what stands in `points` or in the file, in metres.
    """

    unwritten: ClassVar[tuple[str, ...]] = ("places",)
    x: Number | None = None
    y: Number | None = None
    ellipse: Pair | None = None
    arc: Number | None = None
    parabola: Number | None = None
    cycloid: Number | None = None
    involute: Number | None = None
    points: Points | None = None
    file: Text | None = None
    scale: Number = 1
    start: Number | None = Field(None, alias="from")
    to: Number | None = None
    closed: bool = False
    side: Literal["left", "right"] = "left"
    at: Pair = Vector(0, 0)
    angle: Number = 0
    places: tuple[tuple[float, float], ...] | None = None

    @property
    def in_scene(self) -> dict[str, Any]:
        """The points as a scene writes them, of a file or not."""
        return {"points": [[f"{one!r} m" for one in place] for place in self.places or ()]}
