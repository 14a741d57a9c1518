"""A study: which cases there are, what computes them, what is left of them, and what all that depends on."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..base.errors import SceneError
from ..base.versions import row_versions, versions
from ..compile.asks import Asked
from ..compile.flatten import FlatScene, flatten
from .block import Block
from .cache import Kept
from .failures import Failures
from .layout import RESERVED_NAMES, Coordinate, Layout, names_of
from .manifest import CHECKSUMS
from .plan import SweepPlan
from .retry import Retrying, settings_of, told
from .solver import Solver
from .variants import Variants, asks_of_all, switches_of, variants_of

if TYPE_CHECKING:
    from ..reading.scene import SceneData, WrittenScene


# What is computed at once at most: cases, and bytes of their answers.
_MAX_CASES = 1 << 17
_MAX_BYTES = 1 << 24
# Of the part files and the manifest: another number, no resume.
_FORMAT = 5


class Study:
    """A scene made ready for its cases: one flat scene for each of its [runs], and of its variants.

    `kept`: what earlier sweeps of the same scene found out.
    """

    def __init__(self, scene: WrittenScene, plan: SweepPlan, workers: int, kept: Kept) -> None:
        self.data = scene.data
        self.text = scene.whole_text
        self._scene = scene
        self.plan = plan
        self.workers = workers
        self.failures = Failures(plan)
        self.runs = tuple(self.data.runs)
        self.kept = kept
        try:
            columns, variants = variants_of(plan, self.data.counted | switches_of(self.data))
        except SceneError as error:
            raise error.at(file=self.data.file) from None
        named = [plan.names[i] for i in columns]
        # Tables of each run of each variant; SI, so that each is told by its bits.
        scenes = [self._variant(dict(zip(named, values, strict=True))) for values in variants]
        self.flats = kept.flats(
            scene.table,
            scene.file,
            (frozenset({*plan.names, *map(repr, variants)}), False),
            lambda: [flatten(one, run, history=False) for one in scenes for run in self.runs or (None,)],
        )
        size = len(self.runs) or 1
        solvers = [
            self._with_retry(one, self._solver(one.data, self.flats[i * size : (i + 1) * size]))
            for i, one in enumerate(scenes)
        ]
        self.asks = asks_of_all(solvers)
        self.solver: Solver | Retrying | Variants = solvers[0]
        if columns:
            self.solver = Variants(columns, dict(zip(variants, solvers, strict=True)), self.asks)
        self.layout = self._layout()

    def _variant(self, values: Mapping[str, float]) -> WrittenScene:
        """The scene at one value of each parameter on which it depends what there is."""
        if not values:
            return self._scene
        axes = {axis.name: axis for axis in self.plan.axes}
        places = {name: axes[name].si.tolist().index(value) for name, value in values.items()}
        try:
            made = self._scene.with_values({name: axes[name].text(i) for name, i in places.items()})
            made.data  # noqa: B018 - a fault of one variant is told with it
        except SceneError as error:
            told = ", ".join(f"{name} = {axes[name].text(i)}" for name, i in places.items())
            raise SceneError(f"with {told}: {error}") from None
        return made

    def _with_retry(self, scene: WrittenScene, solver: Solver) -> Solver | Retrying:
        """What computes failed cases once more, where the sweep says so."""
        if self.data.sweep.retry is None:
            return solver
        settings = settings_of(self.data.sweep.retry)
        try:
            other = scene.with_values(settings)
            flats = [flatten(other, run, history=False) for run in self.runs or (None,)]
        except SceneError as error:
            raise SceneError(
                f"as {error.path} that is no setting: {error.reason}", path="sweep.retry"
            ) from None
        return Retrying(solver, self._solver(other.data, flats), told(settings))

    def _solver(self, data: SceneData, flats: Sequence[FlatScene]) -> Solver:
        return Solver(
            names=self.plan.names,
            flats=tuple(flats),
            runs=self.runs,
            own=tuple(frozenset(data.runs[run]) for run in self.runs) or (frozenset(),),
            asks=_asks_of(data, flats),
            estimate=data.solve.estimate,
        )

    def _layout(self) -> Layout:
        coordinates = tuple(
            Coordinate(axis.name, dim, axis.unit, axis.values, axis.labels)
            for (dim, _), group in zip(self.plan.dims, self.plan.groups, strict=True)
            for axis in group
        )
        taken = set(RESERVED_NAMES)
        for name, path in [
            *((name, f"sweep.{name}") for name in self.plan.names),
            *((name, f"ask.{ask.key}") for ask in self.asks for name in names_of(ask)),
        ]:
            if name in taken or "/" in name:
                raise SceneError(
                    "this name cannot stand in the result of a sweep: it is taken there, or has a slash; "
                    "choose another",
                    file=self.data.file,
                    path=path,
                )
            taken.add(name)
        return Layout(self.plan.dims, coordinates, self.asks, self.runs, self.data.solve.estimate)

    @property
    def max_chunk(self) -> int:
        """Cases that are computed at once at most."""
        case_bytes = 8 * sum(ask.columns for ask in self.asks) * (1 + self.data.solve.estimate)
        return max(1, min(_MAX_CASES, _MAX_BYTES // max(case_bytes, 1)))

    def compute(
        self, first: int, count: int, stop: npt.NDArray[np.int32], done: npt.NDArray[np.int64]
    ) -> Block:
        """Runs cases first .. first+count-1; done[run] counts those finished, stop[0] = 1 ends early."""
        swept = self.plan.block(first, count)
        return self.solver.compute(swept, workers=self.workers, stop=stop, done=done)

    def manifest(self) -> dict[str, Any]:
        """All that the rows depend on, for a resumed sweep to compare."""
        return {
            "format": _FORMAT,
            "scene": self._scene.to_toml(),  # without comments: they change no row
            "sweep": {
                axis.name: {
                    "unit": axis.unit,
                    "num": len(axis.values),
                    **({"options": list(dict.fromkeys(axis.labels))} if axis.options else {}),
                    "from": float(axis.values[0]),
                    "to": float(axis.values[-1]),
                }
                for axis in self.plan.axes
            },
            "versions": row_versions(),
            CHECKSUMS: {
                **{f"values of {axis.name}": _hash(axis.si) for axis in self.plan.axes},
                **{
                    f"tables {run}{number}".strip(): _hash(flat.table, flat.constant, flat.defaults)
                    for run, number, flat in self._numbered()
                },
            },
        }

    def _numbered(self) -> Iterator[tuple[str, str, FlatScene]]:
        """All tables, each with its run and, where there are several, the number of its variant."""
        size = len(self.runs) or 1
        for i, flat in enumerate(self.flats):
            number = f" {i // size + 1}" if len(self.flats) > size else ""
            yield (self.runs or ("",))[i % size], number, flat

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
            **({"design": self.data.sweep.design.model_dump_json()} if self.data.sweep.design else {}),
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
        }


def _asks_of(data: SceneData, flats: Sequence[FlatScene]) -> tuple[tuple[int, int, Asked], ...]:
    """The asks in the order of the file, each with its run and its row there."""
    asks = [(run, ask.row, ask) for run, flat in enumerate(flats) for ask in flat.asks]
    order = {key: i for i, key in enumerate(data.ask)}
    return tuple(sorted(asks, key=lambda one: order[one[2].key]))


def _hash(*arrays: npt.NDArray[Any]) -> str:
    total = hashlib.sha256()
    for array in arrays:
        total.update(f"{array.dtype.str}{array.shape}".encode())
        total.update(np.ascontiguousarray(array).tobytes())
    return total.hexdigest()
