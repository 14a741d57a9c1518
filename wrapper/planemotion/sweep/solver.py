"""The block function: the values of the swept parameters of many cases in, their results out.

A solver holds all that cases share and can be pickled, so that a block can be computed in this process or in
any other.  Where it is computed changes no bit of it.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .._layout import (
    PM_AUDITS,
    PM_COUNT_ROUTE,
    PM_COUNT_SOLVES,
    PM_OK,
    PM_TRUST_EXCESS,
    PM_TRUST_MARGIN,
    PM_TRUSTS,
)
from ..base.arrays import Floats, Singles
from ..compile.asks import Asked
from ..compile.flatten import FlatScene
from ..engine import call, messages
from ..engine.outcome import CaseResults
from ..engine.words import read_words
from .block import Block


@dataclass(frozen=True)
class Solver:
    """A scene made ready for its cases.

    `names`: the swept parameters; `flats`: the tables of each run, `runs` their names (none if there is one
    without a name) and `own` the parameters that each sets itself; `asks`: in the order of the file, each
    with its run and its row there; `estimate`: whether errors are estimated.
    """

    names: tuple[str, ...]
    flats: tuple[FlatScene, ...]
    runs: tuple[str, ...]
    own: tuple[frozenset[str], ...]
    asks: tuple[tuple[int, int, Asked], ...]
    estimate: bool

    def compute(
        self,
        swept: Floats,
        *,
        workers: int,
        stop: npt.NDArray[np.int32] | None = None,
        done: npt.NDArray[np.int64] | None = None,
    ) -> Block:
        """Runs a case for each row of `swept` [ncase, names], SI, on so many threads.

        `done` [runs] counts cases finished; `stop` [1] ends early where another thread sets it to 1.
        """
        begun = time.perf_counter()
        if done is None:
            done = np.zeros(len(self.flats), np.int64)
        results = [
            call.run_cases(
                flat, self._param(run, swept), workers=workers, stop=stop, progress=done[run : run + 1]
            )
            for run, flat in enumerate(self.flats)
        ]
        return self._block(results, begun)

    def _param(self, run: int, swept: Floats) -> Floats:
        """The parameters [ncase, parameters] of one run's cases from the swept ones [ncase, swept], SI.

        What a run sets itself is not swept in it.
        """
        flat = self.flats[run]
        param = np.tile(np.asarray(flat.defaults, np.float64), (len(swept), 1))
        for name, column in zip(self.names, swept.T, strict=True):
            if name not in self.own[run] and name in flat.parameters:
                param[:, flat.parameters.index(name)] = column
        return param

    def _block(self, results: Sequence[CaseResults], begun: float) -> Block:
        run_status = np.stack([result.status for result in results], axis=1).astype(np.int32)
        value = self._columns([result.out for result in results])
        error = self._columns([result.error for result in results])
        reason = np.empty((len(run_status), len(self.asks)), np.int8)
        for i, (run, row, ask) in enumerate(self.asks):
            reason[:, i] = results[run].reason[:, row]
            value[i][np.isinf(value[i])] = np.nan
            if ask.letters:
                value[i][:, 0], reason[:, i] = read_words(ask, results[run])
                error[i] *= np.nan
        status = _worst(run_status)
        return Block(
            value=_side_by_side(value, len(status)),
            reason=reason,
            status=status,
            run_status=run_status,
            route=np.stack([result.count[:, PM_COUNT_ROUTE] for result in results], axis=1),
            solves=_total([result.count[:, PM_COUNT_SOLVES] for result in results]),
            audit=np.stack([result.audit[:, :PM_AUDITS] for result in results], axis=1),
            error=_side_by_side(error if self.estimate else [], len(status)).astype(np.float32),
            trust=_worst_trust([result.trust for result in results], self.estimate),
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


def _worst(run_status: npt.NDArray[np.int32]) -> npt.NDArray[np.int32]:
    """Status [ncase] from [ncase, runs]: the first failure, or else the first early stop, or else ok."""
    worst = np.zeros(len(run_status), np.int32)
    for status in run_status.T:
        worst = np.where((worst == PM_OK) | ((worst > PM_OK) & (status < PM_OK)), status, worst)
    return worst


def _total(counts: Sequence[npt.NDArray[np.int64]]) -> npt.NDArray[np.int32]:
    """The sum of the counts [ncase] of all runs, no greater than what is kept."""
    return np.minimum(np.sum(counts, axis=0), np.iinfo(np.int32).max).astype(np.int32)


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
