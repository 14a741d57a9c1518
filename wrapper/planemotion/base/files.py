"""Files that appear whole or not at all, and what the system says about them."""

from __future__ import annotations

import errno
import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .errors import StudyError

# Endings of pictures, and so their formats.
PICTURES = ("png", "svg", "pdf")
# The same of animations.
ANIMATIONS = ("html", "gif", "mp4")
# The same of reports.
REPORTS = ("html",)
# The same of histories.
HISTORIES = ("h5", "nc", "csv")
_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
_FULL_TEXTS = ("no space left", "quota exceeded", "file too large")  # HDF5 does not always pass the number on


def ending(path: Path, known: Collection[str], what: str) -> str:
    """The ending of a file to be written, without its dot and in small letters; it says in which format.

    Raises StudyError for one that is not among `known`; `what` is written there ("a picture").
    """
    found = path.suffix.removeprefix(".").lower()
    if found in known:
        return found
    choice = ("one of " if len(known) > 1 else "") + ", ".join(f".{word}" for word in known)
    has = f"the ending .{found}" if found else "no ending"
    raise StudyError(f"{path}: has {has}; {what} is written as {choice}")


@contextmanager
def appearing(path: Path, mark: str = "") -> Iterator[Path]:
    """A temporary path beside `path`: what is written there becomes `path` when the context ends well, on the
    disk for good; otherwise nothing of it stays.  `mark`: sets it apart where several processes write `path`.

    Raises StudyError if the disk is full or the place cannot be written.
    """
    temporary = path.with_name(f".{path.name}{mark}.tmp")
    try:
        with disk_errors(path):
            yield temporary
            with open(temporary, "rb") as file:
                os.fsync(file.fileno())
            os.replace(temporary, path)
            sync_folder(path.parent)
    finally:
        with suppress(OSError):  # what went wrong before is what counts
            temporary.unlink()


@contextmanager
def disk_errors(path: Path) -> Iterator[None]:
    """Turns what the system says about `path` into a StudyError."""
    try:
        yield
    except OSError as error:
        if error.errno in _FULL or any(text in str(error).lower() for text in _FULL_TEXTS):
            raise StudyError(
                f"{path}: the disk (or the quota) is full; nothing of this file was kept. "
                "Make room and go on with --resume"
            ) from error
        is_lost = error.errno == errno.ENOENT and not path.parent.is_dir()
        why = f"there is no folder {path.parent}" if is_lost else error.strerror or error
        raise StudyError(f"{path}: cannot be written: {why}") from error


def sync_folder(folder: Path) -> None:
    """Makes a rename in `folder` last through a power cut."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
