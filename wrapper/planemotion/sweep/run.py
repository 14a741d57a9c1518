"""A sweep from beginning to end: into files, or into memory."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.errors import StudyError
from .cache import Kept
from .cases import Study
from .chunks import Progress, fill
from .memory import MemoryStore, dataset
from .netcdf import write_result
from .plan import plan_sweep
from .size import Size, check_cases, check_disk, check_memory, expected_size
from .store import SweepStore
from .table import is_table_of, write_csv

if TYPE_CHECKING:
    import xarray as xr

    from ..reading.scene import WrittenScene


class SweepInterrupted(StudyError):
    """Ctrl-C: the sweep stopped; `done` of `total` cases are stored and `--resume` goes on from there."""

    def __init__(self, message: str, done: int, total: int) -> None:
        super().__init__(message)
        self.done = done
        self.total = total


@dataclass(frozen=True)
class SweepFiles:
    """What a sweep left: the HDF5 file, the CSV file, the cases in them, and how many are new."""

    result: Path
    table: Path
    cases: int
    computed: int


def _study_of(scene: WrittenScene, workers: int | None, kept: Kept | None = None) -> Study:
    if workers is not None and workers < 1:
        raise StudyError(f"workers = {workers}: at least 1 is needed")
    return Study(scene, plan_sweep(scene), workers or len(os.sched_getaffinity(0)), kept or Kept())


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
) -> SweepFiles:
    """Runs all cases of the scene's [sweep] and leaves OUT/ID.h5 and OUT/ID.csv.

    `workers`: threads (default: the processors of this process).  `resume`: go on where an earlier sweep into
    `out` was ended; begins where there is none.  `progress(done, total)` is called some times a second in the
    calling thread.  `kept`: of earlier sweeps of the scene, over whatever grids.  `tell(text)` is called
    before anything is computed with how much it will be.  A case that fails becomes NaN, status and message;
    the sweep goes on.

    Raises SceneError (the scene cannot be swept), StudyError (the output cannot be used or written, or
    belongs to something else; nothing half-written stays) and SweepInterrupted (Ctrl-C).
    """
    study = _study_of(scene, workers, kept)
    plan, folder, size = study.plan, Path(out), _size_of(study)
    store = SweepStore(folder, _file_name(scene.data.id), plan.cases, study.manifest(), resume=resume)
    with store:
        missing = plan.cases - store.done
        if missing == plan.cases:
            check_disk(size, folder)
        if missing:
            tell(size.text)
        try:
            fill(store, study, progress or _nobody)
            if not store.finished:
                with store.finish() as path:
                    attributes = {**study.attributes(), "manifest": json.dumps(store.manifest)}
                    write_result(path, study.layout, store.blocks(), attributes)
            if missing or not _has_table(store, tell):
                write_csv(store.result, store.table)
            store.remove_parts()
        except KeyboardInterrupt:
            raise SweepInterrupted(
                f"stopped: {store.done} of {plan.cases} cases are saved in {folder}; go on with --resume",
                store.done,
                plan.cases,
            ) from None
    return SweepFiles(store.result, store.table, plan.cases, missing)


def _has_table(store: SweepStore, tell: Callable[[str], None]) -> bool:
    """Whether the table of a result that was there before is whole."""
    if not store.table.exists():
        return False
    if is_table_of(store.result, store.table):
        return True
    tell(f"{store.table}: was damaged, or changed; it is written anew from {store.result.name}")
    return False


def run_sweep(
    scene: WrittenScene,
    *,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> xr.Dataset:
    """As `sweep_files`, but gives the labelled results: opened lazily from OUT/ID.h5 (its path is in
    `encoding["source"]`), or, without `out`, in memory, with no file left behind."""
    if out is not None:
        import xarray as xr

        files = sweep_files(scene, out, workers=workers, resume=resume, progress=progress, kept=kept)
        return xr.open_dataset(files.result, engine="h5netcdf")
    study = _study_of(scene, workers, kept)
    check_memory(_size_of(study))
    store = MemoryStore(study.plan.cases)
    fill(store, study, progress or _nobody)
    attributes = {**study.attributes(), "manifest": json.dumps(study.manifest())}
    return dataset(study.layout, store.blocks, attributes)


def _file_name(identity: str) -> str:
    """A scene's id as the name of a file."""
    return re.sub(r"[^\w.+-]", "_", identity).lstrip(".") or "sweep"
