"""The cases of a sweep computed by an executor: processes, a cluster, whatever gives futures of functions.

An executor has `submit(function, *arguments)`, as those of `concurrent.futures` have; what it gives has
`add_done_callback` and `result`.  A block is lost with the worker that computes it, and is then done again.
The process of the sweep alone stores what the workers give back, so they need no common disk.
"""

from __future__ import annotations

import math
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import Any, Protocol, TypeAlias, TypeGuard

from ..base.errors import PlanemotionError, StudyError
from .block import Block
from .cases import Study
from .chunks import CHUNK_SECONDS, FIRST_CHUNK, GROWTH, POLL, Progress, keep
from .pools import break_pool, close_pool, has_dead_process
from .size import memory
from .takes import Takes
from .task import Recipe, compute_block

# Blocks that are with the executor at once, for each worker: one that it computes, one that waits.
_AHEAD = 2
# Workers of an executor that does not tell how many it has.
_UNKNOWN_WORKERS = 32
# Between two looks at how many workers there are, in s: clusters grow and shrink.
_COUNT_EVERY = 5.0
# An executor without workers is waited for; after this time, in s, that is said.
_ALONE = 30.0
# A pool of processes has this time to notice that one of them has died, in s.
_NOTICED = 3.0
# A block takes so many times as long as this process needs for one block of each worker: it must never wait.
_SLACK = 3
# The longest block, in s: what a dead worker may cost.
_LONGEST = 60.0
# The smallest of the last blocks, as part of the others: each costs this process time, too.
_LAST = 1 / 8
# The part of this machine's memory that blocks may take that were handed out and are not stored yet.
_HELD = 1 / 8
# How often a block may be lost before it counts as what kills the workers.
_TRIES = 12


class Executor(Protocol):
    """What computes: an executor of `concurrent.futures`, a `dask.distributed.Client` and the like."""

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Any:
        """Begins function(*arguments) somewhere, and gives its future."""


# An executor, or what makes one: that is used again when the workers of the last one have died.
ExecutorLike: TypeAlias = Executor | Callable[[], Executor]


def is_executor(given: object) -> TypeGuard[Executor]:
    """Whether it is an executor, and not what makes one, such as a class."""
    return hasattr(given, "submit") and not isinstance(given, type)


@dataclass
class _Task:
    """Consecutive cases, and how often they were lost."""

    first: int
    count: int
    lost: int = 0


def fill_by(store: Takes, study: Study, executor: ExecutorLike, progress: Progress) -> None:
    """Computes what is missing; `study.workers` threads for each block.

    Raises StudyError if blocks are lost again and again.  What else a block raises ends the sweep; blocks
    that were stored stay.
    """
    with ExitStack() as stack:
        crew = _Crew(executor, stack)
        work = _Work(store, study, crew)
        try:
            while work.fill():
                progress(store.done, study.plan.cases)
                work.take()
        finally:
            work.cancel()
    progress(store.done, study.plan.cases)


class _Crew:
    """The executor, made anew where that is possible when it breaks, and its number of workers."""

    def __init__(self, executor: ExecutorLike, stack: ExitStack) -> None:
        self._stack = stack
        self._make: Callable[[], Executor] | None = None
        if is_executor(executor):
            self._executor = executor
        else:
            assert callable(executor)
            self._make = executor
            self._executor = self._made()
        self._counted = -math.inf
        self._workers = 1
        self._alone = math.inf  # since when no worker is there
        self._died = math.inf  # when a process was first seen dead that the pool had not noticed
        self.number = 0  # of executors that have broken

    def submit(self, *arguments: Any) -> Any:
        return self._executor.submit(compute_block, *arguments)

    @property
    def workers(self) -> int:
        """How many there are, as of some seconds ago; 1 where there is none yet."""
        if time.monotonic() - self._counted > _COUNT_EVERY:
            self._workers, self._counted = _workers_of(self._executor), time.monotonic()
            self._miss()
        return max(1, self._workers)

    def _miss(self) -> None:
        """Says, once, that an executor has had no worker for long: the sweep would seem to hang."""
        if self._workers:
            self._alone = math.inf
            return
        self._alone = min(self._alone, self._counted)
        if self._counted - self._alone >= _ALONE:
            self._alone = math.nan  # a comparison with it is false: said
            text = f"the executor has had no worker for {_ALONE:g} s; the sweep waits until one comes"
            warnings.warn(text, RuntimeWarning, stacklevel=2)

    def notice(self) -> None:
        """Breaks a pool of processes that goes on waiting for one that has died."""
        if not has_dead_process(self._executor):
            self._died = math.inf
            return
        self._died = min(self._died, time.monotonic())
        if time.monotonic() > self._died + _NOTICED:
            break_pool(self._executor)

    def renew(self, number: int) -> None:
        """Another executor in place of that with this number, which is broken; StudyError if none is left."""
        if number != self.number:  # another of its blocks has told that before
            return
        if self._make is None:
            raise StudyError(
                "a worker has died, and its executor with it; give a function that makes one, such as "
                "executor=lambda: ProcessPoolExecutor(4), and the sweep goes on with the next one"
            )
        self._executor, self._counted = self._made(), -math.inf
        self.number += 1

    def _made(self) -> Executor:
        assert self._make is not None
        executor = self._make()
        if not is_executor(executor):
            raise TypeError(f"executor gives {type(executor).__name__}, which has no method submit")
        if isinstance(executor, ProcessPoolExecutor):
            self._stack.callback(close_pool, executor)
        elif hasattr(executor, "__exit__"):
            self._stack.enter_context(executor)  # type: ignore[arg-type]
        return executor


def _workers_of(executor: Any) -> int:
    """The workers of an executor, by the words that executors have for it."""
    if callable(getattr(executor, "nthreads", None)):  # of a client of Dask: by worker
        return sum(executor.nthreads().values())
    for name in ("num_workers", "max_workers", "_max_workers"):
        found = getattr(executor, name, None)
        if isinstance(found, int) and found > 0:
            return found
    return _UNKNOWN_WORKERS


class _Work:
    """Which blocks are with the executor, which come next, and how large they are."""

    def __init__(self, store: Takes, study: Study, crew: _Crew) -> None:
        self._store, self._study, self._crew = store, study, crew
        self._recipe = Recipe.of(study.solver)
        self._left = store.missing  # cases that no task has yet
        self._size = FIRST_CHUNK
        self._new = self._tasks()
        self._again: deque[_Task] = deque()
        self._running: dict[int, Any] = {}
        self._ended: SimpleQueue[tuple[_Task, int, Any]] = SimpleQueue()
        self._storing = 0.0  # seconds that this process needs for a block

    def fill(self) -> bool:
        """Gives the executor as many blocks as it is to have; whether it has any."""
        while len(self._running) < _AHEAD * self._crew.workers:
            task = self._again.popleft() if self._again else next(self._new, None)
            if task is None:
                break
            self._submit(task)
        return bool(self._running or self._again)

    def take(self) -> None:
        """Stores the blocks that have come, or waits some time for one."""
        try:
            self._end(*self._ended.get(timeout=POLL))
        except Empty:
            self._crew.notice()
            return
        with suppress(Empty):
            while True:
                self._end(*self._ended.get_nowait())

    def cancel(self) -> None:
        """What has not begun shall not begin."""
        for future in self._running.values():
            future.cancel()

    def _tasks(self) -> Iterator[_Task]:
        """New blocks; the size of each is chosen when it is asked for, and the last ones are small."""
        for first, count in self._store.gaps():
            end = first + count
            while first < end:
                share = math.ceil(self._left / (_AHEAD * self._crew.workers))
                last = max(1, share, round(_LAST * self._size))
                size = self._store.fit(first, min(self._size, last), end)
                yield _Task(first, size)
                first += size
                self._left -= size

    def _submit(self, task: _Task) -> None:
        swept = self._study.plan.block(task.first, task.count)
        number = self._crew.number
        try:
            future = self._crew.submit(self._recipe, swept, self._study.workers, task.lost)
        except BrokenExecutor as error:
            self._lose(task, number, error)
            return
        self._running[id(task)] = future
        future.add_done_callback(lambda ended: self._ended.put((task, number, ended)))

    def _end(self, task: _Task, number: int, future: Any) -> None:
        """Stores what a task gave."""
        begun = time.perf_counter()
        self._running.pop(id(task), None)
        try:
            block = future.result()
        except PlanemotionError:  # of the scene, or of this installation: to do it again helps nothing
            raise
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # those of asyncio are no Exception
            self._lose(task, number, error)
            return
        keep(self._store, self._study, task.first, block)
        spent = time.perf_counter() - begun
        self._storing = spent if not self._storing else 0.9 * self._storing + 0.1 * spent
        self._pace(block)

    def _pace(self, block: Block) -> None:
        wanted = max(CHUNK_SECONDS, _SLACK * self._crew.workers * self._storing)
        goal = len(block) * min(wanted, _LONGEST) / max(block.seconds, 1e-6)
        of_case = block.nbytes / len(block) + 8 * len(self._study.plan.names)
        held = _HELD * memory() / (_AHEAD * self._crew.workers * of_case)
        self._size = max(1, min(round(goal), self._size * GROWTH, self._study.max_chunk, round(held)))

    def _lose(self, task: _Task, number: int, error: BaseException) -> None:
        """A block that did not come back is done again."""
        task.lost += 1
        if task.lost >= _TRIES:
            cases = f"cases {task.first} to {task.first + task.count - 1}"
            why = f"{type(error).__name__}: {error}".rstrip(": ")
            raise StudyError(f"{cases} were lost {task.lost} times with what computed them ({why})")
        if isinstance(error, BrokenExecutor):
            self._crew.renew(number)
        self._again.append(task)
