"""Tables of measured values: what a scene writes of one, and the piecewise polynomials that they become."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator

from ..base.arrays import Floats
from ..language.dimensions import Dimension
from ..language.lookup import NO_TABLES, Beyond, Book, Measured, Piecewise
from ..language.names import PLAIN_NAMES, Names
from ..language.parser import parse
from .element import Number, Table, Text
from .readers import Value, read_column

# What the slope is beyond the ends, by what the values are there.
_SLOPE_BEYOND: Mapping[Beyond, Beyond] = {
    "stop": "stop",
    "hold": "zero",
    "extend": "hold",
    "repeat": "repeat",
}


@dataclass(frozen=True)
class Points:
    """What stands in a table, SI: `at` increases; `value` [as many]."""

    at: tuple[float, ...]
    value: tuple[float, ...]
    argument: Dimension
    dimension: Dimension


Column = Annotated[str | tuple[Value, ...], BeforeValidator(read_column)]


class Tabulated(Table):
    """Values at given arguments, from the scene or from a CSV file.

    `points` is what stands there."""

    unwritten = ("points",)
    file: Text | None = None
    at: Column | None = None
    value: Column | None = None
    between: Literal["linear", "cubic"] = "linear"
    outside: Literal["stop", "hold", "extend", "repeat"] = "stop"
    scale: Number = 1
    stretch: Number = 1
    points: Points

    @property
    def in_scene(self) -> dict[str, Any]:
        """What a scene writes of the same table with its values, of a file or not."""
        points = self.points
        options = {
            key: getattr(self, key) for key in self.model_fields_set - {"file", "at", "value", "points"}
        }
        return {
            "at": [f"{one!r} {points.argument.unit}".strip() for one in points.at],
            "value": [f"{one!r} {points.dimension.unit}".strip() for one in points.value],
            **dict(sorted(options.items())),
        }


def book_of(tables: Mapping[str, Tabulated], names: Names = PLAIN_NAMES) -> Book:
    """The tables of a scene, and `NAME.slope` of each, as expressions read them; its names.

    Raises SceneError for a scale or a stretch that is no expression.
    """
    if not tables and not names.whole:
        return NO_TABLES
    named: dict[str, Measured] = {}
    for name, table in tables.items():
        scale = parse(table.scale, where=f"tables.{name}.scale")
        stretch = parse(table.stretch, where=f"tables.{name}.stretch")
        values = _piecewise(name, table)
        named[name] = Measured(values, scale, stretch)
        named[f"{name}.slope"] = Measured(_slope(values), scale / stretch, stretch)
    return Book(named, names)


def _piecewise(name: str, table: Tabulated) -> Piecewise:
    points = table.points
    at, value = np.array(points.at), np.array(points.value)
    made = _linear(at, value) if table.between == "linear" or len(at) == 2 else _cubic(at, value)
    return Piecewise(
        name,
        points.at,
        tuple(map(tuple, made.tolist())),
        points.argument,
        points.dimension,
        table.outside,
    )


def _linear(at: Floats, value: Floats) -> Floats:
    """Coefficients [n - 1][2] of straight lines."""
    return np.column_stack([value[:-1], np.diff(value) / np.diff(at)])


def _cubic(at: Floats, value: Floats) -> Floats:
    """Coefficients [n - 1][4] of monotone cubics (Fritsch and Carlson, as scipy has them)."""
    from scipy.interpolate import PchipInterpolator

    return np.ascontiguousarray(PchipInterpolator(at, value).c[::-1].T)


def _slope(of: Piecewise) -> Piecewise:
    """The derivative: one degree less on each piece, and a jump at each knot of straight lines."""
    powers = range(1, of.degree + 1)
    coefficients = tuple(tuple(k * one[k] for k in powers) for one in of.coefficients)
    beyond = _SLOPE_BEYOND[of.beyond]
    return Piecewise(f"{of.name}.slope", of.knots, coefficients, of.argument, of.value / of.argument, beyond)
