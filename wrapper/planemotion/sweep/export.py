"""The result of a sweep as files for others: one HDF5 file, and from it a CSV table and a summary.

The HDF5 file is a netCDF-4 file: `xarray.open_dataset(path, engine="h5netcdf")` opens it as it is.  It has
one dimension per swept parameter (those of a zip share the first one's), on which stand

    the swept parameters     coordinates, in the unit of the grid
    each ask                 float, in its unit, NaN without an answer; a list has one more dimension,
                             KEY_at (the values of its grid) or KEY_number
    KEY_error                its estimated absolute error, likewise (not with solve.estimate = false)
    margin                   least distance of a decision on the way from its threshold, over its error: below
                             1 counts and outcomes are not certain; infinite if there was none (likewise)
    error_over_accuracy      greatest estimated error over what solve.accuracy allows (likewise)
    status                   int, enum pm_status: 0 ok, > 0 an early stop, < 0 a failure
    reason                   int per ask, enum pm_reason: why it is NaN
    message                  text of what was wrong, "" where all is well
    route, audit_energy, ... how each case was computed, and the evidence for it

In a scene with [runs], route, audit and run_status have one more dimension, run.  Everything here streams:
memory does not grow with the number of cases.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import numpy.typing as npt

from .._layout import PM_TRUST_EXCESS, PM_TRUST_MARGIN, pm_audit, pm_reason, pm_route, pm_status
from ..base.errors import StudyError
from .memory import MemoryFile
from .store import Block, Floats, appearing

if TYPE_CHECKING:
    import xarray as xr

# Cases, and numbers, that are turned into text at once.
_TABLE_CASES = 65536
_TABLE_NUMBERS = 1 << 20
# Elements of a chunk of the messages: what is never written, the cases that ended well, takes no space.
_MESSAGE_CHUNK = 4096
# Significant digits of an error in the table.
_ERROR_DIGITS = 3
# A text with one of these stands in quotes in the table.
_QUOTED = re.compile(r'[",\r\n]')


def _words(enumeration: Mapping[str, int], prefix: str, count: str = "") -> dict[int, str]:
    """Values of an enumeration of the kernel as words; its entry `count` is no value."""
    return {value: name.removeprefix(prefix).lower() for name, value in enumeration.items() if name != count}


STATUS_WORDS = _words(pm_status, "PM_")
REASON_WORDS = _words(pm_reason, "PM_REASON_")
ROUTE_WORDS = _words(pm_route, "PM_ROUTE_", "PM_ROUTES")
AUDIT_WORDS = _words(pm_audit, "PM_AUDIT_", "PM_AUDITS")
TRUST_WORDS = {PM_TRUST_MARGIN: "margin", PM_TRUST_EXCESS: "error_over_accuracy"}
_TRUST_TEXTS = {
    PM_TRUST_MARGIN: "least distance of a decision from its threshold over its error",
    PM_TRUST_EXCESS: "greatest estimated error over what solve.accuracy allows",
}

# Names in the result besides those of parameters and asks.
RESERVED_NAMES = frozenset(
    {"status", "reason", "message", "route", "run", "run_status", "ask", *TRUST_WORDS.values()}
    | {f"audit_{word}" for word in AUDIT_WORDS.values()}
)


def error_name(key: str) -> str:
    """The variable of the errors of the ask `key`."""
    return f"{key}_error"


@dataclass(frozen=True)
class Coordinate:
    """The values of one swept parameter, in `unit`, along the dimension `dim`."""

    name: str
    dim: str
    unit: str
    values: Floats


@dataclass(frozen=True)
class AskVariable:
    """One ask: `count` columns of Block.value; `text` is what was asked; `at`: unit and grid of a list."""

    key: str
    unit: str
    text: str
    count: int
    is_list: bool
    at: tuple[str, Floats] | None = None

    @property
    def error(self) -> str:
        """The variable of its errors."""
        return error_name(self.key)

    @property
    def dim(self) -> tuple[str, ...]:
        """The dimension of a list: its grid's values, or else the numbers 1, 2, ..."""
        if not self.is_list:
            return ()
        return (f"{self.key}_at" if self.at else f"{self.key}_number",)


@dataclass(frozen=True)
class Layout:
    """Names and sizes of everything in a result; `runs` are the named runs, empty if the scene has none;
    `estimate`: whether there are errors."""

    dims: tuple[tuple[str, int], ...]
    coordinates: tuple[Coordinate, ...]
    asks: tuple[AskVariable, ...]
    runs: tuple[str, ...] = ()
    estimate: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(size for _, size in self.dims)

    @property
    def cases(self) -> int:
        return math.prod(self.shape)


# ---- HDF5 -----------------------------------------------------------------------------------------------


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
            _write(file, layout, target.checked(blocks), attributes)
        target.check()


def dataset(layout: Layout, blocks: Iterable[Block], attributes: Mapping[str, Any]) -> xr.Dataset:
    """What `xarray.load_dataset` reads from the file that `write_result` makes of the same."""
    file = MemoryFile()
    _write(file, layout, blocks, attributes)
    return file.dataset()


def _write(file: Any, layout: Layout, blocks: Iterable[Block], attributes: Mapping[str, Any]) -> None:
    """Fills an empty h5netcdf.File or MemoryFile."""
    _declare(file, layout)
    summary = _write_blocks(file, layout, blocks)
    parameters = " ".join(coordinate.name for coordinate in layout.coordinates)
    for name, value in {**attributes, **summary, "parameters": parameters}.items():
        file.attrs[name] = value


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
    """Dimensions, coordinates and empty variables of the result."""
    grid = tuple(name for name, _ in layout.dims)
    of_run = (*grid, "run") if layout.runs else grid
    file.dimensions = {**dict(layout.dims), "ask": len(layout.asks)}
    for coordinate in layout.coordinates:
        variable = file.create_variable(coordinate.name, (coordinate.dim,), "f8", data=coordinate.values)
        variable.attrs.update(units=coordinate.unit or "1", long_name=f"parameter {coordinate.name}")
    _texts(file, "ask", [ask.key for ask in layout.asks])
    for ask in layout.asks:
        for dim in ask.dim:
            unit, values = ask.at or ("", np.arange(1.0, ask.count + 1))
            file.dimensions[dim] = ask.count
            file.create_variable(dim, (dim,), "f8", data=values).attrs["units"] = unit or "1"
    if layout.runs:
        file.dimensions["run"] = len(layout.runs)
        _texts(file, "run", layout.runs)

    # CF: coordinates that are not dimensions (the other columns of a zip) are named by the variables.
    zipped = " ".join(item.name for item in layout.coordinates if item.name != item.dim)

    def declare(name: str, dims: tuple[str, ...], dtype: Any, **attributes: Any) -> None:
        chunks = _message_chunks(layout.shape) if name == "message" else None
        variable = file.create_variable(name, dims, dtype, chunks=chunks)
        variable.attrs.update({**attributes, **({"coordinates": zipped} if zipped else {})})

    for ask in layout.asks:
        ancillary = {"ancillary_variables": ask.error} if layout.estimate else {}
        declare(ask.key, (*grid, *ask.dim), "f8", units=ask.unit or "1", long_name=ask.text, **ancillary)
    for ask in layout.asks if layout.estimate else ():
        text = f"estimated absolute error of {ask.key}"
        declare(ask.error, (*grid, *ask.dim), "f4", units=ask.unit or "1", long_name=text)
    for column, word in TRUST_WORDS.items() if layout.estimate else ():
        declare(word, grid, "f4", units="1", long_name=_TRUST_TEXTS[column])
    declare("status", grid, "i4", long_name="how the case ended", **_flags(STATUS_WORDS, np.int32))
    declare(
        "reason", (*grid, "ask"), "i1", long_name="why there is no number", **_flags(REASON_WORDS, np.int8)
    )
    declare("route", of_run, "i1", long_name="route that was taken", **_flags(ROUTE_WORDS, np.int8))
    for word in AUDIT_WORDS.values():
        declare(f"audit_{word}", of_run, "f8", units="1", long_name=f"relative residual of the {word}")
    if layout.runs:
        declare("run_status", of_run, "i4", long_name="how each run ended", **_flags(STATUS_WORDS, np.int32))
    declare("message", grid, h5py.string_dtype(), long_name="what was wrong with the case")


def _message_chunks(shape: Sequence[int]) -> tuple[int, ...]:
    """A chunk that is filled in the order in which cases are written."""
    chunks: list[int] = []
    room = _MESSAGE_CHUNK
    for size in reversed(shape):
        chunks.append(min(size, room))
        room //= chunks[-1]
    return tuple(max(1, size) for size in reversed(chunks))


def _texts(file: Any, name: str, values: Sequence[str]) -> None:
    file.create_variable(name, (name,), h5py.string_dtype(), data=np.array(values, dtype=object))


def _flags(meaning: Mapping[int, str], dtype: type[np.signedinteger[Any]]) -> dict[str, Any]:
    """CF attributes that say what the values of an integer variable mean."""
    return {"flag_values": np.array(list(meaning), dtype), "flag_meanings": " ".join(meaning.values())}


def _write_blocks(file: Any, layout: Layout, blocks: Iterable[Block]) -> dict[str, Any]:
    """Fills the variables; returns the attributes that follow from all cases."""
    first, failed, seconds = 0, 0, 0.0
    routes: set[int] = set()
    for block in blocks:
        row = 0
        for box in hyperslabs(layout.shape, first, len(block)):
            count = math.prod(edge.stop - edge.start for edge in box)
            _write_box(file, layout, box, block, slice(row, row + count))
            row += count
        first += len(block)
        failed += int(np.count_nonzero(block.status))
        seconds += block.seconds
        routes.update(np.unique(block.route).tolist())
    if first != layout.cases:
        raise StudyError(f"{first} of {layout.cases} cases are stored; the result needs all")
    return {
        "cases": np.int64(layout.cases),
        "cases_not_ok": np.int64(failed),
        "routes": " ".join(ROUTE_WORDS[route] for route in sorted(routes)),
        "elapsed_seconds": seconds,
    }


def _write_box(file: Any, layout: Layout, box: tuple[slice, ...], block: Block, rows: slice) -> None:
    """Rows of a block, which fill a box of the grid."""
    edges = tuple(edge.stop - edge.start for edge in box)

    def write(name: str, values: npt.NDArray[Any]) -> None:
        file.variables[name][box] = values[rows].reshape(edges + values.shape[1:])

    column = 0
    for ask in layout.asks:
        columns = slice(column, column + ask.count) if ask.is_list else column
        write(ask.key, block.value[:, columns])
        if layout.estimate:
            write(ask.error, block.error[:, columns])
        column += ask.count
    for index, word in TRUST_WORDS.items() if layout.estimate else ():
        write(word, block.trust[:, index])
    per_run = slice(None) if layout.runs else 0
    write("status", block.status)
    write("reason", block.reason)
    write("route", block.route[:, per_run])
    for index, word in AUDIT_WORDS.items():
        write(f"audit_{word}", block.audit[:, per_run, index])
    if layout.runs:
        write("run_status", block.run_status)
    texts = {row - rows.start: text for row, text in block.message.items() if rows.start <= row < rows.stop}
    if texts:
        column_of_texts = np.full(rows.stop - rows.start, "", dtype=object)
        for row, text in texts.items():
            column_of_texts[row] = text
        file.variables["message"][box] = column_of_texts.reshape(edges)


# ---- CSV ------------------------------------------------------------------------------------------------


def write_csv(result: Path, table: Path) -> None:
    """Writes the result of a sweep as a table, one row per case in C order; it appears whole or not at all.

    Columns: the swept parameters and the asks, with units in the header ("d [in]"; the numbers of a list:
    "v[1] [m/s]", ...), their estimated errors ("v error [m/s]", of a list the greatest) and the margin, then
    `reason` (why something is missing) and, last, `status` as a word.  Numbers have
    as many digits as give back the same bits; missing ones are nan.  Raises StudyError if `result` cannot
    be read or `table` cannot be written.
    """
    with _opened(result) as file, appearing(table) as temporary:
        columns = _Columns(file)
        with open(temporary, "w", encoding="utf-8", newline="") as text:
            csv.writer(text, lineterminator="\n").writerow(columns.header)
            for first, count in columns.slices():
                text.write(columns.lines(first, count))


@dataclass(frozen=True)
class _Column:
    """A column of consecutive cases: as values, and as the table writes them; to be gone through once."""

    values: Iterable[Any]
    texts: Iterable[str]

    @staticmethod
    def exact(numbers: list[float]) -> _Column:
        """Numbers with all their digits."""
        return _Column(numbers, map(repr, numbers))

    @staticmethod
    def short(numbers: list[float]) -> _Column:
        """Numbers with the digits that an error has."""
        return _Column((float(_short(number)) for number in numbers), map(_short, numbers))


# A number with the significant digits that an error has.
_short = f"%.{_ERROR_DIGITS}g".__mod__


def _field(text: str) -> str:
    """A text as CSV has it."""
    return '"' + text.replace('"', '""') + '"' if _QUOTED.search(text) else text


class _Columns:
    """The columns of the table of an opened result."""

    def __init__(self, file: Any) -> None:
        self._variables = file.variables
        status = self._variables["status"]
        self._grid: tuple[str, ...] = status.dimensions
        self.shape: tuple[int, ...] = status.shape
        self.cases = math.prod(self.shape)
        self._asks: list[str] = file["ask"][...].tolist()
        self._parameters: dict[str, tuple[int, Floats]] = {}  # axis of the grid, values along it
        self.header: list[str] = []
        for name in file.attrs["parameters"].split():
            variable = self._variables[name]
            self._parameters[name] = self._grid.index(variable.dimensions[0]), variable[...]
            self.header.append(f"{name} [{variable.attrs['units']}]")
        for key in self._asks:
            variable = self._variables[key]
            numbers = range(1, math.prod(variable.shape[len(self._grid) :]) + 1)
            names = [f"{key}[{number}]" for number in numbers] if self._is_list(key) else [key]
            self.header += [f"{name} [{variable.attrs['units']}]" for name in names]
        self.answers = len(self.header)  # columns in front of the evidence
        self._has_errors = TRUST_WORDS[PM_TRUST_MARGIN] in self._variables
        if self._has_errors:
            units = [self._variables[key].attrs["units"] for key in self._asks]
            self.header += [f"{key} error [{unit}]" for key, unit in zip(self._asks, units, strict=True)]
            self.header.append(TRUST_WORDS[PM_TRUST_MARGIN])
        self.header += ["reason", "status"]

    def slices(self) -> Iterator[tuple[int, int]]:
        """First case and number of cases of each piece that fits well into memory."""
        most = max(1, min(_TABLE_CASES, _TABLE_NUMBERS // len(self.header)))
        for first in range(0, self.cases, most):
            yield first, min(most, self.cases - first)

    def rows(self, first: int, count: int) -> Iterator[tuple[Any, ...]]:
        """The rows of cases first .. first+count-1."""
        return zip(*(column.values for column in self._columns(first, count)), strict=True)

    def lines(self, first: int, count: int) -> str:
        """The lines of the table of cases first .. first+count-1."""
        # Column by column first: that is faster than the same texts row by row.
        texts = [list(column.texts) for column in self._columns(first, count)]
        return "\n".join([*map(",".join, zip(*texts, strict=True)), ""])

    def _columns(self, first: int, count: int) -> Iterator[_Column]:
        place = np.unravel_index(np.arange(first, first + count, dtype=np.int64), self.shape)
        for axis, values in self._parameters.values():
            written = list(map(repr, values.tolist()))
            along = place[axis].tolist()
            yield _Column(values[along].tolist(), map(written.__getitem__, along))
        for key in self._asks:
            numbers = self._read(key, first, count)
            yield from map(_Column.exact, numbers.T.tolist() if self._is_list(key) else [numbers.tolist()])
        if self._has_errors:
            yield from (_Column.short(self._greatest_error(key, first, count)) for key in self._asks)
            yield _Column.short(self._read(TRUST_WORDS[PM_TRUST_MARGIN], first, count).tolist())
        reasons, statuses = self._reasons(first, count), self.statuses(first, count)
        yield _Column(reasons, map(_field, reasons))
        yield _Column(statuses, statuses)

    def _greatest_error(self, key: str, first: int, count: int) -> list[float]:
        """The error of an ask, of a list the greatest of those known."""
        errors = self._read(error_name(key), first, count)
        greatest: list[float] = (np.fmax.reduce(errors, axis=1) if self._is_list(key) else errors).tolist()
        return greatest

    def for_people(self, row: Sequence[Any]) -> tuple[Any, ...]:
        """A row without the errors: they make a table too wide to read."""
        return (*row[: self.answers], *row[-2:])

    def statuses(self, first: int, count: int) -> list[str]:
        """The statuses of these cases as words."""
        return [STATUS_WORDS[status] for status in self._read("status", first, count).tolist()]

    def _is_list(self, key: str) -> bool:
        return len(self._variables[key].dimensions) > len(self._grid)

    def _reasons(self, first: int, count: int) -> list[str]:
        """Why something is missing: what was wrong with the case, or else with each ask."""
        # Cases that ended well have no message, and texts are slow to read.
        is_told = self._read("status", first, count).any()
        texts: list[str] = self._read("message", first, count).tolist() if is_told else [""] * count
        reasons = self._read("reason", first, count)
        for row in np.flatnonzero(reasons.any(axis=1)).tolist():
            texts[row] = texts[row] or "; ".join(
                f"{key}: {REASON_WORDS[code].replace('_', ' ')}"
                for key, code in zip(self._asks, reasons[row].tolist(), strict=True)
                if code
            )
        return texts

    def _read(self, name: str, first: int, count: int) -> npt.NDArray[Any]:
        """A variable of consecutive cases: [count] or [count, its further dimension]."""
        variable = self._variables[name]
        further = variable.shape[len(self.shape) :]
        boxes = [variable[box].reshape(-1, *further) for box in hyperslabs(self.shape, first, count)]
        return np.concatenate(boxes)


@contextmanager
def _opened(result: Path) -> Iterator[Any]:
    import h5netcdf

    try:
        file = h5netcdf.File(result, "r", decode_vlen_strings=True)
    except OSError as error:
        raise StudyError(f"{result}: cannot be read: {error}") from error
    with file:
        yield file


# ---- the terminal ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Summary:
    """What a terminal shows of a result: some rows of the table, and how many cases ended how (in words)."""

    header: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]
    cases: int
    statuses: Mapping[str, int]


def summarise(result: Path, rows: int = 11) -> Summary:
    """`rows` cases evenly spread over the result, first and last included, and the count of each status.

    Raises StudyError if `result` cannot be read.
    """
    with _opened(result) as file:
        columns = _Columns(file)
        statuses: Counter[str] = Counter()
        for first, count in columns.slices():
            statuses.update(columns.statuses(first, count))
        steps = max(1, min(rows, columns.cases) - 1)
        shown = sorted({i * (columns.cases - 1) // steps for i in range(steps + 1)})
        picked = tuple(columns.for_people(row) for case in shown for row in columns.rows(case, 1))
        return Summary(columns.for_people(columns.header), picked, columns.cases, dict(statuses))
