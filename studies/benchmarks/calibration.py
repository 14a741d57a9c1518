"""Estimated errors against true ones: `make calibrate`.

    .venv/bin/python -m studies.benchmarks.calibration          tables; exit status 1 if a target is missed
    .venv/bin/python -m studies.benchmarks.calibration renew    compute the stored truths again (minutes)

Scenes whose answers are known - closed forms, quadratures and integrations in 30 digits that share nothing
with the engine, the chapter's reference figures - are run at many accuracies, on the default route and on
both time routes.  Two things are wanted of the estimates: the true error, counted as at least 1e-14, lies
below the estimate in at least 95 % of the asks, and the estimate is within 100 times of it in the median.
Scenes drawn at random (`drawn.py`) are run at a random accuracy each; of them 97 % are wanted, and hardly
any (1 %: the difference of two runs may be small by chance) whose true error is beyond ten times its
estimate in a run that ends as `ok`.
The values of a list weigh as one ask.  A scene that needs very many steps on a route is run at its first
accuracy alone; the table tells how many runs were left out so.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import planemotion
from planemotion._layout import (
    PM_COUNT_PASSES,
    PM_COUNT_RUNS,
    PM_COUNT_SOLVES,
    PM_OK,
    PM_TRUST_EXCESS,
    PM_UNDECIDED,
)
from planemotion.compile.flatten import flatten
from planemotion.engine import call, messages
from studies.benchmarks.drawn import drawn
from studies.benchmarks.known import Known, bouncing_ball, chapter, collar, pendulum, renew, sphere, stored
from studies.benchmarks.tables import Cell, Table

STUDIES = Path(__file__).parent.parent

LEAST_TRUE_ERROR = 1e-14  # relative: closer than that the truths themselves are not known
COVERED = 0.95
COVERED_OF_DRAWN = 0.97
BEYOND = 10.0  # times its estimate: hardly a true error may be
BEYOND_SHARE = 0.01  # of the asks
DRAWN = 60  # scenes of each kind
WITHIN = 100.0
COSTLY = 2e6  # solves of one run, all its passes: some seconds; tighter accuracies take as long or longer


# ---- the comparison -------------------------------------------------------------------------------------


@dataclass
class Tally:
    """Weights and ratios of the asks of one row of the table."""

    covered: list[float] = field(default_factory=list)
    ratio: list[float] = field(default_factory=list)
    weight: list[float] = field(default_factory=list)
    kept: list[bool] = field(default_factory=list)
    runs: int = 0
    passes: int = 0
    undecided: int = 0
    unanswered: int = 0
    wrong_counts: int = 0
    beyond: int = 0
    left_out: int = 0
    solves: float = 0
    seconds: float = 0
    said: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)

    def cells(self) -> list[Cell]:
        """What the table shows of it."""
        asks, kept = round(sum(self.weight)), 100 * float(np.mean(self.kept))
        shares = [self.passes / self.runs, asks, 100 * self.share(), self.median(), kept]
        counts = [self.undecided, self.unanswered, self.wrong_counts, self.beyond, self.left_out]
        return [self.runs, *shares, *counts, self.seconds]

    def share(self) -> float:
        return float(np.average(self.covered, weights=self.weight))

    def median(self) -> float:
        order = np.argsort(self.ratio)
        total = np.cumsum(np.asarray(self.weight)[order])
        return float(np.asarray(self.ratio)[order][np.searchsorted(total, total[-1] / 2)])


def tally(known: Known, route: str, accuracy: float) -> Tally:
    """One run, compared."""
    scene = known.scene.with_values(
        {"solve.route": route, "solve.accuracy": accuracy, "solve.max_steps": 10**8}
    )
    flat = flatten(scene)
    results = call.run_cases(flat, np.atleast_2d(flat.defaults))
    status = int(results.status[0])
    counts = [int(number) for number in results.count[0]]
    row = Tally(runs=1, passes=counts[PM_COUNT_PASSES], undecided=int(status == PM_UNDECIDED))
    row.solves = counts[PM_COUNT_PASSES] * max(counts[PM_COUNT_RUNS], 1) * counts[PM_COUNT_SOLVES]
    if status not in (PM_OK, PM_UNDECIDED):
        row.unanswered = 1  # declined by the route, or not trusted: the run says so
        message = messages.message(flat, results, 0).removeprefix(f"{flat.file}: ")
        row.said.append(f"{scene.id}, {route}, {accuracy:g}: {message}")
        return row
    row.kept.append(bool(results.trust[0, PM_TRUST_EXCESS] <= 1))
    for column in flat.asks:
        if column.key not in known.truth:
            continue
        truth = np.atleast_1d(known.truth[column.key])
        columns = slice(column.first, column.first + truth.size)
        found, error = results.out[0, columns] / column.factor, results.error[0, columns] / column.factor
        if np.isfinite(results.margin[0, flat.asks.index(column)]):
            row.wrong_counts += int(status == PM_OK and found[0] != truth[0])
            continue
        for value, estimate, wanted in zip(found, error, truth, strict=True):
            least_error = LEAST_TRUE_ERROR * (abs(wanted) or 1.0)
            true = max(abs(value - wanted), least_error)
            row.covered.append(true <= estimate)
            row.beyond += int(status == PM_OK and true > BEYOND * estimate)
            row.ratio.append(estimate / true if math.isfinite(estimate) else math.inf)
            row.weight.append(1 / truth.size)
    return row


def tallies(known: Known, route: str) -> Tally:
    """The runs of a scene on a route at its accuracies, from the loosest on."""
    begun, total = time.process_time(), Tally()
    powers = list(known.accuracies[route])
    for done, power in enumerate(powers, 1):
        row = tally(known, route, 10.0 ** -float(power))
        total.add(row)
        if row.solves > COSTLY and done < len(powers):
            total.left_out += len(powers) - done
            total.said.append(f"{known.scene.id}, {route}: {row.solves:.1e} solves: at 1e-{power:g} only")
            break
    total.seconds = time.process_time() - begun
    return total


def compare() -> dict[tuple[str, str], Tally]:
    """A row for each scene and route, computed on all cores."""
    sources = (pendulum, collar, bouncing_ball, sphere, stored, chapter)
    scenes = [*(known for source in sources for known in source()), *drawn(DRAWN)]
    jobs = [(known, route) for known in scenes for route in known.accuracies]
    JOBS.extend(jobs)
    rows: dict[tuple[str, str], Tally] = {}
    # The children of a fork know the jobs; what they hand back is numbers.
    with multiprocessing.get_context("fork").Pool(os.cpu_count()) as pool:
        for (known, route), row in zip(jobs, pool.imap(job, range(len(jobs))), strict=True):
            print("".join(f"{line}\n" for line in row.said), end="", file=sys.stderr, flush=True)
            rows.setdefault((known.name, route), Tally()).add(row)
    return rows


JOBS: list[tuple[Known, str]] = []


def job(i: int) -> Tally:
    return tallies(*JOBS[i])


def show(rows: dict[tuple[str, str], Tally]) -> bool:
    """Prints the table; whether both targets are reached on every route."""
    table = Table(
        "calibration",
        "Estimated errors against true ones",
        (
            *("scene", "route", "runs", "passes", "asks", "true <= estimate [%]", "median estimate / true"),
            *("accuracy kept [%]", "undecided", "no answer", "wrong counts"),
            *(f"beyond {BEYOND:g} x estimate", "left out", "CPU s"),
        ),
    )
    totals: dict[str, Tally] = {}
    of_drawn: dict[str, Tally] = {}
    for (name, route), row in rows.items():
        (of_drawn if name.startswith("drawn") else totals).setdefault(route, Tally()).add(row)
    sums = [(("all", route), row) for route, row in totals.items()]
    sums += [(("all drawn", route), row) for route, row in of_drawn.items()]
    for (name, route), row in [*rows.items(), *sums]:
        table.rows.append([name, route, *row.cells()])
    table.show()
    good = [row.share() >= COVERED and row.median() <= WITHIN for row in totals.values()]
    good += [
        row.share() >= COVERED_OF_DRAWN and row.beyond <= BEYOND_SHARE * len(row.covered)
        for row in of_drawn.values()
    ]
    return all(good) and not any(row.wrong_counts for row in rows.values())


# ---- what it costs --------------------------------------------------------------------------------------


def cost() -> None:
    """Time with the estimate over time without, at the same accuracy."""
    table = Table(
        "cost",
        "What the estimates cost",
        ("scene", "route", "accuracy", "without [ms]", "with [ms]", "ratio", "passes"),
    )
    names = (
        "pendulum",
        "rolling_collar",
        "bouncing_ball",
        "sphere_over_bars",
        "double_pendulum",
        "slider_crank",
    )
    for name in names:
        for route, accuracy in (("rk", 1e-6), ("rk", 1e-8), ("rk", 1e-10), ("ida", 1e-8)):
            if route == "ida" and name in ("sphere_over_bars", "slider_crank"):
                continue  # minutes, and no other ratio
            times, passes = [], 1
            for estimate in (False, True):
                settings = {"solve.route": route, "solve.accuracy": accuracy, "solve.estimate": estimate}
                flat = flatten(planemotion.load(STUDIES / f"{name}.toml").with_values(settings))
                param = np.atleast_2d(flat.defaults)
                times.append(min(seconds(flat, param) for _ in range(5)))
                passes = int(call.run_cases(flat, param).count[0, PM_COUNT_PASSES])
            without, with_them = (1e3 * least for least in times)
            table.rows.append([name, route, accuracy, without, with_them, with_them / without, passes])
    table.show()


def seconds(flat: Any, param: np.ndarray) -> float:
    begun = time.process_time()
    call.run_cases(flat, param)
    return time.process_time() - begun


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", nargs="?", choices=("compare", "renew"), default="compare")
    if parser.parse_args().what == "renew":
        renew()
        return 0
    good = show(compare())
    cost()
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
