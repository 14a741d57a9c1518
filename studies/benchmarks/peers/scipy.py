"""SciPy's solve_ivp, DOP853 with its root finding, on the hand-derived equations."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import scipy
from scipy.integrate import solve_ivp

from ..models import Log, Model
from ..problems import Floats, Problem
from ..rows import Attempt, Cases

NAME = "SciPy DOP853"
TOLERANCES = (1e-6, 1e-9, 1e-12)
# Longer than any run without an end time, s.
FOREVER = 50.0
# Of angles near rest: absolute below the relative tolerance.
ABSOLUTE = 1e-2


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    cases = problem.cases[: problem.slow_cases()]
    for rtol in TOLERANCES[:1] if quick else TOLERANCES:
        batch = Cases(partial(run, problem.model, rtol=rtol), cases)
        yield Attempt(NAME, f"rtol {rtol:g}", scipy.__version__, batch, note="hand-derived equations")


def run(model: Model, case: Floats, rtol: float) -> list[float]:
    """The answers of one case."""
    p = model.parameters(list(case))
    log, t, y = Log(), 0.0, model.start(p)
    events = [event_function(model, i, p) for i in range(len(model.events))]
    while True:
        end = FOREVER if model.end_time is None else model.end_time
        found = solve_ivp(
            lambda _t, u: model.rhs(math, u, p),
            (0.0, end),
            y,
            method="DOP853",
            rtol=rtol,
            atol=rtol * ABSOLUTE,
            events=events or None,
        )
        if not found.success:
            raise RuntimeError(found.message)
        if not events:
            return model.answers(log, found.y[:, -1])
        after = react(model, log, found, t, p)
        t += found.t[-1]
        if after is None:
            return model.answers(log, found.y[:, -1])
        y = after


def event_function(model: Model, number: int, p: Sequence[float]) -> Any:
    event = model.events[number]

    def value(_t: float, y: Any) -> float:
        return float(event.value(math, y, p))

    value.terminal = event.terminal  # type: ignore[attr-defined]
    value.direction = event.direction  # type: ignore[attr-defined]
    return value


def react(model: Model, log: Log, found: Any, t0: float, p: Sequence[float]) -> list[float] | None:
    """Tells the model what happened, in the order of time; the state from which to go on."""
    hits = [
        (t, number, y)
        for number, (times, states) in enumerate(zip(found.t_events, found.y_events, strict=True))
        for t, y in zip(times, states, strict=True)
    ]
    after: list[float] | None = None
    for t, number, y in sorted(hits, key=lambda hit: hit[:2]):
        after = model.go_on(log, number, t0 + t, [float(u) for u in y], p)
    if found.status != 1:
        return None
    return after
