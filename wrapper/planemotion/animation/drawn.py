"""What a frame shows beside the bodies: traces below them; velocities, forces and blows above."""

from __future__ import annotations

from typing import Any

from matplotlib.patches import Circle

from ..pen.page import IMPULSE, RED, TRACE, VELOCITY
from ..pen.sketch import Sketch
from ..pen.symbols import Pen
from .beside import Arrow, Beside

_COLOURS = {"velocity": VELOCITY, "force": RED, "impulse": IMPULSE}
_SEEN = 0.01  # inches: a shorter arrow is not drawn
_RING = (0.06, 0.10)  # of a blow, inches: its radius at first, and what it grows by
_FAINT = 0.25  # how strong a blow is before it is gone


def draw_below(sketch: Sketch, beside: Beside, time: float) -> None:
    """The ways of the traced points up to a time."""
    for name, anchor in beside.traces:
        gone = [(x, y) for t, x, y in beside.ways[name] if t < time]
        sketch.pen.line([*gone, beside.place(anchor, time)], TRACE, 0.9, zorder=1.8)


def draw_above(sketch: Sketch, beside: Beside, time: float) -> None:
    """Arrows of what is shown at a time, and of the blow that is still seen."""
    pen, words = sketch.pen, beside.shows.words
    for kind, word in (("velocity", "velocities"), ("force", "forces")):
        for one in beside.arrows[kind] if word in words else ():
            _arrow(pen, beside, kind, one, time)
    seen = beside.timing.fresh(time)
    if seen is None:
        return
    event, fresh = float(beside.timing.events[seen[0]]), seen[1]
    for one in beside.arrows["impulse"]:
        look = {"linewidth": 2.6, "mutation_scale": 14, "alpha": _FAINT + (1 - _FAINT) * fresh}
        if _arrow(pen, beside, "impulse", one, event, **look):
            radius = (_RING[0] + _RING[1] * (1 - fresh)) * pen.inch
            ring = Circle(beside.place(one.at, event), radius, fill=False, edgecolor=IMPULSE, linewidth=1.4)
            ring.set(alpha=look["alpha"], zorder=7)
            pen.axes.add_patch(ring)


def _arrow(pen: Pen, beside: Beside, kind: str, one: Arrow, time: float, **look: Any) -> bool:
    """An arrow as long as it is at a time, from where it hangs then; whether it is seen."""
    x, y = beside.arrow(kind, one, time)
    if x * x + y * y < _SEEN**2:
        return False
    tail = beside.place(one.at, time)
    look = {"zorder": 7, "clip_on": False, **look}
    pen.arrow(tail, (tail[0] + x * pen.inch, tail[1] + y * pen.inch), _COLOURS[kind], **look)
    return True
