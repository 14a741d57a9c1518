"""Pools of processes that do not notice the death of one of their processes.

The processes of a `concurrent.futures.ProcessPoolExecutor` share one pipe for their results.  A process that
is killed while it writes leaves half a result there, and the pool waits for the other half without end.  Its
pipe must lose all its writers for the pool to see that it is broken.
"""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from typing import TypeGuard


def has_dead_process(executor: object) -> TypeGuard[ProcessPoolExecutor]:
    """Whether it is a pool that counts itself as whole and has a process that has ended."""
    if not isinstance(executor, ProcessPoolExecutor) or executor._broken:  # type: ignore[attr-defined]
        return False
    return any(process.exitcode is not None for process in list((executor._processes or {}).values()))


def break_pool(executor: ProcessPoolExecutor) -> None:
    """Ends the writers of its results: the other processes and this one's end of the pipe.

    The pool sees that at once, and its futures raise BrokenProcessPool.
    """
    for process in list((executor._processes or {}).values()):
        process.kill()
    executor._result_queue._writer.close()  # type: ignore[attr-defined]
