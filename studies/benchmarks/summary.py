"""What the figures of the scenes come to: the least time of each method at an error that is asked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from .report import time_at
from .rows import Row
from .tables import Table

# Scene: the error at which times are compared, in its unit.
ERRORS = {
    "sphere_over_bars": 1e-12,
    "rolling_collar": 1e-10,
    "linkage_c5": 1e-10,
    "double_pendulum": 1e-9,
    "slider_crank": 1e-8,
    "zeno_ball": 1e-9,
    "pendulum_a01": 1e-9,
    "four_bars_2": 1e-9,
    "four_bars_40": 1e-9,
}


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    methods = list(dict.fromkeys(row.method for row in rows if math.isfinite(row.cpu)))
    scenes = [name for name in ERRORS if any(row.scene == name for row in rows)]
    table = Table(
        "summary",
        "CPU ms per run at equal error",
        ("method", *(f"{name} at {ERRORS[name]:g}" for name in scenes)),
        text="The least time of a method among its settings with at most the error named; or none.",
    )
    for method in methods:
        times = [time_at([row for row in rows if row.scene == s], method, ERRORS[s]) for s in scenes]
        table.rows.append([method, *(1e3 * t for t in times)])
    return [table]
