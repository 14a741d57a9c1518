"""Tables of measured values in expressions: piecewise polynomials, and the node that reads one.

The arithmetic is that of the kernel's piecewise.c, bit for bit.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from .dimensions import Dimension
from .names import PLAIN_NAMES, Names
from .tree import Node

Beyond: TypeAlias = Literal["stop", "hold", "extend", "repeat", "zero"]
# What is read: the value at x; that of a piece, by x and its number; where a piece begins, by its number.
Read: TypeAlias = Literal["value", "piece", "knot"]


@dataclass(frozen=True, eq=False)
class Piecewise:
    """A polynomial on each piece between two knots, in SI: c[0] + c[1] u + .., u = x - the knot at its begin.

    `name`: as expressions call it; `argument`, `value`: the dimensions of x and of what is read; `beyond`:
    what it is beyond its knots.  `knots` [n] increase; `coefficients` [n - 1] from u^0 on.
    """

    name: str
    knots: tuple[float, ...]
    coefficients: tuple[tuple[float, ...], ...]
    argument: Dimension
    value: Dimension
    beyond: Beyond

    @property
    def degree(self) -> int:
        """The highest power of u."""
        return len(self.coefficients[0]) - 1

    def number(self, x: float) -> float:
        """The piece in which x lies: -1 below all, n - 1 above; counted on both ways where it repeats."""
        if not math.isfinite(x):
            return math.nan
        last = len(self.coefficients)
        if self.beyond != "repeat":
            if x >= self.knots[-1]:
                return float(last - (self.beyond == "stop" and x == self.knots[-1]))
            return float(bisect_right(self.knots, x) - 1)
        laps = math.floor((x - self.knots[0]) / self._period)
        piece = max(0, min(bisect_right(self.knots, x - laps * self._period) - 1, last - 1))
        number = float(laps * last + piece)
        for _ in range(2):
            number -= x < self.begin(number)
        for _ in range(2):
            number += x >= self.begin(number + 1)
        return number

    def begin(self, number: float) -> float:
        """Where a piece of the repeated table begins, or a knot."""
        last = len(self.coefficients)
        if self.beyond != "repeat":
            return self.knots[int(number)]
        laps = math.floor(number / last)
        return self.knots[int(number - laps * last)] + laps * self._period

    def at(self, x: float) -> float:
        """The value at x; not a number where it has none."""
        number, last = self.number(x), len(self.coefficients)
        if math.isnan(number):
            return math.nan
        if self.beyond != "repeat" and not 0 <= number < last:
            return self._beyond(number > 0, x)
        return _polynomial(self.coefficients[int(number % last)], x - self.begin(number))[0]

    def _beyond(self, above: bool, x: float) -> float:
        if self.beyond == "stop":
            return math.nan
        if self.beyond == "zero":
            return 0.0
        piece, end = (len(self.coefficients) - 1, self.knots[-1]) if above else (0, self.knots[0])
        value, slope = _polynomial(self.coefficients[piece], end - self.knots[piece])
        return value + (slope if self.beyond == "extend" else 0.0) * (x - end)

    @property
    def _period(self) -> float:
        return self.knots[-1] - self.knots[0]


def _polynomial(coefficients: Sequence[float], u: float) -> tuple[float, float]:
    """Value and derivative."""
    value = slope = 0.0
    for one in reversed(coefficients):
        slope = slope * u + value
        value = value * u + one
    return value, slope


@dataclass(frozen=True)
class Lookup(Node):
    """A table, read at its arguments."""

    table: Piecewise
    arguments: tuple[Node, ...]
    read: Read = "value"

    def __str__(self) -> str:
        return f"{self.table.name}({self.arguments[0]})"

    def value_of(self, values: Sequence[float]) -> float:
        """What is read, by the values of the arguments."""
        if self.read != "value":
            raise TypeError("pieces are read by the kernel alone")
        return self.table.at(values[0])


@dataclass(frozen=True, eq=False)
class Measured:
    """What a name in front of parentheses stands for: scale * table(x / stretch)."""

    table: Piecewise
    scale: Node
    stretch: Node

    def at(self, x: Node) -> Node:
        """The expression that reads it at x."""
        return self.scale * Lookup(self.table, (x / self.stretch,))


@dataclass(frozen=True, eq=False)
class Book:
    """The tables of a scene by the names that expressions call them; its names that are no plain words."""

    tables: Mapping[str, Measured]
    names: Names = PLAIN_NAMES


NO_TABLES = Book({})
