"""One scene, run: each of its [runs] is flattened, computed and answered."""

from __future__ import annotations

import numpy as np

from . import engine
from .errors import SimulationError
from .flatten import HasData, flatten
from .result import RunResult, collect
from .scene import SceneData


def simulate(scene: HasData) -> RunResult:
    """Runs a scene as it is.  A run that fails is told by the result's status, not by an exception.

    Raises SceneError for a fault in the scene.
    """
    data: SceneData = scene.data
    runs = [flatten(data, name) for name in data.runs] or [flatten(data)]
    results = [(flat, engine.run_cases(flat, np.atleast_2d(flat.defaults))) for flat in runs]
    return collect(data.id, data.file, tuple(data.ask), results)


def run(scene: HasData) -> RunResult:
    """The same, but a failure (negative status) raises SimulationError, which carries the partial result."""
    result = simulate(scene)
    if result.code < 0:
        raise SimulationError(result.error, status=result.code, time=result.time, result=result)
    return result
