"""Changed scenes through load, check, explain, run and record, in processes that may fall or hang.

Each mutation has a number, from which alone it follows: `python -m tests.stress --only N` does it again.
"""

from __future__ import annotations

import contextlib
import gc
import io
import math
import multiprocessing
import random
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Any

from tests import ROOT
from tests.stress.mutate import mutated

if TYPE_CHECKING:
    from planemotion import Scene

# s of computing time for each run of a scene: one in forty would take longer, and these would take most of
# the time of all; and s of the clock, where others use the machine too, until a scene counts as a hang.
MOST_CPU, HANG = 0.01, 60.0
# Outcomes that must not be.
WRONG = ("crash", "traceback", "hang", "not finite")


@dataclass
class Table:
    """How many mutations ended how; number, outcome and detail of those that ended as none may."""

    outcomes: Counter[str] = field(default_factory=Counter)
    wrong: list[tuple[int, str, str]] = field(default_factory=list)
    slowest: tuple[float, int] = (0.0, 0)

    def add(self, number: int, outcome: str, detail: str, seconds: float) -> None:
        self.outcomes[outcome] += 1
        self.slowest = max(self.slowest, (seconds, number))
        if outcome in WRONG:
            self.wrong.append((number, outcome, detail))


@cache
def sources() -> tuple[str, ...]:
    """The scenes that are changed."""
    files = sorted(ROOT.glob("studies/**/*.toml"))
    return tuple(file.read_text(encoding="utf-8") for file in files)


def scene(number: int) -> str:
    """The changed scene of that number."""
    chosen = random.Random(number)
    return mutated(chosen.choice(sources()), chosen)


def outcome(text: str) -> tuple[str, str]:
    """What becomes of a scene, in a word, and what is known of it.  A traceback is an outcome, too."""
    from planemotion import PlanemotionError, SceneError

    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("ignore")
            return _answered(text)
    except SceneError as error:
        return "told", str(error)
    except PlanemotionError as error:
        return "failed", str(error)
    except Exception:
        return "traceback", traceback.format_exc()


def _answered(text: str) -> tuple[str, str]:
    from planemotion.engine import call
    from planemotion.report import explain as explanations
    from planemotion.run import simulate
    from planemotion.sweep.plan import plan_sweep

    read = _read(text)
    if read.data.sweep.grids:
        plan_sweep(read)
    explanations.check(read)
    explanations.explain(read)
    result = simulate(read)
    explanations.explain_run(read, result)
    result.to_json()
    for flat in read.tables(history=True):
        call.trace(flat, flat.defaults)
    if result.status == "ok" and not all(_finite(ask.value) for ask in result.asks.values()):
        return "not finite", str(result.asks)
    return result.status, result.error


def _read(text: str) -> Scene:
    """What load_text reads, with a limit of computing time where the text has none; validated once."""
    from planemotion import Scene, file

    table = file.parse_toml(text, None)
    solve = table.setdefault("solve", {})
    if isinstance(solve, dict):
        solve.setdefault("max_cpu", f"{MOST_CPU} s")
    scene = Scene.from_table(table, text=text)
    scene.data  # noqa: B018 - faults are to be found when it is read
    return scene


def _finite(value: Any) -> bool:
    numbers = value if isinstance(value, list) else [value]
    return all(number is None or math.isfinite(number) for number in numbers)


def _work(pipe: Connection) -> None:
    """Outcomes of the numbers that come, until none comes any more."""
    gc.freeze()  # what is there stays: it need not be looked through for garbage
    while (number := pipe.recv()) is not None:
        pipe.send((number, *outcome(scene(number))))


@dataclass
class _Worker:
    """A process, the number that it has, and since when."""

    process: Any
    pipe: Connection
    number: int = -1
    since: float = 0.0

    @classmethod
    def start(cls) -> _Worker:
        context = multiprocessing.get_context("fork")
        mine, other = context.Pipe()
        process = context.Process(target=_work, args=(other,), daemon=True)
        process.start()
        other.close()
        return cls(process, mine)

    def give(self, number: int) -> None:
        self.number, self.since = number, time.monotonic()
        self.pipe.send(number)

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def fuzz(numbers: Sequence[int], jobs: int) -> Iterator[tuple[int, str, str, float]]:
    """Number, outcome, what is known of it and seconds of each mutation, as they end."""
    import planemotion.report.explain  # noqa: F401 - once, for all processes

    sources()
    left = iter(numbers)
    busy: list[_Worker] = []
    for number in left:
        busy.append(_Worker.start())
        busy[-1].give(number)
        if len(busy) == jobs:
            break
    while busy:
        ready = wait([worker.pipe for worker in busy], timeout=1.0)
        for worker in list(busy):
            seconds = time.monotonic() - worker.since
            if worker.pipe not in ready and seconds < HANG:
                continue
            yield _ended(worker, ready, seconds)
            busy.remove(worker)
            alive = worker.pipe in ready and worker.process.is_alive() and not worker.pipe.closed
            following = next(left, None)
            if following is None or not alive:
                worker.end()
            if following is not None:
                busy.append(worker if alive else _Worker.start())
                busy[-1].give(following)


def _ended(worker: _Worker, ready: Sequence[Any], seconds: float) -> tuple[int, str, str, float]:
    if worker.pipe not in ready:
        return worker.number, "hang", f"more than {HANG:g} s", seconds
    try:
        number, word, detail = worker.pipe.recv()
    except EOFError:
        worker.process.join()
        return worker.number, "crash", f"exit status {worker.process.exitcode}", seconds
    return number, word, detail, seconds
