"""What takes the results of a sweep, block by block: files (store.py, zarr_store.py) or memory."""

from __future__ import annotations

from typing import Protocol

from .block import Block


class Takes(Protocol):
    """Where blocks of cases are stored."""

    @property
    def done(self) -> int:
        """Cases stored."""

    @property
    def missing(self) -> int:
        """Cases that are to be stored and are not."""

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of each range that is not stored yet, in order."""

    def fit(self, first: int, count: int, end: int) -> int:
        """How many cases from `first` on, about `count` and at most up to `end`, are one block."""

    def add(self, first: int, block: Block) -> None:
        """Stores the results of consecutive cases."""
