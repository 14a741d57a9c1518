"""One scene over time: what moves, recorded between steps as exactly as at their ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .base.errors import SceneError, StudyError
from .compile.flatten import flatten
from .engine import recording
from .engine.history import dataset
from .language.units import seconds_of

if TYPE_CHECKING:
    import xarray

    from .engine.outcome import History
    from .scene import Scene


def history(
    scene: Scene, quantities: Sequence[str] = (), *, every: Any = None, run: str | None = None
) -> xarray.Dataset:
    """The history of one run as a dataset: see Scene.history.

    It has the dimension t with the coordinates t (s), mark (0 between events, 1 before, 2 after one) and
    event (its name); every variable has its SI unit in the attribute `units`.  A run that ends early has what
    there is, and says so in the attribute `status`.
    """
    recorded = record(scene, quantities, every=every, run=run)
    told = {"id": scene.id, "title": scene.data.title, "scene": scene.whole_text}
    return dataset(recorded, told if run is None else {**told, "run": run})


def record(
    scene: Scene, quantities: Sequence[str] = (), *, every: Any = None, run: str | None = None
) -> History:
    """The history of one run, SI.

    `quantities`: expressions; none: positions, velocities and energies, and the reactions that asks read.
    `every`: a time such as "10 ms"; None: as many instants as straight lines need.  Raises SceneError for
    what the scene does not have, SimulationError if nothing can be recorded, StudyError if it is too much.
    """
    try:
        seconds = None if every is None else _step(every)
        return recording.record(flatten(scene, run, history=tuple(quantities)), every=seconds)
    except (SceneError, StudyError) as error:
        raise error.at(file=scene.file) from None


def record_runs(scene: Scene, quantities: Sequence[str] = (), *, every: Any = None) -> dict[str, History]:
    """The histories of all its [runs] by name; the one of a scene without them has the name "".

    Errors as of `record`."""
    return {run or "": record(scene, quantities, every=every, run=run) for run in scene.run_names or (None,)}


def _step(every: Any) -> float:
    """A time above zero in s.  Raises SceneError."""
    seconds = seconds_of(every, "every", 'a time such as "10 ms" is wanted')
    if not seconds > 0:
        raise SceneError("a time above zero is wanted", path="every", value=every)
    return seconds
