"""A sweep from beginning to end: into files, or into memory."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.errors import SceneError, StudyError
from ..base.words import counted
from .cache import Kept
from .cases import Study
from .chunks import Progress, fill
from .forms import FileStore, Form, file_name, finish
from .memory import MemoryStore, dataset
from .plan import plan_sweep
from .shard import Shard
from .size import Size, check_cases, check_disk, check_memory, expected_size
from .spread import ExecutorLike, fill_by, is_executor
from .store import wait_for_cases

if TYPE_CHECKING:
    import xarray as xr

    from ..reading.scene import WrittenScene

_USUAL = Form()
# Ranges of missing cases that a message names.
_NAMED_GAPS = 3


class SweepInterrupted(StudyError):
    """Ctrl-C: the sweep stopped; `done` of `total` cases are stored and `--resume` goes on from there."""

    def __init__(self, message: str, done: int, total: int) -> None:
        super().__init__(message)
        self.done = done
        self.total = total


@dataclass(frozen=True)
class SweepFiles:
    """What a sweep left: the result, its table (if one was wanted), their cases, and how many are new."""

    result: Path
    table: Path
    cases: int
    computed: int


def _study_of(
    scene: WrittenScene,
    workers: Any,
    kept: Kept | None,
    executor: ExecutorLike | None = None,
    stop_after: int | None = None,
) -> Study:
    if workers is not None and not isinstance(workers, int):
        reason = 'a number of threads is wanted; a parameter of that name is swept by grids={"workers": ...}'
        raise SceneError(reason, file=scene.file, path="workers")
    if workers is not None and workers < 1:
        raise StudyError(f"workers = {workers}: at least 1 is needed")
    if executor is not None and not (callable(executor) or is_executor(executor)):
        raise StudyError(
            f"executor is {type(executor).__name__}; what has the method submit is wanted, such as a "
            "ProcessPoolExecutor or a dask.distributed.Client, or a function that makes it"
        )
    if stop_after is not None and stop_after < 1:
        raise StudyError(f"stop_after = {stop_after}: at least 1 is needed")
    usual = 1 if executor is not None else len(os.sched_getaffinity(0))
    study = Study(scene, plan_sweep(scene), workers or usual, kept or Kept())
    study.failures.most = stop_after
    return study


def _fill(
    store: FileStore | MemoryStore, study: Study, executor: ExecutorLike | None, progress: Progress
) -> None:
    if executor is None:
        fill(store, study, progress)
    else:
        fill_by(store, study, executor, progress)


def _size_of(study: Study) -> Size:
    """What the study leaves; SceneError for more cases than it allows."""
    size = expected_size(study.layout)
    check_cases(size, study.data.solve.max_cases, study.data.file)
    return size


def _nobody(done: int, total: int) -> None:
    """Progress that is not shown."""


def _silent(text: str) -> None:
    """What is not told."""


def sweep_files(
    scene: WrittenScene,
    out: str | os.PathLike[str],
    *,
    workers: int | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    kept: Kept | None = None,
    tell: Callable[[str], None] = _silent,
    executor: ExecutorLike | None = None,
    stop_after: int | None = None,
    form: Form = _USUAL,
) -> SweepFiles:
    """Runs all cases of the scene's [sweep] and leaves OUT/ID.h5 and OUT/ID.csv, or what `form` says.

    `workers`: threads (default: the processors of this process).  `executor`: what computes instead of them,
    as spread.py says; `workers` are then the threads of each of its tasks (default: 1).  `resume`: go on
    where an earlier sweep into `out` was ended; begins where there is none.  `progress(done, total)` is
    called some times a second in the calling thread.  `kept`: of earlier sweeps of the scene, over whatever
    grids.  `tell(text)` is called before anything is computed with how much it will be.  A case that fails
    becomes NaN, status and message; the sweep goes on.  `stop_after`: until so many have failed.
    `form`: of the files.

    Raises SceneError (the scene cannot be swept), StudyError (the output cannot be used or written, or
    belongs to something else; nothing half-written stays; or so many cases have failed) and
    SweepInterrupted (Ctrl-C).
    """
    study = _study_of(scene, workers, kept, executor, stop_after)
    plan, folder, size = study.plan, Path(out), _size_of(study)
    study.failures.hint = f"What was computed is saved in {folder}; go on with --resume"
    with form.store(folder, study, resume=resume) as store:
        missing = plan.cases - store.done
        if missing == plan.cases:
            check_disk(size, folder)
        if missing:
            tell(form.told(size))
        try:
            _fill(store, study, executor, progress or _nobody)
            table = finish(store, study, form, missing, tell)
        except KeyboardInterrupt:
            raise SweepInterrupted(
                f"stopped: {store.done} of {plan.cases} cases are saved in {folder}; go on with --resume",
                store.done,
                plan.cases,
            ) from None
    return SweepFiles(store.result, table, plan.cases, missing)


@dataclass(frozen=True)
class ShardDone:
    """What a shard left: its cases, how many of them are new, and how many of the sweep are missing still."""

    cases: int
    computed: int
    missing: int


def sweep_shard(
    scene: WrittenScene,
    out: str | os.PathLike[str],
    shard: Shard,
    *,
    workers: int | None = None,
    progress: Progress | None = None,
    executor: ExecutorLike | None = None,
    stop_after: int | None = None,
    form: Form = _USUAL,
) -> ShardDone:
    """Runs the cases of one shard of the scene's [sweep] and leaves them as parts in OUT/ID.parts.

    Processes on any machines that see the folder may compute other shards meanwhile.  A shard that was ended
    goes on where it was.  `progress` is told the cases of all shards.  Raises as `sweep_files` does.
    """
    study = _study_of(scene, workers, None, executor, stop_after)
    _size_of(study)
    plan, folder = study.plan, Path(out)
    with form.store(folder, study, resume=True, shard=shard) as store:
        missing = store.missing
        try:
            _fill(store, study, executor, progress or _nobody)
        except KeyboardInterrupt:
            raise SweepInterrupted(
                f"stopped: shard {shard} has {counted(store.missing, 'case')} to go; "
                "the same command goes on there",
                store.done,
                plan.cases,
            ) from None
        return ShardDone(store.wanted, missing, plan.cases - store.count())


def merge_shards(
    scene: WrittenScene,
    out: str | os.PathLike[str],
    *,
    wait: bool = False,
    progress: Progress | None = None,
    tell: Callable[[str], None] = _silent,
    table: str = "csv",
) -> SweepFiles:
    """Makes OUT/ID.h5 and OUT/ID.csv of what the shards have left; the parts are removed then.

    `wait`: until all cases are there.  Raises StudyError if some are missing, and as `sweep_files` does.
    """
    study = _study_of(scene, None, None)
    folder, name, cases = Path(out), file_name(scene.data.id), study.plan.cases
    if wait:
        wait_for_cases(folder, name, cases, progress or _nobody)
    form = Form.in_folder(folder, name, table)
    if form.result == "hdf5" and not any((folder / f"{name}{end}").exists() for end in (".parts", ".h5")):
        raise StudyError(f"{folder}: no shard of the sweep {name} has been computed there")
    with form.store(folder, study, resume=True) as store:
        gaps = store.gaps()
        if gaps:
            named = ", ".join(f"{first} to {first + count - 1}" for first, count in gaps[:_NAMED_GAPS])
            more = f" and {len(gaps) - _NAMED_GAPS} more ranges" if len(gaps) > _NAMED_GAPS else ""
            raise StudyError(
                f"{folder}: {store.missing} of {cases} cases are missing: {named}{more}. Compute their "
                "shards once more, or what is missing here by sweep --resume"
            )
        was_there = store.finished
        made = finish(store, study, form, 0 if was_there else cases, tell)
    return SweepFiles(store.result, made, cases, 0)


def run_sweep(
    scene: WrittenScene,
    *,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    kept: Kept | None = None,
    executor: ExecutorLike | None = None,
    stop_after: int | None = None,
    form: Form = _USUAL,
) -> xr.Dataset:
    """As `sweep_files`, but gives the labelled results: opened lazily from OUT/ID.h5 (its path is in
    `encoding["source"]`), or, without `out`, in memory, with no file left behind."""
    if out is not None:
        import xarray as xr

        files = sweep_files(
            scene,
            out,
            workers=workers,
            resume=resume,
            progress=progress,
            kept=kept,
            executor=executor,
            stop_after=stop_after,
            form=form,
        )
        return xr.open_dataset(files.result, engine="zarr" if form.result == "zarr" else "h5netcdf")
    study = _study_of(scene, workers, kept, executor, stop_after)
    check_memory(_size_of(study))
    store = MemoryStore(study.plan.cases)
    _fill(store, study, executor, progress or _nobody)
    attributes = {**study.attributes(), "manifest": json.dumps(study.manifest())}
    return dataset(study.layout, store.blocks, attributes)
