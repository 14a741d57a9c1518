"""The outcome of a case: how it ended, and what was answered to the questions that the map is about."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._layout import PM_OK, PM_TRUST_MARGIN, PM_UNDECIDED
from ..base.arrays import Ints
from ..base.errors import SceneError
from ..compile.asks import Asked
from ..engine.words import spelled
from ..sweep.block import Block
from ..sweep.layout import STATUS_WORDS

# A map of more outcomes than this is about something that changes all along.
_MOST = 1000


class Outcomes:
    """Numbers outcomes in the order in which they are met.

    `columns`: of each question its ask and its column of a block's values.  A case whose decisions lie within
    the errors of its run counts as what it answers; `uncertain` counts those.
    """

    def __init__(self, columns: Sequence[tuple[Asked, int]], file: str | None) -> None:
        self._columns = columns
        self._file = file
        self._numbers: dict[tuple[float, ...], int] = {}
        self.uncertain = 0

    def of_block(self, block: Block) -> Ints:
        """The outcome [n] of each case.  Raises SceneError if there are far too many different ones."""
        ended = np.where(block.status == PM_UNDECIDED, PM_OK, block.status)
        failed = ended < PM_OK
        answers = [np.where(failed, np.nan, block.value[:, column]) for _, column in self._columns]
        if block.trust.size:
            self.uncertain += int(np.count_nonzero(block.trust[:, PM_TRUST_MARGIN] < 1))
        table = np.stack([ended.astype(np.float64), *answers], axis=1)
        table[np.isnan(table)] = -np.inf  # not-a-number is not equal to itself
        rows, back = np.unique(table, axis=0, return_inverse=True)
        numbers = [self._numbers.setdefault(tuple(row), len(self._numbers)) for row in rows.tolist()]
        if len(numbers) > _MOST or len(self._numbers) > _MOST:
            asked = ", ".join(ask.key for ask, _ in self._columns)
            reason = (
                f"more than {_MOST} different outcomes: what is asked ({asked}) changes all along; give "
                'questions whose answers are counts, words of events or conditions, such as "tip.count > 0"'
            )
            raise SceneError(reason, file=self._file, path="sweep.refine.of")
        return np.array(numbers, np.int32)[back.reshape(-1)]

    def names(self) -> list[str]:
        """What each outcome is, in words."""
        return [self._name(row) for row in self._numbers]

    def statuses(self) -> list[int]:
        """The status of each outcome."""
        return [int(row[0]) for row in self._numbers]

    def _name(self, row: tuple[float, ...]) -> str:
        status, *answers = row
        if status < PM_OK:
            return STATUS_WORDS.get(int(status), f"status {status:g}")
        parts = [_said(ask, answer) for (ask, _), answer in zip(self._columns, answers, strict=True)]
        if status != PM_OK:
            parts.append(f"({STATUS_WORDS.get(int(status), f'status {status:g}')})")
        return ", ".join(parts)


def _said(ask: Asked, answer: float) -> str:
    if ask.letters:
        return spelled(answer, ask.letters) or "nothing"
    if np.isinf(answer):
        return f"{ask.key}: none"
    return f"{ask.key} = {answer:g}" + (f" {ask.unit}" if ask.unit not in ("", "1") else "")
