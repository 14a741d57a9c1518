"""Calls of the kernel that Ctrl-C ends: in a thread of their own, with a flag that the kernel looks at."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from ..base.arrays import Ints

T = TypeVar("T")
# What the kernel gets to end after Ctrl-C, in s: it looks at the flag in every step of every case.
_GRACE = 2.0


def heard(work: Callable[[Ints], T]) -> T:
    """What work(stop) gives; when Ctrl-C comes, stop [1] is raised and KeyboardInterrupt passed on.

    Only the main thread hears Ctrl-C; in any other the work is done at once.
    """
    stop = np.zeros(1, np.int32)
    if threading.current_thread() is not threading.main_thread():
        return work(stop)
    given: list[T] = []
    fault: list[BaseException] = []

    def do() -> None:
        try:
            given.append(work(stop))
        except BaseException as error:
            fault.append(error)

    thread = threading.Thread(target=do, daemon=True)  # must not keep a process alive
    thread.start()
    try:
        thread.join()
    except KeyboardInterrupt:
        stop[0] = 1
        thread.join(_GRACE)
        raise
    if fault:
        raise fault[0]
    return given[0]
