"""Runs the attempts of all peers at one problem and turns them into rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from .problems import ROOT, Problem
from .rows import Attempt, Batch, Row
from .timing import Timer, interleave, timed

# Samples beyond the first, and CPU seconds that they may take for each method.
ROUNDS = 5
BUDGET = 1.0
# A call that takes longer than this is timed from its first time on, CPU s.
LONG = 0.3


def measure(
    problem: Problem,
    attempts: Iterable[Attempt],
    *,
    rounds: int = ROUNDS,
    budget: float = BUDGET,
    say: Callable[[Row], None] = lambda row: None,
) -> list[Row]:
    """One row per attempt; `say` is told each after its first run.

    A method that fails keeps its row, with the reason as its status.
    """
    rows: list[Row] = []
    timers: list[tuple[Row, Timer, int]] = []
    for attempt in attempts:
        row = Row(problem.name, attempt.method, attempt.setting, attempt.version, note=attempt.note)
        rows.append(row)
        if attempt.batch is None:
            row.status = attempt.skip
        else:
            try:
                timers.append((row, first_run(problem, attempt.batch, row), attempt.batch.runs()))
            except Exception as error:  # of any peer's library; its text is the row's status
                row.status = f"failed: {sentence(error)}"
        say(row)
    interleave([timer for _, timer, _ in timers], rounds, budget)
    for row, timer, runs in timers:
        row.cpu, row.samples = timer.best / runs, timer.samples
    return rows


def first_run(problem: Problem, batch: Batch, row: Row) -> Timer:
    """Runs the batch once and puts its errors into the row; the timer for what follows.

    A first call may warm up; it counts only where another would take long.
    """
    answers, seconds = timed(batch.answers)
    row.cases = len(answers)
    row.error, row.wrong = problem.error(answers), problem.wrong(answers)
    row.drift, row.steps = problem.energy_drift(answers), batch.steps()
    row.note = "; ".join(text for text in (row.note, batch.said()) if text)
    if math.isnan(row.error):
        row.status = "an answer is missing"
    batch.lengthen(seconds)
    timer = Timer(batch.answers, seconds, spent=seconds) if seconds > LONG else Timer.first(batch.answers)
    row.cpu = timer.best / batch.runs()
    return timer


def sentence(error: BaseException, most: int = 160) -> str:
    """The first line of an exception's text, in bounds, files from the root of the project."""
    text = (str(error).strip() or type(error).__name__).splitlines()[0].replace(f"{ROOT}/", "")
    return text if len(text) <= most else text[: most - 1] + "…"
