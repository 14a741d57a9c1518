"""Where two curves, or a line and a curve, are nearest to each other in a picture."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..geometry.curves import CurveMark
from ..geometry.pairs import as_curve
from ..geometry.partners import Partner
from ..language.tree import Number
from .symbols import Place

if TYPE_CHECKING:
    from .sketch import Sketch

# Places of a curve that are joined by straight lines.
_OF_CURVE = 240


def places_of(sketch: Sketch, owner: str, mark: CurveMark) -> np.ndarray:
    """Places [n, 2] of a curve, in the order of s."""
    return _places(sketch, owner, mark, _along(sketch, mark))


def along_curve(sketch: Sketch, owner: str, mark: CurveMark, at: Place) -> tuple[Place, float]:
    """The place of a curve next to a place, and its direction there."""
    if mark.endless:
        return _along_line(sketch, owner, mark, at)
    values = _along(sketch, mark)
    for _ in range(2):  # once more between the neighbours of the nearest
        places = _places(sketch, owner, mark, values)
        k = int(np.argmin(np.hypot(*(places - np.asarray(at)).T)))
        first, last = max(k - 1, 0), min(k + 1, len(values) - 1)
        values = np.linspace(values[first], values[last], _OF_CURVE + 1)
    step = places[last] - places[first]
    return _place(places[k]), math.atan2(step[1], step[0])


def between_curves(sketch: Sketch, a: Partner, b: Partner) -> tuple[Place, Place]:
    """The nearest places of two curves, one of which may be an edge or a line."""
    marks = as_curve(a), as_curve(b)
    if marks[0].endless:
        of_b = places_of(sketch, b.owner, marks[1])
        apart = [math.dist(_along_line(sketch, a.owner, marks[0], _place(one))[0], one) for one in of_b]
        near = _along_line(sketch, a.owner, marks[0], _place(of_b[int(np.argmin(apart))]))[0]
        at_b = along_curve(sketch, b.owner, marks[1], near)[0]
        return _along_line(sketch, a.owner, marks[0], at_b)[0], at_b
    places = [places_of(sketch, one.owner, mark) for one, mark in zip((a, b), marks, strict=True)]
    distances = np.hypot(*(places[0][:, None] - places[1][None]).T)
    of_a = places[0][np.unravel_index(np.argmin(distances), distances.shape)[1]]
    at_b = along_curve(sketch, b.owner, marks[1], _place(of_a))[0]
    return along_curve(sketch, a.owner, marks[0], at_b)[0], at_b


def _along_line(sketch: Sketch, owner: str, mark: CurveMark, at: Place) -> tuple[Place, float]:
    first, last = _places(sketch, owner, mark, _along(sketch, mark)[[0, -1]])
    way = last - first
    part = (np.asarray(at) - first) @ way / (way @ way)
    return _place(first + part * way), math.atan2(way[1], way[0])


def _along(sketch: Sketch, mark: CurveMark) -> np.ndarray:
    first, last = (sketch.number(bound) for bound in mark.bounds)
    return np.linspace(first, last, _OF_CURVE + 1)


def _places(sketch: Sketch, owner: str, mark: CurveMark, values: np.ndarray) -> np.ndarray:
    return np.array([sketch.place(owner, mark.at(Number(float(s)))) for s in values])


def _place(at: np.ndarray) -> Place:
    return float(at[0]), float(at[1])
