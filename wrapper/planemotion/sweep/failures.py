"""How many cases of a sweep have failed, and when that is enough."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._layout import PM_OK
from ..base.errors import StudyError
from ..base.words import counted
from .block import Block
from .plan import SweepPlan


@dataclass
class Failures:
    """Counts the cases that fail (an early stop is no failure); after `most` of them the sweep ends.

    `hint`: how to go on then.
    """

    plan: SweepPlan
    most: int | None = None
    count: int = 0
    first: str = ""
    hint: str = ""

    def add(self, first: int, block: Block) -> None:
        """Counts those of a block that begins with case `first`.  Raises StudyError if that is enough."""
        rows = np.flatnonzero(block.status < PM_OK)
        if self.most is None or not rows.size:
            return
        row = int(rows[0])
        if not self.first:
            values = ", ".join(f"{name} = {value}" for name, value in self.plan.case(first + row).items())
            self.first = f"case {first + row} ({values}): {block.message.get(row, '')}"
        self.count += len(rows)
        if self.count >= self.most:
            told = f"stopped: {counted(self.count, 'case')} failed, first {self.first}"
            raise StudyError(f"{told}. {self.hint}".removesuffix(". "))
