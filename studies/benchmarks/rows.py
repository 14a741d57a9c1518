"""One line of a result: who computed what, in which time, with which error - or why not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt


@dataclass
class Row:
    """`cpu`: s per run of one case, least of `samples` samples; `wall` where threads matter.

    `status`: "ok", "not installed", or why there is no figure.  `drift`: J.  `error` in the problem's unit.
    """

    scene: str
    method: str
    setting: str
    version: str = ""
    status: str = "ok"
    cases: int = 0
    cpu: float = float("nan")
    samples: int = 0
    error: float = float("nan")
    wrong: int | None = None
    drift: float | None = None
    steps: float | None = None
    note: str = ""


class Batch(Protocol):
    """What can be timed: `answers` runs the cases once each and gives [cases, columns]."""

    def answers(self) -> npt.NDArray[np.float64]: ...

    def lengthen(self, seconds: float) -> None:
        """A call took `seconds`; a batch that can repeats its cases if that is too short to time."""

    def runs(self) -> int:
        """Cases that a call runs."""

    def steps(self) -> float | None:
        """Mean steps of a case in the last call, if known."""

    def said(self) -> str:
        """What else the last call said of itself."""


@dataclass
class Attempt:
    """A row to be measured; `skip`: why it is not."""

    method: str
    setting: str
    version: str
    batch: Batch | None = None
    skip: str = ""
    note: str = ""


class Cases:
    """A batch of a peer that runs one case after another."""

    def __init__(self, run: Callable[[npt.NDArray[np.float64]], list[float]], cases: npt.NDArray[np.float64]):
        self._run, self._cases = run, cases

    def answers(self) -> npt.NDArray[np.float64]:
        return np.array([self._run(case) for case in self._cases], float)

    def lengthen(self, seconds: float) -> None:
        """The timer repeats the call itself."""

    def runs(self) -> int:
        return len(self._cases)

    def steps(self) -> float | None:
        return None

    def said(self) -> str:
        return ""
