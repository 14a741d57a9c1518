"""Where two curves, or a line and a curve, are nearest to each other in a picture."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..geometry.curves import CurveMark
from ..geometry.drawing import Drawing
from ..geometry.pairs import as_curve
from ..geometry.partners import Partner
from ..language.tree import Number
from ..model.words import GROUND
from .symbols import Place

if TYPE_CHECKING:
    from .sketch import Sketch

# Places of a curve that are joined by straight lines.
_OF_CURVE = 240


def places_of(sketch: Sketch, owner: str, mark: CurveMark) -> np.ndarray:
    """Places [n, 2] of a curve, in the order of s."""
    own = _own_places(sketch.drawing, owner, mark) / sketch.factor
    if owner == GROUND:
        return own
    gx, gy, angle = sketch.poses[owner]
    c, s = math.cos(angle), math.sin(angle)
    return np.array([gx, gy]) / sketch.factor + own @ np.array([[c, s], [-s, c]])


def along_curve(sketch: Sketch, owner: str, mark: CurveMark, at: Place) -> tuple[Place, float]:
    """The place of a curve next to a place, and its direction there."""
    if mark.endless:
        return _along_line(sketch, owner, mark, at)
    places = places_of(sketch, owner, mark)
    k = int(np.argmin(np.hypot(*(places - np.asarray(at)).T)))
    before, middle, after = places[min(max(k, 1), len(places) - 2) + np.array([-1, 0, 1])]
    # Between three places the curve is a parabola, but for what nobody sees.
    slope, bend = 0.5 * (after - before), 0.5 * (after + before) - middle
    u = np.linspace(-1.0, 1.0, _OF_CURVE + 1)[:, None]
    near = middle + u * (slope + u * bend)
    best = int(np.argmin(np.hypot(*(near - np.asarray(at)).T)))
    way = slope + 2 * u[best] * bend
    return _place(near[best]), math.atan2(way[1], way[0])


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
    first, last = places_of(sketch, owner, mark)[[0, -1]]
    way = last - first
    part = (np.asarray(at) - first) @ way / (way @ way)
    return _place(first + part * way), math.atan2(way[1], way[0])


def _own_places(drawing: Drawing, owner: str, mark: CurveMark) -> np.ndarray:
    """Places [n, 2] of a curve in m, from the mass centre of its body along its axes; alike in all poses."""
    known = drawing.places.get((owner, mark))
    if known is None:
        number = drawing.tables.default
        first, last = (number(bound) for bound in mark.bounds)
        values = np.linspace(first, last, _OF_CURVE + 1)
        marks = (drawing.from_mass_center(owner, mark.at(Number(float(s)))) for s in values)
        known = drawing.places[owner, mark] = np.array([(number(x), number(y)) for x, y in marks])
    return known


def _place(at: np.ndarray) -> Place:
    return float(at[0]), float(at[1])
