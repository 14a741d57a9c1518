"""The two named studies with all their asks: cases per second in the kernel, and from the file to HDF5."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import planemotion
from planemotion.compile.flatten import FlatScene
from planemotion.engine import call, messages
from planemotion.engine.outcome import CaseResults

from .peers.engine import columns, flat_of
from .problems import PROBLEMS, STUDIES, Floats, Problem
from .rows import Row
from .tables import Table
from .timing import Timer, cpu, interleave, wall

ROUTES = ("auto", "rk", "ida")
ASKS = {
    "sphere_over_bars": ("omega_B", "bars_passed", "min_normal_over_weight", "friction_needed"),
    "rolling_collar": ("omega_above", "time_of_turn", "min_normal_over_weight", "friction_needed"),
}
# Of the kernel's rates: seconds of a sample, samples of each in turn, seconds of one that is slow.
SAMPLE_SECONDS = 0.2
ROUNDS = 12
BUDGET = 2.5
# Seconds that a sweep with files should take.
SWEEP_SECONDS = 3.0
# Side of the smallest grid of a sweep.
LEAST_SIDE = 4
REPEAT = 3


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    return [rate_table(quick), sweep_table(quick)]


def rate_table(quick: bool) -> Table:
    table = Table(
        "named_studies",
        "The two named studies, in the kernel",
        ("study", "asks", "route", "estimates", "cases/s a core", "2 threads", "error", "wrong", "why not"),
        text="Cases per CPU second of one thread, and by the clock two threads over one. The error is "
        "relative, the greatest of all asks that have a reference.",
    )
    rates = [
        Rate.of(problem, asks, route, estimate, quick)
        for problem in PROBLEMS
        for asks in (ASKS.get(problem.name, ()), problem.asks)
        if problem.name in ASKS
        for route in (ROUTES[:1] if quick else ROUTES)
        for estimate in (True, False)
    ]
    interleave([rate.timer for rate in rates if rate.timer], 0 if quick else ROUNDS, BUDGET)
    table.rows.extend(rate.row(1 if quick else REPEAT) for rate in rates)
    return table


@dataclass
class Rate:
    """One row: its words, greatest relative error, wrong counts, why there are none; and what is timed."""

    words: list[str]
    error: float | None
    wrong: int | None
    why: str
    flat: FlatScene
    param: Floats
    timer: Timer | None

    @classmethod
    def of(cls, problem: Problem, asks: Sequence[str], route: str, estimate: bool, quick: bool) -> Rate:
        flat = flat_of(problem.scene(), asks, {"solve.route": route, "solve.estimate": estimate})
        cases = problem.cases[: problem.slow_cases()] if route == "ida" or quick else problem.cases
        param = columns(flat, problem.names, cases)
        results = call.run_cases(flat, param)
        words = [
            problem.name,
            "all four" if len(asks) == 4 else ", ".join(asks),
            "default" if route == "auto" else route,
            "yes" if estimate else "no",
        ]
        if np.any(results.status < 0):
            why = messages.message(flat, results, int(np.argmin(results.status)))
            return cls(words, None, None, why, flat, param, None)
        error, wrong = study_error(problem, flat, results)
        once = max(cpu(lambda: call.run_cases(flat, param)), 1e-6)
        param = np.tile(param, (max(1, round(SAMPLE_SECONDS / once)), 1))
        timer = Timer.first(lambda: call.run_cases(flat, param))
        return cls(words, error, wrong, "", flat, param, timer)

    def row(self, repeat: int) -> list[str | float | int | None]:
        if not self.timer:
            return [*self.words, None, None, None, None, self.why]
        one, two = (wall(partial(call.run_cases, self.flat, self.param, workers=n), repeat) for n in (1, 2))
        rate = len(self.param) / self.timer.best
        return [*self.words, rate, one / two, self.error, self.wrong, ""]


def study_error(problem: Problem, flat: FlatScene, results: CaseResults) -> tuple[float, int | None]:
    """Greatest relative error of the asks, and cases with a wrong count."""
    greatest, wrong = 0.0, None
    for ask in flat.asks:
        found = results.out[:, ask.first]
        exact = reference_of(problem, ask.key)[: len(found)]
        if ask.key == problem.count:
            wrong = int(np.count_nonzero(found != exact))
            continue
        both = np.isfinite(exact) & (exact != 0)
        greatest = max(greatest, float(np.max(np.abs(found[both] / exact[both] - 1))))
    return greatest, wrong


def reference_of(problem: Problem, key: str) -> Floats:
    reference = problem.reference
    if key in reference.get("more", {}):
        return np.array(reference["more"][key], float)
    return problem.exact()[:, reference["columns"].index(key)]


# ---- from the file to the files ----


def sweep_table(quick: bool) -> Table:
    table = Table(
        "sweeps",
        "From the scene file to HDF5",
        ("study", "asks", "cases", "CPU s", "cases/s a core", "of it in the kernel", "MB written"),
        text="`planemotion.load`, `Scene.sweep(out=...)` with one worker, all but the imports: reading and "
        "validating the scene, the kernel, and writing HDF5 and CSV, with error estimates; CPU time of the "
        "whole process.",
    )
    for asks in (ASKS["sphere_over_bars"], ("omega_B", "bars_passed")):
        table.rows.append(sweep_row("sphere_over_bars_grid", asks, ("d", "omega0"), quick))
    table.rows.append(sweep_row("rolling_collar", ASKS["rolling_collar"], ("d", "mass_ratio"), quick))
    return table


RANGES = {"d": {"sphere_over_bars_grid": ("1 in", "6 in"), "rolling_collar": ("0 m", "0.3 m")}}
OTHER = {"omega0": ("1 rad/s", "3 rad/s"), "mass_ratio": (0.5, 2)}


def sweep_row(study: str, asks: Sequence[str], names: Sequence[str], quick: bool) -> list[str | int | float]:
    path = STUDIES / f"{study}.toml"
    side = LEAST_SIDE
    seconds = dry(path, asks, grid(study, names, side))
    while not quick and seconds < 0.5 * SWEEP_SECONDS:
        side = int(side * max(2, SWEEP_SECONDS / max(seconds, 1e-3)) ** 0.5) + 1
        seconds = dry(path, asks, grid(study, names, side))
    with tempfile.TemporaryDirectory() as folder:
        seconds = cpu(lambda: sweep(path, asks, grid(study, names, side), folder))
        size = sum(file.stat().st_size for file in Path(folder).rglob("*") if file.is_file())
    kernel = kernel_seconds(path, asks, grid(study, names, side))
    words = "all four" if len(asks) == 4 else ", ".join(asks)
    cases = side * side
    return [study, words, cases, seconds, cases / seconds, f"{100 * kernel / seconds:.0f} %", size / 2**20]


def dry(path: Path, asks: Sequence[str], grids: dict[str, Any]) -> float:
    """CPU seconds of a sweep that writes nothing."""
    return cpu(lambda: sweep(path, asks, grids, None))


def grid(study: str, names: Sequence[str], side: int) -> dict[str, Any]:
    first, second = names
    low, high = RANGES[first][study]
    least, most = OTHER[second]
    return {
        first: {"from": low, "to": high, "num": side},
        second: {"from": least, "to": most, "num": side},
    }


def sweep(path: Path, asks: Sequence[str], grids: dict[str, Any], out: str | None) -> None:
    with_asks(path, asks).sweep(out=out, workers=1, **grids)


def with_asks(path: Path, asks: Sequence[str]) -> planemotion.Scene:
    scene = planemotion.load(path)
    raw = {**scene.table, "ask": {key: scene.table["ask"][key] for key in asks}}
    return planemotion.Scene.from_table(raw, file=scene.file)


def kernel_seconds(path: Path, asks: Sequence[str], grids: dict[str, Any]) -> float:
    """CPU s of the kernel alone for the cases of a sweep."""
    from planemotion.sweep.plan import plan_sweep

    scene = with_asks(path, asks)
    scene = planemotion.Scene.from_table({**scene.table, "sweep": grids}, file=scene.file)
    plan = plan_sweep(scene)
    flat = flat_of(scene, asks, {})
    param = columns(flat, plan.names, plan.block(0, plan.cases))
    return cpu(lambda: call.run_cases(flat, param))
