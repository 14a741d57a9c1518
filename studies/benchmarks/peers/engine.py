"""planemotion from the scene: every route, several accuracies, with and without error estimates."""

from __future__ import annotations

import contextlib
import os
import resource
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import version
from typing import Any

import numpy as np

import planemotion
from planemotion import _layout as layout
from planemotion.base.errors import SceneError, SimulationError
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call, kernel, messages
from planemotion.engine.outcome import CaseResults

from ..measure import sentence
from ..problems import Floats, Problem
from ..rows import Attempt, Batch

NAME = "planemotion"
# What any scene is given; a route that the kernel lacks, or that does not apply, is a row that says so.
ROUTES = ("auto", "path", "uniform", "rk", "ida")
ACCURACIES = (1e-6, 1e-8, 1e-10, 1e-12)
DEFAULT_ACCURACY = 1e-10
# Runs the first cases of a problem only.
SLOW_ROUTES = ("ida",)
# A batch that takes longer than this is a row that says so, CPU s.
PATIENCE = 10
# Cases that take less than this together are run several at once, so that the kernel is what is timed, s.
LEAST_CALL = 5e-3
MOST_COPIES = 4096


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    for route in ROUTES:
        for estimate in (True, False):
            for accuracy in (DEFAULT_ACCURACY,) if quick else ACCURACIES:
                found = attempt(problem, route, accuracy, estimate)
                if found.batch is not None and not finishes(found.batch):
                    found.batch, found.skip = None, f"not finished in {PATIENCE} s"
                yield found
                if found.skip:
                    break  # tighter takes longer, and what is not taken is said once
            if found.skip:
                break


def method_name(route: str, estimate: bool) -> str:
    """As it stands in tables: "planemotion default", "planemotion rk, no estimates"."""
    word = "default" if route == "auto" else route
    return f"{NAME} {word}" + ("" if estimate else ", no estimates")


def attempt(problem: Problem, route: str, accuracy: float, estimate: bool) -> Attempt:
    """One route at one accuracy; what the engine does not take is an attempt that says why."""
    one = Attempt(method_name(route, estimate), f"accuracy {accuracy:g}", version("planemotion"))
    try:
        settings = {"solve.route": route, "solve.accuracy": accuracy, "solve.estimate": estimate}
        flat = flat_of(problem.scene(), problem.asks, settings)
    except SceneError as error:
        one.skip = f"not taken: {sentence(error)}"
        return one
    cases = problem.cases[: problem.slow_cases()] if route in SLOW_ROUTES else problem.cases
    one.batch = KernelBatch(flat, columns(flat, problem.names, cases), problem.asks)
    return one


def finishes(batch: Batch) -> bool:
    """Whether a batch ends within PATIENCE, tried in a process of its own: a case cannot be stopped."""
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE + 1))
        with contextlib.suppress(Exception):  # a failure is reported by the run that counts
            batch.answers()
        os._exit(0)
    _, status = os.waitpid(child, 0)
    return not os.WIFSIGNALED(status)


def flat_of(scene: planemotion.Scene, asks: Sequence[str], settings: Mapping[str, Any]) -> FlatScene:
    """The tables of a scene with the given asks alone, so that what is not compared costs nothing."""
    chosen = scene.with_values(settings)
    raw = {**chosen.table, "ask": {key: chosen.table["ask"][key] for key in asks}}
    return flatten(planemotion.Scene.from_table(raw, file=scene.file))


def columns(flat: FlatScene, names: Sequence[str], cases: Floats) -> Floats:
    """Parameter rows in SI: the defaults of the file but for the given columns."""
    param = np.tile(flat.defaults, (len(cases), 1))
    for i, name in enumerate(names):
        param[:, flat.parameters.index(name)] = cases[:, i]
    return param


class KernelBatch:
    """A batch for the kernel; a quick one repeats its cases, so that a call is kernel time."""

    def __init__(self, flat: FlatScene, param: Floats, asks: Sequence[str]) -> None:
        self.flat, self.cases = flat, len(param)
        by_key = {ask.key: ask for ask in flat.asks}
        self.columns = [by_key[key].first + i for key in asks for i in range(by_key[key].count)]
        self.param = param
        self.results: CaseResults | None = None

    def runs(self) -> int:
        """Cases that a call runs."""
        return len(self.param)

    def answers(self) -> Floats:
        """Runs them.  Raises SimulationError for a case that fails."""
        results = self.results = call.run_cases(self.flat, self.param)
        failed = np.flatnonzero(results.status[: self.cases] < layout.PM_OK)
        if failed.size:
            raise SimulationError(messages.message(self.flat, results, int(failed[0])), status=0)
        return results.out[: self.cases, self.columns]

    def lengthen(self, seconds: float, least: float = LEAST_CALL) -> None:
        """Copies of all cases, which take `seconds`, such that a call takes at least about `least`."""
        copies = int(min(max(least / max(seconds, 1e-7), 1), MOST_COPIES / self.cases))
        self.param = np.tile(self.param[: self.cases], (max(copies, 1), 1))

    def steps(self) -> float:
        """Mean steps of a case."""
        assert self.results is not None
        return float(np.mean(self.results.count[: self.cases, layout.PM_COUNT_STEPS]))

    def said(self) -> str:
        """Routes that ran, early stops and doubts."""
        assert self.results is not None
        routes = np.unique(self.results.count[: self.cases, layout.PM_COUNT_ROUTE])
        words = ["ran " + ", ".join(kernel.route_name(int(route)) for route in routes)]
        stops = self.results.status[: self.cases]
        for status in np.unique(stops[stops > layout.PM_OK]):
            words.append(f"{np.count_nonzero(stops == status)} x {kernel.status_name(int(status))}")
        return "; ".join(words)
