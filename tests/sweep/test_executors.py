"""Sweeps by executors: the same bytes whoever computes, in whatever order, and however many workers die."""

from __future__ import annotations

import os
import signal
import struct
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import planemotion
from planemotion.base.errors import StudyError
from planemotion.sweep import chunks, run, spread, task
from planemotion.sweep.plan import plan_sweep
from planemotion.sweep.pools import close_pool
from planemotion.sweep.task import Recipe, compute_block
from tests.scenes.pendulum import THROWN
from tests.sweep.fake import BIG, FakeEngine, FakeScene, data_of
from tests.waiting import HANGS

GRIDS = {"L": {"from": "10 in", "to": "30 in", "num": 40}, "m": ["1 kg", "-1 kg", "2 kg", "3 kg"]}


class Reversed:
    """An executor that computes the last task first, in this process, in bundles of `waiting`."""

    def __init__(self, waiting: int = 5) -> None:
        self._max_workers = self._waiting = waiting
        self._tasks: list[tuple[Future[Any], Callable[..., Any], tuple[Any, ...]]] = []
        self._lock = threading.Lock()
        self.submitted = 0

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Future[Any]:
        future: Future[Any] = Future()
        with self._lock:
            self.submitted += 1
            self._tasks.append((future, function, arguments))
        threading.Timer(0.01, self._work).start()
        return future

    def _work(self) -> None:
        with self._lock:
            tasks, self._tasks = self._tasks, []
            for future, function, arguments in reversed(tasks):
                if not future.set_running_or_notify_cancel():
                    continue
                try:
                    future.set_result(function(*arguments))
                except BaseException as error:
                    future.set_exception(error)


@pytest.fixture(autouse=True)
def short_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """So that a small sweep has many blocks, however fast the machine is."""
    monkeypatch.setattr(spread, "CHUNK_SECONDS", 0.001)
    monkeypatch.setattr(spread, "FIRST_CHUNK", 4)
    monkeypatch.setattr(spread, "GROWTH", 1)


def swept(folder: Path, executor: Any, workers: int | None = None) -> tuple[dict[str, Any], bytes]:
    """What a sweep leaves: the variables of the HDF5 file, and the table."""
    scene = planemotion.load_text(THROWN).grids(GRIDS)
    files = run.sweep_files(scene, folder, executor=executor, workers=workers)
    assert not list(folder.glob("*.parts"))
    return data_of(files.result), files.table.read_bytes()


@pytest.fixture(scope="module")
def by_threads(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], bytes]:
    return swept(tmp_path_factory.mktemp("threads"), None, 2)


@pytest.mark.parametrize("kind", ["threads", "one process", "processes", "last first", "a class"])
def test_the_same_bytes_by_any_executor(
    kind: str, tmp_path: Path, by_threads: tuple[dict[str, Any], bytes]
) -> None:
    executors: dict[str, Any] = {
        "threads": lambda: ThreadPoolExecutor(3),
        "one process": lambda: ProcessPoolExecutor(1),
        "processes": lambda: ProcessPoolExecutor(2),
        "last first": Reversed(),
        "a class": ThreadPoolExecutor,
    }
    assert swept(tmp_path, executors[kind], 2 if kind == "threads" else None) == by_threads


def test_in_memory_too() -> None:
    scene = planemotion.load_text(THROWN)
    executor = Reversed()
    found, expected = scene.sweep(executor=executor, grids=GRIDS), scene.sweep(grids=GRIDS)
    assert executor.submitted > 5
    for data in (found, expected):
        for name in ("created", "elapsed_seconds", "workers"):
            del data.attrs[name]
    assert found.identical(expected)


def test_the_block_function_alone() -> None:
    """Table in, table out: rows do not depend on which others are there."""
    scene = planemotion.load_text(THROWN).grids(GRIDS)
    plan = plan_sweep(scene)
    recipe = Recipe.of(run._study_of(scene, 1, None).solver)
    whole = compute_block(recipe, plan.block(0, plan.cases), 2, 0)
    some = np.array([7, 3, 150, 22])
    table = np.concatenate([plan.block(case, 1) for case in some])
    table.flags.writeable = False
    few = compute_block(recipe, table, 1, 3)
    assert few.value.tobytes() == whole.value[some].tobytes()
    assert few.status.tobytes() == whole.status[some].tobytes()
    assert dict(few.message) == {
        i: whole.message[case] for i, case in enumerate(some) if case in whole.message
    }


def test_a_worker_of_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    recipe = Recipe.of(run._study_of(planemotion.load_text(THROWN), 1, None).solver)
    monkeypatch.setattr(task, "row_versions", lambda: {**dict(recipe.versions), "kernel": "other"})
    with pytest.raises(StudyError, match=r"a worker has kernel other and not [0-9a-f]+"):
        compute_block(recipe, np.zeros((1, 2)), 1, 0)


class Mortal:
    """A pool of processes of which one is killed when so many blocks have come back."""

    def __init__(self, kills: int, every: int = 2) -> None:
        self.kills, self._every = kills, every

    def __call__(self) -> ProcessPoolExecutor:
        pool = ProcessPoolExecutor(2)
        submit, ended = pool.submit, iter(range(1, sys.maxsize))

        def killing(function: Any, /, *arguments: Any) -> Any:
            future = submit(function, *arguments)
            future.add_done_callback(self._count(pool, ended))
            return future

        pool.submit = killing  # type: ignore[method-assign,assignment]
        return pool

    def _count(self, pool: ProcessPoolExecutor, ended: Iterator[int]) -> Callable[[Any], None]:
        def done(future: Any) -> None:
            good = not future.cancelled() and not future.exception()
            if good and self.kills and next(ended) == self._every:
                self.kills -= 1
                os.kill(next(iter(pool._processes)), signal.SIGKILL)

        return done


def test_blocks_of_workers_that_die_are_done_again(
    tmp_path: Path, by_threads: tuple[dict[str, Any], bytes]
) -> None:
    mortal = Mortal(kills=3, every=1)
    assert swept(tmp_path, mortal) == by_threads
    assert mortal.kills == 0


def test_a_worker_that_dies_while_it_writes_holds_up_nothing(
    tmp_path: Path, by_threads: tuple[dict[str, Any], bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pool of the standard library would wait for the rest of its result without end."""
    monkeypatch.setattr(spread, "_NOTICED", 0.2)
    left = iter([True, True])

    class Halting(ProcessPoolExecutor):
        def submit(self, function: Any, /, *arguments: Any) -> Any:  # type: ignore[override]
            halts = arguments[1][0, 0] > 0.5 and next(left, False)
            return super().submit(_die_writing if halts else function, *arguments)

    assert swept(tmp_path, lambda: Halting(2)) == by_threads
    assert not next(left, False)


def _die_writing(*_: Any) -> None:
    frame: Any = sys._getframe()
    while "result_queue" not in frame.f_locals:
        frame = frame.f_back
    os.write(frame.f_locals["result_queue"]._writer.fileno(), struct.pack("!i", 10**6) + b"a half")
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_pool_ends_though_one_of_its_processes_was_killed_and_another_waits() -> None:
    """The one that is stopped stands for one that waits for a lock which the other has taken with it."""
    pool = ProcessPoolExecutor(2)
    assert sorted(pool.map(abs, [-1, -2])) == [1, 2]
    waits, dies = list(pool._processes)
    os.kill(waits, signal.SIGSTOP)
    os.kill(dies, signal.SIGKILL)
    closed = threading.Thread(target=close_pool, args=[pool], daemon=True)
    closed.start()
    closed.join(HANGS)
    assert not closed.is_alive()


def test_a_pool_that_cannot_be_made_again_ends_the_sweep_and_resume_goes_on(
    tmp_path: Path, by_threads: tuple[dict[str, Any], bytes]
) -> None:
    with pytest.raises(StudyError, match=r"a worker has died.*give a function that makes one"):
        swept(tmp_path, Mortal(kills=1, every=5)())
    scene = planemotion.load_text(THROWN).grids(GRIDS)
    files = run.sweep_files(scene, tmp_path, resume=True)
    assert 0 < files.computed < files.cases
    assert (data_of(files.result), files.table.read_bytes()) == by_threads


class Deadly:
    """An executor that never gives a block back in which one of these cases is."""

    def __init__(self, number: int = 2) -> None:
        self._pool = ThreadPoolExecutor(number)

    def submit(self, function: Any, /, *arguments: Any) -> Any:
        swept = arguments[1]
        dies = bool((swept[:, 0] > 0.5).any())
        return self._pool.submit(_die if dies else function, *arguments)


def _die(*_: Any) -> None:
    raise ConnectionError("the worker went away")


def test_cases_that_kill_whoever_computes_them_are_named(tmp_path: Path) -> None:
    said = r"cases \d+ to \d+ were lost 12 times with what computed them \(ConnectionError: the worker went"
    with pytest.raises(StudyError, match=said):
        swept(tmp_path, Deadly())
    assert list(tmp_path.glob("*.parts/part-*"))  # the others stay


def test_what_is_no_executor_is_refused(tmp_path: Path) -> None:
    scene = planemotion.load_text(THROWN)
    with pytest.raises(StudyError, match="executor is int; what has the method submit is wanted"):
        scene.sweep(executor=4)
    with pytest.raises(TypeError, match="executor gives int, which has no method submit"):
        scene.sweep(executor=lambda: 4)


class Late(Reversed):
    """A cluster whose only worker comes late: it counts them as a client of Dask does."""

    def __init__(self, after: float) -> None:
        super().__init__()
        self._comes = time.monotonic() + after

    def nthreads(self) -> dict[str, int]:
        return {"tcp://127.0.0.1:1": 1} if time.monotonic() > self._comes else {}

    def _work(self) -> None:
        time.sleep(max(0.0, self._comes - time.monotonic()))
        super()._work()


def test_a_sweep_says_that_it_waits_for_workers(
    tmp_path: Path, by_threads: tuple[dict[str, Any], bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(spread, "_COUNT_EVERY", 0.05)
    monkeypatch.setattr(spread, "_ALONE", 0.2)
    with pytest.warns(RuntimeWarning, match=r"no worker for 0\.2 s; the sweep waits") as said:
        assert swept(tmp_path, Late(after=1.0)) == by_threads
    assert len(said) == 1


class Thousand:
    """An executor of 1000 workers that compute nothing, and say that a case takes 10 ms."""

    _max_workers = 1000

    def __init__(self, solver: FakeEngine) -> None:
        self.most = self.there = self.tasks = 0
        self._done: list[Future[Any]] = []

    def submit(self, function: Any, /, *arguments: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.tasks += 1
        self.there += 1
        self.most = max(self.most, self.there)
        threading.Timer(0, self._end, (future, function, arguments)).start()
        return future

    def _end(self, future: Future[Any], function: Any, arguments: Any) -> None:
        block = function(*arguments)
        future.set_result(replace(block, seconds=0.01 * len(block)))
        self.there -= 1


def test_a_thousand_workers_have_work_and_none_has_a_large_last_block(
    engine: FakeEngine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(task, "row_versions", dict)
    executor = Thousand(engine)
    sizes = {"d": {"from": "1 in", "to": "6 in", "num": 200}, "w": {"from": 0, "to": "5 rad/s", "num": 200}}
    data = run.run_sweep(FakeScene(sizes), executor=executor)
    assert executor.tasks >= 2000
    assert np.isfinite(data["sum"].values).all()
    assert max(engine.chunks[-500:]) <= 8


def test_ctrl_c_keeps_what_is_stored(
    tmp_path: Path, engine: FakeEngine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(task, "row_versions", dict)
    monkeypatch.setattr(chunks, "POLL", 0.01)
    seen: list[int] = []

    def progress(done: int, total: int) -> None:
        seen.append(done)
        if done > 300:
            raise KeyboardInterrupt

    with pytest.raises(run.SweepInterrupted, match="go on with --resume"):
        run.sweep_files(FakeScene(BIG), tmp_path, executor=lambda: Reversed(2), progress=progress)
    files = run.sweep_files(FakeScene(BIG), tmp_path, resume=True)
    assert files.computed == files.cases - seen[-1]
