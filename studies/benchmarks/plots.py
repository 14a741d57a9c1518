"""Work-precision pictures, one for each scene: CPU time per run against true error, both logarithmic."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from planemotion.pen import page
from planemotion.pen.page import CURVES
from planemotion.pictures.scales import plain_numbers

from .problems import LEAST_ERROR, Problem
from .rows import Row

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Colour and marker of a family; its variants differ in line and filling.
STYLES = {
    "planemotion default": (CURVES[0], "o"),
    "planemotion path": (CURVES[1], "D"),
    "planemotion uniform": (CURVES[5], "P"),
    "planemotion rk": (CURVES[3], "s"),
    "planemotion ida": (CURVES[7], "v"),
    "C loop": (page.INK, "*"),
    "heyoka": (CURVES[6], "^"),
    "SciPy DOP853": (CURVES[2], "<"),
    "scikit-SUNDAE IDA": (CURVES[4], ">"),
    "MuJoCo RK4": (page.SOFT, "X"),
    "Exudyn generalized-alpha": (page.RED, "p"),
}
VARIANT = ", no estimates"
SIZE = (7.4, 4.8)  # inches


def work_precision(problem: Problem, rows: Sequence[Row], path: Path) -> None:
    """Writes the picture of one scene; errors below LEAST_ERROR are drawn there."""
    with page.style():
        figure = _work_precision(problem, rows)
        page.save(figure, path)


def _work_precision(problem: Problem, rows: Sequence[Row]) -> Figure:
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.subplots()
    for method in dict.fromkeys(row.method for row in rows):
        points = sorted(
            (max(row.error, LEAST_ERROR), row.cpu)
            for row in rows
            if row.method == method and math.isfinite(row.error) and math.isfinite(row.cpu)
        )
        if not points:
            continue
        family = method.removesuffix(VARIANT)
        colour, marker = STYLES.get(family, ("#000000", "."))
        variant = method != family
        axes.plot(
            [error for error, _ in points],
            [1e3 * cpu for _, cpu in points],
            linestyle=":" if variant else "-",
            marker=marker,
            markersize=5 if marker != "*" else 8,
            markerfacecolor="white" if variant else colour,
            color=colour,
            linewidth=1.2,
            label=method,
        )
    axes.set(
        xscale="log", yscale="log", xlabel=f"true error [{problem.unit}]", ylabel="CPU time per run [ms]"
    )
    axes.invert_xaxis()  # better is to the right, and down
    plain_numbers(axes.yaxis)
    page.head(figure, problem.title, "better is to the right, and down")
    figure.legend(loc="outside right upper")
    return figure


def growth(
    title: str, x_label: str, y_label: str, lines: Mapping[str, Sequence[tuple[float, float]]], path: Path
) -> None:
    """Writes a picture of cost growth: lines of (x, y), both logarithmic."""
    from matplotlib.figure import Figure

    with page.style():
        figure = Figure(figsize=(5.6, 3.8), layout="constrained")
        axes = figure.subplots()
        for (name, points), colour in zip(lines.items(), cycle(page.CURVES), strict=False):
            axes.plot(*zip(*points, strict=True), marker="o", markersize=4, label=name, color=colour)
        axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label)
        for axis in (axes.xaxis, axes.yaxis):
            plain_numbers(axis)
        page.head(figure, title, "")
        axes.legend()
        page.save(figure, path)
