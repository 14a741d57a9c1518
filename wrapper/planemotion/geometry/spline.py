"""Curves through points: cubic splines of both coordinates over the length of the chords."""

from __future__ import annotations

import numpy as np

from ..base.errors import SceneError
from ..language.dimensions import LENGTH
from ..language.lookup import Piecewise

# Of a spline that is open, and of one that is closed: fewer determine none.
_LEAST_OPEN, _LEAST_CLOSED = 4, 3
# Of the whole length: neighbours nearer than that are one point written twice.
_SAME = 1e-6


def spline(places: tuple[tuple[float, float], ...], closed: bool, where: str) -> tuple[Piecewise, Piecewise]:
    """x and y over s, SI, with continuous second derivatives.

    A closed curve goes on from its last point to its first, whether that is written again or not; an open one
    has no knot at the second point and at the last but one.

    Raises SceneError for too few points and for neighbours that are one.
    """
    from scipy.interpolate import CubicSpline

    least = _LEAST_CLOSED if closed else _LEAST_OPEN
    points = np.array(places[:-1] if closed and places[0] == places[-1] else places)
    if len(points) < least:
        kind = "a closed" if closed else "an open"
        raise SceneError(f"{len(points)} points; {kind} curve needs at least {least}", path=where)
    points = np.vstack([points, points[:1]]) if closed else points
    chords = np.hypot(*np.diff(points, axis=0).T)
    _check_chords(chords, points, where)
    at = np.concatenate([[0.0], np.cumsum(chords)])
    made = CubicSpline(at, points, bc_type="periodic" if closed else "not-a-knot")
    knots = tuple(at.tolist())
    x, y = (
        Piecewise(f"{where}.{name}", knots, tuple(map(tuple, part)), LENGTH, LENGTH, "stop")
        for name, part in zip("xy", made.c[::-1].transpose(2, 1, 0).tolist(), strict=True)
    )
    return x, y


def _check_chords(chords: np.ndarray, points: np.ndarray, where: str) -> None:
    short = np.flatnonzero(chords <= _SAME * chords.sum())
    if len(short):
        k, shown = int(short[0]), ", ".join(f"{one:.6g} m" for one in points[short[0]])
        after = f"{k + 2}" if k + 1 < len(chords) else f"{k + 2} (or the first, at which a closed curve ends)"
        raise SceneError(f"points {k + 1} and {after} are one: [{shown}]; neighbours stand apart", path=where)
