"""heyoka's adaptive Taylor method with its event detection, on the hand-derived equations.

Compiling an integrator takes it a second or so; that is not counted, because a sweep compiles once.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import heyoka as hy

from ..models import Log, Model
from ..problems import Floats, Problem
from ..rows import Attempt, Cases

NAME = "heyoka"
TOLERANCES = (1e-6, 1e-9, 1e-12, 2.2e-16)
# Longer than any run without an end time, s.
FOREVER = 50.0
# The first step is bounded, s: at rest the method takes a far too great one, the odd coefficients being zero.
FIRST_STEP = 0.01


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    for tolerance in TOLERANCES[-1:] if quick else TOLERANCES:
        integrator = compiled(problem.model, len(problem.model.parameters(list(problem.cases[0]))), tolerance)
        batch = Cases(partial(run, problem.model, integrator), problem.cases)
        yield Attempt(NAME, f"tol {tolerance:g}", hy.__version__, batch, note="hand-derived equations")


def compiled(model: Model, parameters: int, tolerance: float) -> Any:
    """An integrator of the model; each of its events stops it."""
    y = hy.make_vars(*(f"y{i}" for i in range(model.dimension)))
    p = [hy.par[i] for i in range(parameters)]
    directions = {1: hy.event_direction.positive, -1: hy.event_direction.negative}
    events = [hy.t_event(e.value(hy, y, p), direction=directions[e.direction]) for e in model.events]
    equations = list(zip(y, model.rhs(hy, y, p), strict=True))
    return hy.taylor_adaptive(
        equations, [0.0] * model.dimension, pars=[0.0] * parameters, t_events=events, tol=tolerance
    )


def run(model: Model, ta: Any, case: Floats) -> list[float]:
    """The answers of one case."""
    p = model.parameters(list(case))
    log = Log()
    ta.time = 0.0
    ta.pars[:] = p
    ta.state[:] = model.start(p)
    if not model.events:
        ta.step(FIRST_STEP)
        outcome = ta.propagate_until(model.end_time)[0]
        if outcome != hy.taylor_outcome.time_limit:
            raise RuntimeError(f"it ended early: {outcome}")
        return model.answers(log, ta.state)
    ta.reset_cooldowns()
    ta.step(FIRST_STEP)
    while True:
        number = -ta.propagate_for(FOREVER)[0].value - 1
        if not 0 <= number < len(model.events):
            raise RuntimeError(f"no event for {FOREVER:g} s")
        before = ta.state.tolist()
        after = model.go_on(log, number, ta.time, before, p)
        if after is None:
            return model.answers(log, ta.state)
        if after != before:
            ta.state[:] = after
            ta.reset_cooldowns()
