"""How much a sweep leaves behind, known before it is computed, and whether there is room for it."""

from __future__ import annotations

import math
import os
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import SceneError, StudyError
from ..base.words import counted
from .layout import Layout

# Bytes of a number in the table, with its comma: with all its digits, and with those that an error has.
_EXACT, _SHORT = 19, 9
# Bytes of what HDF5 has beside the numbers, roughly: names, attributes, the text of the scene.
_FRAME = 25_000
# The parts are there until the whole result is; in memory the blocks are there until they are joined.
EXTRA = 2
_UNITS = ("bytes", "kB", "MB", "GB", "TB", "PB", "EB")


@dataclass(frozen=True)
class Size:
    """What a sweep of `cases` cases leaves: bytes of the HDF5 and of the CSV file."""

    cases: int
    result: int
    table: int

    @property
    def text(self) -> str:
        """For people."""
        files = f"about {readable(self.result)} of HDF5 and {readable(self.table)} of CSV"
        return f"{counted(self.cases, 'case')}, {files}"


def expected_size(layout: Layout) -> Size:
    """The size of what a sweep leaves, without messages of cases that fail."""
    sizes = layout.dimensions
    grid = len(layout.dims)
    of_case = 0
    for one in layout.variables():
        if one.data is None and one.dtype is not None:
            count = math.prod(sizes[dim] for dim in one.dims[grid:])
            of_case += count * np.dtype(one.dtype).itemsize
    answers = sum(ask.count for ask in layout.asks)
    row = _EXACT * (len(layout.coordinates) + answers) + _SHORT * layout.estimate * (len(layout.asks) + 1)
    return Size(layout.cases, _FRAME + layout.cases * of_case, layout.cases * row)


def readable(size: float) -> str:
    """A number of bytes for people: "3.2 GB"."""
    power = min(len(_UNITS) - 1, int(math.log10(size) // 3)) if size >= 1 else 0
    return f"{size / 1000**power:.3g} {_UNITS[power]}"


def check_cases(size: Size, most: int, file: str | None) -> None:
    """Raises SceneError for more cases than solve.max_cases."""
    if size.cases > most:
        raise SceneError(
            f"{size.text}; at most {most} cases are computed where solve.max_cases says nothing else: "
            f"give solve.max_cases = {size.cases} if they are meant",
            file=file,
            path="sweep",
        )


def check_disk(size: Size, folder: Path) -> None:
    """Raises StudyError if the disk of `folder`, which need not exist yet, has no room for the result."""
    place = next(parent for parent in (folder.absolute(), *folder.absolute().parents) if parent.exists())
    needed, free = EXTRA * size.result + size.table, shutil.disk_usage(place).free
    if needed > free:
        raise StudyError(
            f"{folder}: {size.text}: {readable(needed)} are needed on the way, and "
            f"{readable(free)} are free there; "
            "give another --out, or sweep less"
        )


def memory() -> int:
    """Bytes of memory of this machine."""
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def check_memory(size: Size) -> None:
    """Raises StudyError if the results do not fit into the memory of this machine."""
    there = memory()
    needed = EXTRA * size.result
    if needed > there:
        raise StudyError(
            f"{size.cases} cases need {readable(needed)} of memory, and this machine has {readable(there)}; "
            "give out = a folder, into which they are written as they come"
        )
