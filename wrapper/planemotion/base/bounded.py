"""What comes from outside, read within bounds: files of a bounded size, tables of a bounded depth.

Whatever a bound refuses is told with its place, its size and the bound; nothing larger is kept.
"""

from __future__ import annotations

import errno
import os
import select
import stat
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from .errors import SceneError

# Levels of tables and lists, entries of all of them, characters of a text and of a key: far above what any
# scene needs, and below what recursion, messages and the files of results can take.
MOST_LEVELS = 32
MOST_ENTRIES = 1_000_000
MOST_TEXT = 100_000
MOST_KEY = 200
# An integer of more bits is larger than any double, and Python does not write it out.
_MOST_BITS = 1024
_DIGITS_OF_A_BIT = 0.30103
# A pipe that brings nothing for so long, in s, has nobody at its other end.
_PATIENCE = 10.0
_PIECE = 1 << 16
_CONTAINERS = (Mapping, list, tuple, range)


def read_bytes(path: Path, most: int) -> bytes:
    """What stands in the file, or comes out of the pipe, of at most `most` bytes.

    Raises OSError, whose `strerror` is for people, also for more bytes, for a path that no file can have, and
    for a pipe that brings nothing.
    """
    if "\0" in os.fspath(path):
        raise OSError(errno.EINVAL, "a path has no character NUL")
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        return _read(descriptor, most)
    finally:
        os.close(descriptor)


def _read(descriptor: int, most: int) -> bytes:
    pieces: list[bytes] = []
    left, end = most, time.monotonic() + _PATIENCE
    while True:
        ready, _, _ = select.select([descriptor], [], [], max(0.0, end - time.monotonic()))
        if not ready:
            raise OSError(errno.ETIMEDOUT, f"nothing was written into it for {_PATIENCE:g} s")
        piece = os.read(descriptor, _PIECE)
        left -= len(piece)
        if left < 0:
            raise OSError(errno.EFBIG, f"it is larger than {most} bytes")
        if not piece:
            return b"".join(pieces)
        pieces.append(piece)
        end = time.monotonic() + _PATIENCE


def require_file(path: Path) -> None:
    """Raises OSError for anything but a file: a library that opened a pipe would wait for ever."""
    if "\0" in os.fspath(path):
        raise OSError(errno.EINVAL, "a path has no character NUL")
    mode = path.stat().st_mode
    if not stat.S_ISREG(mode):
        raise OSError(
            errno.EINVAL, "it is a folder" if stat.S_ISDIR(mode) else "it is no file but a device or a pipe"
        )


def shown(text: str) -> str:
    """A text that can be written as UTF-8: bytes of a file's name that are none become `\\xff`."""
    return (
        text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
        if _is_foreign(text)
        else text
    )


def _is_foreign(text: str) -> bool:
    return not text.isascii() and any("\ud800" <= sign <= "\udfff" for sign in text)


def check_table(table: object, path: str = "") -> None:
    """Raises SceneError, with the key path, for what is too deep, too much or too long, and for texts that no
    file can hold.  Goes through tables and lists without recursion; what else there is, it leaves alone."""
    _check_plain(table, lambda: path)
    waiting = [(path, 0, table)] if isinstance(table, _CONTAINERS) else []
    entries = 0
    while waiting:
        place, level, container = waiting.pop()
        entries += len(container)
        if level == MOST_LEVELS:
            raise SceneError(f"tables and lists more than {MOST_LEVELS} levels deep", path=place)
        if entries > MOST_ENTRIES:
            raise SceneError(f"more than {MOST_ENTRIES} entries", path=place)
        keys = isinstance(container, Mapping)
        items = container.items() if isinstance(container, Mapping) else enumerate(container)
        for key, value in items:
            if keys:
                _check_key(key, place)
            if _is_common(value):
                continue
            _check_plain(value, partial(place_of, place, key))
            if isinstance(value, _CONTAINERS):
                waiting.append((place_of(place, key), level + 1, value))


def place_of(path: str, key: object) -> str:
    """The path of a key of a table, or of an index of a list."""
    if isinstance(key, int):
        return f"{path}[{key}]"
    return f"{path}.{key}" if path else str(key)


def _check_key(key: object, path: str) -> None:
    if not isinstance(key, str):
        raise SceneError(f"a key is a text, not {type(key).__name__}", path=path)
    _check_text(key, MOST_KEY, "a key", lambda: path)


def _is_common(value: object) -> bool:
    """A short plain text or a number that no bound refuses, as nearly all of a long grid are."""
    if isinstance(value, str):
        return len(value) <= MOST_KEY and value.isascii() and "\0" not in value
    return isinstance(value, float | bool)


def _check_plain(value: object, place: Callable[[], str]) -> None:
    if isinstance(value, str):
        _check_text(value, MOST_TEXT, "a text", place)
    elif isinstance(value, int) and value.bit_length() > _MOST_BITS:
        digits, most = (int(bits * _DIGITS_OF_A_BIT) + 1 for bits in (value.bit_length(), _MOST_BITS))
        raise SceneError(f"an integer of about {digits} digits; at most {most} are read", path=place())


def _check_text(text: str, most: int, what: str, place: Callable[[], str]) -> None:
    if len(text) > most:
        raise SceneError(f"{what} of {len(text)} characters; at most {most} are read", path=place())
    if "\0" in text or _is_foreign(text):
        reason = f"{what} with a character that no file can hold (NUL, or half of a pair)"
        raise SceneError(reason, path=place())
