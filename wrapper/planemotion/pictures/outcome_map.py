"""A map of outcomes: areas in colours, the boundaries between them, and a legend with their sizes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..base.arrays import Floats
from ..language.cf import unit_of
from ..pen.page import INK, head

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

# Outcomes that the legend names; what there is beside them is one entry.
_NAMED = 14
_LONGEST_NAME = 60
_LINE = 0.7


def plot_outcome_map(dataset: xr.Dataset) -> Figure:
    """The figure of a map as `maps.run` makes it."""
    figure = Figure(figsize=(7.6, 4.6), layout="constrained")
    place = figure.subplots()
    names = _parameters(dataset)
    colours = _colours(dataset.sizes["outcome"])
    of_piece = [colours[outcome] for outcome in dataset["piece_outcome"].values]
    pieces = list(_lists(dataset, "piece", "vertices", "vertex"))
    place.add_collection(PolyCollection(pieces, facecolors=of_piece, edgecolors=of_piece, linewidths=0.2))
    for points in _lists(dataset, "curve", "points", "point"):
        place.plot(points[:, 0], points[:, 1], color=INK, linewidth=_LINE)
    _finish(place, dataset, names)
    _legend(place, dataset, colours)
    head(figure, str(dataset.attrs.get("title") or dataset.attrs.get("id") or "Map"), _words(dataset))
    return figure


def _parameters(dataset: xr.Dataset) -> list[str]:
    return str(dataset.attrs["parameters"]).split()


def _lists(dataset: xr.Dataset, of: str, count: str, point: str) -> Iterator[Floats]:
    """Points [n, 2] of each list."""
    both = np.stack([dataset[f"{point}_{name}"].values for name in _parameters(dataset)], axis=1)
    ends = np.cumsum(dataset[f"{of}_{count}"].values)
    yield from np.split(both, ends[:-1]) if len(ends) else ()


def _colours(count: int) -> list[tuple[float, ...]]:
    """So many pale colours: named ones, or steps of one scale where there are more."""
    if count <= 10:
        return [
            (*(0.45 + 0.55 * part for part in matplotlib.colormaps["tab10"](k)[:3]),) for k in range(count)
        ]
    return [tuple(one) for one in matplotlib.colormaps["viridis"](np.linspace(0.05, 0.95, count))]


def _finish(place: Axes, dataset: xr.Dataset, names: list[str]) -> None:
    logarithmic = str(dataset.attrs.get("logarithmic", "")).split()
    for which, name in zip("xy", names, strict=True):
        unit = unit_of(dataset[name].attrs)
        values = dataset[name].values
        set_ = {"label": getattr(place, f"set_{which}label"), "lim": getattr(place, f"set_{which}lim")}
        set_["label"](name if unit == "1" else f"{name} [{unit}]")
        set_["lim"](float(values.min()), float(values.max()))
        if name in logarithmic:
            getattr(place, f"set_{which}scale")("log")
    place.grid(False)


def _legend(place: Axes, dataset: xr.Dataset, colours: list[tuple[float, ...]]) -> None:
    share = dataset["share"].values
    order = np.argsort(-share, kind="stable")
    shown = order[:_NAMED]
    handles = [
        Patch(facecolor=colours[k], label=f"{_short(str(dataset['outcome'].values[k]))}  {share[k]:.1%}")
        for k in shown
    ]
    if len(order) > _NAMED:
        rest = float(share[order[_NAMED:]].sum())
        handles.append(Patch(facecolor="none", label=f"{len(order) - _NAMED} more  {rest:.1%}"))
    place.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.2)


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME - 3]}..."


def _words(dataset: xr.Dataset) -> str:
    cases = int(dataset.attrs["cases"])
    part = cases / float(dataset.attrs["cases_of_full_grid"])
    tolerance = float(dataset.attrs["tolerance"])
    return f"{cases} cases, {part:.2g} of a full grid; boundaries to {tolerance:g} of the ranges"
