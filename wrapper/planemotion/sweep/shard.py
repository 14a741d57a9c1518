"""A shard: the cases of a sweep that one of several processes computes, on whatever machine."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

from ..base.errors import StudyError


@dataclass(frozen=True)
class Shard:
    """Shard `number` (from 1) of `of`: consecutive cases, as many as the others have, give or take one."""

    number: int
    of: int

    @classmethod
    def read(cls, written: str) -> Self:
        """Raises StudyError if it is not "i/n" with 1 <= i <= n."""
        match = re.fullmatch(r"\s*(\d+)\s*/\s*(\d+)\s*", written)
        if match and 1 <= int(match[1]) <= int(match[2]):
            return cls(int(match[1]), int(match[2]))
        raise StudyError(f'shard "{written}": i/n is wanted with i from 1 to n, such as 3/16')

    def range(self, cases: int) -> tuple[int, int]:
        """Its first case, and the first one behind it."""
        return cases * (self.number - 1) // self.of, cases * self.number // self.of

    @property
    def mark(self) -> str:
        """For names of files."""
        return f"{self.number}-of-{self.of}"

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"
