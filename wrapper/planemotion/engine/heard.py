"""Calls of the kernel that Ctrl-C ends: a thread waits for the signal and raises the flag that they read.

Python's own handler of a signal waits until the kernel returns, but the signal's number is written into a
pipe at once (`signal.set_wakeup_fd`).  So the kernel runs in the calling thread, and to listen costs some
microseconds: a thread for each call would cost more than many a run.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import TypeVar

import numpy as np

from ..base.arrays import Ints

T = TypeVar("T")
_MOST_SIGNALS = 64  # that are read at once


def heard(work: Callable[[Ints], T]) -> T:
    """What work(stop) gives; when Ctrl-C comes, stop [1] is raised, and KeyboardInterrupt when it returns.

    Only the main thread hears Ctrl-C, and only where that is to raise KeyboardInterrupt; else `stop` stays 0.
    """
    stop = np.zeros(1, np.int32)
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return work(stop)
    watch = _watch(os.getpid())
    watch.begin(stop)
    try:
        return work(stop)
    finally:
        watch.end()


class _Watch:
    """A thread that sleeps on a pipe into which signals are written."""

    def __init__(self) -> None:
        self._read, self._write = os.pipe()
        os.set_blocking(self._write, False)
        self._stop: Ints | None = None
        self._other = -1  # where signals went before, such as to an event loop: they go on there
        threading.Thread(target=self._wait, daemon=True, name="planemotion Ctrl-C").start()

    def begin(self, stop: Ints) -> None:
        self._stop = stop
        self._other = signal.set_wakeup_fd(self._write, warn_on_full_buffer=False)

    def end(self) -> None:
        signal.set_wakeup_fd(self._other)
        self._stop = None

    def _wait(self) -> None:
        while signals := os.read(self._read, _MOST_SIGNALS):
            stop, other = self._stop, self._other
            if stop is not None and signal.SIGINT in signals:
                stop[0] = 1
            if other >= 0:
                with suppress(OSError):
                    os.write(other, signals)


@cache
def _watch(process: int) -> _Watch:
    """The one of this process: a thread does not live on in a child."""
    return _Watch()
