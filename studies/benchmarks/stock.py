"""What the ida route saves by its own vectors, Jacobian and linear algebra: beside a package that is built
with those of the library (PM_IDA_STOCK in kernel/ida.h), each in a process of its own, in turn.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from .problems import PROBLEMS, ROOT, Problem
from .rows import Row
from .tables import Cell, Table

ACCURACIES = (1e-6, 1e-8)
BUILD = ROOT / "build" / "ida-stock"
TURNS = 2
# Seconds of one process.
PATIENCE = 30
MEASURE = """
import json
from studies.benchmarks import measure
from studies.benchmarks.peers import engine
from studies.benchmarks.problems import PROBLEMS
problem = next(p for p in PROBLEMS if p.name == {name!r})
attempt = engine.attempt(problem, "ida", {accuracy}, estimate=False)
row, = measure.measure(problem, [attempt], rounds=2)
print(json.dumps([row.cpu, row.error, row.status]))
"""


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    table = Table(
        "ida_stock",
        "The ida route beside the library's own vectors and linear solver",
        ("scene", "accuracy", "CPU ms", "library's: CPU ms", "times", "error", "library's: error", "why not"),
        text="Vectors of the active unknowns, block elimination (KLU where there are many) and the exact "
        "Jacobian, beside N_Vector_Serial, SUNLinSol_Dense and differences; without error estimates. Asks, "
        "cases and errors: those of the scenes above, the first cases where a scene has many. The least of "
        f"{TURNS} processes that take turns, of {PATIENCE} s each.",
    )
    missed = build()
    for problem in PROBLEMS[:1] if quick else PROBLEMS:
        for accuracy in ACCURACIES[:1] if quick else ACCURACIES:
            cells = missed_cells(missed) if missed else compared(problem, accuracy, 1 if quick else TURNS)
            table.rows.append([problem.name, accuracy, *cells])
    return [table]


def build() -> str:
    """Installs the other package; why that is not possible, or nothing."""
    pip = [
        sys.executable,
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-deps",
        "--no-build-isolation",
        "--upgrade",
    ]
    folder = f"--config-settings=builddir={BUILD.relative_to(ROOT)}/build"
    flag = "--config-settings=setup-args=-Dc_args=-DPM_IDA_STOCK=1"
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    ended = subprocess.run(
        [*pip, "--target", str(BUILD / "package"), folder, flag, "."],
        cwd=ROOT,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
    )
    return "" if ended.returncode == 0 else f"cannot be built: {last_line(ended.stderr)}"


def compared(problem: Problem, accuracy: float, turns: int) -> list[Cell]:
    """The cells of a row after its accuracy."""
    own: list[list[float]] = []
    library: list[list[float]] = []
    for _ in range(turns):
        for found, folder in ((own, None), (library, BUILD / "package")):
            cpu, error, why = measured(problem, accuracy, folder)
            if why:
                whose = "the library's: " if folder else ""
                return missed_cells(whose + why)
            found.append([cpu, error])
    ours, theirs = min(own), min(library)
    return [1e3 * ours[0], 1e3 * theirs[0], theirs[0] / ours[0], ours[1], theirs[1], ""]


def missed_cells(why: str) -> list[Cell]:
    return [None, None, None, None, None, why]


def measured(problem: Problem, accuracy: float, package: Path | None) -> tuple[float, float, str]:
    """CPU s of a run, its error, and why there is none, of the package in a folder."""
    code = MEASURE.format(name=problem.name, accuracy=accuracy)
    env = {**os.environ, **({"PYTHONPATH": str(package)} if package else {})}
    command = [sys.executable, "-c", code]
    try:
        ended = subprocess.run(command, cwd=ROOT, env=env, capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return 0, 0, f"not finished in {PATIENCE} s"
    if ended.returncode > 0:
        return 0, 0, last_line(ended.stderr)
    cpu, error, status = json.loads(ended.stdout.splitlines()[-1])
    return cpu, error, "" if status == "ok" else status


def last_line(text: str) -> str:
    return (text.strip().splitlines() or ["no word"])[-1]
