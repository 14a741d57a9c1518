"""What a picture shows on request: dimensions of bodies, and velocities.

Dimensions are lengths of rods with the places of points on them, sides of plates, radii of circles, and
angles of rods from the horizontal; velocities those of mass centres and of rotation, with their values.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.patches import Arc

from ..language.units import factor
from ..model.words import shown_words
from ..pen.page import SOFT, VELOCITY
from ..pen.sketch import Sketch
from ..pen.symbols import Place
from .known import STILL
from .scene import Start, is_imperial

_OFF, _STEP = 0.3, 0.24  # inches from what is measured to the first dimension line, and to the next
_OVER = 0.05  # inches by which a witness line passes it
_SMALL = 7.5  # size of numbers, points
_LEAST = 0.18  # inches: what is shorter on paper has no dimension
_ARC = 0.45  # radius of an angle, inches
_ARROW = 0.5  # inches of the greatest velocity: less than the room around all that has a size
_LEVEL = 1e-6  # rad: a rod is level or upright


def shown_with(show: str | Iterable[str]) -> list[Callable[[Start, Sketch], None]]:
    """What draws these words.  Raises StudyError for one that there is not."""
    words = shown_words(show, SHOWN)
    return [draw for word, draw in SHOWN.items() if word in words]


# ---- dimensions ----


def dimensions(start: Start, sketch: Sketch) -> None:
    """Draws the dimensions of all bodies."""
    for name, body in start.drawing.bodies.items():
        if not body.rotates:
            continue
        if body.rod is not None:
            _rod(sketch, name, body.rod[0], body.rod[1])
        elif body.plate is not None:
            corners = sketch.corners(name, body.plate)
            for a, b in pairwise(corners[:3]):
                _length(sketch, a, b, _OFF, _free_side(sketch, a, b))
        for circle in start.drawing.marks(name).circles.values():
            _radius(sketch, sketch.place(name, circle.center), sketch.length(circle.radius))


def _rod(sketch: Sketch, name: str, first: str, last: str) -> None:
    """The length of a rod, the points on it, and its angle."""
    a, b = sketch.point(name, first), sketch.point(name, last)
    side = _free_side(sketch, a, b)
    between = _on_line(sketch, name, a, b)
    for one, other in pairwise([a, *between, b] if between else []):
        _length(sketch, one, other, _OFF, side)
    _length(sketch, a, b, _OFF + (_STEP if between else 0.0), side)
    _angle(sketch, a, b)


def _on_line(sketch: Sketch, name: str, a: Place, b: Place) -> list[Place]:
    """The named points of a body between two places, in their order; its mass centre is none."""
    along, length = _along(a, b)
    found = []
    for key in sketch.drawing.marks(name).named_points:
        away = np.subtract(sketch.point(name, key), a)
        far, aside = float(away @ along), float(abs(away @ (-along[1], along[0])))
        if aside < 0.01 * length and 0.01 < far / length < 0.99:
            found.append((far, sketch.point(name, key)))
    return [place for _, place in sorted(found)]


def _along(a: Place, b: Place) -> tuple[np.ndarray, float]:
    """The direction from a place to another, and how far that is."""
    length = math.dist(a, b)
    return np.subtract(b, a) / (length or 1.0), length


def _free_side(sketch: Sketch, a: Place, b: Place) -> float:
    """1 if there is less ink on the left of a line, else -1."""
    along, length = _along(a, b)
    ink = np.array(sketch.pen.ink or [a]) - a
    far, aside = ink @ along, ink @ (-along[1], along[0])
    reach = (_OFF + _STEP) * sketch.pen.inch
    near = (far > 0) & (far < length) & (np.abs(aside) < reach) & (np.abs(aside) > 0.1 * sketch.pen.inch)
    return 1.0 if np.count_nonzero(aside[near] > 0) <= np.count_nonzero(aside[near] < 0) else -1.0


def _length(sketch: Sketch, a: Place, b: Place, off: float, side: float) -> None:
    """A dimension line beside two places, with witness lines and the length."""
    pen = sketch.pen
    along, length = _along(a, b)
    if length < _LEAST * pen.inch:
        return
    across = side * pen.inch * np.array([-along[1], along[0]])
    first, last = (np.asarray(place) + off * across for place in (a, b))
    for place, end in ((a, first), (b, last)):
        pen.line(np.array([np.asarray(place) + 0.06 * across, end + _OVER * across]), SOFT, 0.5)
    tail, tip = (float(first[0]), float(first[1])), (float(last[0]), float(last[1]))
    pen.arrow(tail, tip, SOFT, "<|-|>", linewidth=0.6, mutation_scale=6)
    turn = math.degrees(math.atan2(along[1], along[0]))
    upright = (turn + 90) % 180 - 90  # never upside down
    middle = 0.5 * (first + last)
    _number(sketch, (middle[0], middle[1]), f"{length:.4g} {sketch.unit}", upright)


def _number(sketch: Sketch, at: Place, text: str, turn: float = 0.0) -> None:
    """A number on a line, which it hides."""
    box = {"facecolor": "#ffffff", "edgecolor": "none", "pad": 0.8}
    sketch.pen.axes.text(
        *at, text, size=_SMALL, color=SOFT, ha="center", va="center", rotation=turn, bbox=box, zorder=7
    )
    wide = 0.03 * len(text) * sketch.pen.inch
    along = wide * np.array([math.cos(math.radians(turn)), math.sin(math.radians(turn))])
    sketch.pen.remember(np.array([np.asarray(at) - along, np.asarray(at) + along]))


def _radius(sketch: Sketch, center: Place, radius: float) -> None:
    """A radius towards where there is least ink, with its length."""
    pen = sketch.pen
    ink = np.array(pen.ink or [center]) - center
    turns = np.radians(np.arange(15, 360, 30))
    tips = radius * np.column_stack([np.cos(turns), np.sin(turns)])
    beyond = tips * (1 + 0.35 * pen.inch / max(radius, 1e-300))
    crowd = [np.count_nonzero(np.hypot(*(ink - place).T) < 0.3 * pen.inch) for place in beyond]
    best = int(np.argmin(crowd))
    tip = (center[0] + float(tips[best, 0]), center[1] + float(tips[best, 1]))
    if radius >= _LEAST * pen.inch:
        pen.arrow(center, tip, SOFT, linewidth=0.6, mutation_scale=6)
    pen.name(tip, f"r = {radius:.4g} {sketch.unit}", SOFT)


def _angle(sketch: Sketch, a: Place, b: Place) -> None:
    """The angle of a line from the horizontal, if it is neither level nor upright."""
    along, length = _along(a, b)
    turn = math.atan2(along[1], along[0])
    size = min(_ARC * sketch.pen.inch, 0.5 * length)
    if min(abs(math.sin(turn)), abs(math.cos(turn))) < _LEVEL or size < _LEAST * sketch.pen.inch:
        return
    level = 0.0 if abs(turn) <= math.pi / 2 else math.copysign(math.pi, turn)
    first, last = sorted((level, turn))
    foot = (a[0] + 1.3 * size * math.cos(level), a[1])
    sketch.pen.line([a, foot], SOFT, 0.5, linestyle=(0, (4, 3)))
    degrees = math.degrees(first), math.degrees(last)
    look: Any = {"theta1": degrees[0], "theta2": degrees[1], "color": SOFT, "linewidth": 0.6, "zorder": 6}
    sketch.pen.axes.add_patch(Arc(a, 2 * size, 2 * size, **look))
    middle = 0.5 * (first + last)
    at = (a[0] + size * math.cos(middle), a[1] + size * math.sin(middle))
    sketch.pen.name(at, f"{degrees[1] - degrees[0]:.4g} deg", SOFT)


# ---- velocities ----


def velocities(start: Start, sketch: Sketch) -> None:
    """Draws the velocities of mass centres, and of rotation, in the units of the scene."""
    unit = "ft/s" if is_imperial(start.data) else "m/s"
    known = start.velocities
    fastest = max((math.hypot(x, y) for x, y, _ in known.values()), default=0.0)
    fastest_turn = max((abs(omega) for *_, omega in known.values()), default=0.0)
    size = float((sketch.high - sketch.low).max()) * sketch.factor
    still = STILL * max(fastest, fastest_turn * size)
    for name in start.drawing.bodies:
        x, y, omega = known.get(name, (0.0, 0.0, 0.0))
        body = start.drawing.bodies[name]
        at = sketch.point(name, "G" if body.rotates else "center")
        speed = math.hypot(x, y)
        if speed > still:
            scale = _ARROW * sketch.pen.inch / fastest
            tip = (at[0] + x * scale, at[1] + y * scale)
            sketch.pen.arrow(at, tip, VELOCITY, zorder=7)
            sketch.pen.name(tip, f"{speed / factor(unit)[0]:.4g} {unit}", VELOCITY)
        if body.rotates and abs(omega) * size > still:
            sketch.pen.curved_arrow(at, omega > 0, 0.3, VELOCITY)
            top = (at[0], at[1] + 0.3 * sketch.pen.inch)
            sketch.pen.name(top, f"{abs(omega):.4g} rad/s", VELOCITY)


# Dimensions come last: they keep off what is there.
SHOWN: dict[str, Callable[[Start, Sketch], None]] = {"velocities": velocities, "dimensions": dimensions}
