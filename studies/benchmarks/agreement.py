"""Whether the routes agree: every study and benchmark scene on rk and on ida against the default.

Each run is a process of its own with a limit of its time.  Differences are relative; an answer that the
default route cannot tell from zero has no size of its own and is compared as it is, in SI.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import resource
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np

import planemotion
from planemotion import _layout as layout
from planemotion.base.errors import SceneError
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call, kernel, messages
from planemotion.sweep.plan import plan_sweep

from . import generate
from .problems import HERE, STUDIES, Floats
from .rows import Row
from .tables import Cell, Table

AGREES = 1e-6
# Of a time route: the default of solve.accuracy first; where that does not agree the finest, and one that
# asks less of the arithmetic.
ACCURACIES = (1e-10, 1e-12, 1e-9)
# Cases of a sweep that stand for it, from its first to its last.
CASES = 3
# CPU seconds of a run, all its cases together.
PATIENCE = 150
# A sample of the clock takes at least this, CPU s: it ticks in milliseconds on some machines.
LEAST_SAMPLE = 0.04
# In this time a chain of 40 four-bars does not come to its first flat position.
SHORT = "t = 0.5 s"


@dataclass
class Answers:
    """[cases, columns] in SI with estimated errors, statuses [cases], routes, CPU s, first message."""

    out: Floats
    error: Floats
    status: Sequence[int]
    routes: Sequence[str]
    seconds: float
    message: str


def scenes() -> list[tuple[str, Callable[[], planemotion.Scene]]]:
    """Name, with the duration where it is not that of the file, and how to get it."""
    files = [*sorted(STUDIES.glob("*.toml")), *sorted((HERE / "scenes").glob("*.toml"))]
    found: list[tuple[str, Callable[[], planemotion.Scene]]] = [
        (path.stem, partial(planemotion.load, path)) for path in files
    ]
    found += [(f"four_bars_{n}, 10 s", partial(generate.four_bars, n)) for n in (2, 40)]
    return [*found, ("four_bars_40, 0.5 s", lambda: generate.four_bars(40, SHORT))]


def tables(rows: Sequence[Row], quick: bool, out: Path) -> list[Table]:
    return [table(scenes()[:2] if quick else scenes())]


def table(of: Sequence[tuple[str, Callable[[], planemotion.Scene]]]) -> Table:
    found = Table(
        "agreement",
        "Agreement of the routes",
        (
            "scene",
            "cases",
            "route",
            "accuracy",
            "CPU ms a case",
            "greatest difference",
            "of",
            "estimated there",
            "agrees",
            "what limits it",
        ),
        text="Every study and every scene of the benchmark on both time routes against the default, all "
        f"asks; of a sweep {CASES} cases from its first to its last. Relative differences; `~`: the answer "
        "is zero within the error of the default route, and its difference is absolute, in SI. Estimated: "
        f"the error that both say of that answer. A run that differs by more than {AGREES:g} is repeated at "
        f"other accuracies. Each run has {PATIENCE} s.",
    )
    for name, scene in of:
        found.rows += scene_rows(name, scene())
    return found


def scene_rows(name: str, scene: planemotion.Scene) -> list[list[Cell]]:
    """A row for the default route and one or more for each time route."""
    default = limited(scene, "auto", ACCURACIES[0])
    if isinstance(default, str):
        return [[name, None, "default", ACCURACIES[0], None, None, None, None, "no answer", default]]
    asks = ask_keys(flatten(scene))
    cases = len(default.out)
    words = "default: " + ", ".join(default.routes)
    rows: list[list[Cell]] = [
        [name, cases, words, ACCURACIES[0], per_case(default), None, None, None, None, default.message]
    ]
    for route in ("rk", "ida"):
        for accuracy in ACCURACIES:
            row, agrees = compared(asks, default, limited(scene, route, accuracy))
            rows.append([name, cases, route, accuracy, *row])
            if agrees:
                break
    return rows


def ask_keys(flat: FlatScene) -> list[str]:
    """The ask of each column of out."""
    keys = [""] * sum(ask.count for ask in flat.asks)
    for ask in flat.asks:
        for i in range(ask.count):
            keys[ask.first + i] = f"{ask.key}[{i}]" if ask.is_list else ask.key
    return keys


def compared(asks: Sequence[str], default: Answers, other: Answers | str) -> tuple[list[Cell], bool]:
    """The cells of a row after its accuracy, and whether the routes agree."""
    if isinstance(other, str):
        return [None, None, None, None, "no answer", other], False
    zero = np.abs(default.out) <= default.error
    size = np.where(zero, 1.0, np.abs(default.out))
    difference = relative_difference(default.out, other.out, size)
    case, column = np.unravel_index(int(np.argmax(difference)), difference.shape)
    greatest = float(difference[case, column])
    estimated = float((default.error + other.error)[case, column] / size[case, column])
    key = asks[int(column)] + (" ~" if zero[case, column] else "")
    agrees, status = greatest <= AGREES, next(filter(None, other.status), layout.PM_OK)
    word = "yes" if agrees else "no"
    word += "" if status == layout.PM_OK else f", {kernel.status_name(status)}"
    return [per_case(other), greatest, key, estimated, word, limit(greatest, estimated, other)], agrees


def relative_difference(default: Floats, other: Floats, size: Floats) -> Floats:
    """[cases, columns]; infinite where one route has an answer and the other has none."""
    missing = np.isnan(default) != np.isnan(other)
    same = (default == other) | (np.isnan(default) & np.isnan(other))
    with np.errstate(invalid="ignore"):
        found = np.where(same, 0.0, np.abs(default - other) / size)
    return np.where(missing | np.isnan(found), np.inf, found)


def limit(greatest: float, estimated: float, other: Answers) -> str:
    """What the run itself says; else whether its estimate knows of the difference."""
    if other.message or greatest <= AGREES:
        return other.message
    return "its own truncation, as it says" if greatest <= estimated else "not known to the estimates"


def per_case(answers: Answers) -> float:
    return 1e3 * answers.seconds / len(answers.out)


def limited(scene: planemotion.Scene, route: str, accuracy: float) -> Answers | str:
    """The answers of a scene on a route, from a process of its own; or why there are none."""
    context = multiprocessing.get_context("fork")
    near, far = context.Pipe(duplex=False)
    child = context.Process(target=run, args=(scene, route, accuracy, far))
    child.start()
    far.close()
    answers: Answers | str = f"not finished in {PATIENCE} s"
    with contextlib.suppress(EOFError):  # ended by its limit
        answers = near.recv()
    child.join()
    return answers


def run(scene: planemotion.Scene, route: str, accuracy: float, out: Connection) -> None:
    """In the child: a case cannot be stopped, a process can."""
    resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE + 1))
    try:
        flat = flatten(scene.with_values({"solve.route": route, "solve.accuracy": accuracy}))
    except SceneError as error:
        out.send(f"not taken: {error}")
        return
    param = some_cases(scene, flat)
    begun, runs = time.process_time(), 0
    while runs == 0 or time.process_time() - begun < LEAST_SAMPLE:
        results, runs = call.run_cases(flat, param), runs + 1
    seconds = (time.process_time() - begun) / runs
    worst = int(np.argmax(results.status != layout.PM_OK))
    message = messages.message(flat, results, worst) if results.status[worst] != layout.PM_OK else ""
    message = message.removeprefix(f"{flat.file}: ")
    ran = np.bitwise_or.reduce(results.count[:, layout.PM_COUNT_ROUTES])
    routes = [kernel.route_name(i) for i in range(1, layout.PM_ROUTES) if int(ran) >> i & 1]
    out.send(Answers(results.out, results.error, [int(s) for s in results.status], routes, seconds, message))


def some_cases(scene: planemotion.Scene, flat: FlatScene) -> Floats:
    """[cases, parameters] in SI: of a sweep a few from its first to its last, else the file's own."""
    if not scene.data.sweep.grids:
        return np.atleast_2d(flat.defaults)
    plan = plan_sweep(scene)
    picked = np.unique(np.linspace(0, plan.cases - 1, CASES).astype(int))
    param = np.tile(flat.defaults, (len(picked), 1))
    for i, name in enumerate(plan.names):
        param[:, flat.parameters.index(name)] = [plan.block(int(k), 1)[0, i] for k in picked]
    return param
