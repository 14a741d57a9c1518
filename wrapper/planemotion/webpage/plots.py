"""The panels of a sweep as plots of Plotly: a curve or a map that can be hovered over and zoomed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import cycle
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..pen.page import CURVES, RED
from ..pictures.condensed import evenly, outline
from ..pictures.panels import Panel, Panels, SweptAxis
from ..pictures.samples import bins_of, influential

# Values along a side of a map, and runs of neighbours of a curve.
MAP_CELLS = 300
_CURVE_PARTS = 1500
# Cases of a design; more take long to draw.
_MOST_DOTS = 20_000
# Curves of so few points show the points as well.
_FEW_POINTS = 60
_DIGITS = 9


def plots(read: Panels) -> list[dict[str, Any]]:
    """A plot for each ask: its title, and data and layout as Plotly.newPlot takes them."""
    make = _samples if read.drawn else _map if len(read.axes) == 2 else _curves
    return [make(read, panel) for panel in read.panels]


def _curves(read: Panels, panel: Panel) -> dict[str, Any]:
    axis = read.axes[0]
    names = panel.names or ("",)
    data = [
        _curve(axis, values, name, CURVES[i % len(CURVES)])
        for i, (values, name) in enumerate(zip(panel.values.T, names, strict=True))
    ]
    if read.bad.any():
        data.append(_bad_cases(axis, read.bad))
    layout = {
        "xaxis": _layout_of(axis),
        "yaxis": {"title": {"text": panel.label}, **_whole(panel.values)},
        "yaxis2": {"overlaying": "y", "range": [0, 1], "visible": False, "fixedrange": True},
        "showlegend": len(names) > 1 or bool(read.bad.any()),
        "hovermode": "closest",
    }
    return _plot(panel, data, layout)


def _samples(read: Panels, panel: Panel) -> dict[str, Any]:
    """Of a design: how an ask is distributed, and beside it the ask over each parameter."""
    drawn = influential(read)
    width, step = 1 / (len(drawn) + 1) - 0.06, 1 / (len(drawn) + 1)
    names = panel.names or ("",)
    data: list[dict[str, Any]] = []
    layout: dict[str, Any] = {
        "xaxis": {"domain": [0, width], "title": {"text": panel.label}},
        "yaxis": {"title": {"text": "cases"}, "rangemode": "tozero"},
        "yaxis2": {"title": {"text": panel.label}, "anchor": "x2", **_whole(panel.values)},
        "barmode": "overlay",
        "bargap": 0,
        "showlegend": len(names) > 1,
        "hovermode": "closest",
    }
    for i, axis in enumerate(drawn, start=2):
        left = step * (i - 1) + 0.03
        place = {"domain": [left, left + width], "anchor": "y2", "nticks": 5, "tickangle": 0}
        layout[f"xaxis{i}"] = {**_layout_of(axis), **place}
    for values, name, colour in zip(panel.values.T, names, _colours(), strict=False):
        known = values[np.isfinite(values)]
        look = {"name": name, "marker": {"color": colour, "size": 4}, "showlegend": False}
        data.append({**_histogram(known), **look, "showlegend": True})
        for i, axis in enumerate(drawn, start=2):
            one = _curve(axis, values, name, colour)
            data.append({**one, **look, "xaxis": f"x{i}", "yaxis": "y2", "mode": "markers"})
    return _plot(panel, data, layout)


def _histogram(known: Floats) -> dict[str, Any]:
    edges = bins_of(known) if known.size else np.zeros(2)
    counts, _ = np.histogram(known, edges) if known.size else (np.zeros(1), None)
    bars = {
        "x": _numbers(0.5 * (edges[1:] + edges[:-1])),
        "y": counts.tolist(),
        "width": _numbers(np.diff(edges)),
    }
    return {
        "type": "bar",
        "opacity": 0.7,
        "hovertemplate": "%{y} cases about %{x:.6g}<extra></extra>",
        **bars,
    }


def _colours() -> Iterator[str]:
    return cycle(CURVES)


def _curve(axis: SweptAxis, values: Floats, name: str, colour: str) -> dict[str, Any]:
    if axis.drawn or axis.words:
        kept = evenly(len(axis.values), _MOST_DOTS)
        x, y, mode = axis.values[kept], values[kept], "markers"
    else:
        x, y = outline(axis.values, values, _CURVE_PARTS)
        mode = "lines+markers" if len(x) <= _FEW_POINTS else "lines"
    return {
        "type": "scatter",
        "mode": mode,
        "name": name,
        "x": _numbers(x),
        "y": _numbers(y),
        "line": {"color": colour, "width": 2},
        "marker": {"size": 5},
        "connectgaps": False,
        "hovertemplate": f"{axis.name} = %{{x:.6g}}<br>%{{y:.8g}}<extra>{name}</extra>",
    }


def _bad_cases(axis: SweptAxis, bad: npt.NDArray[np.bool_]) -> dict[str, Any]:
    """Red ticks on the lower edge."""
    x = axis.values[bad]
    x = x[evenly(len(x), _CURVE_PARTS)]
    return {
        "type": "scatter",
        "mode": "markers",
        "name": "not ok",
        "x": _numbers(x),
        "y": [0.02] * len(x),
        "yaxis": "y2",
        "marker": {"symbol": "line-ns-open", "size": 9, "color": RED},
        "hovertemplate": f"{axis.name} = %{{x:.6g}}: not ok<extra></extra>",
    }


def _map(read: Panels, panel: Panel) -> dict[str, Any]:
    across, up = read.axes
    data: list[dict[str, Any]] = [
        {
            "type": "heatmap",
            "x": _numbers(across.values),
            "y": _numbers(up.values),
            "z": [_numbers(row) for row in panel.values.T],
            "colorscale": "Viridis",
            "colorbar": {"thickness": 14, **_whole(panel.values)},
            "hovertemplate": f"{across.name} = %{{x:.6g}}<br>{up.name} = %{{y:.6g}}<br>%{{z:.8g}}"
            "<extra></extra>",
        }
    ]
    if read.bad.any():
        column, row = np.nonzero(read.bad)
        data.append(
            {
                "type": "scatter",
                "mode": "markers",
                "name": "not ok",
                "x": _numbers(across.values[column]),
                "y": _numbers(up.values[row]),
                "marker": {"symbol": "x-thin-open", "size": 5, "color": RED},
                "hovertemplate": f"{across.name} = %{{x:.6g}}<br>{up.name} = %{{y:.6g}}: not ok"
                "<extra></extra>",
            }
        )
    return _plot(panel, data, {"xaxis": _layout_of(across), "yaxis": _layout_of(up), "showlegend": False})


def _plot(panel: Panel, data: Sequence[dict[str, Any]], layout: dict[str, Any]) -> dict[str, Any]:
    return {"title": panel.label, "note": panel.note, "data": list(data), "layout": layout}


def _layout_of(axis: SweptAxis) -> dict[str, Any]:
    ticks = {"tickvals": _numbers(axis.values), "ticktext": list(axis.words)} if axis.words else {}
    return {"title": {"text": axis.label}, **({"type": "log"} if axis.log else {}), **ticks}


def _whole(values: Floats) -> dict[str, Any]:
    """Ticks at whole numbers where there are no others."""
    known = values[np.isfinite(values)]
    if not known.size or np.any(known != np.round(known)) or np.ptp(known) > 12:
        return {}
    return {"tick0": 0, "dtick": 1, "tickformat": "d"}


def _numbers(values: Floats) -> list[float | None]:
    """As JSON has them: no NaN, no more digits than a screen shows."""
    return [float(f"{value:.{_DIGITS}g}") if np.isfinite(value) else None for value in values]
