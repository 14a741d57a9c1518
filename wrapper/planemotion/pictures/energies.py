"""Work and energy: from the start of a run to an instant, a bar for each force.

    T1 + sum of works = T2

Weights work by how far G sinks; blows, and impulses that events apply, by how the kinetic energy jumps.  What
none of these did is done by friction and by what drives bodies, and is one bar.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from ..engine.history import AFTER
from ..language.units import factor
from ..pen import page
from ..pen.page import BLUE, CURVES, RED, SOFT
from ..reading.scene import HasData
from .acting import Instant, instant
from .scene import is_imperial, title_of

_WIDTH, _BAR, _MARGINS = 7.6, 0.32, 1.25  # of the picture, in
_LETTER, _BESIDE = 0.085, 0.3  # of the names beside the bars: width of a letter, and room around them, in
_NOTHING = 1e-9  # of the greatest bar: less is rounding


@dataclass(frozen=True)
class Ledger:
    """Kinetic energy at the start and at an instant, and the work of each in between, J.

    `blows`: of these and of impulses; `rest`: what is left of the change.
    """

    before: float
    works: dict[str, float]
    blows: float
    after: float

    @property
    def rest(self) -> float:
        return self.after - self.before - sum(self.works.values()) - self.blows

    @property
    def size(self) -> float:
        """The greatest of them."""
        return max(abs(one) for one in (self.before, self.after, self.blows, *self.works.values())) or 1.0


def ledger(at: Instant) -> Ledger:
    """What did work from the first recorded row to the instant."""
    works: dict[str, float] = {}
    if at.start.data.plane == "vertical":
        for body in at.bodies:
            weight = at.value(f"{body}.weight")
            if weight > 0:
                works[f"weight of {body}"] = -weight * (at.value(f"{body}.y") - at.value(f"{body}.y", 0))
    for name in at.start.data.forces:
        if f"{name}.work" in at.recorded.columns:
            works[name] = at.value(f"{name}.work") - at.value(f"{name}.work", 0)
    before, after = at.value("energy.kinetic", 0), at.value("energy.kinetic")
    struck = np.flatnonzero(at.recorded.mark[1 : at.row + 1] == AFTER) + 1
    jumps = (
        at.value("energy.kinetic", row) - at.value("energy.kinetic", row - 1) for row in map(int, struck)
    )
    return Ledger(before, works, sum(jumps), after)


def energies(scene: HasData, at: str | None = None, run: str | None = None) -> Figure:
    """The bars from the start to an instant (default: the end of the run)."""
    here = instant(scene, at, run, last=at is None)
    found = ledger(here)
    imperial = is_imperial(here.start.data)
    unit = "ft*lb" if imperial else "J"
    scale = factor("ft*lb" if imperial else "N*m")[0]
    least = _NOTHING * found.size
    bars = [("T1", found.before, BLUE)]
    bars += [(f"U {name}", work, RED) for name, work in found.works.items()]
    others = (("blows, impulses", found.blows), ("friction, drives", found.rest))
    bars += [(name, work, CURVES[1]) for name, work in others if abs(work) > least]
    bars.append(("T2", found.after, BLUE))
    bars = [(name, work if abs(work) > least else 0.0, colour) for name, work, colour in bars]
    height = _MARGINS + _BAR * len(bars)
    made = Figure(figsize=(_WIDTH, height), dpi=page.RESOLUTION)
    page.head(made, title_of(here.start.data), f"T1 + U = T2; from the start to {here.start.when}")
    left = (_BESIDE + _LETTER * max(len(name) for name, _, _ in bars)) / _WIDTH
    axes = made.add_axes((left, 0.45 / height, 0.97 - left, (height - _MARGINS + 0.1) / height))
    places = np.arange(len(bars))[::-1]
    values = [value / scale for _, value, _ in bars]
    axes.barh(places, values, height=0.6, color=[colour for _, _, colour in bars])
    axes.set_yticks(places, [name for name, _, _ in bars])
    axes.axvline(0, color=SOFT, linewidth=0.8)
    axes.set_xlabel(f"energy [{unit}]")
    axes.margins(x=0.18)
    for place, value in zip(places, values, strict=True):
        side = "left" if value >= 0 else "right"
        axes.annotate(
            f"{value:.4g}",
            (value, place),
            (4 if value >= 0 else -4, 0),
            textcoords="offset points",
            va="center",
            ha=side,
        )
    return made
