"""Cases that are listed: columns in place of grids, from a CSV or Parquet file or from the scene.

A row is a case; the head of a column is a parameter with its unit, "d [in]", or an option.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import SceneError
from ..language.units import declared_unit, factor
from ..model import words
from ..model.listed import Cases, Listed
from ..model.tables import MOST_DRAWN
from .columns import Column, CsvFile, beside
from .plain import literal

CASES = "cases"
_MOST_BYTES = 2_000_000_000
_WANTED = 'the name of a CSV or Parquet file is wanted, or columns such as { d = ["1 in", "2 in"] }'
# Files of cases that are kept: a scene is read anew for each variant of it.
_KEPT = 4


def with_cases(raw: Mapping[str, Any], file: str | None) -> dict[str, Any]:
    """What takes the place of the [sweep] of a scene whose cases are listed: a column for each parameter.

    Nothing where none are.  `file` is the scene's, beside which files of cases stand.  Raises SceneError.
    """
    sweep = raw.get("sweep")
    if not isinstance(sweep, Mapping) or CASES not in sweep:
        return {}
    given = sweep[CASES]
    table = {"file": given} if isinstance(given, str) else given
    if not isinstance(table, Mapping) or not table:
        raise SceneError(_WANTED, path=f"sweep.{CASES}", value=given)
    if "design" in sweep:
        reason = "cases are listed or drawn by a design, not both"
        raise SceneError(reason, path="sweep.design")
    parameters = words.table(raw, "parameters")
    listed = _of_file(table, file, parameters) if "file" in table else _written(table)
    for name in listed:
        if name in sweep:
            raise SceneError("its values are listed in sweep.cases; it has a grid, too", path=f"sweep.{name}")
    made: dict[str, Any] = {}
    for key, one in sweep.items():
        if key == CASES:
            made.update(listed)
            made[CASES] = {key: value for key, value in table.items() if key in Cases.file_keys()}
        else:
            made[key] = one
    return {"sweep": made}


def _written(table: Mapping[str, Any]) -> dict[str, Any]:
    columns: dict[str, dict[str, Any]] = {}
    for place, (head, values) in enumerate(table.items()):
        path = f"sweep.{CASES}.{head}"
        if not isinstance(values, list | tuple) or not values:
            raise SceneError("a list of values is wanted, one for each case", path=path, value=values)
        column = Column.read(place, head)
        columns[column.name] = {"values": values, "listed": Listed(_checked(column, path))}
    sizes = {len(column["values"]) for column in columns.values()}
    if len(sizes) > 1:
        told = ", ".join(f"{name} has {len(column['values'])}" for name, column in columns.items())
        raise SceneError(f"a row is a case, so all columns are of one length: {told}", path=f"sweep.{CASES}")
    return columns


def _checked(column: Column, path: str) -> str | None:
    """The unit of a column that is written in the scene, None if there is none."""
    if column.unit in (None, "", "1"):
        return column.unit and ""
    try:
        factor(column.unit)
    except SceneError as error:
        raise SceneError(error.reason, path=path) from None
    return column.unit


# ---- files ----


def _of_file(table: Mapping[str, Any], file: str | None, parameters: Mapping[str, Any]) -> dict[str, Any]:
    for key in table:
        if key not in Cases.file_keys():
            raise SceneError(
                words.unknown(key, Cases.file_keys(), "key of cases in a file"), path=f"sweep.{CASES}.{key}"
            )
    given, chosen = table["file"], table.get("columns")
    if not isinstance(given, str):
        raise SceneError(_WANTED, path=f"sweep.{CASES}.file", value=given)
    named = [chosen] if isinstance(chosen, str) else chosen
    if named is not None and (not isinstance(named, list | tuple) or not named):
        raise SceneError("names of columns are wanted", path=f"sweep.{CASES}.columns", value=chosen)
    place = beside(file, given)
    units = {name: declared_unit(written) for name, written in parameters.items()}
    try:
        now = place.stat()
        state = now.st_mtime_ns, now.st_size, now.st_ino
    except (OSError, ValueError):
        state = 0, 0, 0  # what is wrong with it is told where it is read
    wanted = None if named is None else tuple(map(str, named))
    return dict(_read(place, given, wanted, tuple(units.items()), state))


@lru_cache(_KEPT)
def _read(
    place: Path,
    name: str,
    wanted: tuple[str, ...] | None,
    units: tuple[tuple[str, str], ...],
    state: tuple[int, int, int],
) -> Mapping[str, Any]:
    """The columns of a file; `wanted`: names of those that count, else all; `units` of the parameters."""
    del state  # another file under the same name is read anew
    read = _parquet if place.suffix in (".parquet", ".pq") else _csv
    return read(place, name, wanted, dict(units))


def _chosen(
    columns: Sequence[Column], wanted: Sequence[str] | None, file: str, line: int | None
) -> list[Column]:
    """The columns that count.  Raises SceneError for names that are not there, or twice."""
    known = [column.name for column in columns]
    for name in known if wanted is None else wanted:
        if name not in known:
            reason = words.unknown(name, known, f"column of {file}")
            raise SceneError(reason, path=f"sweep.{CASES}.columns", value=name)
        if known.count(name) > 1:
            reason = f"there are {known.count(name)} columns {name}"
            raise SceneError(reason, file=file, line=line, path=f"sweep.{CASES}")
    return [column for column in columns if wanted is None or column.name in wanted]


def _unit(column: Column, units: Mapping[str, str]) -> str | None:
    """The unit of a column; None of an option.  Raises ValueError, whose text says what is wrong."""
    name = column.name
    if name not in units:
        if words.is_option(name):
            return None
        reason = words.unknown(name, units, "parameter")
        raise ValueError(f'{reason}; if other columns are meant: cases = {{ file = ..., columns = ["d"] }}')
    if column.unit is None and units[name]:
        raise ValueError(f'the column "{name}" has no unit: write "{name} [{units[name]}]"')
    return "" if column.unit in (None, "1") else column.unit


def _csv(place: Path, name: str, wanted: Sequence[str] | None, units: Mapping[str, str]) -> dict[str, Any]:
    file = CsvFile(place, name, f"sweep.{CASES}.file", _MOST_BYTES)
    columns = _chosen(
        file.header("a header with units is wanted, such as: d [in],e"), wanted, file.file, file.header_line
    )
    of_column: list[tuple[Column, str | None]] = []
    for column in columns:
        try:
            of_column.append((column, _unit(column, units)))
        except ValueError as error:
            raise file.fault(str(error), file.header_line) from None
        if of_column[-1][1]:
            file.unit(column)
    numbers = [(column, array("d")) for column, unit in of_column if unit is not None]
    texts: list[tuple[Column, list[Any]]] = [(column, []) for column, unit in of_column if unit is None]
    count = 0
    for line, row in file.rows():
        count += 1
        if count > MOST_DRAWN:
            raise file.fault(f"at most {MOST_DRAWN} cases are possible", line)
        for column, values in numbers:
            values.append(file.number(row, column, line))
        for column, options in texts:
            options.append(literal(row[column.place].strip()))
    if not count:
        raise file.fault("there are no cases below the header", file.header_line)
    found: dict[str, Any] = {column.name: np.array(values) for column, values in numbers}
    found.update({column.name: options for column, options in texts})
    return _listed(of_column, found, file.file, file.header_line)


def _listed(
    columns: Iterable[tuple[Column, str | None]], found: Mapping[str, Any], file: str, line: int | None
) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for column, unit in columns:
        values = found[column.name]
        if unit is None:
            made[column.name] = {"values": values, "listed": Listed(None, None, file, line)}
        else:
            made[column.name] = {"listed": Listed(unit, values, file, line)}
    return made


def _parquet(
    place: Path, name: str, wanted: Sequence[str] | None, units: Mapping[str, str]
) -> dict[str, Any]:
    path = f"sweep.{CASES}.file"
    try:
        from pyarrow import ArrowException, parquet
    except ImportError:
        reason = 'Parquet is read by pyarrow, which is not installed: pip install "planemotion[stores]"'
        raise SceneError(reason, path=path, value=name) from None
    try:
        with parquet.ParquetFile(place) as file:
            heads, rows = file.schema_arrow.names, file.metadata.num_rows
            if not 1 <= rows <= MOST_DRAWN:
                reason = f"{rows} rows; 1 to {MOST_DRAWN} cases are possible"
                raise SceneError(reason, file=str(place), path=f"sweep.{CASES}")
            columns = _chosen(
                [Column.read(i, head) for i, head in enumerate(heads)], wanted, str(place), None
            )
            table = file.read([heads[column.place] for column in columns])
    except (OSError, ArrowException) as error:
        raise SceneError(f"cannot be read as Parquet: {error}", path=path, value=name) from None
    found, of_column = {}, []
    for column in columns:
        try:
            unit = _unit(column, units)
            if unit:
                factor(unit)
            of_column.append((column, unit))
            values = table.column(heads[column.place])
            found[column.name] = _options(column, values) if unit is None else _numbers(column, values)
        except ValueError as error:
            reason = error.reason if isinstance(error, SceneError) else str(error)
            raise SceneError(
                f'in the column "{column.written}": {reason}', file=str(place), path=f"sweep.{CASES}"
            ) from None
    return _listed(of_column, found, str(place), None)


def _numbers(column: Column, values: Any) -> Any:
    try:
        numbers = np.asarray(values.to_numpy(zero_copy_only=False), np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"numbers are wanted, not {values.type}") from None
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if wrong.size:
        raise ValueError(f"row {wrong[0] + 1}: a finite number is wanted, not {numbers[wrong[0]]}")
    return numbers


def _options(column: Column, values: Any) -> list[Any]:
    found = values.to_pylist()
    for row, one in enumerate(found, 1):
        if not isinstance(one, str | bool | int | float):
            raise ValueError(f"row {row}: a word or a number is wanted, not {one}")
    return found
