"""Cases that a design has drawn: of each ask how it is distributed, and how it goes with each parameter.

A row for each ask: a histogram with the part of the cases below (the distribution function), then the ask
over each parameter, with their rank correlation (Spearman's: 1 or -1 where one rises or falls with the
other).  Where cases did not end well, a last row shows by category how, over pairs of parameters.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from ..base.arrays import Floats
from ..pen.page import HEAD_HEIGHT, SOFT, TRACE
from .panels import Panel, Panels, SweptAxis
from .scales import (
    colours_of,
    ending_colours,
    is_whole,
    limits,
    logarithmic,
    spans_decades,
    ticks_of_bad_cases,
    whole_ticks,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLUMN, _ROW = 2.75, 2.1  # inches
_PARAMETERS = 5  # at most: those that matter most
_BINS = (8, 40)  # of a histogram, at least and at most
_LARGE, _SMALL = 3.5, 1.5  # dots of few cases and of many, in points
_MANY = 1000  # cases
_LETTERS = 22  # of numbers along an axis


def samples(read: Panels) -> Figure:
    """The figure of a design."""
    drawn = influential(read)
    pairs = list(combinations(drawn, 2))[: 1 + len(drawn)] if read.bad.any() else []
    rows, columns = len(read.panels) + bool(pairs), 1 + max(len(drawn), len(pairs) - 1)
    size = (max(columns * _COLUMN, 7.0), rows * _ROW + HEAD_HEIGHT + 0.3)
    figure = Figure(figsize=size, layout="constrained")
    places = figure.subplots(rows, columns, squeeze=False)
    for row, panel in zip(places, read.panels, strict=False):
        _distribution(row[0], panel)
        for place, axis in zip(row[1:], drawn, strict=False):
            _scatter(place, axis, panel, read)
    for place, (across, up) in zip(places[-1], pairs, strict=False):
        _endings(place, across, up, read)
    for place in places.flat:
        if not place.has_data():
            place.remove()
    if pairs:
        places[-1][0].set_title("how the cases ended")
        figure.legend(*places[-1][0].get_legend_handles_labels(), loc="outside lower left", ncols=5)
    return figure


def influential(read: Panels) -> Sequence[SweptAxis]:
    """The drawn parameters, or where there are many those that an ask goes with most, in their order."""
    if len(read.drawn) <= _PARAMETERS:
        return read.drawn
    weight = {
        axis.name: max(abs(rank_correlation(axis.values, panel.values[:, 0])) for panel in read.panels)
        for axis in read.drawn
    }
    kept = sorted(weight, key=lambda name: -weight[name])[:_PARAMETERS]
    return [axis for axis in read.drawn if axis.name in kept]


def rank_correlation(x: Floats, y: Floats) -> float:
    """Spearman's coefficient of the known pairs of x [n] and y [n]; 0 where one of them does not vary."""
    known = np.isfinite(x) & np.isfinite(y)
    a, b = _ranks(x[known]), _ranks(y[known])
    if len(a) < 2 or not np.ptp(a) or not np.ptp(b):
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])


def _ranks(values: Floats) -> Floats:
    """From 1 on; what is equal has the mean rank."""
    _, place, count = np.unique(values, return_inverse=True, return_counts=True)
    mean: Floats = (np.cumsum(count) - 0.5 * (count - 1))[place]
    return mean


def bins_of(values: Floats) -> Floats:
    """The edges of bins of a histogram: one for each whole number, or by the spread of the middle half."""
    if is_whole(values) and np.ptp(values) < _BINS[1]:
        return np.arange(values.min() - 0.5, values.max() + 1.0)
    low, high = float(values.min()), float(values.max())
    quarter, rest = np.percentile(values, [25, 75])
    width = 2 * (rest - quarter) / len(values) ** (1 / 3)
    wanted = (high - low) / width if width > 0 else 0.0
    room = 0.0 if high > low else abs(low) * 0.1 or 1.0
    return np.linspace(low - room, high + room, int(np.clip(np.ceil(wanted), *_BINS)) + 1)


def _curves(panel: Panel) -> Iterator[tuple[Floats, Any, str | None]]:
    """The values of a panel with their colours and names."""
    colours = colours_of(len(panel.names) or 1)
    for i, values in enumerate(panel.values.T):
        yield values, colours[i], panel.names[i] if panel.names else None


def _distribution(place: Axes, panel: Panel) -> None:
    """A histogram of the known values, and over it which part of them is not greater."""
    from matplotlib.ticker import MaxNLocator

    known = panel.values[np.isfinite(panel.values)]
    place.set_title(panel.label)
    place.set_ylabel("cases")
    place.set_xlabel(f"{panel.words or panel.label}\n{_summary(panel)}")
    if not known.size:
        place.text(0.5, 0.5, "no values", transform=place.transAxes, ha="center", color=SOFT)
        return
    edges = bins_of(known)
    below = place.twinx()
    for values, colour, name in _curves(panel):
        values = np.sort(values[np.isfinite(values)])
        look: Any = {"histtype": "stepfilled", "alpha": 0.45, "color": colour, "label": name}
        place.hist(values, edges.tolist(), **look)
        below.step(values, np.arange(1, len(values) + 1) / max(len(values), 1), where="post", color=colour)
    place.yaxis.set_major_locator(MaxNLocator(nbins=4, integer=True))
    below.set(ylim=(0.0, 1.02), ylabel="part of them below")
    below.grid(False)
    _few_ticks(place, is_whole(known))
    if panel.names:
        place.legend(fontsize=7)


def _summary(panel: Panel) -> str:
    """Mean and standard deviation, and what is missing."""
    known = panel.values[np.isfinite(panel.values)]
    one = known.size and panel.values.shape[1] == 1
    spread = f"mean {known.mean():.4g}, deviation {known.std():.2g}" if one else ""
    return "; ".join(filter(None, [spread, panel.note]))


def _few_ticks(place: Axes, whole: bool = False) -> None:
    """As many numbers along x as have room."""
    from matplotlib.ticker import MaxNLocator

    longest = max(len(label.get_text()) for label in place.get_xticklabels())
    count = max(2, min(5, _LETTERS // max(longest, 1)))
    place.xaxis.set_major_locator(MaxNLocator(nbins=count, integer=whole))


def _scatter(place: Axes, axis: SweptAxis, panel: Panel, read: Panels) -> None:
    """An ask over a drawn parameter."""
    size = _LARGE if len(axis.values) <= _MANY else _SMALL
    for values, colour, name in _curves(panel):
        place.plot(axis.values, values, ".", color=colour, label=name, markersize=size, rasterized=True)
    if is_whole(panel.values):
        whole_ticks(place)
    if spans_decades(panel.values):
        logarithmic(place, "y")
    place.set(xlabel=axis.label, ylabel=panel.label, xlim=limits(axis))
    ticks_of_bad_cases(place, axis.values[read.bad])
    if panel.values.shape[1] == 1:
        told = f"rank correlation {rank_correlation(axis.values, panel.values[:, 0]):.2f}"
        place.set_title(told, loc="right", size=7.5, weight="normal", color=SOFT)
    _few_ticks(place)


def _endings(place: Axes, across: SweptAxis, up: SweptAxis, read: Panels) -> None:
    """How the cases ended over two parameters, a colour for each way."""
    colours = [TRACE, *ending_colours(len(read.endings))[1:]]
    for number, (word, colour) in enumerate(zip(read.endings, colours, strict=True)):
        there = read.ended == number
        place.plot(
            across.values[there],
            up.values[there],
            ".",
            color=colour,
            label=word,
            markersize=4,
            rasterized=True,
        )
    place.set(xlabel=across.label, ylabel=up.label, xlim=limits(across), ylim=limits(up))
