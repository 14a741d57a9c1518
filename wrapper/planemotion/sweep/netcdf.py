"""The result of a sweep as an HDF5 file, written block by block: memory does not grow with the cases.

The file is a netCDF-4 file: `xarray.open_dataset(path, engine="h5netcdf")` opens it as it is.  What stands in
it says layout.py.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt

from ..base.bounded import require_file
from ..base.checksums import seal
from ..base.errors import StudyError
from .block import Block
from .layout import MESSAGE, Layout, Tally
from .zarr_file import SUFFIX, opened_zarr

# Elements of a chunk of the messages: what is never written, the cases that ended well, takes no space.
_MESSAGE_CHUNK = 4096


def hyperslabs(shape: Sequence[int], first: int, count: int) -> Iterator[tuple[slice, ...]]:
    """The boxes that cover cases first .. first+count-1 of a C-ordered grid, in that order."""
    if count <= 0:
        return
    if len(shape) == 1:
        yield (slice(first, first + count),)
        return
    inner = shape[1:]
    row = math.prod(inner)
    i, begun = divmod(first, row)
    if begun:
        part = min(count, row - begun)
        for box in hyperslabs(inner, begun, part):
            yield (slice(i, i + 1), *box)
        i, count = i + 1, count - part
    whole, rest = divmod(count, row)
    if whole:
        yield (slice(i, i + whole), *(slice(0, size) for size in inner))
    for box in hyperslabs(inner, 0, rest):
        yield (slice(i + whole, i + whole + 1), *box)


def write_result(path: Path, layout: Layout, blocks: Iterable[Block], attributes: Mapping[str, Any]) -> None:
    """Writes the file that `xarray.open_dataset(path, engine="h5netcdf")` opens; `blocks` in order of cases.

    Memory does not grow with the number of cases.  Raises OSError if the file cannot be written.
    """
    import h5netcdf

    with _CarefulFile(path) as target:
        with h5netcdf.File(target, "w") as file:
            _declare(file, layout)
            summary = _write_blocks(file, layout, target.checked(blocks))
            for name, value in {**attributes, **summary}.items():
                file.attrs[name] = value
        target.check()
        with h5py.File(target, "r+") as sealed:
            seal(sealed)
        target.check()


class _CarefulFile(io.FileIO):
    """A file for HDF5 to write to, which does not survive a failed write: it crashes when it closes the file.

    So a failure is only remembered here, and what follows is dropped; `check` tells of it.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path, "w+")
        self._error: OSError | None = None

    def check(self) -> None:
        """Raises the first OSError that there was."""
        if self._error:
            raise self._error

    def checked(self, blocks: Iterable[Block]) -> Iterator[Block]:
        """The blocks, until one could not be written."""
        for block in blocks:
            yield block
            self.check()

    def write(self, data: Any) -> int:
        written, size = 0, len(data)
        try:
            while written < size and not self._error:
                written += super().write(data[written:])
        except OSError as error:
            self._error = error
        return size

    def truncate(self, size: int | None = None) -> int:
        try:
            return super().truncate(size)
        except OSError as error:
            self._error = self._error or error
            return size or 0


def _declare(file: Any, layout: Layout) -> None:
    """Dimensions and variables of the result in an empty h5netcdf.File; those of the cases stay empty."""
    file.dimensions = layout.dimensions
    for one in layout.variables():
        dtype = one.dtype or h5py.string_dtype()
        chunks = _message_chunks(layout.shape) if one.name == MESSAGE else None
        variable = file.create_variable(one.name, one.dims, dtype, data=one.data, chunks=chunks)
        variable.attrs.update(one.attributes)


def _message_chunks(shape: Sequence[int]) -> tuple[int, ...]:
    """A chunk that is filled in the order in which cases are written."""
    chunks: list[int] = []
    room = _MESSAGE_CHUNK
    for size in reversed(shape):
        chunks.append(min(size, room))
        room //= chunks[-1]
    return tuple(max(1, size) for size in reversed(chunks))


def _write_blocks(file: Any, layout: Layout, blocks: Iterable[Block]) -> dict[str, Any]:
    """Fills the variables; returns the attributes that follow from all cases."""
    tally = Tally(layout)
    for block in blocks:
        first, row = tally.add(block), 0
        for box in hyperslabs(layout.shape, first, len(block)):
            count = math.prod(edge.stop - edge.start for edge in box)
            _write_box(file, layout, box, block, slice(row, row + count))
            row += count
    return tally.attributes()


def _write_box(file: Any, layout: Layout, box: tuple[slice, ...], block: Block, rows: slice) -> None:
    """Rows of a block, which fill a box of the grid."""
    edges = tuple(edge.stop - edge.start for edge in box)

    def write(name: str, values: npt.NDArray[Any]) -> None:
        file.variables[name][box] = values.reshape(edges + values.shape[1:])

    for name, values in layout.case_values(block):
        write(name, values[rows])
    texts = {row - rows.start: text for row, text in block.message.items() if rows.start <= row < rows.stop}
    if texts:
        column_of_texts = np.full(rows.stop - rows.start, "", dtype=object)
        for row, text in texts.items():
            column_of_texts[row] = text
        write(MESSAGE, column_of_texts)


@contextmanager
def opened(result: Path) -> Iterator[Any]:
    """The result of a sweep, HDF5 or Zarr, to be read.  Raises StudyError."""
    import h5netcdf

    if result.suffix == SUFFIX:
        with opened_zarr(result) as store:
            yield store
        return
    try:
        require_file(result)
        file = h5netcdf.File(result, "r", decode_vlen_strings=True)
    except OSError as error:
        raise StudyError(f"{result}: cannot be read: {error}") from error
    with file:
        yield file
