"""The figures of the book: free-body and kinetic diagrams, impulse and momentum, work and energy.

Each body is drawn alone, with arrows as long as the roots of what they stand for and the values beside them,
in the units of the scene.  What nothing tells is drawn with its name and "?".
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..language.units import factor
from ..model.words import unknown
from ..pen import page
from ..pen.page import BLUE, INK, RED, SOFT
from ..pen.sketch import Sketch
from ..pen.symbols import Pen, Place
from ..reading.scene import HasData
from .acting import BY_AXES, BY_SURFACE, Acting, Balance, Instant, Wrench, blows, forces, instant
from .energies import energies
from .scene import SceneDrawing, is_imperial, plane_of, title_of, usual_length

FREE_BODY, KINETIC, IMPULSE, ENERGY = "free-body", "kinetic", "impulse-momentum", "energy"
KINDS = (FREE_BODY, KINETIC, IMPULSE, ENERGY)
_PANEL = 3.8, 3.0  # width and height of the drawing of one body, in
_BODY = 1.25  # greatest size of the body itself, in
_BETWEEN = 0.45  # room of a sign between panels, in
_SHORT, _LONG = 0.28, 0.37  # an arrow: its least length, and what the greatest adds to it, in
_NOTHING = 1e-7  # of the greatest of a picture: less is not drawn
_ASIDE = 0.08  # arrows on one line are drawn so far beside each other, in
_COUPLE, _WIDER = 0.24, 0.09  # radius of a couple's arrow, and by how much the next one is wider, in
_TOUCHES = 1e-9  # inches: a force whose line passes the centre nearer points neither in nor out
_LETTER = 0.1  # width of a letter of the title, in
_ROW = 3  # free bodies beside each other
_UNKNOWN = (1.0, 0.7)  # direction of what nothing tells

_Part: TypeAlias = tuple[str, Floats]
# An arrow: its end at the body, and the other.
_Shaft: TypeAlias = tuple[Floats, Floats]


@dataclass(frozen=True)
class _Units:
    """Units of what is drawn, and their factors."""

    vector: str
    couple: str

    def value(self, size: float, couple: bool = False) -> str:
        unit = self.couple if couple else self.vector
        return "?" if math.isnan(size) else f"{abs(size) / factor(unit)[0]:.4g} {unit}"


@dataclass(frozen=True)
class _Panel:
    """One drawing of a body: what acts, its caption, and the sign before it."""

    body: str
    acts: Sequence[Acting]
    caption: str
    sign: str = ""
    colour: str = RED


def figure(
    scene: HasData,
    kind: str,
    at: str | None = None,
    run: str | None = None,
    bodies: Sequence[str] = (),
) -> Figure:
    """A figure of the book.

    `kind`: one of KINDS; `at`: a time, or the name of an event or contact (default: the start, or the first
    blow, or for energies the end); `bodies`: which (default: all).  Raises SceneError, StudyError and
    SimulationError as `instants.instant_of` does, and SceneError for a kind or a body that there is not.
    """
    if kind not in KINDS:
        raise SceneError(unknown(kind, KINDS, "figure"), path="as")
    if kind == ENERGY:
        if bodies:
            raise SceneError("work and energy are those of all bodies together; leave it out", path="bodies")
        return energies(scene, at, run)
    here = instant(scene, at, run, blow=kind == IMPULSE)
    for body in bodies:
        if body not in here.bodies:
            raise SceneError(unknown(body, here.bodies, "body"), path="bodies")
    chosen = tuple(bodies) or here.bodies
    imperial = is_imperial(here.start.data)
    force, length = ("lb", "ft") if imperial else ("N", "m")
    if kind == IMPULSE:
        units = _Units(f"{force}*s", f"{force}*{length}*s")
        rows = [_momentum_row(one) for one in blows(here, chosen)]
    else:
        units = _Units(force, f"{force}*{length}")
        rows = [_force_row(one, kind == KINETIC) for one in forces(here, chosen)]
    if kind == FREE_BODY:
        flat = [panel for row in rows for panel in row]
        rows = [flat[first : first + _ROW] for first in range(0, len(flat), _ROW)]
    return _figure(here, rows, units, f"{_NAMES[kind]}; {plane_of(here.start.data)}; {here.start.when}")


_NAMES = {
    FREE_BODY: "free bodies",
    KINETIC: "forces = m a, couples = I α",
    IMPULSE: "momenta before + impulses = momenta after",
}


def _force_row(one: Balance, kinetic: bool) -> list[_Panel]:
    free = _Panel(one.body, one.acts, "forces")
    if not kinetic:
        return [free]
    return [free, _Panel(one.body, _of(one, one.after, "m a", "I α"), "m a, I α", "=", BLUE)]


def _momentum_row(one: Balance) -> list[_Panel]:
    return [
        _Panel(one.body, _of(one, one.before, "m v", "I ω"), "before", "", BLUE),
        _Panel(one.body, one.acts, "impulses", "+"),
        _Panel(one.body, _of(one, one.after, "m v", "I ω"), "after", "=", BLUE),
    ]


def _of(one: Balance, wrench: Wrench, vector: str, couple: str) -> list[Acting]:
    """What stands at the mass centre: a vector by its parts, and a couple."""
    return [
        Acting(vector, one.center, wrench.vector, None, parts=BY_AXES),
        *([Acting(couple, one.center, None, wrench.couple)] if wrench.couple is not None else []),
    ]


# ---- on paper ----


def _figure(here: Instant, rows: Sequence[Sequence[_Panel]], units: _Units, note: str) -> Figure:
    columns = max(map(len, rows))
    drawn = columns * (_PANEL[0] + _BETWEEN) + 0.5 * _BETWEEN
    width = max(drawn, _LETTER * max(len(title_of(here.start.data)), len(note)))
    height = len(rows) * _PANEL[1] + page.HEAD_HEIGHT
    made = Figure(figsize=(width, height), dpi=page.RESOLUTION)
    canvas = FigureCanvasAgg(made)
    data = here.start.data
    page.head(made, title_of(data), note)
    for number, row in enumerate(rows):
        acts = [act for panel in row for act in panel.acts]
        most = _most(here.pose(row[0].body), acts)
        for column, panel in enumerate(row):
            x = 0.5 * (width - drawn) + column * (_PANEL[0] + _BETWEEN) + _BETWEEN
            y = height - page.HEAD_HEIGHT - (number + 1) * _PANEL[1]
            box = (x / width, y / height, _PANEL[0] / width, _PANEL[1] / height)
            made.text(
                (x - 0.5 * _BETWEEN) / width,
                (y + 0.5 * _PANEL[1]) / height,
                panel.sign,
                size=16,
                ha="center",
                va="center",
            )
            places = [act.place for other in row if other.body == panel.body for act in other.acts]
            sketch = _BodySketch(here, panel.body, made, canvas, box, places)
            _draw_panel(sketch, here, panel, units, most)
    return made


class _BodySketch(Sketch):
    """Axes of their own for one body, in a box (left, below, width, height) of a figure."""

    def __init__(
        self,
        here: Instant,
        body: str,
        made: Figure,
        canvas: FigureCanvasAgg,
        box: tuple[float, float, float, float],
        places: Sequence[Place],
    ) -> None:
        self.body, self.made, self.paper, self.box = body, made, canvas, box
        self.places = places
        super().__init__(here.start.drawing, here.start.poses, usual_length(here.start.data))

    def extent(self) -> tuple[Floats, Floats]:
        """That of the body alone, with the places (m) where something acts on it."""
        acted = [(x / self.factor, y / self.factor) for x, y in self.places]
        xy = np.array([*self.outer(self.body), *acted])
        return xy.min(axis=0), xy.max(axis=0)

    def canvas(self) -> tuple[Figure, Pen]:
        """The box, with the body in its middle."""
        size = float(max((self.high - self.low).max(), 0.0)) or 1.0
        inch = size / _BODY
        middle, half = 0.5 * (self.low + self.high), 0.5 * inch * np.array(_PANEL)
        self.low, self.high = middle - half, middle + half
        axes = self.made.add_axes(self.box)
        axes.set_xlim(self.low[0], self.high[0])
        axes.set_ylim(self.low[1], self.high[1])
        axes.set_axis_off()
        return self.made, Pen(axes, self.paper, inch)


def _draw_panel(
    sketch: _BodySketch, here: Instant, panel: _Panel, units: _Units, most: tuple[float, float]
) -> None:
    """One body with what acts on it; `most`: the greatest vector and couple of its row."""
    pen = sketch.pen
    SceneDrawing(here.start.data, sketch).draw_body(panel.body, sketch.drawing.bodies[panel.body])
    pen.cover()
    # Also of a couple that the greatest vector would have at the end of the body: less is rounding.
    couples = max(most[1], most[0] * sketch.reach(panel.body) * sketch.factor)
    wider: dict[Place, int] = {}
    arrows: list[_Shaft] = []
    for act in panel.acts:
        at = act.place[0] / sketch.factor, act.place[1] / sketch.factor
        for name, part in _parts(act):
            size = float(np.hypot(*part))
            if not size <= _NOTHING * most[0]:
                label = f"{name} = {units.value(size)}"
                arrows.append(_arrow(sketch, at, part, label, most[0], panel.colour, arrows))
        if act.couple is not None and not abs(act.couple) <= _NOTHING * couples:
            count = wider[at] = wider.get(at, -1) + 1
            label = f"{act.label} = {units.value(act.couple, couple=True)}"
            _couple(pen, at, act.couple, count, label, panel.colour)
    pen.write_names()
    caption = panel.caption if arrows or wider else f"{panel.caption}: 0"
    pen.axes.text(0.5, 0.01, caption, transform=pen.axes.transAxes, ha="center", color=SOFT)


def _most(center: Sequence[float], acts: Sequence[Acting]) -> tuple[float, float]:
    """The greatest vector, and the greatest couple, also of a vector about the centre; 0 if there is none."""
    vectors = [float(np.hypot(*act.vector)) for act in acts if act.vector is not None]
    couples = [abs(act.couple) for act in acts if act.couple is not None]
    couples += [
        float(np.hypot(*act.vector) * np.hypot(*np.subtract(act.place, center[:2])))
        for act in acts
        if act.vector is not None
    ]
    return max((one for one in vectors if one == one), default=0.0), max(
        (one for one in couples if one == one), default=0.0
    )


def _parts(act: Acting) -> list[_Part]:
    """A vector as it is shown: names and vectors [2]."""
    if act.vector is None:
        return []
    if np.isnan(act.vector).any() or act.parts not in (BY_AXES, BY_SURFACE):
        return [(act.label, act.vector)]
    turn = act.turn if act.parts == BY_SURFACE and act.turn is not None else 0.0
    along = np.array([math.cos(turn), math.sin(turn)])
    across = np.array([-along[1], along[0]])
    marks = ("F", "N") if act.parts == BY_SURFACE else ("x", "y")
    split = (
        (f"{act.label}_{mark}", (act.vector @ axis) * axis)
        for mark, axis in zip(marks, (along, across), strict=True)
    )
    tiny = _NOTHING * float(np.hypot(*act.vector))
    return [(name, part) for name, part in split if np.hypot(*part) > tiny]


def _arrow(
    sketch: _BodySketch,
    at: Place,
    part: Floats,
    label: str,
    most: float,
    colour: str,
    others: Sequence[_Shaft],
) -> _Shaft:
    """An arrow at a place: its tip pushes or its tail pulls, to stand off the body and off others."""
    pen = sketch.pen
    known = not np.isnan(part).any()
    size = float(np.hypot(*part)) if known else 0.0
    direction = part / size if known else np.array(_UNKNOWN) / np.hypot(*_UNKNOWN)
    reach = (_SHORT + _LONG * (math.sqrt(size / most) if most else 0.0)) * pen.inch
    inwards = np.subtract(sketch.point(sketch.body, "center"), at) @ direction > _TOUCHES * pen.inch
    foot, tip = np.asarray(at), np.asarray(at) + (-1 if inwards else 1) * reach * direction
    aside = _ASIDE * pen.inch * np.array([-direction[1], direction[0]])
    while any(_overlap((foot, tip), other, 0.5 * _ASIDE * pen.inch) for other in others):
        foot, tip = foot + aside, tip + aside
    ends = [(float(end[0]), float(end[1])) for end in (foot, tip)]
    tail, head = (ends[1], ends[0]) if inwards else (ends[0], ends[1])
    first = len(pen.ink)
    pen.arrow(tail, head, colour, linestyle="-" if known else ":")
    pen.name(ends[1], label, colour if known else INK, around=pen.ink[first:])
    return foot, tip


def _overlap(one: _Shaft, other: _Shaft, near: float) -> bool:
    """Whether two arrows lie along each other, on lines nearer than `near`."""
    along = one[1] - one[0]
    length = float(np.hypot(*along))
    along /= length
    apart = [along[0] * way[1] - along[1] * way[0] for way in (end - one[0] for end in other)]
    if max(map(abs, apart)) > near:
        return False
    first, last = sorted(float((end - one[0]) @ along) for end in other)
    return first < length - near and last > near


def _couple(pen: Pen, at: Place, size: float, count: int, label: str, colour: str) -> None:
    known = not math.isnan(size)
    radius = _COUPLE + count * _WIDER
    first = len(pen.ink)
    pen.curved_arrow(at, size >= 0 or not known, radius, colour, "-" if known else ":")
    turn = math.radians(190)
    there = at[0] + radius * pen.inch * math.cos(turn), at[1] + radius * pen.inch * math.sin(turn)
    pen.name(there, label, colour if known else INK, around=pen.ink[first:])
