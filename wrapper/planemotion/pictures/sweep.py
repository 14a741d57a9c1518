"""A sweep as curves or colour maps.

Along one parameter it becomes one panel per ask; along two, colour maps, or a family of curves where one of
them has few values; further parameters are held at their first value, which the picture says.  Cases without
an answer are gaps, those that did not end well are marked in red, and both are counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from ..base.arrays import Floats
from ..pen.page import CURVES, FAMILY, HEAD_HEIGHT, RED, ROW_HEIGHT, SOFT, head
from .panels import Panel, SweptAxis, read_panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.colors import Colormap, Normalize


PALE_RED = "#dd9c95"
EMPTY = "#ebebeb"
# Curves of so few points show the points as well.
_FEW_POINTS = 40
# Whole numbers of at most so many different values get a colour each.
_STEPS_OF_COLOUR = 12
# Positive values that span more than this are drawn on a logarithmic axis.
_LOG_SPAN = 100.0
_COLUMN_WIDTH, _MAP_HEIGHT = 5.2, 3.1  # inches


def plot_sweep(dataset: xr.Dataset) -> Figure:
    """The figure of a sweep as `xarray.open_dataset` gives it."""
    shown = read_panels(dataset)
    if len(shown.axes) == 2:
        figure = _maps(shown.axes, shown.panels, shown.bad)
    else:
        figure = _curves(shown.axes[0], shown.panels, shown.bad)
    head(figure, shown.title, shown.words)
    return figure


def _grid(panels: int, row_height: float) -> tuple[Figure, list[Axes], int]:
    """A figure with so many axes, in one column or two; the number of columns."""
    columns = 1 if panels <= 3 else 2
    rows = max(1, -(-panels // columns))
    width = 7.0 if columns == 1 else 2 * _COLUMN_WIDTH
    figure = Figure(figsize=(width, rows * row_height + HEAD_HEIGHT + 0.4), layout="constrained")
    made = figure.subplots(rows, columns, squeeze=False)
    axes = list(made.flat)
    for spare in axes[panels:]:
        spare.remove()
    return figure, axes[:panels], columns


def _curves(axis: SweptAxis, panels: Sequence[Panel], bad: npt.NDArray[np.bool_]) -> Figure:
    figure, places, columns = _grid(len(panels), ROW_HEIGHT)
    for place, panel in zip(places, panels, strict=True):
        colours = _colours(len(panel.names) or 1)
        for i, values in enumerate(panel.values.T):
            name = panel.names[i] if panel.names else None
            draw = _dots if axis.drawn else _curve
            draw(place, axis.values, values, colours[i], name)
        if _is_whole(panel.values) and np.nanmax(panel.values) - np.nanmin(panel.values) <= _STEPS_OF_COLOUR:
            _whole_ticks(place)
        _title(place, panel)
        if _spans_decades(panel.values):
            _logarithmic(place, "y")
        if axis.log:
            _logarithmic(place, "x")
        _ticks_of_bad_cases(place, axis.values[bad])
    for i, place in enumerate(places):
        below = i + columns < len(places)
        place.tick_params(labelbottom=not below)
        if not below:
            place.set_xlabel(axis.label)
        place.set_xlim(_limits(axis))
    if any(panel.names for panel in panels):
        _legend(figure, places, panels)
    return figure


def _limits(axis: SweptAxis) -> tuple[float, float]:
    low, high = float(axis.values.min()), float(axis.values.max())
    if axis.log:
        return low / 1.05, high * 1.05
    room = 0.015 * (high - low) or abs(low) * 0.1 or 1.0
    return low - room, high + room


def _colours(count: int) -> list[Any]:
    """So many colours: named ones, or steps of one scale where there are more."""
    if count <= len(CURVES):
        return list(CURVES[:count])
    return list(matplotlib.colormaps["viridis"](np.linspace(0.0, 0.88, count)))


def _dots(place: Axes, x: Floats, y: Floats, colour: Any, name: str | None) -> None:
    """Cases that a design has drawn, y [n] over x [n]: between them there is nothing to follow."""
    place.plot(x, y, ".", color=colour, label=name, markersize=3.5 if len(x) <= 1000 else 1.5)


def _curve(place: Axes, x: Floats, y: Floats, colour: Any, name: str | None) -> None:
    """One curve y [n] over x [n]; NaN breaks it, and a value between two gaps is a dot."""
    known = np.isfinite(y)
    whole = _is_whole(y)
    dots = len(x) <= _FEW_POINTS
    place.plot(
        x,
        y,
        color=colour,
        label=name,
        drawstyle="steps-mid" if whole and not dots else "default",
        linestyle="" if whole and dots else "-",
        marker="o" if dots else None,
        markersize=3.5,
    )
    if not dots:
        gap = np.concatenate([[True], ~known, [True]])
        alone = known & gap[:-2] & gap[2:]
        place.plot(x[alone], y[alone], ".", color=colour, markersize=3)


def _is_whole(values: Floats) -> bool:
    """Whether all known values are whole numbers, some of them again and again: a count, a yes or no."""
    known = values[np.isfinite(values)]
    return bool(known.size and np.all(known == np.round(known)) and len(np.unique(known)) < known.size)


def _whole_ticks(place: Axes) -> None:
    from matplotlib.ticker import MaxNLocator

    place.yaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
    low, high = place.get_ylim()
    place.set_ylim(min(low, np.ceil(low) - 0.2), max(high, np.floor(high) + 0.2))


def _title(place: Axes, panel: Panel) -> None:
    place.set_title(panel.label)
    if panel.note:
        place.set_title(panel.note, loc="right", size=8, weight="normal", color=SOFT)


def _ticks_of_bad_cases(place: Axes, x: Floats) -> None:
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


def _logarithmic(place: Axes, which: str) -> None:
    """Makes an axis logarithmic."""
    if which == "x":
        place.set_xscale("log")
        _plain_numbers(place.xaxis)
    else:
        place.set_yscale("log")
        _plain_numbers(place.yaxis)


def _plain_numbers(axis: Axis) -> None:
    """Labels 1, 10, 100 instead of powers, which would need mathematical text."""
    from matplotlib.ticker import LogFormatter

    axis.set_major_formatter(LogFormatter())
    axis.set_minor_formatter(LogFormatter(minor_thresholds=(1.0, 0.4)))


def _spans_decades(values: Floats) -> bool:
    known = values[np.isfinite(values)]
    return bool(known.size and known.min() > 0 and known.max() / known.min() > _LOG_SPAN)


def _legend(figure: Figure, places: Sequence[Axes], panels: Sequence[Panel]) -> None:
    """One legend above the panels if all show the same curves, else one in each that needs it."""
    sets = {panel.names for panel in panels}
    if len(sets) == 1 and len(panels) > 1 and len(panels[0].names) <= FAMILY:
        handles, labels = places[0].get_legend_handles_labels()
        corner = (1 - 0.1 / figure.get_figwidth(), 1 - 0.28 / figure.get_figheight())
        figure.legend(handles, labels, loc="upper right", bbox_to_anchor=corner, ncols=len(labels))
        return
    for place, panel in zip(places, panels, strict=True):
        if panel.names:
            place.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.2)


def _maps(axes: Sequence[SweptAxis], panels: Sequence[Panel], bad: npt.NDArray[np.bool_]) -> Figure:
    from matplotlib.colors import ListedColormap, LogNorm

    figure, places, _ = _grid(len(panels), _MAP_HEIGHT)
    for place, panel in zip(places, panels, strict=True):
        colours, norm, ticks = _colour_scale(panel.values)
        x, y = axes[0].values, axes[1].values
        place.set_facecolor(EMPTY)
        place.grid(False)
        mesh = place.pcolormesh(
            x, y, panel.values.T, cmap=colours, norm=norm, shading="nearest", rasterized=True
        )
        if bad.any():
            mark = np.ma.masked_where(~bad.T, np.ones(bad.T.shape))
            place.pcolormesh(x, y, mark, cmap=ListedColormap([PALE_RED]), shading="nearest", rasterized=True)
        bar = figure.colorbar(mesh, ax=place, pad=0.02, aspect=28, ticks=ticks)
        bar.outline.set_visible(False)
        if isinstance(norm, LogNorm):
            _plain_numbers(bar.ax.yaxis)
        for which, axis in zip("xy", axes, strict=True):
            if axis.log:
                _logarithmic(place, which)
        place.set_xlabel(axes[0].label)
        place.set_ylabel(axes[1].label)
        _title(place, panel)
    return figure


def _colour_scale(values: Floats) -> tuple[str | Colormap, Normalize | None, list[float] | None]:
    """Colours, their norm and ticks: steps for few whole numbers, logarithmic for many decades."""
    from matplotlib.colors import BoundaryNorm, LogNorm

    known = values[np.isfinite(values)]
    if not known.size:
        return "viridis", None, []
    low, high = float(known.min()), float(known.max())
    if np.all(known == np.round(known)) and high - low < _STEPS_OF_COLOUR:
        edges = np.arange(low - 0.5, high + 1.0)
        steps = matplotlib.colormaps["viridis"].resampled(max(2, len(edges) - 1))
        return steps, BoundaryNorm(edges, steps.N), np.arange(low, high + 1).tolist()
    if _spans_decades(values):
        return "viridis", LogNorm(low, high), None
    return "viridis", None, None
