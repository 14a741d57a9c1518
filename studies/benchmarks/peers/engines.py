"""What MuJoCo and Exudyn share: fixed steps, mechanisms, and no more patience than a table deserves."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Protocol

from ..mechanisms import Mechanism
from ..problems import Floats, Problem
from ..rows import Attempt, Cases
from ..timing import timed

# A setting that would take longer than this is a row that says so, s.
PATIENCE = 12.0
# Steps that are tried to tell how long a run takes; the first call also warms up.
TRIED_STEPS = 50


class Run(Protocol):
    """A mechanism at a fixed step; `solve(steps)` starts anew; the rods' angles and the energy, J."""

    def solve(self, steps: int) -> tuple[Sequence[float], float]: ...


def attempts(
    name: str, version: str, steps: Sequence[float], problem: Problem, make: Callable[[Mechanism, float], Run]
) -> Iterator[Attempt]:
    """One attempt for each step, s."""
    mechanism = problem.mechanism
    if mechanism is None:
        yield Attempt(name, "", version, skip=f"does not apply: {problem.no_engine}")
        return
    for step in steps:
        one = Attempt(name, f"h = {step:g} s", version)
        run, count = make(mechanism, step), round(mechanism.end_time / step)
        run.solve(1)
        _, seconds = timed(partial(run.solve, TRIED_STEPS))
        expected = seconds / TRIED_STEPS * count
        if expected > PATIENCE:
            one.skip = f"not run: it would take about {expected:.0f} s"
        else:
            one.batch = Cases(partial(answers, problem, mechanism, run, count), problem.cases)
        yield one


def answers(problem: Problem, mechanism: Mechanism, run: Run, steps: int, _case: Floats) -> list[float]:
    """The problem's answers from the angles of the rods at the end."""
    angles, energy = run.solve(steps)
    if not all(map(math.isfinite, angles)):
        raise RuntimeError("it diverged")
    if mechanism.tip_asked:
        return mechanism.tip(angles)
    return [angles[0], energy] if problem.drift else [angles[0]]
