"""The result of a sweep as a CSV table, and a few rows of it for a terminal.

Both stream: memory does not grow with the number of cases.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .._layout import PM_TRUST_MARGIN
from ..base.arrays import Floats
from ..base.files import appearing, disk_errors
from ..engine.words import spelled
from ..language.cf import unit_of
from .costs import Costly, Costs
from .layout import REASON_WORDS, STATUS_WORDS, TRUST_WORDS, error_name
from .netcdf import hyperslabs, opened
from .plan import CASE

# Cases, and numbers, that are turned into text at once.
_TABLE_CASES = 65536
_TABLE_NUMBERS = 1 << 20
# Significant digits of an error in the table.
_ERROR_DIGITS = 3
# A text with one of these stands in quotes in the table.
_QUOTED = re.compile(r'[",\r\n]')


def write_csv(result: Path, table: Path) -> None:
    """Writes the result of a sweep as a table, one row per case in C order; it appears whole or not at all.

    Columns: the swept parameters and the asks, with units in the header ("d [in]"; the numbers of a list:
    "v[1] [m/s]", ...), their estimated errors ("v error [m/s]", of a list the greatest) and the margin, then
    `reason` (why something is missing) and, last, `status` as a word.  Numbers have
    as many digits as give back the same bits; missing ones are nan.  Raises StudyError if `result` cannot
    be read or `table` cannot be written.
    """
    with opened(result) as file, appearing(table) as temporary:
        columns = Columns(file)
        with open(temporary, "wb") as text:
            for piece in _text_of(columns):
                text.write(piece)


def is_table_of(result: Path, table: Path) -> bool:
    """Whether a table is, byte for byte, the one that `write_csv` makes of a result that is sound.

    Raises StudyError if either cannot be read.
    """
    with opened(result) as file, disk_errors(table), open(table, "rb") as text:
        return all(text.read(len(piece)) == piece for piece in _text_of(Columns(file))) and not text.read(1)


def _text_of(columns: Columns) -> Iterator[bytes]:
    header = io.StringIO()
    csv.writer(header, lineterminator="\n").writerow(columns.header)
    yield header.getvalue().encode()
    for first, count in columns.slices():
        yield columns.lines(first, count).encode()


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


class Columns:
    """The columns of the table of an opened result."""

    def __init__(self, file: Any) -> None:
        self._variables = file.variables
        status = self._variables["status"]
        self._grid: tuple[str, ...] = status.dimensions
        self.shape: tuple[int, ...] = status.shape
        self.cases = math.prod(self.shape)
        self._mended = bool(file.attrs.get("cases_mended", 0))  # by a second computation, which is told
        self.drawn = self._grid == (CASE,) and "design" in file.attrs
        self._asks: list[str] = file["ask"][...].tolist()
        self._parameters: dict[str, tuple[int, Floats]] = {}  # axis of the grid, values along it
        self.header: list[str] = []
        for name in file.attrs["parameters"].split():
            variable = self._variables[name]
            self._parameters[name] = self._grid.index(variable.dimensions[0]), variable[...]
            has_unit = "units" in variable.attrs  # an option has none
            self.header.append(f"{name} [{unit_of(variable.attrs)}]" if has_unit else name)
        for key in self._asks:
            variable = self._variables[key]
            numbers = range(1, math.prod(variable.shape[len(self._grid) :]) + 1)
            names = [f"{key}[{number}]" for number in numbers] if self._is_list(key) else [key]
            self.header += [f"{name} [{unit_of(variable.attrs)}]" for name in names]
        self.answers = len(self.header)  # columns in front of the evidence
        self._has_errors = TRUST_WORDS[PM_TRUST_MARGIN] in self._variables
        if self._has_errors:
            units = [unit_of(self._variables[key].attrs) for key in self._asks]
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

    def values(self, first: int, count: int) -> Iterator[Iterable[Any]]:
        """The columns of cases first .. first+count-1."""
        return (column.values for column in self._columns(first, count))

    def lines(self, first: int, count: int) -> str:
        """The lines of the table of cases first .. first+count-1."""
        # Column by column first: that is faster than the same texts row by row.
        texts = [list(column.texts) for column in self._columns(first, count)]
        return "\n".join([*map(",".join, zip(*texts, strict=True)), ""])

    def _columns(self, first: int, count: int) -> Iterator[_Column]:
        place = np.unravel_index(np.arange(first, first + count, dtype=np.int64), self.shape)
        for axis, values in self._parameters.values():
            written = [_field(one) if isinstance(one, str) else repr(one) for one in values.tolist()]
            along = place[axis].tolist()
            yield _Column(values[along].tolist(), map(written.__getitem__, along))
        for key in self._asks:
            numbers = self._read(key, first, count)
            letters = self._letters(key)
            if letters:
                words = [spelled(word, letters) for word in numbers.tolist()]
                yield _Column(words, map(_field, words))
                continue
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
        return [
            STATUS_WORDS.get(status, f"status {status}")
            for status in self._read("status", first, count).tolist()
        ]

    def solves(self, first: int, count: int) -> npt.NDArray[Any]:
        """Systems of equations solved for these cases."""
        return self._read("solves", first, count)

    def values_of(self, case: int) -> str:
        """The parameters of a case for people: "d = 1.02 in"."""
        values = next(self.rows(case, 1))[: len(self._parameters)]
        told = []
        for head, value in zip(self.header, values, strict=False):
            name, _, unit = head.partition(" ")
            shown = value if isinstance(value, str) else f"{value:.6g}"
            told.append(f"{name} = {shown} {unit.strip('[]').removeprefix('1')}".rstrip())
        return ", ".join(told)

    def _is_list(self, key: str) -> bool:
        return len(self._variables[key].dimensions) > len(self._grid)

    def _letters(self, key: str) -> tuple[str, ...]:
        """The events of an answer which of them happened; none of another."""
        return tuple(str(self._variables[key].attrs.get("letters", "")).split())

    def _reasons(self, first: int, count: int) -> list[str]:
        """Why something is missing: what was wrong with the case, or else with each ask."""
        # Cases that ended well have no message, and texts are slow to read.
        has_texts = self._mended or self._read("status", first, count).any()
        texts: list[str] = self._read("message", first, count).tolist() if has_texts else [""] * count
        reasons = self._read("reason", first, count)
        for row in np.flatnonzero(reasons.any(axis=1)).tolist():
            texts[row] = texts[row] or "; ".join(
                f"{key}: {REASON_WORDS.get(code, f'reason {code}').replace('_', ' ')}"
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


@dataclass(frozen=True)
class Summary:
    """What a terminal shows of a result: some rows of the table, and how many cases ended how (in words);
    `drawn`: a design has drawn the cases, and there is no grid beside; `costliest`: cases that cost far more
    than the others."""

    header: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]
    cases: int
    statuses: Mapping[str, int]
    drawn: bool = False
    costliest: tuple[Costly, ...] = ()


def summarise(result: Path, rows: int = 11) -> Summary:
    """`rows` cases evenly spread over the result, first and last included, and the count of each status.

    Raises StudyError if `result` cannot be read.
    """
    with opened(result) as file:
        columns = Columns(file)
        statuses: Counter[str] = Counter()
        costs = Costs()
        for first, count in columns.slices():
            statuses.update(columns.statuses(first, count))
            costs.add(first, columns.solves(first, count))
        steps = max(1, min(rows, columns.cases) - 1)
        shown = sorted({i * (columns.cases - 1) // steps for i in range(steps + 1)})
        picked = tuple(columns.for_people(row) for case in shown for row in columns.rows(case, 1))
        head = columns.for_people(columns.header)
        costliest = costs.found(columns.values_of)
        return Summary(head, picked, columns.cases, dict(statuses), columns.drawn, costliest)
