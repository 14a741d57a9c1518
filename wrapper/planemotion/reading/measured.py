"""Tables of measured values: from the scene, or from a CSV file beside it, whose header has the units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..base.errors import Faults, SceneError
from ..language.dimensions import DIMENSIONLESS, Dimension
from ..model import words
from ..model.tabulated import Points
from .columns import Column, CsvFile, beside
from .quantities import finite

# Bytes of a file, and rows of a table: far above what is measured by hand, and below what makes a run slow.
MOST_BYTES = 50_000_000
MOST_ROWS = 100_000
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
    return _points_of(CsvFile(beside(file, given), given, f"{path}.file", MOST_BYTES), table, path)


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
        quantity = finite(one, where)
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


def _points_of(file: CsvFile, table: Mapping[str, Any], path: str) -> Points:
    """What stands in the two columns that the scene names; else in the first two."""
    columns = file.header("a header with units is wanted")
    if len(columns) < 2:
        raise file.fault("two columns are wanted, such as: t [s],force [N]", file.header_line)
    argument, result = (_place(file, columns, table.get(key), i, f"{path}.{key}") for i, key in _KEYS)
    (x_factor, x_dimension), (y_factor, y_dimension) = file.unit(argument), file.unit(result)
    at: list[float] = []
    value: list[float] = []
    for line, row in file.rows():
        at.append(file.number(row, argument, line) * x_factor)
        value.append(file.number(row, result, line) * y_factor)
        if len(at) > 1 and not at[-1] > at[-2]:
            shown = f"{argument.name} = {row[argument.place].strip()}"
            raise file.fault(f"{shown}: arguments must increase from row to row", line)
    _check_rows(len(at), path, file.file)
    return Points(tuple(at), tuple(value), x_dimension, y_dimension)


_KEYS = ((0, "at"), (1, "value"))


def _place(file: CsvFile, columns: Sequence[Column], wanted: Any, first: int, path: str) -> Column:
    if wanted is None:
        return columns[first]
    named = [column for column in columns if column.name == wanted]
    if not named:
        reason = words.unknown(wanted, [column.name for column in columns], f"column of {file.file}")
        raise SceneError(reason, path=path, value=wanted)
    if len(named) > 1:
        raise SceneError(f"{file.file} has {len(named)} columns of that name", path=path, value=wanted)
    return named[0]
