"""Columns of numbers from files that others write: CSV files whose header has names and units."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..base.bounded import read_bytes
from ..base.errors import SceneError
from ..language.dimensions import DIMENSIONLESS, Dimension
from ..language.units import factor

# "height [mm]" or "height (mm)": a name and a unit; "[1]" is a plain number.
_HEAD = re.compile(r"\s*(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))?\s*")


@dataclass(frozen=True)
class Column:
    """A column by its place: its name, and its unit as written, None if there is none."""

    place: int
    written: str
    name: str
    unit: str | None

    @classmethod
    def read(cls, place: int, written: str) -> Column:
        """Of a head, such as "height [mm]"."""
        head = _HEAD.fullmatch(written)
        assert head is not None
        unit = head[2] if head[2] is not None else head[3]
        return cls(place, written.strip(), head[1], unit if unit is None else unit.strip())


def beside(scene: str | None, name: str) -> Path:
    """Where a file is that a scene names: beside the file of the scene, if it has one."""
    return Path(name) if scene is None else Path(scene).parent / name


class CsvFile:
    """A CSV file: a header with units, then rows; empty lines and those that begin with # are passed.

    `path`: the key of the scene that names the file.  Raises SceneError with file and line.
    """

    def __init__(self, place: Path, name: str, path: str, most_bytes: int) -> None:
        self.file = str(place)
        self.header_line = 1
        self._path = path
        try:
            text = read_bytes(place, most_bytes).decode("utf-8-sig")
        except UnicodeDecodeError:
            raise SceneError("the file is not text in UTF-8", path=path, value=name) from None
        except OSError as error:
            reason = f"cannot be read: {error.strerror or error}"
            raise SceneError(reason, path=path, value=name) from None
        self._reader = csv.reader(io.StringIO(text))
        self._columns: list[Column] = []

    def header(self, wanted: str) -> list[Column]:
        """Its columns; `wanted` is told where the file is empty."""
        for line, row in self._lines():
            self.header_line = line
            self._columns = [Column.read(i, written) for i, written in enumerate(row)]
            return self._columns
        raise self.fault(f"the file is empty; {wanted}", 1)

    def rows(self) -> Iterator[tuple[int, list[str]]]:
        """What follows the header: lines and their fields."""
        for line, row in self._lines():
            if len(row) != len(self._columns):
                raise self.fault(f"{len(row)} fields; the header has {len(self._columns)}", line)
            yield line, row

    def _lines(self) -> Iterator[tuple[int, list[str]]]:
        try:
            for row in self._reader:
                if any(row) and not row[0].lstrip().startswith("#"):
                    yield self._reader.line_num, row
        except csv.Error as error:
            raise self.fault(f"this is no CSV: {error}", self._reader.line_num) from None

    def unit(self, column: Column) -> tuple[float, Dimension]:
        """What one of its unit is in SI, and its dimension."""
        if column.unit is None:
            reason = f'the column "{column.written}" has no unit: write "{column.written} [mm]", or "[1]"'
            raise self.fault(reason, self.header_line)
        try:
            return (1.0, DIMENSIONLESS) if column.unit in ("", "1") else factor(column.unit)
        except SceneError as error:
            raise self.fault(f'in the column "{column.written}": {error.reason}', self.header_line) from None

    def number(self, row: list[str], column: Column, line: int) -> float:
        """The finite number in a column of a row."""
        written = row[column.place]
        try:
            number = float(written)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            shown = written.strip() or "nothing"
            raise self.fault(f"{column.name} = {shown}: a finite number is wanted", line)
        return number

    def fault(self, reason: str, line: int) -> SceneError:
        """An error in a line of the file."""
        return SceneError(reason, file=self.file, line=line, path=self._path.removesuffix(".file"))
