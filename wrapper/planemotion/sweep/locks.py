"""The folder of a sweep and its locks: one sweep alone, or the shards of one sweep beside each other."""

from __future__ import annotations

import fcntl
import os
import socket
import time
from contextlib import suppress
from pathlib import Path

from ..base.errors import StudyError
from ..base.files import disk_errors
from .shard import Shard

# Between two looks at what other shards have stored, in s.
LOOK_EVERY = 5.0


class OutputLock:
    """Keeps a second sweep out of a folder.

    The lock itself is the system's (flock), so it ends with the process however that ends; the text in the
    file only tells a second sweep whom it meets.
    """

    name = "sweep.lock"
    _how = fcntl.LOCK_EX

    def __init__(self, folder: Path) -> None:
        self.path = folder / self.name
        self._descriptor: int | None = None

    def acquire(self) -> None:
        """Raises StudyError if another sweep holds the lock."""
        while self._descriptor is None:
            descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
            try:
                fcntl.flock(descriptor, self._how | fcntl.LOCK_NB)
            except BlockingIOError:
                owner = os.read(descriptor, 1000).decode(errors="replace").strip()
                os.close(descriptor)
                raise StudyError(self._refusal(owner or "just started")) from None
            except OSError:
                os.close(descriptor)
                raise
            if self._is_current(descriptor):
                self._descriptor = descriptor
            else:  # its owner removed the file between our open and our lock
                os.close(descriptor)
        os.ftruncate(self._descriptor, 0)
        os.write(self._descriptor, _owner().encode())

    def release(self) -> None:
        if self._descriptor is not None:
            self.path.unlink(missing_ok=True)
            os.close(self._descriptor)
            self._descriptor = None

    def _refusal(self, owner: str) -> str:
        return (
            f"{self.path.parent}: another sweep writes into this folder ({owner}); "
            "wait until it ends, or give another --out"
        )

    def _is_current(self, descriptor: int) -> bool:
        try:
            return os.path.samestat(os.fstat(descriptor), os.stat(self.path))
        except FileNotFoundError:
            return False


class _CommonLock(OutputLock):
    """The same file held by all shards together: it stays when one of them ends."""

    _how = fcntl.LOCK_SH

    def release(self) -> None:
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None


class _OneShardLock(OutputLock):
    """Keeps a second process away from the same shard."""

    def __init__(self, folder: Path, shard: Shard) -> None:
        super().__init__(folder)
        self.path = folder / f"shard-{shard.mark}.lock"
        self._shard = shard

    def _refusal(self, owner: str) -> str:
        return f"{self.path.parent}: shard {self._shard} is being computed already ({owner})"


class ShardLock:
    """Keeps whole sweeps out of a folder, and others away from this shard; other shards may come."""

    def __init__(self, folder: Path, shard: Shard) -> None:
        self._locks = (_CommonLock(folder), _OneShardLock(folder, shard))

    def acquire(self) -> None:
        """Raises StudyError if a sweep as a whole, or this shard, is being computed there."""
        for lock in self._locks:
            lock.acquire()

    def release(self) -> None:
        for lock in self._locks:
            lock.release()


class OutputFolder:
    """A folder that is made where it is missing, and locked until it is left; `shard`: for this one alone."""

    def __init__(self, path: Path, shard: Shard | None) -> None:
        self.path = path
        self._lock = ShardLock(path, shard) if shard else OutputLock(path)
        self._made = False

    def enter(self) -> None:
        """Raises StudyError if the folder cannot be written, or another sweep runs there."""
        if self.path.exists() and not self.path.is_dir():
            raise StudyError(f"{self.path}: is a file; --out wants a folder")
        with disk_errors(self.path):
            self._made = not self.path.exists()
            self.path.mkdir(parents=True, exist_ok=True)
            self._lock.acquire()

    def leave(self) -> None:
        """A folder that was made goes again if nothing is in it."""
        self._lock.release()
        if self._made:
            with suppress(OSError):  # holds results
                self.path.rmdir()

    def remove_shard_locks(self) -> None:
        """To be called when nothing of the result is missing any more."""
        for lock in self.path.glob("shard-*-of-*.lock"):
            lock.unlink(missing_ok=True)


def wait_until_free(folder: Path) -> None:
    """Waits until no sweep and no shard writes into the folder."""
    with suppress(FileNotFoundError), open(folder / OutputLock.name, "rb+") as file:
        fcntl.flock(file, fcntl.LOCK_EX)


def _owner() -> str:
    return f"process {os.getpid()} on {socket.gethostname()}, since {time.strftime('%Y-%m-%d %H:%M:%S')}"
