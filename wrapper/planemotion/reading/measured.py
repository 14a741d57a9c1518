"""Tables of measured values: from the scene, or from a CSV file beside it, whose header has the units."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..base.bounded import read_bytes
from ..base.errors import Faults, SceneError, nearest
from ..language.dimensions import DIMENSIONLESS, Dimension
from ..language.units import factor, parse_quantity
from ..model import words
from ..model.tabulated import Points

# Bytes of a file, and rows of a table: far above what is measured by hand, and below what makes a run slow.
MOST_BYTES = 50_000_000
MOST_ROWS = 100_000
# "height [mm]" or "height (mm)": a name and a unit; "[1]" is a plain number.
_HEAD = re.compile(r"\s*(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))?\s*")
_GIVEN = 'at = ["0 s", "1 s"] and value = ["0 N", "5 N"], or file = "measured.csv"'


def add_points(raw: Mapping[str, Any], file: str | None) -> dict[str, Any]:
    """The tables of a scene, each with its points; `file` is the scene's, beside which CSV files stand.

    Raises SceneError for all faults found.
    """
    faults = Faults()
    made: dict[str, Any] = {}
    for name, table in words.table(raw, "tables").items():
        with faults.noted():
            made[name] = {**table, "points": _points(table, f"tables.{name}", file)}
    faults.tell()
    return made


def _points(table: Mapping[str, Any], path: str, file: str | None) -> Points:
    given = table.get("file")
    if given is None:
        return _written(table, path)
    if not isinstance(given, str):
        raise SceneError("the name of a CSV file is wanted", path=f"{path}.file", value=given)
    for key in ("at", "value"):
        if not isinstance(table.get(key, ""), str):
            reason = "the values stand in the file: the name of one of its columns is wanted here"
            raise SceneError(reason, path=f"{path}.{key}")
    place = Path(given) if file is None else Path(file).parent / given
    return _File(place, given, path).points(table)


# ---- in the scene ----


def _written(table: Mapping[str, Any], path: str) -> Points:
    columns = {}
    for key in ("at", "value"):
        given = table.get(key)
        if not isinstance(given, list | tuple):
            reason = f"a table is {_GIVEN}"
            raise SceneError(reason, path=f"{path}.{key}" if key in table else path, value=given)
        columns[key] = _column(given, f"{path}.{key}")
    (at, argument), (value, dimension) = columns["at"], columns["value"]
    if len(at) != len(value):
        reason = f"as many values are wanted as arguments: there are {len(at)} and {len(value)}"
        raise SceneError(reason, path=f"{path}.value")
    _check_rows(len(at), path)
    for i in range(1, len(at)):
        if not at[i] > at[i - 1]:
            reason = f"arguments must increase; the one before is {table['at'][i - 1]}"
            raise SceneError(reason, path=f"{path}.at[{i}]", value=table["at"][i])
    return Points(tuple(at), tuple(value), argument, dimension)


def _column(given: Sequence[Any], path: str) -> tuple[list[float], Dimension]:
    """The numbers of a list, SI, and their one dimension; 0 has any."""
    numbers: list[float] = []
    first: tuple[Dimension, Any] | None = None
    for i, one in enumerate(given):
        where = f"{path}[{i}]"
        try:
            quantity = parse_quantity(one)
        except SceneError as error:
            raise SceneError(error.reason, path=where, value=one) from None
        if not math.isfinite(quantity.value_si):
            raise SceneError("a finite number is wanted", path=where, value=one)
        numbers.append(quantity.value_si)
        if quantity.value_si == 0 and not quantity.unit_text:
            continue
        if first is None:
            first = quantity.dimension, one
        elif quantity.dimension != first[0]:
            reason = f"it is {quantity.dimension.phrase}; {first[1]} is {first[0].phrase}"
            raise SceneError(reason, path=where, value=one)
    return numbers, first[0] if first else DIMENSIONLESS


def _check_rows(rows: int, path: str, file: str | None = None) -> None:
    line = None if file is None else 1
    if rows < 2:
        found = "there is 1" if rows == 1 else "there is none"
        raise SceneError(f"at least 2 rows are wanted, {found}", path=path, file=file, line=line)
    if rows > MOST_ROWS:
        raise SceneError(f"{rows} rows; at most {MOST_ROWS} are read", path=path, file=file, line=line)


# ---- in a file ----


class _File:
    """A CSV file: a header with units, then rows of numbers; empty lines and those with # are passed."""

    def __init__(self, place: Path, name: str, path: str) -> None:
        self.file = str(place)
        self.path = path
        try:
            text = read_bytes(place, MOST_BYTES).decode("utf-8-sig")
        except UnicodeDecodeError:
            raise SceneError("the file is not text in UTF-8", path=f"{path}.file", value=name) from None
        except OSError as error:
            reason = f"cannot be read: {error.strerror or error}"
            raise SceneError(reason, path=f"{path}.file", value=name) from None
        reader = csv.reader(io.StringIO(text))
        try:
            self._rows = [
                (reader.line_num, row) for row in reader if any(row) and not row[0].lstrip().startswith("#")
            ]
        except csv.Error as error:
            raise self._fault(f"this is no CSV: {error}", reader.line_num) from None

    def points(self, table: Mapping[str, Any]) -> Points:
        """What stands in the two columns that the scene names; else in the first two."""
        if not self._rows:
            raise self._fault("the file is empty; a header with units is wanted", 1)
        line, header = self._rows[0]
        heads = [_HEAD.fullmatch(one) for one in header]
        known = [head[1] if head else one for head, one in zip(heads, header, strict=True)]
        if len(known) < 2:
            raise self._fault("two columns are wanted, such as: t [s],force [N]", line)
        places = [self._place(table.get(key), i, known, key) for i, key in enumerate(("at", "value"))]
        units = [self._unit(heads[place], header[place], line) for place in places]
        _check_rows(len(self._rows) - 1, self.path, self.file)
        at, value = [], []
        for line, row in self._rows[1:]:
            if len(row) != len(header):
                raise self._fault(f"{len(row)} fields; the header has {len(header)}", line)
            x, y = (self._number(row[place], known[place], line) for place in places)
            at.append(x * units[0][0])
            value.append(y * units[1][0])
            if len(at) > 1 and not at[-1] > at[-2]:
                shown = f"{known[places[0]]} = {row[places[0]].strip()}"
                raise self._fault(f"{shown}: arguments must increase from row to row", line)
        return Points(tuple(at), tuple(value), units[0][1], units[1][1])

    def _place(self, wanted: Any, first: int, known: list[str], key: str) -> int:
        if wanted is None:
            return first
        if wanted not in known:
            guess = nearest(wanted, known)
            hint = f' (did you mean "{guess}"?)' if guess else ""
            reason = f"{self.file} has no such column{hint}; it has {', '.join(known)}"
            raise SceneError(reason, path=f"{self.path}.{key}", value=wanted)
        if known.count(wanted) > 1:
            reason = f"{self.file} has {known.count(wanted)} columns of that name"
            raise SceneError(reason, path=f"{self.path}.{key}", value=wanted)
        return known.index(wanted)

    def _unit(self, head: re.Match[str] | None, written: str, line: int) -> tuple[float, Dimension]:
        unit = head and (head[2] if head[2] is not None else head[3])
        if unit is None:
            reason = f'the column "{written.strip()}" has no unit: write "{written.strip()} [mm]", or "[1]"'
            raise self._fault(reason, line)
        try:
            return (1.0, DIMENSIONLESS) if unit.strip() in ("", "1") else factor(unit.strip())
        except SceneError as error:
            raise self._fault(f'in the column "{written.strip()}": {error.reason}', line) from None

    def _number(self, written: str, column: str, line: int) -> float:
        try:
            number = float(written)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise self._fault(f"{column} = {written.strip() or 'nothing'}: a finite number is wanted", line)
        return number

    def _fault(self, reason: str, line: int) -> SceneError:
        return SceneError(reason, file=self.file, line=line, path=self.path)
