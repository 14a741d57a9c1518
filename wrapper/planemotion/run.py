"""One scene, run: each of its [runs] is computed and answered."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .base.errors import SimulationError
from .engine import call
from .engine.result import RunResult, collect

if TYPE_CHECKING:
    from .scene import Scene


def simulate(scene: Scene) -> RunResult:
    """Runs a scene as it is.  A run that fails is seen by the result's status, not by an exception.

    Raises SceneError for a fault in the scene.
    """
    data = scene.data
    results = [(flat, call.run_cases(flat, np.atleast_2d(flat.defaults))) for flat in scene.tables()]
    return collect(data.id, data.file, tuple(data.ask), results)


def run(scene: Scene) -> RunResult:
    """The same, but a failure (negative status) raises SimulationError, which carries the partial result."""
    result = simulate(scene)
    if result.code < 0:
        raise SimulationError(result.error, status=result.code, time=result.time, result=result)
    return result
