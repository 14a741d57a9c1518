"""One scene, run: each of its [runs] is computed and answered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _layout as layout
from .base.arrays import Floats
from .base.errors import SimulationError
from .compile.asks import EACH_FIRINGS, MOST_FIRINGS
from .compile.flatten import flatten
from .engine import call
from .engine.outcome import CaseResults
from .engine.result import RunResult, collect
from .geometry.parameters import like_declared
from .report.waited import ENDLESS, waited_for

if TYPE_CHECKING:
    from .compile.flatten import FlatScene
    from .reading.scene import SceneData
    from .scene import Scene


# How much longer lists become at once.
_LONGER = 16


def simulate(scene: Scene) -> RunResult:
    """Runs a scene as it is.  A run that fails is seen by the result's status, not by an exception.

    Raises SceneError for a fault in the scene.
    """
    data = scene.data
    results = [_with_whole_lists(scene, flat, _run_once(flat)) for flat in scene.tables()]
    result = _told_more(data, results, collect(data.id, data.file, tuple(data.ask), results))
    shared = [group for flat, one in results if _is_shared(one) for group in _shared(flat)]
    return replace(result, notes=(*result.notes, *dict.fromkeys(shared))) if shared else result


def _told_more(
    data: SceneData, results: Sequence[tuple[FlatScene, CaseResults]], result: RunResult
) -> RunResult:
    """The same; what a run that did not come to its end waited for is told with its error."""
    for flat, one in results:
        if result.code in ENDLESS and int(one.status[0]) == result.code and flat.find is None:
            more = waited_for(data, flat.run)
            return replace(result, error=f"{result.error}; {more}") if more else result
    return result


def _run_once(flat: FlatScene) -> CaseResults:
    return call.run_cases(flat, np.atleast_2d(flat.defaults))


def _with_whole_lists(scene: Scene, flat: FlatScene, results: CaseResults) -> tuple[FlatScene, CaseResults]:
    """Once more with longer lists, up to the longest, while an event fires more often than one is long."""
    firings = EACH_FIRINGS
    while firings < MOST_FIRINGS and _has_cut_list(flat, results):
        firings = min(_LONGER * firings, MOST_FIRINGS)
        flat = flatten(scene, flat.run, history=False, firings=firings)
        results = _run_once(flat)
    return flat, results


def _has_cut_list(flat: FlatScene, results: CaseResults) -> bool:
    rows = [ask.row for ask in flat.asks if ask.is_list]
    return bool(rows) and bool((results.reason[:, rows] == layout.PM_REASON_CUT).any())


def _is_shared(results: CaseResults) -> bool:
    return bool((results.reason == layout.PM_REASON_SHARED).any())


def _shared(flat: FlatScene) -> list[str]:
    """Which joints and contacts share their loads in some phase of the run."""
    start = call.check(flat).shared
    groups = dict.fromkeys([*start, *(group for phase in call.phases(flat) for group in phase.shared)])
    return [
        f'{", ".join(group)} share their loads; nothing tells how (solve.shared = "least" gives the least)'
        for group in groups
    ]


def run(scene: Scene) -> RunResult:
    """The same, but a failure (negative status) raises SimulationError, which carries the partial result."""
    result = simulate(scene)
    if result.code < 0:
        raise SimulationError(result.error, status=result.code, time=result.stopped_at, result=result)
    return result


def run_near(scene: Scene, values: Mapping[str, Any]) -> RunResult | None:
    """The result for other sizes of some parameters, as TOML has them, by the tables that are there.

    None where that may not be all that changes, or if it is not ok: the scene with these values tells more.
    """
    data = scene.data
    results = []
    for flat in scene.tables():
        near = _near(flat, data, values)
        if near is None:
            return None
        found = call.run_cases(flat, near[None])
        if _has_cut_list(flat, found) or _is_shared(found) or found.status[0] != layout.PM_OK:
            return None
        results.append((flat, found))
    return collect(data.id, data.file, tuple(data.ask), results)


def _near(flat: FlatScene, data: SceneData, values: Mapping[str, Any]) -> Floats | None:
    """The parameters [parameters] of the tables; None if these are not what the values change alone."""
    own = data.runs[flat.run] if flat.run is not None else {}
    sought = flat.find.vary if flat.find is not None else {}
    defaults = flat.defaults.copy()
    for name, value in values.items():
        if name not in flat.parameters or name in flat.decided or name in sought:
            return None
        size = like_declared(data.parameters[name], value) if name in data.parameters else None
        if size is None:
            return None
        if name not in own:
            defaults[flat.parameters.index(name)] = size
    if not flat.checks.hold(dict(zip(flat.parameters, defaults.tolist(), strict=True))):
        return None
    return defaults
