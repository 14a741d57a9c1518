"""The cases of a sweep computed in chunks, so that a killed sweep can go on.

A chunk is about half a second of work; it is computed by the kernel's threads while the chunk before it is
stored.  No row depends on chunks, workers or interruptions: each is, bit for bit, what a single run with the
same parameter values gives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from threading import Thread

import numpy as np

from .block import Block
from .cases import Study
from .takes import Takes

# Seconds of work per chunk: what a kill may cost, and far more than storing a part takes.
CHUNK_SECONDS = 0.5
# How fast the size of a chunk may grow towards the goal.
GROWTH = 4
FIRST_CHUNK = 8
# Between two looks at progress and at Ctrl-C, and the time the kernel gets to end after Ctrl-C, in s.
POLL = 0.05
_GRACE = 0.7
Progress = Callable[[int, int], None]


class _ChunkCall:
    """A chunk computed in a thread of its own: the main thread shows progress meanwhile, and can stop it."""

    def __init__(self, study: Study, first: int, count: int) -> None:
        self._stop = np.zeros(1, np.int32)
        self._done = np.zeros(len(study.runs) or 1, np.int64)
        self._block: Block | None = None
        self._error: BaseException | None = None

        def compute() -> None:
            try:
                self._block = study.compute(first, count, self._stop, self._done)
            except BaseException as error:
                self._error = error

        # A daemon: a kernel that does not stop in time must not keep the process alive.
        self._thread = Thread(target=compute, daemon=True)
        self._thread.start()

    def wait(self, report: Callable[[int], None]) -> Block:
        """The results; until then `report` gets now and then how many cases are finished."""
        while self._thread.is_alive():
            self._thread.join(POLL)
            report(int(self._done.min()))
        if self._block is None:
            assert self._error is not None
            raise self._error
        return self._block

    def cancel(self) -> None:
        self._stop[0] = 1
        self._thread.join(_GRACE)


class _Pacer:
    """Chooses the size of the next chunk from the time the last one took; `first`: of the first, if known."""

    def __init__(self, workers: int, most: int, first: int | None = None) -> None:
        self._workers = workers
        self._most = most
        self._size = min(first or workers * FIRST_CHUNK, most)

    @property
    def size(self) -> int:
        """Cases of the next chunk."""
        return self._size

    def observe(self, count: int, seconds: float) -> None:
        goal = count * CHUNK_SECONDS / max(seconds, 1e-6)
        # Whole rounds of all workers, so that none waits for the last case of a small chunk.
        rounds = max(1, round(min(goal, self._size * GROWTH) / self._workers))
        self._size = min(rounds * self._workers, self._most)

    def chunks(self, store: Takes) -> Iterator[tuple[int, int]]:
        """First case and number of cases of each chunk; its size is chosen when it is asked for."""
        for first, count in store.gaps():
            end = first + count
            while first < end:
                size = store.fit(first, self._size, end)
                yield first, size
                first += size


def keep(store: Takes, study: Study, first: int, block: Block) -> None:
    """Stores a block.  Raises StudyError if more cases have failed than is allowed."""
    store.add(first, block)
    study.failures.add(first, block)


def fill(store: Takes, study: Study, progress: Progress) -> None:
    """Computes what is missing: each chunk while the one before it is being stored."""
    pacer = _Pacer(study.workers, study.max_chunk, study.kept.chunk.get(study.workers))
    computed: tuple[int, Block] | None = None
    call: _ChunkCall | None = None
    try:
        for first, count in pacer.chunks(store):
            call = _ChunkCall(study, first, count)
            if computed:
                keep(store, study, *computed)
            block = call.wait(lambda finished: progress(store.done + finished, study.plan.cases))
            pacer.observe(count, block.seconds)
            computed = first, block
        if computed:
            keep(store, study, *computed)
        study.kept.chunk[study.workers] = pacer.size
    except BaseException:
        if call:
            call.cancel()
        raise
    progress(store.done, study.plan.cases)
