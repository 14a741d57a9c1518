"""Cases that failed are computed once more, with other settings, where the sweep says so.

What comes of it depends on the case alone, as all else does: it is what a run with these settings gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from .._layout import PM_LIMIT_CPU, PM_LIMIT_EVENTS, PM_LIMIT_STEPS, PM_OK, PM_UNDECIDED
from ..base.arrays import Floats
from ..compile.asks import Asked
from ..model.tables import Retry
from .block import Block
from .solver import Solver

# Beside failures: what other limits or a smaller error can mend.
_MENDED = (PM_LIMIT_EVENTS, PM_LIMIT_STEPS, PM_LIMIT_CPU, PM_UNDECIDED)


def has_failed(status: npt.NDArray[np.int32]) -> npt.NDArray[np.bool_]:
    """Which of [n] cases are computed once more."""
    return np.asarray((status < PM_OK) | np.isin(status, _MENDED))


def settings_of(retry: Retry) -> dict[str, object]:
    """What a retry sets, by key path."""
    given = retry.model_dump(exclude_none=True)
    return {f"solve.{key}": value for key, value in given.items()}


def told(settings: Mapping[str, object]) -> str:
    """Settings for people."""
    return ", ".join(f"{key} = {value}" for key, value in settings.items())


@dataclass(frozen=True)
class Retrying:
    """A solver, and `other` for the cases that fail with it; `told`: what is other about it."""

    first: Solver
    other: Solver
    told: str

    @property
    def asks(self) -> tuple[tuple[int, int, Asked], ...]:
        """As those of a Solver."""
        return self.first.asks

    @property
    def estimate(self) -> bool:
        """As that of a Solver."""
        return self.first.estimate

    def compute(
        self,
        swept: Floats,
        *,
        workers: int,
        stop: npt.NDArray[np.int32] | None = None,
        done: npt.NDArray[np.int64] | None = None,
    ) -> Block:
        """As Solver.compute."""
        block = self.first.compute(swept, workers=workers, stop=stop, done=done)
        rows = np.flatnonzero(has_failed(block.status))
        if not rows.size or (stop is not None and stop[0]):
            return block
        return self._joined(block, rows, self.other.compute(swept[rows], workers=workers, stop=stop))

    def _joined(self, block: Block, rows: npt.NDArray[np.intp], again: Block) -> Block:
        """Rows of `again` that came to an end stand in the place of the failed ones; messages tell of all."""
        message = dict(block.message)
        for number, row in enumerate(rows.tolist()):
            message[row] = self._message(block.message.get(row, ""), again, number)
        good = ~has_failed(again.status)
        arrays = {name: getattr(block, name).copy() for name in Block.arrays()}
        for name, array in arrays.items():
            array[rows[good]] = getattr(again, name)[good]
        arrays["solves"][rows] = block.solves[rows] + again.solves
        seconds = block.seconds + again.seconds
        return replace(block, **arrays, message=dict(sorted(message.items())), seconds=seconds)

    def _message(self, before: str, again: Block, row: int) -> str:
        then = again.message.get(row, "")
        if has_failed(again.status[row : row + 1])[0]:
            return f"{before}; computed again with {self.told}: {then}"
        return f"computed again with {self.told}{': ' if then else ''}{then}; before: {before}"
