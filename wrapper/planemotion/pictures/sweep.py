"""A sweep as curves or colour maps.

Along one parameter it becomes one panel per ask; along two, colour maps, or a family of curves where one of
them has few values; further parameters are held at their first value, which the picture says.  Cases without
an answer are gaps, those that did not end well are marked in red, and both are counted; beside maps one shows
by category how the cases ended.  What a design has drawn is in samples.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from ..base.arrays import Floats
from ..pen.page import FAMILY, HEAD_HEIGHT, ROW_HEIGHT, head
from .panels import Panel, Panels, SweptAxis, read_panels
from .samples import samples
from .scales import (
    EMPTY,
    PALE_RED,
    colours_of,
    ending_colours,
    is_whole,
    limits,
    logarithmic,
    plain_numbers,
    spans_decades,
    ticks_of_bad_cases,
    title,
    whole_ticks,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap, Normalize

# Curves of so few points show the points as well.
_FEW_POINTS = 40
# Whole numbers of at most so many different values get a colour each.
_STEPS_OF_COLOUR = 12
_COLUMN_WIDTH, _MAP_HEIGHT = 5.2, 3.1  # inches


def plot_sweep(dataset: xr.Dataset) -> Figure:
    """The figure of a sweep as `xarray.open_dataset` gives it."""
    shown = read_panels(dataset)
    if shown.drawn:
        figure = samples(shown)
    elif len(shown.axes) == 2:
        figure = _maps(shown)
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
        colours = colours_of(len(panel.names) or 1)
        for i, values in enumerate(panel.values.T):
            name = panel.names[i] if panel.names else None
            draw = _dots if axis.words else _curve
            draw(place, axis.values, values, colours[i], name)
        if is_whole(panel.values) and np.nanmax(panel.values) - np.nanmin(panel.values) <= _STEPS_OF_COLOUR:
            whole_ticks(place)
        title(place, panel, figure.get_figwidth() / columns)
        if spans_decades(panel.values):
            logarithmic(place, "y")
        if axis.log:
            logarithmic(place, "x")
        ticks_of_bad_cases(place, axis.values[bad])
    for i, place in enumerate(places):
        below = i + columns < len(places)
        place.tick_params(labelbottom=not below)
        if not below:
            place.set_xlabel(axis.label)
        if axis.words:
            place.set_xticks(axis.values, axis.words)
        place.set_xlim(limits(axis))
    if any(panel.names for panel in panels):
        _legend(figure, places, panels)
    return figure


def _dots(place: Axes, x: Floats, y: Floats, colour: Any, name: str | None) -> None:
    """Values y [n] over options x [n]: between them there is nothing to follow."""
    place.plot(x, y, ".", color=colour, label=name, markersize=6)


def _curve(place: Axes, x: Floats, y: Floats, colour: Any, name: str | None) -> None:
    """One curve y [n] over x [n]; NaN breaks it, and a value between two gaps is a dot."""
    known = np.isfinite(y)
    whole = is_whole(y)
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


def _maps(shown: Panels) -> Figure:
    figure, places, columns = _grid(len(shown.panels) + bool(shown.bad.any()), _MAP_HEIGHT)
    for place, panel in zip(places, shown.panels, strict=False):
        _map(figure, place, shown, panel)
        title(place, panel, 0.8 * figure.get_figwidth() / columns)
    if shown.bad.any():
        _map_of_endings(places[-1], shown)
    for place in places:
        for which, axis in zip("xy", shown.axes, strict=True):
            if axis.log:
                logarithmic(place, which)
            if axis.words:
                place.set(**{f"{which}ticks": axis.values, f"{which}ticklabels": axis.words})
        place.set_xlabel(shown.axes[0].label)
        place.set_ylabel(shown.axes[1].label)
    return figure


def _map(figure: Figure, place: Axes, shown: Panels, panel: Panel) -> None:
    from matplotlib.colors import ListedColormap, LogNorm

    colours, norm, ticks = _colour_scale(panel.values)
    x, y = shown.axes[0].values, shown.axes[1].values
    place.set_facecolor(EMPTY)
    place.grid(False)
    look: Any = {"shading": "nearest", "rasterized": True}
    mesh = place.pcolormesh(x, y, panel.values.T, cmap=colours, norm=norm, **look)
    if shown.bad.any():
        mark = np.ma.masked_where(~shown.bad.T, np.ones(shown.bad.T.shape))
        place.pcolormesh(x, y, mark, cmap=ListedColormap([PALE_RED]), **look)
    bar = figure.colorbar(mesh, ax=place, pad=0.02, aspect=28, ticks=ticks)
    bar.outline.set_visible(False)
    if isinstance(norm, LogNorm):
        plain_numbers(bar.ax.yaxis)


def _map_of_endings(place: Axes, shown: Panels) -> None:
    """How the cases ended, a colour for each way."""
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    colours = ending_colours(len(shown.endings))
    x, y = (axis.values for axis in shown.axes)
    place.grid(False)
    norm = BoundaryNorm(np.arange(-0.5, len(colours)), len(colours))
    place.pcolormesh(
        x, y, shown.ended.T, cmap=ListedColormap(colours), norm=norm, shading="nearest", rasterized=True
    )
    place.set_title("how the cases ended")
    patches = [Patch(color=colour, label=word) for colour, word in zip(colours, shown.endings, strict=True)]
    place.legend(handles=patches, loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.0)


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
    if spans_decades(values):
        return "viridis", LogNorm(low, high), None
    return "viridis", None, None
