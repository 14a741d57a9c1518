"""A sweep of 10^9 cases on 1,000 workers, as docs/howto.md tells it: python -m tests.sweep.thousand.

What hands out blocks and stores them is the real one (`sweep/spread.py`), and takes the time that it takes.
Its workers are no more than a clock: a block comes back when its cases would have been computed.  So are the
disk and the network: to receive and to store a block lasts as long as was measured here.  The clock leaps
ahead where all wait, so that hours pass in seconds.
"""

from __future__ import annotations

import heapq
import itertools
import pickle
import random
import tempfile
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from queue import Empty
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np

from planemotion import load
from planemotion.base.arrays import Floats
from planemotion.sweep import spread
from planemotion.sweep.block import Block
from planemotion.sweep.cache import Kept
from planemotion.sweep.cases import Study
from planemotion.sweep.parts import part_at, write_part
from planemotion.sweep.plan import plan_sweep
from tests import ROOT

# Seconds a case, and workers.
SWEEPS = ((1e-4, 30), (1e-4, 100), (1e-4, 1000), (1e-3, 100), (1e-3, 1000), (1e-2, 1000))
# Of two blocks from whose times those of a block and of a case follow.
FEW, MANY = 1 << 10, 1 << 16
REPEAT = 5
HOUR = 3600.0
# A worker dies about once in so many hours.
LIFE = 100 * HOUR
# How much the time of one block differs from that of another of its size.
SPREAD = 0.1


@dataclass(frozen=True)
class Costs:
    """Seconds that the process of the sweep needs for a block: each has its own, and more for every case."""

    received: float
    stored: float
    stored_block: float
    case_bytes: float

    @classmethod
    def measured(cls) -> Costs:
        """Of the sphere over bars with its four answers, on the disk of this folder."""
        study = study_of(MANY)
        few, many = (study.solver.compute(study.plan.block(0, n), workers=1) for n in (FEW, MANY))
        data = pickle.dumps(many)
        with tempfile.TemporaryDirectory(dir=ROOT / "build") as name:
            short, long = (least(partial(store_in, Path(name), block)) for block in (few, many))
        of_case = (long - short) / (MANY - FEW)
        received = least(lambda: pickle.loads(data)) / MANY
        return cls(received, of_case, max(0.0, short - FEW * of_case), len(data) / MANY)


def study_of(cases: int) -> Study:
    scene = load(ROOT / "studies/sphere_over_bars.toml").grids(d={"from": "1 in", "to": "6 in", "num": cases})
    return Study(scene, plan_sweep(scene), 1, Kept())


def store_in(folder: Path, block: Block) -> None:
    part, data = part_at(folder, 0, block)
    write_part(part, data)


def least(action: Callable[[], object]) -> float:
    """Seconds that it takes, of some times the least."""
    spent = []
    for _ in range(REPEAT):
        begun = time.perf_counter()
        action()
        spent.append(time.perf_counter() - begun)
    return min(spent)


class Clock:
    """The time that passes here, and what is added to it."""

    def __init__(self) -> None:
        self._begun = time.perf_counter()
        self._added = 0.0

    def now(self) -> float:
        return time.perf_counter() - self._begun + self._added

    def add(self, seconds: float) -> None:
        self._added += seconds


@dataclass
class Came:
    """A block of a worker: what a sweep uses of it."""

    count: int
    seconds: float
    nbytes: float
    message: dict[int, str] = field(default_factory=dict)

    @property
    def status(self) -> Floats:
        return np.broadcast_to(np.zeros(1), (self.count,))

    def __len__(self) -> int:
        return self.count


@dataclass
class Given:
    """A task that waits for a worker, and since when."""

    future: Future[Any]
    count: int
    since: float


class Workers:
    """An executor as those of `concurrent.futures`; `of_case`: seconds that a worker needs for a case."""

    def __init__(self, clock: Clock, number: int, of_case: float, costs: Costs, life: float = LIFE) -> None:
        self._max_workers = number
        self._clock, self._of_case, self._costs, self._life = clock, of_case, costs, life
        self._chance = random.Random(1)
        self._free = number
        self._waiting: deque[Given] = deque()
        self._at_work: list[tuple[float, int, Given]] = []  # by when they end
        self._order = itertools.count()
        self.ended: deque[Any] = deque()  # what the sweep has not looked at yet
        self.tasks = self.deaths = self.held = self.most_held = self.longest = 0
        self.busy = 0.0

    def submit(self, function: Any, /, *arguments: Any) -> Future[Any]:
        """The block is never computed: its number of cases tells how long it would take."""
        del function
        given = Given(Future(), len(arguments[1]), self._clock.now())
        self.tasks += 1
        self._hold(given.count)
        self._waiting.append(given)
        self._begin(given.since)
        return given.future

    def _begin(self, now: float) -> None:
        while self._free and self._waiting:
            given = self._waiting.popleft()
            needs = given.count * self._of_case * self._chance.uniform(1 - SPREAD, 1 + SPREAD)
            self._free -= 1
            self.busy += needs
            heapq.heappush(self._at_work, (max(now, given.since) + needs, next(self._order), given))

    def come(self, leap: bool) -> None:
        """What ends until now is over, its workers take the next; `leap`: to the next end, if none has."""
        begun = time.perf_counter()
        if leap and self._at_work:
            self._clock.add(max(0.0, self._at_work[0][0] - self._clock.now()))
        now = self._clock.now()
        while self._at_work and self._at_work[0][0] <= now:
            end, _, given = heapq.heappop(self._at_work)
            self._free += 1
            self._end(given)
            self._begin(end)
        self._clock.add(begun - time.perf_counter())  # what this takes is no time of the sweep

    def _end(self, given: Given) -> None:
        seconds = given.count * self._of_case
        if self._chance.random() < seconds / self._life:
            self.deaths += 1
            given.future.set_exception(ConnectionError("the worker has died"))
            self._hold(-given.count)
        else:
            given.future.set_result(Came(given.count, seconds, given.count * self._costs.case_bytes))

    def _hold(self, cases: int) -> None:
        self.longest = max(self.longest, cases)
        self.held += cases
        self.most_held = max(self.most_held, self.held)

    # ---- as the queue in which the sweep finds what has ended ----

    def put(self, item: Any) -> None:
        self.ended.append(item)

    def get(self, timeout: float) -> Any:
        del timeout
        self.come(leap=not self.ended)
        return self.get_nowait()

    def get_nowait(self) -> Any:
        self.come(leap=False)
        if not self.ended:
            raise Empty
        return self.ended.popleft()

    def store(self, cases: int) -> None:
        """What the process of the sweep does with a block that came."""
        self._hold(-cases)
        self._clock.add(cases * (self._costs.received + self._costs.stored) + self._costs.stored_block)


class Store:
    """Where blocks are stored: nowhere, in the time that it takes."""

    def __init__(self, workers: Workers, cases: int) -> None:
        self._workers, self._cases = workers, cases
        self.done = 0

    @property
    def missing(self) -> int:
        return self._cases - self.done

    def gaps(self) -> list[tuple[int, int]]:
        return [(0, self._cases)]

    def fit(self, first: int, count: int, end: int) -> int:
        return min(count, end - first)

    def add(self, first: int, block: Any) -> None:
        del first
        self.done += len(block)
        self._workers.store(len(block))


@dataclass(frozen=True)
class Found:
    """How a sweep went: seconds by the clock, and parts of them in which workers and own process work."""

    seconds: float
    efficiency: float
    own: float
    tasks: int
    deaths: int
    longest: float  # block, s
    gigabytes: float  # of blocks that were with the workers or waited to be stored, at most


def simulate(cases: int, number: int, of_case: float, costs: Costs, life: float = LIFE) -> Found:
    """A sweep by `number` workers that need `of_case` seconds for a case."""
    clock = Clock()
    workers = Workers(clock, number, of_case, costs, life)
    store = Store(workers, cases)
    study: Any = SimpleNamespace(
        plan=SimpleNamespace(
            cases=cases, names=["d"], block=lambda first, count: np.broadcast_to(np.zeros(1), (count, 1))
        ),
        solver=None,
        workers=1,
        max_chunk=study_of(2).max_chunk,
        failures=SimpleNamespace(add=lambda first, block: None),
    )
    times = SimpleNamespace(perf_counter=clock.now, monotonic=clock.now)
    begun = time.perf_counter()
    with patch.multiple(spread, time=times, SimpleQueue=lambda: workers):
        spread.fill_by(store, study, workers, lambda done, total: None)
    assert store.done == cases
    seconds = clock.now()
    storing = cases * (costs.received + costs.stored) + workers.tasks * costs.stored_block
    return Found(
        seconds,
        cases * of_case / (number * seconds),
        (storing + time.perf_counter() - begun) / seconds,
        workers.tasks,
        workers.deaths,
        workers.longest * of_case,
        workers.most_held * costs.case_bytes / 1e9,
    )


def main() -> None:
    costs = Costs.measured()
    print(
        f"received {1e6 * costs.received:.3f} us a case, stored {1e6 * costs.stored:.3f} us a case and "
        f"{1e3 * costs.stored_block:.2f} ms a block, {costs.case_bytes:.0f} bytes a case"
    )
    print(
        "a case   workers     clock   workers busy   own process busy   tasks   longest block   held   died"
    )
    for of_case, number in SWEEPS:
        found = simulate(10**9, number, of_case, costs)
        print(
            f"{1e3 * of_case:5g} ms {number:8} {found.seconds / HOUR:8.2f} h "
            f"{100 * found.efficiency:12.1f} % {100 * found.own:16.1f} % {found.tasks:10} "
            f"{found.longest:13.1f} s {found.gigabytes:6.2f} GB {found.deaths:4}"
        )


if __name__ == "__main__":
    main()
