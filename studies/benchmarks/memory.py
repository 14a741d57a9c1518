"""Resident memory of sweeps written to HDF5, each in a process of its own."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from .problems import STUDIES
from .rows import Row
from .tables import Table

SIZES = (1000, 10_000, 100_000)
LONG_SIZES = (1_000_000,)
WORKERS = 2
# A wide spacing stops the sphere after few bars: what is measured is memory, not the kernel.
SWEEP = """
import planemotion
scene = planemotion.load({path!r})
scene.sweep(out={out!r}, workers={workers}, d={{"from": "5.5 in", "to": "6 in", "num": {cases}}})
with open("/proc/self/status") as file:
    print(next(line.split()[1] for line in file if line.startswith("VmHWM")))
"""


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    return [of_sizes(SIZES[:1] if quick else SIZES)]


def long_tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    return [of_sizes(LONG_SIZES)]


def of_sizes(sizes: Sequence[int]) -> Table:
    table = Table(
        "memory",
        "Memory against cases",
        ("cases", "most resident MB", "s by the clock", "MB of files"),
        text="`Scene.sweep(out=...)` of sphere over bars, four asks, d from 5.5 to 6 in, two workers, in a "
        "process of its own.",
    )
    for cases in sizes:
        with tempfile.TemporaryDirectory() as folder:
            code = SWEEP.format(
                path=str(STUDIES / "sphere_over_bars.toml"), out=folder, workers=WORKERS, cases=cases
            )
            begun = time.perf_counter()
            peak = peak_of(code)
            taken = time.perf_counter() - begun
            size = sum(file.stat().st_size for file in Path(folder).rglob("*") if file.is_file())
        table.rows.append([cases, peak, taken, size / 2**20])
    return table


def peak_of(code: str) -> float:
    """MB that a Python program had resident at most; it prints its kB.

    What the system tells of an ended child counts its parent's memory too, from before its own program.
    """
    ended = subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE, text=True)
    return int(ended.stdout) / 1024
