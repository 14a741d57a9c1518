"""What panels of sweeps share: titles, ticks, limits, logarithmic axes, colours of curves and categories."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np

from ..base.arrays import Floats
from ..pen.page import CURVES, RED, SOFT
from .panels import Panel, SweptAxis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

PALE_RED = "#dd9c95"
EMPTY = "#ebebeb"
# Positive values that span more than this are drawn on a logarithmic axis.
_LOG_SPAN = 100.0
_LETTERS = 13.0  # of a title to an inch


def colours_of(count: int) -> list[Any]:
    """So many colours: named ones, or steps of one scale where there are more."""
    if count <= len(CURVES):
        return list(CURVES[:count])
    return list(matplotlib.colormaps["viridis"](np.linspace(0.0, 0.88, count)))


def is_whole(values: Floats) -> bool:
    """Whether all known values are whole numbers, some of them again and again: a count, a yes or no."""
    known = values[np.isfinite(values)]
    return bool(known.size and np.all(known == np.round(known)) and len(np.unique(known)) < known.size)


def whole_ticks(place: Axes) -> None:
    from matplotlib.ticker import MaxNLocator

    place.yaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
    low, high = place.get_ylim()
    if high - low < 1:  # one number: the next one is seen, too
        low, high = np.ceil(low), np.ceil(low) + 1
    place.set_ylim(min(low, np.ceil(low) - 0.2), max(high, np.floor(high) + 0.2))


def title(place: Axes, panel: Panel, width: float) -> None:
    """The name of an ask, what is asked in words, and what is missing; on `width` inches."""
    place.set_title(panel.label)
    room = int(_LETTERS * width) - len(panel.label) - 2
    words = ", ".join(filter(None, [panel.note, panel.words]))
    words = words if len(words) <= room else panel.note
    if words:
        place.set_title(words, loc="right", size=8, weight="normal", color=SOFT)


def ticks_of_bad_cases(place: Axes, x: Floats) -> None:
    """Red ticks on the lower edge where a case did not end well."""
    if x.size:
        place.plot(
            x,
            np.zeros(x.size),
            "|",
            color=RED,
            markersize=7,
            markeredgewidth=0.8,
            transform=place.get_xaxis_transform(),
            clip_on=False,
            zorder=5,
        )


def logarithmic(place: Axes, which: str) -> None:
    """Makes an axis logarithmic."""
    if which == "x":
        place.set_xscale("log")
        plain_numbers(place.xaxis)
    else:
        place.set_yscale("log")
        plain_numbers(place.yaxis)


def plain_numbers(axis: Axis) -> None:
    """Labels 1, 10, 100 instead of powers, which would need mathematical text."""
    from matplotlib.ticker import LogFormatter

    axis.set_major_formatter(LogFormatter())
    axis.set_minor_formatter(LogFormatter(minor_thresholds=(1.0, 0.4)))


def spans_decades(values: Floats) -> bool:
    known = values[np.isfinite(values)]
    return bool(known.size and known.min() > 0 and known.max() / known.min() > _LOG_SPAN)


def limits(axis: SweptAxis) -> tuple[float, float]:
    low, high = float(axis.values.min()), float(axis.values.max())
    if axis.words:
        return low - 0.5, high + 0.5
    if axis.log:
        return low / 1.05, high * 1.05
    room = 0.015 * (high - low) or abs(low) * 0.1 or 1.0
    return low - room, high + room


def ending_colours(count: int) -> list[Any]:
    """Of cases that ended well, which are the background, and of other ways to end."""
    return [EMPTY, *colours_of(count)[: count - 1]]
