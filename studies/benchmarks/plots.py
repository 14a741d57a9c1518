"""Work-precision pictures, one for each scene: CPU time per run against true error, both logarithmic."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from .problems import LEAST_ERROR, Problem
from .rows import Row

# Colour and marker of a family; its variants differ in line and filling.
STYLES = {
    "planemotion default": ("#c0392b", "o"),
    "planemotion path": ("#e67e22", "D"),
    "planemotion uniform": ("#8e6c00", "P"),
    "planemotion rk": ("#8e44ad", "s"),
    "planemotion ida": ("#d98ac7", "v"),
    "C loop": ("#222222", "*"),
    "heyoka": ("#1f77b4", "^"),
    "SciPy DOP853": ("#2ca02c", "<"),
    "scikit-SUNDAE IDA": ("#17a2a2", ">"),
    "MuJoCo RK4": ("#7f7f7f", "X"),
    "Exudyn generalized-alpha": ("#b8860b", "p"),
}
VARIANT = ", no estimates"
SIZE = (7.4, 4.8)  # inches
DOTS = 110  # per inch: small files that still print


def work_precision(problem: Problem, rows: Sequence[Row], path: Path) -> None:
    """Writes the picture of one scene; errors below LEAST_ERROR are drawn there."""
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
    axes.set_title(problem.title, fontsize=10)
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.invert_xaxis()  # better is to the right, and down
    axes.tick_params(labelsize=8)
    figure.legend(loc="outside right upper", fontsize=7, frameon=False)
    figure.savefig(path, dpi=DOTS)


def growth(
    title: str, x_label: str, y_label: str, lines: Mapping[str, Sequence[tuple[float, float]]], path: Path
) -> None:
    """Writes a picture of cost growth: lines of (x, y), both logarithmic."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.6, 3.8), layout="constrained")
    axes = figure.subplots()
    for name, points in lines.items():
        axes.plot(*zip(*points, strict=True), marker="o", markersize=4, linewidth=1.2, label=name)
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label)
    axes.set_title(title, fontsize=10)
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.tick_params(labelsize=8)
    axes.legend(fontsize=7, frameon=False)
    figure.savefig(path, dpi=DOTS)
