"""Curves through points: the points of the scene, or of a CSV file beside it, whose header has the units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..base.errors import Faults, SceneError
from ..language.dimensions import LENGTH
from ..model import words
from .columns import CsvFile, beside
from .quantities import finite
from .scene import SceneData

MOST_BYTES = 50_000_000
MOST_POINTS = 100_000
_PLACE = tuple[float, float]


def with_places(raw: Mapping[str, Any], file: str | None) -> dict[str, Any]:
    """The same with the places of all curves by points; `file` is the scene's, beside which CSV files stand.

    Raises SceneError for all faults found.
    """
    faults = Faults()
    made: dict[str, Any] = dict(raw)
    for path, curve in _curves_by_points(raw):
        with faults.noted():
            made = _with(made, path, {**curve, "places": _places(curve, ".".join(path), file)})
    faults.tell()
    return made


def without_files(raw: Mapping[str, Any], data: SceneData) -> Mapping[str, Any]:
    """The same with the points of curves in place of their files; `raw` itself if there are none."""
    made = raw
    for path, curve in _curves_by_points(raw):
        if "file" in curve:
            owner = data.ground if path[0] == words.GROUND else data.bodies[path[1]]
            options = {key: value for key, value in curve.items() if key != "file"}
            made = _with(made, path, {**options, **owner.curves[path[-1]].in_scene})
    return made


def _curves_by_points(raw: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], Mapping[str, Any]]]:
    bodies = words.table(raw, "bodies")
    owners: dict[tuple[str, ...], Mapping[str, Any]] = {(words.GROUND,): words.table(raw, words.GROUND)}
    owners |= {("bodies", name): body for name, body in bodies.items() if isinstance(body, Mapping)}
    for path, owner in owners.items():
        curves = owner.get("curves", {})
        for name, curve in curves.items() if isinstance(curves, Mapping) else ():
            if isinstance(curve, Mapping) and ("points" in curve or "file" in curve):
                yield (*path, "curves", name), curve


def _with(raw: Mapping[str, Any], path: tuple[str, ...], value: Any) -> dict[str, Any]:
    return {**raw, path[0]: value if len(path) == 1 else _with(raw[path[0]], path[1:], value)}


def _places(curve: Mapping[str, Any], path: str, file: str | None) -> tuple[_PLACE, ...]:
    given = curve.get("file")
    if given is None:
        return _written(curve["points"], f"{path}.points")
    if "points" in curve:
        raise SceneError("the points stand in the file; give points or file, not both", path=f"{path}.points")
    if not isinstance(given, str):
        raise SceneError("the name of a CSV file is wanted", path=f"{path}.file", value=given)
    return _of_file(CsvFile(beside(file, given), given, f"{path}.file", MOST_BYTES), path)


# ---- in the scene ----


def _written(points: Any, path: str) -> tuple[_PLACE, ...]:
    if not isinstance(points, list | tuple):
        reason = 'a list of points is wanted, such as [["0 m", "1 m"], ["1 m", "0 m"]]'
        raise SceneError(reason, path=path, value=points)
    _check_count(len(points), path)
    return tuple(_place(one, f"{path}[{i}]") for i, one in enumerate(points))


def _place(written: Any, path: str) -> _PLACE:
    if not isinstance(written, list | tuple) or len(written) != 2:
        raise SceneError("a point is wanted: [x, y]", path=path, value=written)
    return _length(written[0], f"{path}[0]"), _length(written[1], f"{path}[1]")


def _length(written: Any, path: str) -> float:
    quantity = finite(written, path)
    if quantity.dimension != LENGTH and (quantity.value_si != 0 or quantity.unit_text):
        reason = f"a length is wanted; it is {quantity.dimension.phrase}"
        raise SceneError(reason, path=path, value=written)
    return quantity.value_si


def _check_count(count: int, path: str, file: str | None = None) -> None:
    line = None if file is None else 1
    if count == 0:
        raise SceneError("points are wanted, there is none", path=path, file=file, line=line)
    if count > MOST_POINTS:
        reason = f"{count} points; at most {MOST_POINTS} are read"
        raise SceneError(reason, path=path, file=file, line=line)


# ---- in a file ----


def _of_file(file: CsvFile, path: str) -> tuple[_PLACE, ...]:
    """What stands in the first two columns."""
    columns = file.header("a header with units is wanted, such as: x [m],y [m]")
    if len(columns) < 2:
        raise file.fault("two columns are wanted, such as: x [m],y [m]", file.header_line)
    factors = []
    for column in columns[:2]:
        factor, dimension = file.unit(column)
        if dimension != LENGTH:
            reason = f'the column "{column.written}": a length is wanted; it is {dimension.phrase}'
            raise file.fault(reason, file.header_line)
        factors.append(factor)
    x, y = columns[:2]
    made = tuple(
        (file.number(row, x, line) * factors[0], file.number(row, y, line) * factors[1])
        for line, row in file.rows()
    )
    _check_count(len(made), path, file.file)
    return made
