"""Runs the benchmark: `make bench`, or

    python -m studies.benchmarks [--quick] [--only SCENE,...] [--out FOLDER]

from the root of the project.  Writes README.md, a CSV file for each table and a picture for each scene.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from . import measure, parts, peers, plots, report
from .problems import HERE, PROBLEMS
from .rows import Row
from .tables import Table

RESULTS = HERE / "results"
# The part that stands before everything else on the page.
FIRST = "summary"


def main() -> None:
    given = arguments()
    names = given.only.split(",") if given.only else [p.name for p in PROBLEMS] + list(parts.PARTS)
    unknown = set(names) - {p.name for p in PROBLEMS} - set(parts.PARTS) - set(parts.LONG_PARTS)
    if unknown:
        sys.exit(f"no such scene or part: {', '.join(sorted(unknown))}")
    page = report.introduction(given.quick)
    given.out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    tables: list[Table] = []
    for problem in PROBLEMS:
        if problem.name in names:
            attempts = peers.attempts(problem, given.quick, given.without.split(","))
            rounds = 1 if given.quick else measure.ROUNDS
            found = measure.measure(problem, attempts, rounds=rounds, say=say)
            rows += found
            tables.append(report.scene_table(problem, found))
            plots.work_precision(problem, found, given.out / f"{problem.name}.png")
    for name, part in {**parts.PARTS, **parts.LONG_PARTS}.items():
        if name in names:
            print(name, flush=True)
            more = part(rows, given.quick, given.out)
            tables = more + tables if name == FIRST else tables + more
    report.write(given.out, page, tables, [report.all_rows(rows)])
    if given.keep:
        shutil.copytree(given.out, RESULTS, dirs_exist_ok=True)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m studies.benchmarks",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--quick", action="store_true", help="one setting for each method, few samples: for tests"
    )
    parser.add_argument("--only", default="", metavar="NAMES", help="scenes and parts, by comma")
    parser.add_argument("--without", default="", metavar="PACKAGES", help="taken for not installed, by comma")
    parser.add_argument("--out", type=Path, default=Path("build/bench"), help="folder of the results")
    parser.add_argument("--keep", action="store_true", help="copy the results to studies/benchmarks/results")
    return parser.parse_args()


def say(row: Row) -> None:
    status = row.status if row.status != "ok" else f"{row.cpu * 1e3:.4g} ms, error {row.error:.1e}"
    print(f"{row.scene}, {row.method}, {row.setting}: {status}", flush=True)


if __name__ == "__main__":
    main()
