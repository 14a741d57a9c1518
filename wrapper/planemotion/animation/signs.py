"""What a picture of a scene is made of, as signs with places instead of ink.

A `Signs` is a pen: whoever draws with it leaves a list of signs.  Signs that are stretched or stand upright
(springs, welds, supports) are noted as such, with the places they hang on; all others as lines and circles.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base.arrays import Floats
from ..geometry.drawing import Drawing
from ..pen.names import Written
from ..pen.page import BLUE, INK, RED, SOFT
from ..pen.sketch import Sketch, inch_of
from ..pen.symbols import BODY_FILL, PIN, SPRING, TOUCH, Pen, Place

# Colours by what they are for; the player has its own for each, light and dark.
_ROLES = {
    INK: "ink",
    SOFT: "soft",
    BLUE: "body",
    RED: "force",
    BODY_FILL: "fill",
    SPRING: "spring",
    TOUCH: "touch",
    "white": "paper",
    "none": "",
}


@dataclass(frozen=True)
class Sign:
    """`kind` and the places it hangs on.

    `size`: a radius, in the unit of the picture, of a dot in inches.  How it looks: roles of colours, `width`
    of lines and `dashes` in points, `order` from below to above.  `text`: of a name.
    """

    kind: str
    places: tuple[Place, ...]
    size: float = 0.0
    stroke: str = ""
    fill: str = ""
    width: float = 1.0
    dashes: tuple[float, ...] = ()
    order: float = 3.0
    text: str = ""


@dataclass
class Signs(Pen):
    """A pen that notes signs.  `inch`: the length in the unit of the picture that is an inch on paper."""

    signs: list[Sign] = field(default_factory=list)

    def line(
        self, places: Sequence[Place] | Floats, colour: str = INK, width: float = 1.0, **options: Any
    ) -> None:
        self._add("line", places, stroke=colour, width=width, **options)

    def polygon(
        self, places: Sequence[Place] | Floats, fill: str = BODY_FILL, edge: str = BLUE, **options: Any
    ) -> None:
        options = {"linewidth": 1.1, "zorder": 2, **options}
        self._add("polygon", places, stroke=edge, fill=fill, width=options.pop("linewidth"), **options)

    def circle(
        self, center: Place, radius: float, fill: str = "none", edge: str = BLUE, **options: Any
    ) -> None:
        options = {"linewidth": 1.1, "zorder": 2, **options}
        width = options.pop("linewidth")
        self._add("circle", [center], size=radius, stroke=edge, fill=fill, width=width, **options)

    def arrow(self, tail: Place, tip: Place, colour: str = RED, style: str = "-|>", **options: Any) -> None:
        self._add("arrow", [tail, tip], stroke=colour, width=options.get("linewidth", 1.4), zorder=6)

    def remember(self, places: Floats) -> None:
        """Names are placed by the player."""

    def dot(self, at: Place, colour: str = INK, radius: float = 0.022) -> None:
        self._add("dot", [at], size=radius, stroke="none", fill=colour, zorder=5)

    def pin(self, at: Place) -> None:
        self._add("dot", [at], size=PIN, stroke=INK, fill="white", width=1.1, zorder=5)

    def pitch_circle(self, center: Place, radius: float) -> None:
        self._add("circle", [center], size=radius, stroke=INK, width=0.6, linestyle=(0, (6, 2, 1, 2)))

    def ground_line(self, a: Place, b: Place, zorder: float = 1.5) -> None:
        self._add("ground", [a, b], stroke=INK, width=1.2, zorder=zorder)

    def weld(self, at: Place) -> None:
        self._add("weld", [at], stroke=INK, fill=INK, zorder=5)

    def block(self, at: Place, angle: float) -> None:
        self._add("block", [at, self._along(at, angle)], stroke=INK, fill="white", zorder=4)

    def rolls(self, at: Place, angle: float) -> None:
        self._add("rolls", [at, self._along(at, angle)], stroke=INK, width=0.8, zorder=4)

    def open_joint(self, at: Place, there: Place) -> None:
        """In motion joints are closed."""

    def touch(self, a: Place, b: Place) -> None:
        self._add("touch", [a, b], stroke=TOUCH, width=1.3, zorder=5)

    def spring(self, a: Place, b: Place) -> None:
        self._add("spring", [a, b], stroke=SPRING, width=1.1, zorder=4)

    def damper(self, a: Place, b: Place) -> None:
        self._add("damper", [a, b], stroke=SPRING, width=1.1, zorder=4)

    def spiral(self, at: Place) -> None:
        self._add("spiral", [at], stroke=SPRING, width=1.0, zorder=4)

    def couple(self, at: Place, counterclockwise: bool) -> None:
        self._add("couple", [at], size=1.0 if counterclockwise else -1.0, stroke=RED, width=1.4, zorder=6)

    def mass_centre(self, at: Place) -> None:
        self._add("centre", [at], stroke=BLUE, width=0.7, zorder=4.6)

    def name(
        self, at: Place, text: str, colour: str = INK, bold: bool = False, around: Sequence[Place] = ()
    ) -> None:
        self._add("name", [at], size=float(bold), stroke=colour, zorder=8, text=text)

    def write_names(self) -> list[Written]:
        """They are signs."""
        return []

    def _along(self, at: Place, angle: float) -> Place:
        """A place an inch away in a direction."""
        return at[0] + self.inch * math.cos(angle), at[1] + self.inch * math.sin(angle)

    def _add(
        self,
        kind: str,
        places: Sequence[Place] | Floats,
        *,
        stroke: str,
        size: float = 0.0,
        fill: str = "none",
        width: float = 1.0,
        text: str = "",
        **options: Any,
    ) -> None:
        style = options.get("linestyle")
        dashes = (
            tuple(map(float, style[1])) if isinstance(style, tuple) else (1.0, 2.0) if style == ":" else ()
        )
        self.signs.append(
            Sign(
                kind,
                tuple((float(x), float(y)) for x, y in places),
                size,
                _ROLES[stroke],
                _ROLES[fill],
                width,
                dashes,
                float(options.get("zorder", 3)),
                text,
            )
        )


class SignSketch(Sketch):
    """A sketch whose pen notes signs; `room` is all that is ever seen, `view` how much of it at once.

    `page_inch`: what would be an inch if all were seen at once; the pen's is that of what is seen.
    """

    signs: Signs
    page_inch: float

    def __init__(
        self,
        drawing: Drawing,
        poses: Mapping[str, tuple[float, float, float]],
        unit: str,
        room: tuple[np.ndarray, np.ndarray],
        view: float = math.inf,
        known: Mapping[str, float] | None = None,
    ) -> None:
        self.view = view
        super().__init__(drawing, poses, unit, room, known)

    def canvas(self) -> tuple[Figure, Pen]:
        """No paper, but its size."""
        figure, axes, canvas = _no_paper()
        self.page_inch = self.fit()[0]
        self.signs = Signs(axes, canvas, min(self.page_inch, inch_of(np.full(2, self.view))))
        return figure, self.signs


@cache
def _no_paper() -> tuple[Figure, Axes, FigureCanvasAgg]:
    """What a pen has to have; nothing is drawn on it."""
    figure = Figure()
    return figure, figure.gca(), FigureCanvasAgg(figure)
