"""The page of results: rows of the scenes as tables, everything else as it comes; Markdown and CSV."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Sequence
from pathlib import Path

from planemotion.base.versions import versions

from .problems import LEAST_ERROR, PROBLEMS, Problem
from .rows import Row
from .tables import Table

HEADER = ("method", "version", "setting", "CPU ms per run", "error", "steps", "what it says")
INTRODUCTION = """# Benchmarks: results

Written by `make bench` ({options}) on {date}: {machine}, {cores} cores, load {load:.1f} when it began.

{versions}

CPU time is that of the whole process per run of one case: the least of several samples which the methods
take in turn, with everything that can be prepared (scenes read, integrators compiled) done before. Compare
times within this page, not with those of another machine. Errors are against the references of
`studies/benchmarks/references.json` (30-digit integration, closed forms, quadrature; `references.py` makes
them), the greatest over all cases and answers. "planemotion default" is what a user gets who chooses nothing:
the planner's route, at the accuracy given, with error estimates, which cost it further passes; the peers give
none, so the rows "no estimates" stand beside them. The solvers (heyoka, SciPy, IDA, the C loop) are given
equations derived by hand in least coordinates; planemotion, MuJoCo and Exudyn are given the mechanism.
"""


def scene_table(problem: Problem, rows: Sequence[Row]) -> Table:
    """All methods at one scene."""
    header, extra = list(HEADER), []
    if problem.count:
        header.insert(5, "wrong counts")
        extra.append("wrong")
    if problem.drift:
        header.insert(5, "energy drift [J]")
        extra.append("drift")
    header[4] = f"error [{problem.unit}]"
    table = Table(problem.name, problem.title, header, text=scene_text(problem))
    for row in rows:
        more = [getattr(row, name) for name in extra]
        words = "; ".join(text for text in (row.status if row.status != "ok" else "", row.note) if text)
        measured = [row.cpu * 1e3, row.error, *more, row.steps]
        table.rows.append([row.method, row.version, row.setting, *measured, words])
    return table


def scene_text(problem: Problem) -> str:
    reference = problem.reference
    words = [f"Reference: {reference['origin']}"]
    if "agreement" in reference:
        words.append(f"which agree to {reference['agreement']}")
    cases, slow = len(problem.cases), problem.slow_cases()
    if cases > 1:
        words.append(f"{cases} cases, of which slow methods run the {slow} that stand for all")
    return ", ".join(words) + f".\n\n![CPU time against error]({problem.name}.png)"


def all_rows(rows: Sequence[Row]) -> Table:
    """Every measured figure in one file, for other programs."""
    names = [name for name in Row.__dataclass_fields__ if name != "cpu"]
    table = Table("scenes", "All scenes", [*names, "cpu_s"])
    table.rows = [[*(getattr(row, name) for name in names), row.cpu] for row in rows]
    return table


def introduction(quick: bool) -> str:
    return INTRODUCTION.format(
        options="quick: one setting each" if quick else "all settings",
        date=time.strftime("%Y-%m-%d"),
        machine=machine(),
        cores=os.cpu_count(),
        load=os.getloadavg()[0],
        versions=", ".join(f"{name} {text}" for name, text in versions().items()) + ".",
    )


def machine() -> str:
    """The processor's own name where the system tells it."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.machine()
    for line in text.splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.machine()


def write(folder: Path, page: str, tables: Sequence[Table], hidden: Sequence[Table]) -> None:
    """README.md with all tables, and each as CSV; `hidden` ones as CSV only."""
    folder.mkdir(parents=True, exist_ok=True)
    text = "\n".join([page, *(table.markdown() for table in tables)])
    (folder / "README.md").write_text(text, encoding="utf-8")
    for table in (*tables, *hidden):
        table.write_csv(folder)


def time_at(rows: Sequence[Row], method: str, error: float) -> float:
    """Least CPU s per run of a method with at most this error; not a number if it has none."""
    times = [row.cpu for row in rows if row.method == method and max(row.error, LEAST_ERROR) <= error]
    return min(times, default=float("nan"))


def problem_of(name: str) -> Problem:
    return next(problem for problem in PROBLEMS if problem.name == name)
