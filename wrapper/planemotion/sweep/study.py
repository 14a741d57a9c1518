"""Sweeps: which cases there are, and computing them in chunks so that a killed sweep can go on.

A sweep is a grid over parameters.  Its cases are numbered in C order (the last parameter changes fastest)
and made on the fly, chunk by chunk.  A chunk is about half a second of work; it is computed by the kernel's
threads while the chunk before it is stored.  No row depends on chunks, workers or interruptions: each is, bit
for bit, what a single run with the same parameter values gives.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._layout import PM_AUDITS, PM_COUNT_ROUTE, PM_OK, PM_TRUST_EXCESS, PM_TRUST_MARGIN, PM_TRUSTS
from ..base.errors import SceneError, StudyError
from ..base.versions import versions
from ..compile.flatten import FlatScene, flatten
from ..engine import call as engine
from ..geometry.parameters import Parameters
from ..language.units import factor, parse_quantity
from ..model.readers import Value
from ..model.tables import Ask, At
from ..reading.scene import SceneData
from .cache import Kept
from .export import RESERVED_NAMES, AskVariable, Coordinate, Layout, dataset, write_csv, write_result
from .grids import read_grid
from .memory import MemoryStore
from .store import CHECKSUMS, Block, Floats, Singles, SweepStore

if TYPE_CHECKING:
    import xarray as xr

    from ..reading.scene import WrittenScene

# Seconds of work per chunk: what a kill may cost, and far more than storing a part takes.
CHUNK_SECONDS = 0.5
# Bounds of a chunk: its cases, the bytes of its answers, and how fast its size may grow towards the goal.
_MAX_CHUNK = 1 << 17
_MAX_CHUNK_BYTES = 1 << 24
_GROWTH = 4
_FIRST_CHUNK_PER_WORKER = 8
# Between two looks at progress and at Ctrl-C, and the time the kernel gets to end after Ctrl-C, in s.
_POLL = 0.05
_GRACE = 0.7
# Other versions of these might compute other bits; the rest only writes files.
_ROW_VERSIONS = ("planemotion", "kernel", "SUNDIALS", "GSL")
# Of the part files and the manifest: another number, no resume.
_FORMAT = 3

Progress = Callable[[int, int], None]


class SweepInterrupted(StudyError):
    """Ctrl-C: the sweep stopped; `done` of `total` cases are stored and `--resume` goes on from there."""

    def __init__(self, message: str, done: int, total: int) -> None:
        super().__init__(message)
        self.done = done
        self.total = total


# ---- the cases ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Axis:
    """The values of one swept parameter, as written, in `unit`."""

    name: str
    unit: str
    values: Floats

    @cached_property
    def si(self) -> Floats:
        """The values in SI, each with the bits that `parse_quantity` gives for its text."""
        return self.values * factor(self.unit)[0]


@dataclass(frozen=True)
class SweepPlan:
    """The cases of a sweep; `groups` are its dimensions, each with the parameters that move along it."""

    groups: tuple[tuple[Axis, ...], ...]

    @property
    def axes(self) -> tuple[Axis, ...]:
        return tuple(axis for group in self.groups for axis in group)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(axis.name for axis in self.axes)

    @property
    def dims(self) -> tuple[tuple[str, int], ...]:
        """Name (of its first parameter) and length of each dimension."""
        return tuple((group[0].name, len(group[0].values)) for group in self.groups)

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(size for _, size in self.dims)

    @property
    def cases(self) -> int:
        return math.prod(self.shape)

    def case(self, index: int) -> dict[str, str]:
        """The parameters of one case as one would write them after --set: "1.01 in"."""
        place = np.unravel_index(index, self.shape)
        return {
            axis.name: f"{float(axis.values[i])!r} {axis.unit}".rstrip()
            for group, i in zip(self.groups, place, strict=True)
            for axis in group
        }

    def block(self, first: int, count: int) -> Floats:
        """SI values [count, len(names)] of cases first .. first+count-1."""
        place = np.unravel_index(np.arange(first, first + count, dtype=np.int64), self.shape)
        columns = [axis.si[i] for group, i in zip(self.groups, place, strict=True) for axis in group]
        return np.stack(columns, axis=1)


def plan_sweep(scene: WrittenScene) -> SweepPlan:
    """The cases of the scene's [sweep].  Raises SceneError with file and key path."""
    try:
        return _plan(scene.data)
    except SceneError as error:
        raise error.at(file=scene.data.file) from None


def _plan(data: SceneData) -> SweepPlan:
    if not data.sweep.grids:
        raise SceneError("nothing to sweep; write for example sweep.d = { from, to, num }", path="sweep")
    dimensions = Parameters(data.parameters).dimensions
    axes: dict[str, Axis] = {}
    for name, grid in data.sweep.grids.items():
        unit, values = read_grid(grid, path=f"sweep.{name}", unit=_declared_unit(data.parameters[name]))
        wanted, given = dimensions[name], factor(unit)[1]
        if wanted not in (None, given):
            raise SceneError(
                f"the grid is of {given.name}, but the parameter is {wanted.phrase}", path=f"sweep.{name}"
            )
        axes[name] = Axis(name, unit, values)
    return SweepPlan(tuple(_grouped(axes, data.sweep.zip)))


def _declared_unit(raw: Value) -> str:
    """Unit of a parameter as the file gives it; "" where it is an expression."""
    try:
        return parse_quantity(raw).unit_text
    except SceneError:
        return ""


def _grouped(axes: Mapping[str, Axis], zips: Sequence[Sequence[str]]) -> Iterator[tuple[Axis, ...]]:
    """The dimensions in the order of the file; a zip stands where its first parameter does."""
    together: dict[str, tuple[Axis, ...]] = {}
    for i, names in enumerate(zips):
        group = tuple(axes[name] for name in names)
        if len({len(axis.values) for axis in group}) > 1:
            sizes = ", ".join(f"{axis.name} has {len(axis.values)}" for axis in group)
            raise SceneError(f"zipped grids need equal numbers of values: {sizes}", path=f"sweep.zip[{i}]")
        together.update(dict.fromkeys(names, group))
    seen: set[str] = set()
    for name, axis in axes.items():
        if name not in seen:
            group = together.get(name, (axis,))
            seen.update(member.name for member in group)
            yield group


# ---- from cases to results ------------------------------------------------------------------------------


@dataclass(frozen=True)
class _AskPlace:
    """Where the numbers of an ask come from: column `first` of the run, ask number `index` there."""

    key: str
    unit: str
    factor: float
    run: int
    index: int
    first: int
    count: int
    is_list: bool


class _Study:
    """A scene made ready for its cases: one flat scene for each of its [runs].

    `kept`: what earlier sweeps of the same scene found out.
    """

    def __init__(self, scene: WrittenScene, plan: SweepPlan, workers: int, kept: Kept) -> None:
        self.data = scene.data
        self.text = scene.text
        self.words = scene.to_toml()  # without comments: they change no row
        self.plan = plan
        self.workers = workers
        self.runs = tuple(self.data.runs)
        self.kept = kept
        self.flats = kept.flats(
            scene.raw,
            scene.file,
            (frozenset(plan.names), False),
            lambda: [flatten(scene, run, history=False) for run in self.runs or (None,)],
        )
        self.asks = self._ask_places()
        self.layout = self._layout()

    def _ask_places(self) -> list[_AskPlace]:
        """The asks in the order of the file."""
        places = [
            _AskPlace(ask.key, ask.unit, ask.factor, run, index, ask.first, ask.count, ask.is_list)
            for run, flat in enumerate(self.flats)
            for index, ask in enumerate(flat.asks)
        ]
        order = {key: i for i, key in enumerate(self.data.ask)}
        return sorted(places, key=lambda place: order[place.key])

    def _layout(self) -> Layout:
        coordinates = tuple(
            Coordinate(axis.name, group[0].name, axis.unit, axis.values)
            for group in self.plan.groups
            for axis in group
        )
        asks = tuple(
            AskVariable(
                ask.key,
                ask.unit,
                ask_text(self.data.ask[ask.key]),
                ask.count,
                ask.is_list,
                _list_values(self.data.ask[ask.key], ask.count),
            )
            for ask in self.asks
        )
        taken = set(RESERVED_NAMES)
        for name, path in [
            *((name, f"sweep.{name}") for name in self.plan.names),
            *((name, f"ask.{ask.key}") for ask in asks for name in (ask.key, ask.error, *ask.dim)),
        ]:
            if name in taken or "/" in name:
                raise SceneError(
                    "this name cannot stand in the result of a sweep: it is taken there, or has a slash; "
                    "choose another",
                    file=self.data.file,
                    path=path,
                )
            taken.add(name)
        return Layout(self.plan.dims, coordinates, asks, self.runs, self.data.solve.estimate)

    @property
    def max_chunk(self) -> int:
        """Cases that are computed at once at most."""
        case_bytes = 8 * sum(ask.count for ask in self.asks) * (1 + self.data.solve.estimate)
        return max(1, min(_MAX_CHUNK, _MAX_CHUNK_BYTES // max(case_bytes, 1)))

    def compute(
        self, first: int, count: int, stop: npt.NDArray[np.int32], done: npt.NDArray[np.int64]
    ) -> Block:
        """Runs cases first .. first+count-1; done[run] counts those finished, stop[0] = 1 ends early."""
        begun = time.perf_counter()
        swept = self.plan.block(first, count)
        results = []
        for run, flat in enumerate(self.flats):
            param = self._param(flat, run, swept)
            results.append(
                engine.run_cases(flat, param, workers=self.workers, stop=stop, progress=done[run : run + 1])
            )
        return self._block(results, begun)

    def _param(self, flat: FlatScene, run: int, swept: Floats) -> Floats:
        """The parameters of one run's cases; what a run sets itself is not swept in it."""
        param = np.tile(np.asarray(flat.defaults, np.float64), (len(swept), 1))
        own = self.data.runs[self.runs[run]] if self.runs else {}
        for name, column in zip(self.plan.names, swept.T, strict=True):
            if name not in own and name in flat.parameters:
                param[:, flat.parameters.index(name)] = column
        return param

    def _block(self, results: Sequence[engine.CaseResults], begun: float) -> Block:
        run_status = np.stack([result.status for result in results], axis=1).astype(np.int32)
        value = self._columns([result.out for result in results])
        error = self._columns([result.error for result in results])
        reason = np.empty((len(run_status), len(self.asks)), np.int8)
        for i, ask in enumerate(self.asks):
            reason[:, i] = results[ask.run].reason[:, ask.index]
            value[i][np.isinf(value[i])] = np.nan
        status = _worst(run_status)
        return Block(
            value=_side_by_side(value, len(status)),
            reason=reason,
            status=status,
            run_status=run_status,
            route=np.stack([result.count[:, PM_COUNT_ROUTE] for result in results], axis=1),
            audit=np.stack([result.audit[:, :PM_AUDITS] for result in results], axis=1),
            error=_side_by_side(error if self.data.solve.estimate else [], len(status)).astype(np.float32),
            trust=_worst_trust([result.trust for result in results], self.data.solve.estimate),
            message={int(row): self._message(results, row) for row in np.flatnonzero(status)},
            seconds=time.perf_counter() - begun,
        )

    def _columns(self, of_runs: Sequence[Floats]) -> list[Floats]:
        """The columns of each ask, in its unit, from the columns of the runs."""
        return [
            np.asarray(of_runs[ask.run][:, ask.first : ask.first + ask.count]) / ask.factor
            for ask in self.asks
        ]

    def _message(self, results: Sequence[engine.CaseResults], row: np.intp) -> str:
        texts = []
        for run, result in enumerate(results):
            if result.status[row] != PM_OK:
                text = engine.message(self.flats[run], result, int(row))
                texts.append(f"runs.{self.runs[run]}: {text}" if self.runs else text)
        return "; ".join(texts)

    def manifest(self) -> dict[str, Any]:
        """All that the rows depend on, for a resumed sweep to compare."""
        return {
            "format": _FORMAT,
            "scene": self.words,
            "sweep": {
                axis.name: {
                    "unit": axis.unit,
                    "num": len(axis.values),
                    "from": float(axis.values[0]),
                    "to": float(axis.values[-1]),
                }
                for axis in self.plan.axes
            },
            "versions": {name: text for name, text in versions().items() if name in _ROW_VERSIONS},
            CHECKSUMS: {
                **{f"values of {axis.name}": _hash(axis.si) for axis in self.plan.axes},
                **{
                    f"tables {run}".strip(): _hash(flat.table, flat.constant, flat.defaults)
                    for run, flat in zip(self.runs or ("",), self.flats, strict=True)
                },
            },
        }

    def attributes(self) -> dict[str, Any]:
        """Attributes of the result that say where it comes from."""
        return {
            "Conventions": "CF-1.10",
            "title": self.data.title or self.data.id,
            "id": self.data.id,
            "scene": self.text,
            "versions": json.dumps(versions()),
            "solve": self.data.solve.model_dump_json(),
            "workers": self.workers,
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
        }


def ask_text(ask: Ask) -> str:
    """What was asked, for people: "max hoop.omega", "-sphere.omega at before strike 1"."""
    words = [("", ask.of), ("max ", ask.max), ("min ", ask.min)]
    if isinstance(ask.at, At):
        words += [("at max ", ask.at.max), ("at min ", ask.at.min), ("at each ", ask.at.each)]
    else:
        words.append(("at ", ask.at))
    words.append(("in run ", ask.run))
    return " ".join(f"{word}{written}" for word, written in words if written is not None)


def _list_values(ask: Ask, count: int) -> tuple[str, Floats] | None:
    """Unit and values at which a list of `count` numbers is asked, if they are plain quantities."""
    if not isinstance(ask.at, At) or ask.at.values is None:
        return None
    try:
        unit, values = read_grid(ask.at.values, path="at.values")
    except SceneError:  # expressions, which may differ from case to case
        return None
    return (unit, values) if len(values) == count else None


def _worst(run_status: npt.NDArray[np.int32]) -> npt.NDArray[np.int32]:
    """Per case: the first failure of its runs, or else the first early stop, or else ok."""
    worst = np.zeros(len(run_status), np.int32)
    for status in run_status.T:
        worst = np.where((worst == PM_OK) | ((worst > PM_OK) & (status < PM_OK)), status, worst)
    return worst


def _side_by_side(columns: Sequence[Floats], cases: int) -> Floats:
    return np.concatenate(columns, axis=1) if columns else np.empty((cases, 0))


def _worst_trust(of_runs: Sequence[Floats], estimate: bool) -> Singles:
    """Per case: the least margin of its runs and the greatest excess; no columns without estimates."""
    if not estimate:
        return np.empty((len(of_runs[0]), 0), np.float32)
    worst = np.empty((len(of_runs[0]), PM_TRUSTS), np.float32)
    worst[:, PM_TRUST_MARGIN] = np.min([trust[:, PM_TRUST_MARGIN] for trust in of_runs], axis=0)
    worst[:, PM_TRUST_EXCESS] = np.max([trust[:, PM_TRUST_EXCESS] for trust in of_runs], axis=0)
    return worst


def _hash(*arrays: npt.NDArray[Any]) -> str:
    total = hashlib.sha256()
    for array in arrays:
        total.update(f"{array.dtype.str}{array.shape}".encode())
        total.update(np.ascontiguousarray(array).tobytes())
    return total.hexdigest()


# ---- computing ------------------------------------------------------------------------------------------


class _ChunkCall:
    """A chunk computed in a thread of its own: the main thread shows progress meanwhile, and can stop it."""

    def __init__(self, study: _Study, first: int, count: int) -> None:
        self._stop = np.zeros(1, np.int32)
        self._done = np.zeros(len(study.flats), np.int64)
        self._block: Block | None = None
        self._error: BaseException | None = None

        def compute() -> None:
            try:
                self._block = study.compute(first, count, self._stop, self._done)
            except BaseException as error:
                self._error = error

        # A daemon: a kernel that does not stop in time must not keep the process alive.
        self._thread = Thread(target=compute, daemon=True)
        self._thread.start()

    def wait(self, report: Callable[[int], None]) -> Block:
        """The results; until then `report` is told now and then how many cases are finished."""
        while self._thread.is_alive():
            self._thread.join(_POLL)
            report(int(self._done.min()))
        if self._block is None:
            assert self._error is not None
            raise self._error
        return self._block

    def cancel(self) -> None:
        self._stop[0] = 1
        self._thread.join(_GRACE)


class _Pacer:
    """Chooses the size of the next chunk from the time the last one took; `first`: of the first, if known."""

    def __init__(self, workers: int, most: int, first: int | None = None) -> None:
        self._workers = workers
        self._most = most
        self._size = min(first or workers * _FIRST_CHUNK_PER_WORKER, most)

    @property
    def size(self) -> int:
        """Cases of the next chunk."""
        return self._size

    def observe(self, count: int, seconds: float) -> None:
        goal = count * CHUNK_SECONDS / max(seconds, 1e-6)
        # Whole rounds of all workers, so that none waits for the last case of a small chunk.
        rounds = max(1, round(min(goal, self._size * _GROWTH) / self._workers))
        self._size = min(rounds * self._workers, self._most)

    def chunks(self, gaps: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int]]:
        """First case and number of cases of each chunk; its size is chosen when it is asked for."""
        for first, count in gaps:
            end = first + count
            while first < end:
                size = min(self._size, end - first)
                yield first, size
                first += size


def _fill(store: SweepStore | MemoryStore, study: _Study, progress: Progress) -> None:
    """Computes what is missing: each chunk while the one before it is being stored."""
    pacer = _Pacer(study.workers, study.max_chunk, study.kept.chunk.get(study.workers))
    computed: tuple[int, Block] | None = None
    call: _ChunkCall | None = None
    try:
        for first, count in pacer.chunks(store.gaps()):
            call = _ChunkCall(study, first, count)
            if computed:
                store.add(*computed)
            block = call.wait(lambda finished: progress(store.done + finished, study.plan.cases))
            pacer.observe(count, block.seconds)
            computed = first, block
        if computed:
            store.add(*computed)
        study.kept.chunk[study.workers] = pacer.size
    except BaseException:
        if call:
            call.cancel()
        raise
    progress(store.done, study.plan.cases)


@dataclass(frozen=True)
class SweepFiles:
    """What a sweep left: the HDF5 file, the CSV file, the cases in them, and how many are new."""

    result: Path
    table: Path
    cases: int
    computed: int


def _study_of(scene: WrittenScene, workers: int | None, kept: Kept | None = None) -> _Study:
    if workers is not None and workers < 1:
        raise StudyError(f"workers = {workers}: at least 1 is needed")
    return _Study(scene, plan_sweep(scene), workers or len(os.sched_getaffinity(0)), kept or Kept())


def _nobody(done: int, total: int) -> None:
    """Progress that is not shown."""


def sweep_files(
    scene: WrittenScene,
    out: str | os.PathLike[str],
    *,
    workers: int | None = None,
    resume: bool = False,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> SweepFiles:
    """Runs all cases of the scene's [sweep] and leaves OUT/ID.h5 and OUT/ID.csv.

    `workers`: threads (default: the processors of this process).  `resume`: go on where an earlier sweep into
    `out` was ended; begins where there is none.  `progress(done, total)` is called some times a second in the
    calling thread.  `kept`: of earlier sweeps of the scene, over whatever grids.  A case that fails becomes
    NaN, status and message; the sweep goes on.

    Raises SceneError (the scene cannot be swept), StudyError (the output cannot be used or written, or
    belongs to something else; nothing half-written stays) and SweepInterrupted (Ctrl-C).
    """
    study = _study_of(scene, workers, kept)
    plan, folder = study.plan, Path(out)
    store = SweepStore(folder, _file_name(scene.data.id), plan.cases, study.manifest(), resume=resume)
    with store:
        missing = plan.cases - store.done
        try:
            _fill(store, study, progress or _nobody)
            if not store.finished:
                with store.finish() as path:
                    attributes = {**study.attributes(), "manifest": json.dumps(store.manifest)}
                    write_result(path, study.layout, store.blocks(), attributes)
            if missing or not store.table.exists():
                write_csv(store.result, store.table)
            store.remove_parts()
        except KeyboardInterrupt:
            raise SweepInterrupted(
                f"stopped: {store.done} of {plan.cases} cases are saved in {folder}; go on with --resume",
                store.done,
                plan.cases,
            ) from None
    return SweepFiles(store.result, store.table, plan.cases, missing)


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
    store = MemoryStore(study.plan.cases)
    _fill(store, study, progress or _nobody)
    attributes = {**study.attributes(), "manifest": json.dumps(study.manifest())}
    return dataset(study.layout, store.blocks, attributes)


def _file_name(identity: str) -> str:
    """A scene's id as the name of a file."""
    return re.sub(r"[^\w.+-]", "_", identity).lstrip(".") or "sweep"
