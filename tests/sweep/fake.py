"""A scene to sweep and an engine that is no more than a formula."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np

from planemotion._layout import (
    PM_ASSEMBLY,
    PM_AUDITS,
    PM_CANCELLED,
    PM_COUNT_COLUMNS,
    PM_COUNT_ROUTE,
    PM_LIMIT_TIME,
    PM_REASON_FAILED,
    PM_REASON_NOT_REACHED,
    PM_ROUTE_RK,
)
from planemotion.compile.asks import Asked
from planemotion.language import units
from planemotion.reading.validate import validate
from planemotion.sweep import cases, solver


class FakeScene:
    """What a sweep uses of a scene."""

    def __init__(
        self,
        sweep: dict[str, Any],
        parameters: dict[str, Any] | None = None,
        runs: dict[str, Any] | None = None,
        ask: dict[str, Any] | None = None,
        text: str = "fake",
    ) -> None:
        raw = {
            "id": "fake",
            "until": "t = 1 s",
            "bodies": {"A": {"mass": "1 kg", "at": [0, 0]}},
            "parameters": parameters or {"d": "1 in", "w": "2 rad/s", "m": 3},
            "ask": ask or {"sum": {"of": "d", "unit": "ft"}, "list": {"of": "w", "unit": "rpm"}, "odd": "m"},
            "sweep": sweep,
            "runs": runs or {},
        }
        self.table: dict[str, Any] = raw
        self.file: str | None = "fake.toml"
        self.data = validate(raw, file=self.file)
        self.run_names = tuple(self.data.runs)
        self.text = self.whole_text = text

    def with_values(self, values: Mapping[str, Any]) -> FakeScene:
        raise AssertionError(f"what there is in this scene is always the same: {values}")

    def to_toml(self) -> str:
        return "\n".join(line for line in self.text.splitlines() if not line.startswith("#"))


RPM = units.factor("rpm")[0]
ASKS = (
    Asked(key="sum", unit="ft", factor=0.3048, first=0, count=1, is_list=False),
    Asked(key="list", unit="rpm", factor=RPM, first=1, count=2, is_list=True, row=1),
    Asked(key="odd", unit="", factor=1.0, first=3, count=1, is_list=False, row=2),
)


def fake_flatten(scene: Any, run: str | None = None, *, history: bool = True) -> Any:
    """Three parameters; asks that are not of this run are left out."""
    data = scene.data
    values = {**data.parameters, **(data.runs[run] if run else {})}
    names = tuple(name for name in values if name != "g")
    return SimpleNamespace(
        table=np.arange(5, dtype=np.int32),
        constant=np.zeros(1),
        parameters=names,
        defaults=np.array([units.parse_quantity(values[name]).value_si for name in names]),
        asks=tuple(
            replace(ask, text=data.ask[ask.key].text)
            for ask in ASKS
            if ask.key in data.ask and data.ask[ask.key].run in (None, run)
        ),
    )


class FakeEngine:
    """Rows follow from their own parameters only; `pause` s per case."""

    def __init__(self, pause: float = 0.0) -> None:
        self.pause = pause
        self.chunks: list[int] = []

    def run_cases(
        self, flat: Any, param: Any, *, workers: int = 1, stop: Any = None, progress: Any = None
    ) -> Any:
        assert param.dtype == np.float64
        assert param.flags.c_contiguous
        n = len(param)
        self.chunks.append(n)
        d, w, m = param.T
        out = np.stack([d + w, w, w * d, m], axis=1)
        status = np.zeros(n, np.int32)
        reason = np.zeros((n, len(ASKS)), np.int32)
        status[m == 13] = PM_ASSEMBLY
        status[m == 14] = PM_LIMIT_TIME
        reason[m == 13] = PM_REASON_FAILED
        reason[m == 14, 0] = PM_REASON_NOT_REACHED
        reason[m == 15, 0] = PM_REASON_NOT_REACHED
        out[reason[:, 0] > 0, 0] = np.nan
        out[m == 13] = np.nan  # as the kernel does where nothing stands
        count = np.zeros((n, PM_COUNT_COLUMNS), np.int64)
        count[:, PM_COUNT_ROUTE] = PM_ROUTE_RK
        for i in range(n if self.pause else 0):
            if stop[0]:
                status[i:] = PM_CANCELLED
                break
            time.sleep(self.pause)
            progress[0] = i + 1
        progress[0] = n
        audit = np.stack([d * 1e-15] * PM_AUDITS, axis=1)
        trust = np.stack([1 + d, np.full(n, 0.5)], axis=1)
        numbers = {"out": out, "error": 1e-12 * out, "audit": audit, "trust": trust}
        return SimpleNamespace(**numbers, reason=reason, status=status, count=count)

    def message(self, flat: Any, results: Any, i: int) -> str:
        return f"case with status {results.status[i]}, as said"


SWEEP = {"d": {"from": "1 in", "to": "6 in", "num": 501}, "m": [1, 13, 14, 15]}
MILLION = {
    "d": {"from": "1 in", "to": "6 in", "num": 2000},
    "w": {"from": "0 rad/s", "to": "5 rad/s", "num": 500},
}
BIG = {"d": {"from": "1 in", "to": "6 in", "num": 30}, "w": {"from": "0 rad/s", "to": "5 rad/s", "num": 40}}


def data_of(path: Path) -> dict[str, Any]:
    """Names and bytes of everything in a result."""
    with h5py.File(path) as file:
        return {name: file[name][...].tolist() if file[name].dtype.kind == "O" else file[name][...].tobytes()
                for name in file}  # fmt: skip


def stand_ins(engine: FakeEngine) -> list[tuple[Any, str, Any]]:
    """Module, name and what it is to use instead."""
    versions = {"planemotion": "1"}
    return [
        (solver, "call", engine),
        (solver, "messages", engine),
        (cases, "flatten", fake_flatten),
        (cases, "row_versions", lambda: versions),
        (cases, "versions", lambda: versions),
    ]


def plant(engine: FakeEngine) -> None:
    for module, name, fake in stand_ins(engine):
        setattr(module, name, fake)
