"""How cost grows: with bodies, with contacts, with cases, with threads."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np

import planemotion
from planemotion.base.errors import SceneError
from planemotion.compile.flatten import FlatScene
from planemotion.engine import messages
from planemotion.engine.call import run_cases

from . import generate, plots
from .peers.engine import KernelBatch, columns, finishes, flat_of, method_name
from .problems import PROBLEMS, STUDIES, Floats
from .rows import Row
from .tables import Cell, Table
from .timing import cpu, wall

FOUR_BARS = (10, 20, 40, 80, 160)
PENDULUMS = (1, 2, 4, 8, 16, 32, 64)
FLOORS = (1, 4, 16, 64, 256)
IDLE = (0, 1, 4, 16, 64)
CASES = (1, 10, 100, 1000, 10_000)
THREADS = (1, 2)
REPEAT = 5
# Calls of a sweep that are timed at least, and how long all may take, s.
CALLS = 5
CALLS_SECONDS = 1.0
# A batch of cases for the threads takes about this long on one, s; how often one thread and two take turns.
THREAD_SECONDS = 0.3
THREAD_TURNS = 15
# A call for a chain takes at least this long, s: what is made once a batch is a small part of it then.
CHAIN_CALL = 0.2
COUNT_TO = 10_000_000


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    found = [bodies(quick, out), contacts(quick, out), idle(quick), cases(quick), threads(quick)]
    return found


def bodies(quick: bool, out: Path) -> Table:
    """Time per step of chains: loops (A02, to the end through its flat position) and trees."""
    table = Table(
        "growth_bodies",
        "Growth with the number of bodies",
        (
            "chain",
            "method",
            "N",
            "bodies",
            "CPU ms per run",
            "steps",
            "us per step",
            "us per step and body",
            "why not",
        ),
        text="N-four-bar (A02): 10 s, and 0.5 s before its first flat position; N pendulums in series: 1 s. "
        "Without error estimates, accuracy 1e-8. Pictures: ![](growth_bodies.png)",
    )
    chains: list[tuple[str, Sequence[int], Callable[[int], planemotion.Scene]]] = [
        ("N-four-bar, 10 s", FOUR_BARS, generate.four_bars),
        ("N-four-bar, 0.5 s", FOUR_BARS, lambda n: generate.four_bars(n, "t = 0.5 s")),
        ("pendulums, 1 s", PENDULUMS, generate.pendulums),
    ]
    lines: dict[str, list[tuple[float, float]]] = {}
    for name, sizes, scene in chains:
        for route in ("auto", "rk"):
            method = method_name(route, True)
            scenes = [scene(n) for n in (sizes[:2] if quick else sizes)]
            for n, one, (figures, missed) in zip(
                sizes, scenes, in_turn(scenes, ("energy",), route), strict=False
            ):
                count = len(one.table["bodies"])
                table.rows.append([name, method, n, count, *per_step(figures, count), missed])
                if missed:
                    break
                lines.setdefault(f"{name}, {method}", []).append((count, 1e6 * figures[0] / figures[1]))
    plots.growth("Chains", "bodies", "CPU time per step [us]", lines, out / "growth_bodies.png")
    return table


def contacts(quick: bool, out: Path) -> Table:
    """A double pendulum above level lines that it never reaches."""
    table = Table(
        "growth_contacts",
        "Growth with the number of contacts",
        (
            "scene",
            "method",
            "contacts",
            "CPU ms per run",
            "steps",
            "us per step",
            "us per step and contact",
            "why not",
        ),
        text="A double pendulum, 2 s, above N level lines that it does not reach; without error estimates.",
    )
    for route in ("auto", "rk"):
        for n in FLOORS[:2] if quick else FLOORS:
            figures, missed = one_case(generate.floors(n), ("energy",), route)
            table.rows.append(["floors", method_name(route, True), n, *per_step(figures, n), missed])
            if missed:
                break
    return table


def idle(quick: bool) -> Table:
    """What bodies cost that no answer depends on."""
    table = Table(
        "growth_idle",
        "Growth with what nothing depends on",
        ("scene", "method", "idle pendulums", "CPU ms per run", "steps", "times the cost without", "why not"),
        text="A double pendulum, 2 s, its speed asked, beside N pendulums of which nothing is asked; "
        "without error estimates.",
    )
    for route in ("auto", "rk"):
        alone = np.nan
        for n in IDLE[:2] if quick else IDLE:
            (taken, steps), missed = one_case(generate.idle(n), ("omega",), route)
            alone = taken if n == 0 else alone
            table.rows.append(
                ["idle pendulums", method_name(route, True), n, 1e3 * taken, steps, taken / alone, missed]
            )
    return table


def one_case(scene: planemotion.Scene, asks: Sequence[str], route: str) -> tuple[tuple[float, float], str]:
    """CPU s and steps of a run, least of a few; or why there is none."""
    return in_turn([scene], asks, route)[0]


def in_turn(
    scenes: Sequence[planemotion.Scene], asks: Sequence[str], route: str
) -> list[tuple[tuple[float, float], str]]:
    """The same of each scene; they take turns, so that a slow phase of the machine meets all alike.

    Those after one that has no figures have none either.
    """
    batches: list[KernelBatch] = []
    missed = ""
    for scene in scenes:
        batch, missed = prepared(scene, asks, route)
        if batch is None:
            break
        batches.append(batch)
    taken = np.full(len(batches), np.inf)
    for _ in range(REPEAT):
        taken = np.minimum(taken, [cpu(batch.answers) / batch.runs() for batch in batches])
    found = [((float(least), batch.steps()), "") for least, batch in zip(taken, batches, strict=True)]
    return [*found, ((np.nan, np.nan), missed)] if missed else found


def prepared(scene: planemotion.Scene, asks: Sequence[str], route: str) -> tuple[KernelBatch | None, str]:
    """A scene's case, as often as a call needs to be timed; or why there is none."""
    settings = {"solve.route": route, "solve.estimate": False, "solve.accuracy": 1e-8}
    try:
        flat = flat_of(scene, asks, settings)
    except SceneError as error:
        return None, str(error)
    batch = KernelBatch(flat, flat.defaults[None, :], asks)
    if not finishes(batch):
        return None, "not finished in time"
    results = run_cases(flat, batch.param)
    if results.status[0] < 0:
        return None, messages.message(flat, results, 0)
    batch.lengthen(cpu(batch.answers), CHAIN_CALL)
    return batch, ""


def per_step(figures: tuple[float, float], n: int) -> list[Cell]:
    taken, steps = figures
    return [1e3 * taken, steps, 1e6 * taken / steps, 1e6 * taken / steps / n]


def cases(quick: bool) -> Table:
    """Time of a call and what a Python sweep adds."""
    table = Table(
        "growth_cases",
        "Growth with the number of cases, and what Python adds to a sweep",
        (
            "cases",
            "kernel ms",
            "kernel us per case",
            "sweep ms",
            "overhead ms",
            "overhead us per case",
            "overhead ms, medians",
        ),
        text="Rolling collar, all asks, default route, one thread: `call.run_cases`, and `Scene.sweep` "
        "without a folder for the same cases, which gives an xarray.Dataset in memory; CPU time, the scene "
        "already read and swept before. Overhead: sweep less kernel, the least of calls that take turns, "
        "and their medians.",
    )
    scene = planemotion.load(STUDIES / "rolling_collar.toml")
    flat = flat_of(scene, tuple(scene.table["ask"]), {})
    scales = (1e3, 1e6, 1e3, 1e3, 1e6, 1e3)
    for n in CASES[:3] if quick else CASES:
        d = {"from": "0 m", "to": "0.3 m", "num": n} if n > 1 else ["0.2 m"]
        param = columns(flat, ("d",), np.linspace(0, 0.3, n)[:, None] if n > 1 else np.array([[0.2]]))
        kernel, sweep = in_turns(partial(run_cases, flat, param), partial(scene.sweep, workers=1, d=d))
        least, middle = np.min(sweep) - np.min(kernel), np.median(sweep) - np.median(kernel)
        figures = [np.min(kernel), np.min(kernel) / n, np.min(sweep), least, least / n, middle]
        table.rows.append([n, *(scale * figure for scale, figure in zip(scales, figures, strict=True))])
    return table


def in_turns(*calls: Callable[[], object]) -> list[list[float]]:
    """CPU s of each call, over and over in turn, without a first round, which may prepare something."""
    taken: list[list[float]] = [[] for _ in calls]
    once = sum(cpu(call) for call in calls)
    for _ in range(max(CALLS, round(CALLS_SECONDS / once))):
        for times, call in zip(taken, calls, strict=True):
            times.append(cpu(call))
    return taken


def threads(quick: bool) -> Table:
    """By the clock: other work on the machine shows here."""
    table = Table(
        "growth_threads",
        "Growth with the number of threads",
        ("study", "route", "threads", "cases", "s by the clock", "times one thread"),
        text="All asks of the named studies; by the clock, least of some turns of all rows: other work on "
        "the machine shows. Beside them two processes that only count, at once, against one of them: what "
        "the machine itself gives.",
    )
    rows = [
        (problem, route) for problem in PROBLEMS[:2] for route in (("auto",) if quick else ("auto", "rk"))
    ]
    batches = []
    for problem, route in rows:
        flat = flat_of(problem.scene(), tuple(problem.scene().table["ask"]), {"solve.route": route})
        cases = columns(flat, problem.names, problem.cases)
        batches.append((flat, batch_for(flat, cases, 0.1 if quick else THREAD_SECONDS)))
    calls = [
        lambda flat=flat, param=param, n=n: run_cases(flat, param, workers=n)
        for flat, param in batches
        for n in THREADS
    ]
    taken = by_the_clock([*calls, lambda: count(1), lambda: count(2)], 2 if quick else THREAD_TURNS)
    for (problem, route), (_, param), times in zip(rows, batches, pairs(taken), strict=False):
        name = "default" if route == "auto" else route
        for n, seconds in zip(THREADS, times, strict=True):
            table.rows.append([problem.name, name, n, len(param), seconds, times[0] / seconds])
    alone, together = taken[-2:]
    table.rows.append(["processes that count", "-", 2, 2, together, 2 * alone / together])
    return table


def by_the_clock(calls: Sequence[Callable[[], object]], turns: int) -> list[float]:
    """Least seconds of each call, which take turns: a slow moment of the machine meets them all."""
    least = [math.inf] * len(calls)
    for _ in range(turns):
        for i, call in enumerate(calls):
            least[i] = min(least[i], wall(call, 1))
    return least


def pairs(numbers: Sequence[float]) -> Iterator[tuple[float, ...]]:
    return zip(*[iter(numbers)] * len(THREADS), strict=True)


def count(processes: int) -> None:
    """So many processes that count to a number each, at once."""
    command = [sys.executable, "-c", f"for i in range({COUNT_TO}): pass"]
    running = [subprocess.Popen(command) for _ in range(processes)]
    for process in running:
        process.wait()


def batch_for(flat: FlatScene, param: Floats, seconds: float) -> Floats:
    """Copies of the cases that take about so long."""
    once = max(cpu(lambda: run_cases(flat, param)), 1e-6)
    return np.tile(param, (max(1, round(seconds / once)), 1))
