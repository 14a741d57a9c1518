"""From cases to results: a scene made ready for all of them, and the answers of its runs side by side."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._layout import PM_AUDITS, PM_COUNT_ROUTE, PM_OK, PM_TRUST_EXCESS, PM_TRUST_MARGIN, PM_TRUSTS
from ..base.arrays import Floats, Singles
from ..base.errors import SceneError
from ..base.versions import versions
from ..compile.asks import Asked
from ..compile.flatten import FlatScene, flatten
from ..engine import call, messages
from ..engine.outcome import CaseResults
from .block import Block
from .cache import Kept
from .layout import RESERVED_NAMES, Coordinate, Layout, names_of
from .plan import SweepPlan
from .store import CHECKSUMS

if TYPE_CHECKING:
    from ..reading.scene import WrittenScene


# What is computed at once at most: cases, and bytes of their answers.
_MAX_CASES = 1 << 17
_MAX_BYTES = 1 << 24
# Other versions of these might compute other bits; the rest only writes files.
_ROW_VERSIONS = ("planemotion", "kernel", "SUNDIALS", "GSL")
# Of the part files and the manifest: another number, no resume.
_FORMAT = 4


class Study:
    """A scene made ready for its cases: one flat scene for each of its [runs].

    `kept`: what earlier sweeps of the same scene found out.
    """

    def __init__(self, scene: WrittenScene, plan: SweepPlan, workers: int, kept: Kept) -> None:
        self.data = scene.data
        self.text = scene.whole_text
        self._scene = scene
        self.plan = plan
        self.workers = workers
        self.runs = tuple(self.data.runs)
        self.kept = kept
        self.flats = kept.flats(
            scene.table,
            scene.file,
            (frozenset(plan.names), False),
            lambda: [flatten(scene, run, history=False) for run in self.runs or (None,)],
        )
        self.asks = self._asks()
        self.layout = self._layout()

    def _asks(self) -> list[tuple[int, int, Asked]]:
        """The asks in the order of the file, each with its run and its number there."""
        asks = [
            (run, index, ask) for run, flat in enumerate(self.flats) for index, ask in enumerate(flat.asks)
        ]
        order = {key: i for i, key in enumerate(self.data.ask)}
        return sorted(asks, key=lambda one: order[one[2].key])

    def _layout(self) -> Layout:
        coordinates = tuple(
            Coordinate(axis.name, dim, axis.unit, axis.values)
            for (dim, _), group in zip(self.plan.dims, self.plan.groups, strict=True)
            for axis in group
        )
        asks = tuple(ask for _, _, ask in self.asks)
        taken = set(RESERVED_NAMES)
        for name, path in [
            *((name, f"sweep.{name}") for name in self.plan.names),
            *((name, f"ask.{ask.key}") for ask in asks for name in names_of(ask)),
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
        case_bytes = 8 * sum(ask.count for _, _, ask in self.asks) * (1 + self.data.solve.estimate)
        return max(1, min(_MAX_CASES, _MAX_BYTES // max(case_bytes, 1)))

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
                call.run_cases(flat, param, workers=self.workers, stop=stop, progress=done[run : run + 1])
            )
        return self._block(results, begun)

    def _param(self, flat: FlatScene, run: int, swept: Floats) -> Floats:
        """The parameters [ncase, parameters] of one run's cases from the swept ones [ncase, swept], SI.

        What a run sets itself is not swept in it.
        """
        param = np.tile(np.asarray(flat.defaults, np.float64), (len(swept), 1))
        own = self.data.runs[self.runs[run]] if self.runs else {}
        for name, column in zip(self.plan.names, swept.T, strict=True):
            if name not in own and name in flat.parameters:
                param[:, flat.parameters.index(name)] = column
        return param

    def _block(self, results: Sequence[CaseResults], begun: float) -> Block:
        run_status = np.stack([result.status for result in results], axis=1).astype(np.int32)
        value = self._columns([result.out for result in results])
        error = self._columns([result.error for result in results])
        reason = np.empty((len(run_status), len(self.asks)), np.int8)
        for i, (run, index, _) in enumerate(self.asks):
            reason[:, i] = results[run].reason[:, index]
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
        """The columns [ncase, count] of each ask, in its unit, from those of the runs [ncase, nout], SI."""
        return [
            np.asarray(of_runs[run][:, ask.first : ask.first + ask.count]) / ask.factor
            for run, _, ask in self.asks
        ]

    def _message(self, results: Sequence[CaseResults], row: np.intp) -> str:
        texts = []
        for run, result in enumerate(results):
            if result.status[row] != PM_OK:
                text = messages.message(self.flats[run], result, int(row))
                texts.append(f"runs.{self.runs[run]}: {text}" if self.runs else text)
        return "; ".join(texts)

    def manifest(self) -> dict[str, Any]:
        """All that the rows depend on, for a resumed sweep to compare."""
        return {
            "format": _FORMAT,
            "scene": self._scene.to_toml(),  # without comments: they change no row
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


def _worst(run_status: npt.NDArray[np.int32]) -> npt.NDArray[np.int32]:
    """Status [ncase] from [ncase, runs]: the first failure, or else the first early stop, or else ok."""
    worst = np.zeros(len(run_status), np.int32)
    for status in run_status.T:
        worst = np.where((worst == PM_OK) | ((worst > PM_OK) & (status < PM_OK)), status, worst)
    return worst


def _side_by_side(columns: Sequence[Floats], cases: int) -> Floats:
    return np.concatenate(columns, axis=1) if columns else np.empty((cases, 0))


def _worst_trust(of_runs: Sequence[Floats], estimate: bool) -> Singles:
    """Trust [ncase, 2] from that of each run [ncase, 2]: least margin, greatest excess.

    Without estimates there are no columns.
    """
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
