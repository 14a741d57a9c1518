"""IDA of SUNDIALS through scikit-SUNDAE, with its root finding, on the hand-derived equations."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from importlib.metadata import version
from typing import Any

import numpy as np
from sksundae.ida import IDA

from ..models import Log, Model
from ..problems import Floats, Problem
from ..rows import Attempt, Cases

NAME = "scikit-SUNDAE IDA"
TOLERANCES = (1e-5, 1e-7, 1e-9)
# Longer than any run without an end time, s.
FOREVER = 50.0
MOST_STEPS = 1_000_000
# Of angles near rest: absolute below the relative tolerance.
ABSOLUTE = 1e-2


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    cases = problem.cases[: problem.slow_cases()]
    for rtol in TOLERANCES[:1] if quick else TOLERANCES:
        batch = Cases(partial(run, problem.model, rtol=rtol), cases)
        yield Attempt(NAME, f"rtol {rtol:g}", version("scikit-sundae"), batch, note="hand-derived equations")


def run(model: Model, case: Floats, rtol: float) -> list[float]:
    """The answers of one case."""
    p = model.parameters(list(case))
    residual, events = residual_of(model, p), events_of(model, p)
    log, t, y = Log(), 0.0, model.start(p)
    end = FOREVER if model.end_time is None else model.end_time
    while True:
        # A solver that is used again gives the events of its earlier runs too.
        solver = IDA(residual, rtol=rtol, atol=rtol * ABSOLUTE, max_num_steps=MOST_STEPS, **events)
        found = solver.solve(np.array([0.0, end]), np.array(y), np.array(model.rhs(math, y, p)))
        if not found.success:
            raise RuntimeError(found.message)
        if not model.events:
            return model.answers(log, found.y[-1])
        after = None
        for hit, at, state in zip(found.i_events, found.t_events, found.y_events, strict=True):
            for number in np.flatnonzero(hit):
                after = model.go_on(log, int(number), t + at, [float(u) for u in state], p)
        if after is None:
            return model.answers(log, found.y[-1])
        t += found.t[-1]
        y = after


def residual_of(model: Model, p: Sequence[float]) -> Any:
    def residual(_t: float, y: Any, rate: Any, out: Any) -> None:
        out[:] = rate - np.array(model.rhs(math, y, p))

    return residual


def events_of(model: Model, p: Sequence[float]) -> dict[str, Any]:
    if not model.events:
        return {}

    def values(_t: float, y: Any, _rate: Any, out: Any) -> None:
        for i, event in enumerate(model.events):
            out[i] = event.value(math, y, p)

    values.terminal = [event.terminal for event in model.events]  # type: ignore[attr-defined]
    values.direction = [event.direction for event in model.events]  # type: ignore[attr-defined]
    return {"eventsfn": values, "num_events": len(model.events)}
