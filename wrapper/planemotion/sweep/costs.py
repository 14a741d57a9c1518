"""Which cases of a sweep cost far more than the others, by the systems of equations solved for them.

Computing times would differ from run to run; these numbers are the same wherever a case is computed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

# So many cases are named, if they cost so many times the mean.
_NAMED = 3
_FAR_MORE = 5.0


@dataclass(frozen=True)
class Costly:
    """A case with its parameters, the systems solved for it, and how many times the mean that is."""

    case: int
    values: str
    solves: int
    times: float

    @property
    def text(self) -> str:
        """For people."""
        return f"{self.values}: {self.solves} systems solved, {self.times:.3g} times the mean"


class Costs:
    """Goes through the costs of all cases, block by block."""

    def __init__(self) -> None:
        self._cases = 0
        self._total = 0
        self._greatest: list[tuple[int, int]] = []  # cost, case

    def add(self, first: int, solves: npt.NDArray[Any]) -> None:
        """The costs [n] of the cases from `first` on."""
        self.add_cases(np.arange(first, first + len(solves)), solves)

    def add_cases(self, cases: npt.NDArray[Any], solves: npt.NDArray[Any]) -> None:
        """The costs [n] of cases [n] by number."""
        self._cases += len(solves)
        self._total += int(solves.sum(dtype=np.int64))
        rows = np.argsort(-solves.astype(np.int64), kind="stable")[:_NAMED]
        here = zip(solves[rows].tolist(), cases[rows].tolist(), strict=True)
        self._greatest = sorted([*self._greatest, *here], key=lambda one: (-one[0], one[1]))[:_NAMED]

    def found(self, values_of: Callable[[int], str]) -> tuple[Costly, ...]:
        """Those that cost far more than the mean; `values_of` names the parameters of a case."""
        mean = self._total / self._cases if self._total else 1.0
        return tuple(
            Costly(case, values_of(case), solves, solves / mean)
            for solves, case in self._greatest
            if solves > _FAR_MORE * mean
        )
