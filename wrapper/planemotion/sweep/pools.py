"""Pools of processes that do not notice the death of one of their processes.

The processes of a `concurrent.futures.ProcessPoolExecutor` share one pipe for their results.  A process that
is killed while it writes leaves half a result there, and the pool waits for the other half without end.  Its
pipe must lose all its writers for the pool to see that it is broken.
"""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from multiprocessing.process import BaseProcess
from typing import Any, TypeGuard

# Between two looks at whether a process of a pool that ends has died, in s.
_LOOK = 0.05


def has_dead_process(executor: object) -> TypeGuard[ProcessPoolExecutor]:
    """Whether it is a pool that counts itself as whole and has a process that has ended."""
    if not isinstance(executor, ProcessPoolExecutor) or executor._broken:  # type: ignore[attr-defined]
        return False
    return any(process.exitcode is not None for process in _processes_of(executor))


def break_pool(executor: ProcessPoolExecutor) -> None:
    """Ends the writers of its results: the other processes and this one's end of the pipe.

    The pool sees that at once, and its futures raise BrokenProcessPool.
    """
    _kill(_processes_of(executor))
    executor._result_queue._writer.close()  # type: ignore[attr-defined]


def close_pool(executor: ProcessPoolExecutor) -> None:
    """Ends a pool and waits for it.

    A process that is killed just then may hold the lock of the queue on which the others wait, and the pool
    waits for them without end.  All work is done by then, so they are ended, too.
    """
    processes = _processes_of(executor)
    manager: Any = executor._executor_manager_thread  # type: ignore[attr-defined]
    executor.shutdown(wait=False)
    while manager is not None and manager.is_alive():
        manager.join(_LOOK)
        if any(process.exitcode for process in processes):
            _kill(processes)


def _processes_of(executor: ProcessPoolExecutor) -> list[BaseProcess]:
    """Those that it has begun; a pool that was shut down has none."""
    return list((executor._processes or {}).values())


def _kill(processes: list[BaseProcess]) -> None:
    for process in processes:
        process.kill()
