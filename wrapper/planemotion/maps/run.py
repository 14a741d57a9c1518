"""A map from the scene to its dataset: which outcome there is over two parameters, and where it changes.

The dataset has

    outcome             names of the outcomes; share(outcome): their parts of the area of the map
    case                every run that was made: both parameters, `case_outcome` and `status`
    curve, point        boundaries between two outcomes each, `curve_outcomes(curve, side)`: point_NAME holds
                        curve_points[0] points of the first, then those of the second ...
    piece, vertex       polygons that cover the map, likewise: piece_outcome, piece_vertices, vertex_NAME
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ..base.arrays import Ints
from ..base.errors import SceneError
from ..base.versions import versions
from ..compile.asks import Asked
from ..language.cf import cf_units
from ..model.tables import Refine
from ..sweep.cache import Kept
from ..sweep.cases import Study
from ..sweep.plan import plan_sweep
from .file import KIND
from .lattice import Places, Side, halvings_for
from .looks import Looks
from .outcomes import Outcomes
from .outlines import curves_of, pieces_of
from .refine import Refined, refine

if TYPE_CHECKING:
    import xarray as xr

    from ..reading.scene import WrittenScene

Progress = Callable[[int], None]


def _nobody(done: int) -> None:
    """Progress that is not shown."""


def make_map(scene: WrittenScene, *, workers: int | None = None, progress: Progress = _nobody) -> xr.Dataset:
    """The map that the scene's [sweep] describes: two grids from which it starts, and `refine`.

    Raises SceneError for a sweep of which no map can be made, or too many cases.
    """
    begun = time.perf_counter()
    threads = workers or len(os.sched_getaffinity(0))
    study = Study(scene, plan_sweep(scene), threads, Kept())
    try:
        work = _Map(study, progress)
        found = refine(work.look, work.sides, work.tolerance)
    except SceneError as error:
        raise error.at(file=scene.data.file) from None
    return _dataset(work, found, time.perf_counter() - begun)


class _Map:
    """What a map needs of a study: its axes, its outcomes, and a look at places."""

    def __init__(self, study: Study, progress: Progress) -> None:
        self.study = study
        self._progress = progress
        asked = study.data.sweep.refine or Refine()
        self.tolerance = asked.tolerance
        self.sides = _sides(study, self.tolerance)
        self.outcomes = Outcomes(_questions(study, asked), study.data.file)
        self.look = Looks(self._compute)

    def _compute(self, places: Places) -> Ints:
        """The outcomes [n] of places [n, 2] that were not seen before."""
        most = self.study.data.solve.max_cases
        if len(self.look) + len(places) > most:
            reason = f"the map needs more than {most} cases; allow more, or a greater sweep.refine.tolerance"
            raise SceneError(reason, path="solve.max_cases", value=most)
        values = [side.axis.in_si(side.value(places[:, k])) for k, side in enumerate(self.sides)]
        swept = np.stack(values, axis=1)
        step = self.study.max_chunk
        parts = []
        for first in range(0, len(swept), step):
            block = self.study.solver.compute(swept[first : first + step], workers=self.study.workers)
            parts.append(self.outcomes.of_block(block))
            self._progress(len(self.look) + first + len(block))
        return np.concatenate(parts)


def _sides(study: Study, tolerance: float) -> tuple[Side, Side]:
    """Both axes of the map."""
    groups = study.plan.groups
    if len(groups) != 2 or any(len(group) != 1 for group in groups) or study.plan.listed is not None:
        reason = (
            "a map is over two parameters with a grid each; this sweep has "
            f"{' x '.join('+'.join(axis.name for axis in group) for group in groups)}"
        )
        raise SceneError(reason, path="sweep")
    axes = [group[0] for group in groups]
    logs = [study.data.sweep.grids[axis.name].scale == "log" for axis in axes]
    halvings = max(halvings_for(axis, tolerance, log) for axis, log in zip(axes, logs, strict=True))
    first, second = (Side(axis, 1 << halvings, log) for axis, log in zip(axes, logs, strict=True))
    return first, second


def _questions(study: Study, asked: Refine) -> list[tuple[Asked, int]]:
    """The asks that tell outcomes apart, with their columns: those named, or all words of events."""
    columns = np.cumsum([0, *(ask.count for ask in study.asks)]).tolist()
    asks = {ask.key: (ask, first) for ask, first in zip(study.asks, columns, strict=False)}
    if asked.of is None:
        words = [one for one in asks.values() if one[0].letters]
        if words:
            return words
        reason = (
            'what tells outcomes apart is wanted: an ask such as outcome = { events = ["tip"] }, or '
            'sweep.refine = { of = ["NAME"] } with names of asks'
        )
        raise SceneError(reason, path="sweep.refine")
    for index, name in enumerate(asked.of):
        if asks[name][0].is_list:
            reason = f'"{name}" is a list; an outcome is told by asks that are one number'
            raise SceneError(reason, path=f"sweep.refine.of[{index}]", value=name)
    return [asks[name] for name in asked.of]


# ---- the dataset ----


def _dataset(work: _Map, found: Refined, seconds: float) -> xr.Dataset:
    import xarray as xr

    names = work.outcomes.names()
    data: dict[str, xr.Variable] = {"outcome": xr.Variable("outcome", np.array(names, dtype=object))}
    _add_cases(work, data)
    curves = curves_of(found)
    _add_ragged(work, data, ("curve", "points", "point"), [curve.points for curve in curves])
    sides = np.array([curve.outcomes for curve in curves], np.int32).reshape(-1, 2)
    data["curve_outcomes"] = xr.Variable(
        ("curve", "side"), sides, {"long_name": "outcomes on both sides of the boundary"}
    )
    pieces = list(pieces_of(found))
    _add_ragged(work, data, ("piece", "vertices", "vertex"), [piece.points for piece in pieces])
    of_piece = np.array([piece.outcome for piece in pieces], np.int32)
    data["piece_outcome"] = xr.Variable("piece", of_piece)
    share = np.zeros(len(names))
    np.add.at(share, of_piece, [_area(work, piece.points) for piece in pieces])
    data["share"] = xr.Variable("outcome", share, {"units": "1", "long_name": "part of the area of the map"})
    return xr.Dataset(data, attrs=_attributes(work, found, seconds)).set_coords("outcome")


def _add_cases(work: _Map, data: dict[str, xr.Variable]) -> None:
    import xarray as xr

    places, numbers = work.look.places(), work.look.outcomes()
    for k, side in enumerate(work.sides):
        units = {**cf_units(side.axis.unit), "long_name": f"parameter {side.axis.name}"}
        data[side.axis.name] = xr.Variable("case", side.value(places[:, k]), units)
    data["case_outcome"] = xr.Variable("case", numbers, {"long_name": "number of the outcome"})
    statuses = np.array(work.outcomes.statuses(), np.int32)[numbers]
    data["status"] = xr.Variable("case", statuses, {"long_name": "how the case ended"})


def _add_ragged(
    work: _Map,
    data: dict[str, xr.Variable],
    dims: tuple[str, str, str],
    lists: list[tuple[tuple[float, float], ...]],
) -> None:
    """Lists of points one after the other, with their lengths."""
    import xarray as xr

    of, count, point = dims
    lengths = np.array([len(points) for points in lists], np.int64)
    data[f"{of}_{count}"] = xr.Variable(of, lengths, {"sample_dimension": point})
    flat = np.array([one for points in lists for one in points]).reshape(-1, 2)
    for k, side in enumerate(work.sides):
        units = cf_units(side.axis.unit)
        data[f"{point}_{side.axis.name}"] = xr.Variable(point, side.value(flat[:, k]), units)


def _area(work: _Map, points: tuple[tuple[float, float], ...]) -> float:
    """The area of a polygon in parts of both ranges."""
    x, y = (side.part(np.array(points)[:, k]) for k, side in enumerate(work.sides))
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def _attributes(work: _Map, found: Refined, seconds: float) -> dict[str, object]:
    study, cases = work.study, len(work.look)
    full = (1 + round(1 / work.tolerance)) ** 2
    return {
        **study.attributes(),
        "kind": KIND,
        "versions": json.dumps(versions()),
        "parameters": " ".join(side.axis.name for side in work.sides),
        "logarithmic": " ".join(side.axis.name for side in work.sides if side.log),
        "tolerance": work.tolerance,
        "cases": np.int64(cases),
        "cases_of_full_grid": np.float64(full),
        "cases_uncertain": np.int64(work.outcomes.uncertain),
        "open_cells": np.int64(len(found.open)),
        "elapsed_seconds": seconds,
    }
