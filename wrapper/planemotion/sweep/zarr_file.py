"""The result of a sweep as a Zarr store (version 3): what layout.py says, in chunks of consecutive cases.

Each chunk is a file of its own, so writers of different chunks need no lock.  `block_seconds` says how long
each block of cases, a chunk of all variables, took; it is written last, and not-a-number until then.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.errors import StudyError
from .block import Block
from .chunking import Chunking
from .layout import MESSAGE, Layout, Variable

SUFFIX = ".zarr"
SECONDS = "block_seconds"
_NEEDED = 'Zarr needs the package zarr, version 3: pip install "planemotion[stores]"'


def zarr() -> Any:
    """The module.  Raises StudyError where it is not installed."""
    try:
        import zarr
    except ImportError:
        raise StudyError(_NEEDED) from None
    if int(zarr.__version__.partition(".")[0]) < 3:
        raise StudyError(f"{_NEEDED}; there is {zarr.__version__}")
    return zarr


def declare(path: Path, layout: Layout, chunking: Chunking, attributes: Mapping[str, Any]) -> None:
    """Makes the store with all variables; those of the cases are empty."""
    group = zarr().create_group(path, zarr_format=3, attributes=dict(attributes))
    sizes = layout.dimensions
    for one in layout.variables():
        shape = tuple(sizes[dim] for dim in one.dims)
        chunks = shape
        if one.data is None:
            chunks = (*chunking.box, *shape[len(layout.shape) :])
        _create(group, one, shape, chunks)
    seconds = Variable(
        SECONDS, ("block",), np.float64, {"units": "s", "long_name": "computing time of a block"}
    )
    _create(group, seconds, (chunking.count,), (1,))


def _create(group: Any, one: Variable, shape: tuple[int, ...], chunks: tuple[int, ...]) -> None:
    from zarr.codecs import Crc32cCodec, ZstdCodec

    if one.dtype is None:
        dtype: Any = "string"
        fill: Any = ""
    else:
        dtype = np.dtype(one.dtype)
        fill = np.nan if dtype.kind == "f" else 0
    array = group.create_array(
        one.name,
        shape=shape,
        dtype=dtype,
        chunks=tuple(max(1, size) for size in chunks),
        fill_value=fill,
        compressors=[ZstdCodec(level=1), Crc32cCodec()],
        dimension_names=one.dims,
        attributes={key: _plain(value) for key, value in one.attributes.items()},
    )
    if one.data is not None:
        array[...] = one.data


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value


def write_block(group: Any, layout: Layout, chunking: Chunking, first: int, block: Block) -> None:
    """Writes a block of whole chunks that begins with case `first`."""
    row = 0
    for chunk, count, box in chunking.boxes(first, first + len(block)):
        rows = slice(row, row + count)
        edges = tuple(edge.stop - edge.start for edge in box)
        for name, values in layout.case_values(block):
            part = values[rows]
            group[name][box] = part.reshape(edges + part.shape[1:])
        texts = {at - row: text for at, text in block.message.items() if row <= at < row + count}
        if texts:
            column = np.full(count, "", dtype=object)
            for at, text in texts.items():
                column[at] = text
            group[MESSAGE][box] = column.reshape(edges)
        group[SECONDS][chunk : chunk + 1] = block.seconds * count / len(block)
        row += count


class _Array:
    """A variable as h5netcdf gives it."""

    def __init__(self, array: Any) -> None:
        self._array = array
        self.dimensions: tuple[str, ...] = tuple(array.metadata.dimension_names)
        self.shape: tuple[int, ...] = array.shape
        self.attrs: dict[str, Any] = dict(array.attrs)

    def __getitem__(self, box: Any) -> npt.NDArray[Any]:
        found = np.asarray(self._array[box])
        return found.astype(object) if found.dtype.kind == "T" else found


@contextmanager
def opened_zarr(path: Path) -> Iterator[Any]:
    """A store as `netcdf.opened` gives a file."""
    try:
        group = zarr().open_group(path, mode="r")
        variables = {name: _Array(array) for name, array in group.arrays()}
    except (OSError, ValueError, KeyError) as error:
        raise StudyError(f"{path}: cannot be read: {error}") from error

    class File(SimpleNamespace):
        def __getitem__(self, name: str) -> _Array:
            return variables[name]

    yield File(variables=variables, attrs=dict(group.attrs))


def zarr_faults(path: Path) -> Iterator[str]:
    """What is wrong with a store, one sentence each: blocks that are missing, chunks that are damaged."""
    group = zarr().open_group(path, mode="r")
    missing = int(np.isnan(group[SECONDS][...]).sum())
    if missing:
        yield f"{missing} of {group[SECONDS].shape[0]} blocks of cases are missing; go on with --resume"
    for name, array in sorted(group.arrays()):
        try:
            for box in _pieces(array):
                array[box]
        except (OSError, ValueError, RuntimeError) as error:
            yield f"{name}: is damaged: {error}"


def _pieces(array: Any) -> Iterator[tuple[slice, ...]]:
    """The boxes of its chunks."""
    steps = [range(0, size, chunk) for size, chunk in zip(array.shape, array.chunks, strict=True)]
    for place in np.ndindex(*map(len, steps)):
        yield tuple(slice(step[i], step[i] + step.step) for step, i in zip(steps, place, strict=True))
