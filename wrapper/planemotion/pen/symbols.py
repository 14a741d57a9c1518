"""The drawing signs of mechanics: supports, sliders, springs, dampers, forces, ground; and names beside them.

A `Pen` draws on axes with equal scales.  Places are in the axes' unit, sizes of signs in inches on paper, so
that they look the same for a watch and for a crane.  What has been inked is remembered, and `write_names`
puts each name where it covers least of it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgba
from matplotlib.patches import Arc, Circle, FancyArrowPatch, Polygon

from ..base.arrays import Floats
from .names import Name, Written, write
from .page import BLUE, INK, RED, SOFT

Place = tuple[float, float]

BODY_FILL = "#dbe5ef"
SPRING = "#3b7d5e"
TOUCH = "#c8741a"

_WALL = 0.055  # of a hoop, in
PIN = 0.05  # radius of a pin, in
_SUPPORT = 0.17  # height of a support's triangle, in
_HATCH = 0.075  # length of a hatch stroke, in
_HATCH_STEP = 0.085
_BLOCK = (0.24, 0.13)  # a sliding block, in
_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))  # its corners
_TOUCHES = 0.06  # gap that is drawn as closed, and radius of its ring, in
_COIL = 0.065  # half the width of a spring, in
_INK_STEP = 0.04  # between remembered places along a line, in
_ARROW = 0.55  # an arrow of a force, in
_OPEN = 0.02  # a joint that is open by more is drawn open, in


@dataclass
class Pen:
    """Draws on `axes`; `inch` is the length on the drawing, in the axes' unit, that is an inch on paper."""

    axes: Axes
    canvas: FigureCanvasAgg
    inch: float
    ink: list[Place] = field(default_factory=list)
    names: list[Name] = field(default_factory=list)

    # ---- lines and shapes ----

    def line(
        self, places: Sequence[Place] | Floats, colour: str = INK, width: float = 1.0, **options: Any
    ) -> None:
        """A broken line through places [n, 2] in the axes' unit; `width` in points."""
        xy = np.asarray(places, np.float64)
        options = {"solid_capstyle": "round", "zorder": 3, **options}
        self.axes.plot(xy[:, 0], xy[:, 1], color=colour, linewidth=width, **options)
        self.remember(xy)

    def polygon(
        self, places: Sequence[Place] | Floats, fill: str = BODY_FILL, edge: str = BLUE, **options: Any
    ) -> None:
        xy = np.asarray(places, np.float64)
        options = {"linewidth": 1.1, "zorder": 2, "joinstyle": "round", **options}
        self.axes.add_patch(Polygon(xy, closed=True, facecolor=fill, edgecolor=edge, **options))
        self.remember(np.vstack([xy, xy[:1]]))

    def circle(
        self, center: Place, radius: float, fill: str = "none", edge: str = BLUE, **options: Any
    ) -> None:
        options = {"linewidth": 1.1, "zorder": 2, **options}
        self.axes.add_patch(Circle(center, radius, facecolor=fill, edgecolor=edge, **options))
        turn = np.linspace(0, 2 * math.pi, 73)
        self.remember(np.column_stack([center[0] + radius * np.cos(turn), center[1] + radius * np.sin(turn)]))

    def bar(self, a: Place, b: Place, width: float) -> None:
        """A rod of that width (in inches) with round ends."""
        along, across = _frame(a, b)
        half = 0.5 * width * self.inch
        turn = np.linspace(math.pi / 2, 3 * math.pi / 2, 13)
        cap = np.column_stack([np.cos(turn), np.sin(turn)]) * half
        first = np.asarray(a) + cap[:, :1] * along + cap[:, 1:] * across
        second = np.asarray(b) - cap[:, :1] * along - cap[:, 1:] * across
        self.polygon(np.vstack([first, second]))

    def ring(self, center: Place, radius: float) -> None:
        """A hoop: its rim, and a wall of a width that can be seen."""
        self.circle(center, radius - 0.5 * _WALL * self.inch, edge=BODY_FILL, linewidth=4.0, zorder=1.9)
        self.circle(center, radius)
        self.circle(center, radius - _WALL * self.inch, linewidth=0.7)

    def half_ring(self, center: Place, radius: float, angle: float) -> None:
        """The half of a ring on the side of its x axis."""
        turn = np.linspace(angle - math.pi / 2, angle + math.pi / 2, 49)
        arc = np.column_stack([center[0] + radius * np.cos(turn), center[1] + radius * np.sin(turn)])
        self.line(arc, BLUE, 5.0, zorder=2)
        self.line(arc, BODY_FILL, 3.0, zorder=2.1)

    def dot(self, at: Place, colour: str = INK, radius: float = 0.022) -> None:
        self.axes.add_patch(Circle(at, radius * self.inch, facecolor=colour, linewidth=0, zorder=5))
        self.ink.append(at)

    def arrow(self, tail: Place, tip: Place, colour: str = RED, style: str = "-|>", **options: Any) -> None:
        options = {"mutation_scale": 9, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0, "zorder": 6, **options}
        self.axes.add_patch(FancyArrowPatch(tail, tip, arrowstyle=style, color=colour, **options))
        self.remember(np.array([tail, tip]))

    def remember(self, places: Floats) -> None:
        """Notes what is inked along a broken line [n, 2], for the names to keep off."""
        for a, b in pairwise(places):
            count = 1 + int(min(math.dist(a, b) / (_INK_STEP * self.inch), 400))
            for i in range(count):
                share = i / count
                self.ink.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))

    # ---- ground ----

    def ground_line(self, a: Place, b: Place, zorder: float = 1.5) -> None:
        """A fixed line from a to b, hatched on its right."""
        self.line([a, b], INK, 1.2, zorder=zorder)
        along, across = _frame(a, b)
        length = math.dist(a, b)
        step, size = _HATCH_STEP * self.inch, _HATCH * self.inch
        strokes = []
        for i in range(int(min(length / step, 2000)) + 1):
            foot = np.asarray(a) + along * i * step
            strokes += [foot, foot - size * (along + across), np.array([math.nan, math.nan])]
        xy = np.array(strokes)
        self.axes.plot(xy[:, 0], xy[:, 1], color=SOFT, linewidth=0.6, zorder=zorder - 0.1)
        middle = [np.asarray(end) - 0.6 * size * across for end in (a, b)]
        self.remember(np.array(middle))

    def support(self, at: Place) -> None:
        """The triangle and hatched ground that hold a pin."""
        half, height = 0.62 * _SUPPORT * self.inch, _SUPPORT * self.inch
        foot = at[1] - height
        triangle = [at, (at[0] - half, foot), (at[0] + half, foot)]
        self.polygon(triangle, "white", INK, linewidth=0.9, zorder=3.5)
        self.ground_line((at[0] - 1.6 * half, foot), (at[0] + 1.6 * half, foot), 3.4)

    # ---- joints ----

    def pin(self, at: Place) -> None:
        self.circle(at, PIN * self.inch, fill="white", edge=INK, linewidth=1.1, zorder=5)

    def weld(self, at: Place) -> None:
        size = 0.032 * self.inch
        corners = [(at[0] + x * size, at[1] + y * size) for x, y in _SQUARE]
        self.polygon(corners, INK, INK, linewidth=0.5, zorder=5)

    def block(self, at: Place, angle: float) -> None:
        """The block of a slider, along its guide."""
        along = np.array([math.cos(angle), math.sin(angle)])
        across = np.array([-along[1], along[0]])
        half = 0.5 * np.asarray(_BLOCK) * self.inch
        corners = [np.asarray(at) + x * half[0] * along + y * half[1] * across for x, y in _SQUARE]
        self.polygon(np.array(corners), "white", INK, linewidth=1.0, zorder=4)

    def link(self, a: Place, b: Place) -> None:
        """A massless link: a double line between two pins."""
        self.line([a, b], INK, 3.0, zorder=2.6)
        self.line([a, b], "white", 1.4, zorder=2.7)
        self.pin(a)
        self.pin(b)

    def pitch_circle(self, center: Place, radius: float) -> None:
        """The circle on which a gear meshes."""
        turn = np.linspace(0.0, 2 * np.pi, 97)
        ring = np.column_stack([center[0] + radius * np.cos(turn), center[1] + radius * np.sin(turn)])
        self.line(ring, INK, 0.6, linestyle="-.")

    def open_joint(self, at: Place, there: Place) -> None:
        """A pin whose other half is elsewhere: a start that could not be assembled."""
        if math.dist(at, there) > _OPEN * self.inch:
            self.line([at, there], RED, 1.2, linestyle=":")
            self.pin(there)

    def tail(self, at: Place, x: float, y: float) -> Place:
        """Where an arrow to a place begins, along (x, y); straight above it if that is no direction."""
        size = math.hypot(x, y)
        if size == 0.0:
            x, y, size = 0.0, -1.0, 1.0
        reach = _ARROW * self.inch / size
        return at[0] - reach * x, at[1] - reach * y

    def rolls(self, at: Place, angle: float) -> None:
        """Where one body rolls on another: a short cross stroke and a dot, as on a gear's pitch point."""
        along = np.array([math.cos(angle), math.sin(angle)]) * 0.07 * self.inch
        across = np.array([-along[1], along[0]])
        for sign in (-1, 1):
            middle = np.asarray(at) + sign * 0.4 * along
            self.line(np.array([middle - across, middle + across]), INK, 0.8, zorder=4)
        self.dot(at)

    # ---- contacts and forces ----

    def touches(self, pairs: list[tuple[Place, Place]]) -> None:
        """The contacts of a set: those that are closed, else the nearest one."""
        nearest = min(pairs, key=lambda pair: math.dist(*pair))
        for pair in pairs:
            if pair is nearest or math.dist(*pair) <= _TOUCHES * self.inch:
                self.touch(*pair)

    def touch(self, a: Place, b: Place) -> None:
        """A contact: the gap as a dotted line, a ring where it is closed."""
        if math.dist(a, b) > _TOUCHES * self.inch:
            self.line([a, b], TOUCH, 1.1, linestyle=(0, (1.2, 1.6)), zorder=4)
            for end in (a, b):
                self.dot(end, TOUCH)
        else:
            self.circle(a, _TOUCHES * self.inch, edge=TOUCH, linewidth=1.5, zorder=5)

    def spring(self, a: Place, b: Place) -> None:
        length = math.dist(a, b)
        if length == 0:
            return
        along, across = _frame(a, b)
        end = min(0.12 * self.inch, 0.2 * length)
        coils = int(np.clip((length - 2 * end) / (0.11 * self.inch), 3, 14))
        middle = np.linspace(end, length - end, 2 * coils + 1)
        side = np.array([0.0, *[(-1.0) ** i for i in range(2 * coils - 1)], 0.0]) * _COIL * self.inch
        reach = np.array([0.0, *middle, length])
        aside = np.array([0.0, *side, 0.0])
        self.line(np.asarray(a) + reach[:, None] * along + aside[:, None] * across, SPRING, 1.1, zorder=4)

    def damper(self, a: Place, b: Place) -> None:
        length = math.dist(a, b)
        if length == 0:
            return
        along, across = _frame(a, b)
        middle, half = 0.5 * length, min(0.13 * self.inch, 0.25 * length)
        wide = _COIL * self.inch

        def at(reach: float, aside: float = 0.0) -> Floats:
            return np.asarray(a) + reach * along + aside * across

        cup = ((half, wide), (-half, wide), (-half, -wide), (half, -wide))
        self.line(np.array([a, at(middle - half)]), SPRING, 1.1, zorder=4)
        self.line(np.array([at(middle + x, y) for x, y in cup]), SPRING, 1.1, zorder=4)
        self.line(np.array([at(middle, 0.75 * wide), at(middle, -0.75 * wide)]), SPRING, 2.0, zorder=4)
        self.line(np.array([at(middle), b]), SPRING, 1.1, zorder=4)

    def spiral(self, at: Place) -> None:
        turn = np.linspace(0, 5 * math.pi, 90)
        size = (0.03 + 0.09 * turn / turn[-1]) * self.inch
        spiral = np.column_stack([at[0] + size * np.cos(turn), at[1] + size * np.sin(turn)])
        self.line(spiral, SPRING, 1.0, zorder=4)

    def couple(self, at: Place, counterclockwise: bool) -> None:
        """A curved arrow round a place."""
        self.curved_arrow(at, counterclockwise, 0.24, RED)

    def curved_arrow(
        self, at: Place, counterclockwise: bool, size: float, colour: str, style: str = "-"
    ) -> None:
        """A curved arrow of a radius in inches."""
        radius = size * self.inch
        first, last = math.radians(-50), math.radians(190)
        if not counterclockwise:
            first, last = last, first
        self.axes.add_patch(
            Arc(
                at,
                2 * radius,
                2 * radius,
                theta1=-50,
                theta2=190,
                color=colour,
                linewidth=1.4,
                zorder=6,
                linestyle=style,
            )
        )
        tip = (at[0] + radius * math.cos(last), at[1] + radius * math.sin(last))
        sense = 1.0 if counterclockwise else -1.0
        back = last - sense * 0.35
        tail = (at[0] + radius * math.cos(back), at[1] + radius * math.sin(back))
        self.arrow(tail, tip, colour)
        turns = np.radians(np.linspace(-50, 190, 25))
        self.remember(np.column_stack([at[0] + radius * np.cos(turns), at[1] + radius * np.sin(turns)]))

    def mass_centre(self, at: Place) -> None:
        """The quartered circle."""
        radius = 0.045 * self.inch
        self.circle(at, radius, fill="white", edge=BLUE, linewidth=0.7, zorder=4.5)
        for first in (0, 180):
            turn = np.radians(np.linspace(first, first + 90, 9))
            arc = np.column_stack([at[0] + radius * np.cos(turn), at[1] + radius * np.sin(turn)])
            self.axes.add_patch(Polygon(np.vstack([[at], arc]), facecolor=BLUE, edgecolor="none", zorder=4.6))

    # ---- names ----

    def cover(self) -> None:
        """Remembers all that is filled so far, for the names to keep off it."""
        step = 1.5 * _INK_STEP * self.inch
        low, high = np.array([self.axes.get_xlim(), self.axes.get_ylim()]).T
        places = np.stack(
            np.meshgrid(*(np.arange(a, b, step) for a, b in zip(low, high, strict=True))), axis=-1
        ).reshape(-1, 2)
        for patch in self.axes.patches:
            if patch.get_fill() and to_rgba(patch.get_facecolor())[3]:
                path = patch.get_path().transformed(patch.get_patch_transform())
                self.ink += [(float(x), float(y)) for x, y in places[path.contains_points(places)]]

    def name(
        self, at: Place, text: str, colour: str = INK, bold: bool = False, around: Sequence[Place] = ()
    ) -> None:
        """Remembers a name to be written beside a place; one that stands there already is not repeated.

        `around`: the ink of what has the name, if it is more than that place."""
        near = 0.04 * self.inch
        for other in self.names:
            if math.dist(other.place, at) < near and other.colour == colour and other.bold == bold:
                if text not in other.text.split(", "):
                    other.text += f", {text}"
                return
        self.names.append(Name(at, text, colour, bold, around))

    def write_names(self) -> list[Written]:
        """Writes all names, each at the free place nearest to what it names."""
        written = write(self.axes, self.canvas, self.ink, self.names)
        self.names.clear()
        return written


def _frame(a: Sequence[float] | Place, b: Sequence[float] | Place) -> tuple[Floats, Floats]:
    """Unit vectors along a line and to its left; along x where both ends are one."""
    along = np.asarray(b, np.float64) - np.asarray(a, np.float64)
    length = float(np.hypot(*along))
    along = along / length if length > 0 else np.array([1.0, 0.0])
    return along, np.array([-along[1], along[0]])
