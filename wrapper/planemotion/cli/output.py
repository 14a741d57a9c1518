"""Files that a command claims before its work."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..base.errors import StudyError
from ..base.files import appearing


class _NothingWritten(Exception):
    """Leaves a claimed place as it was."""


@contextmanager
def claimed(path: Path) -> Iterator[Path]:
    """A temporary file beside `path`, made at once; what is written there becomes `path` when the block ends.

    If nothing was written, or the block raised, `path` stays as it was.  Devices and pipes are written
    directly.  Raises StudyError if the place cannot be written.
    """
    if path.is_dir():
        raise StudyError(f"{path}: is a folder; a file is wanted")
    if path.exists() and not path.is_file():
        yield path
        return
    if not path.parent.is_dir():
        raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
    with suppress(_NothingWritten), appearing(path.resolve()) as temporary:
        temporary.touch()
        yield temporary
        if temporary.stat().st_size == 0:
            raise _NothingWritten
