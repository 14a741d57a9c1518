"""CPU time per run: least over repetitions that take turns with those of the other methods.

CPU time of the whole process is counted (its threads included), so that other work on the machine costs less
than by the clock.  Taking turns spreads slow phases of the machine over all methods alike.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

T = TypeVar("T")

# Shorter samples are repeated within one reading of the clock, s.
LEAST_SAMPLE = 0.01


@dataclass
class Timer:
    """One method: `call` is timed `repeat` times in a row per sample; `best` is its least, s per call."""

    call: Callable[[], object]
    best: float
    repeat: int = 1
    samples: int = 1
    spent: float = 0.0

    @classmethod
    def first(cls, call: Callable[[], object]) -> Timer:
        """The first sample, which also chooses how often a call is repeated."""
        once = cpu(call)
        return cls(call, once, max(1, round(LEAST_SAMPLE / max(once, 1e-7))), spent=once)

    def sample(self) -> None:
        taken = cpu(self.call, self.repeat)
        self.best = min(self.best, taken / self.repeat)
        self.samples += 1
        self.spent += taken


def timed(call: Callable[[], T]) -> tuple[T, float]:
    """What a call gives, and its CPU seconds."""
    begun = time.process_time()
    result = call()
    return result, time.process_time() - begun


def cpu(call: Callable[[], object], repeat: int = 1) -> float:
    """CPU seconds of `repeat` calls."""
    begun = time.process_time()
    for _ in range(repeat):
        call()
    return time.process_time() - begun


def wall(call: Callable[[], object], repeat: int = 3) -> float:
    """Least seconds by the clock of a call, for what runs on several cores."""
    taken = []
    for _ in range(repeat):
        begun = time.perf_counter()
        call()
        taken.append(time.perf_counter() - begun)
    return min(taken)


def interleave(timers: Sequence[Timer], rounds: int, budget: float) -> None:
    """Further samples of all timers in turn; one that has had `budget` seconds waits out the rest."""
    for _ in range(rounds):
        for timer in timers:
            if timer.spent + timer.best * timer.repeat <= budget:
                timer.sample()
