"""Waiting for what another process does, however busy the machine is."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable

HANGS = 300  # s: a machine with much else to do is not waited for longer


def wait_for(process: subprocess.Popen[str], condition: Callable[[], bool]) -> None:
    """Waits until something is seen of a process that goes on."""
    deadline = time.monotonic() + HANGS
    while not condition():
        assert process.poll() is None, process.stderr.read() if process.stderr else "it has ended"
        assert time.monotonic() < deadline
        time.sleep(0.005)
