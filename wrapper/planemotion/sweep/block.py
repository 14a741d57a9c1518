"""The results of consecutive cases, as arrays, and as a file of them."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats, Integers, Singles


@dataclass(frozen=True)
class Block:
    """Results of n consecutive cases.

    value[n, columns]: the asks one after the other, in their units; reason[n, asks]: enum pm_reason;
    status[n]: enum pm_status, of the worst run; run_status, route[n, runs]; solves[n]: saddle-point systems
    that were solved, as far as they are counted: what the case cost; audit[n, runs, PM_AUDITS];
    error[n, columns]: as value, and trust[n, PM_TRUSTS], of the worst run, have no columns where nothing is
    estimated; message: row -> text, of the cases that did not end well; seconds: time taken to compute them.
    """

    value: Floats
    reason: Integers
    status: Integers
    run_status: Integers
    route: Integers
    solves: Integers
    audit: Floats
    error: Singles
    trust: Singles
    message: Mapping[int, str]
    seconds: float = 0.0

    def __len__(self) -> int:
        return len(self.status)

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        return sum(getattr(self, name).nbytes for name in _BLOCK_TYPES)

    @staticmethod
    def arrays() -> tuple[str, ...]:
        """The names of the arrays, whose first dimension is the case."""
        return tuple(_BLOCK_TYPES)

    @staticmethod
    def join(blocks: Sequence[Block]) -> Block:
        """Consecutive blocks as one."""
        firsts = np.cumsum([0, *map(len, blocks)])

        def stacked(name: str) -> npt.NDArray[Any]:
            return np.concatenate([getattr(block, name) for block in blocks])

        return Block(
            **{name: stacked(name) for name in _BLOCK_TYPES},
            message={
                int(first) + row: text
                for first, block in zip(firsts, blocks, strict=False)
                for row, text in block.message.items()
            },
            seconds=sum(block.seconds for block in blocks),
        )

    def to_bytes(self) -> bytes:
        """The block as a file: its arrays one after the other, and at the end the rest as JSON; the same
        block gives the same bytes."""
        rest = {"rows": list(self.message), "texts": list(self.message.values()), "seconds": self.seconds}
        buffer = io.BytesIO()
        for name, dtype in _BLOCK_TYPES.items():
            np.save(buffer, np.ascontiguousarray(getattr(self, name), dtype), allow_pickle=False)
        return buffer.getvalue() + json.dumps(rest).encode()

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        """Reads what `to_bytes` wrote."""
        buffer = io.BytesIO(data)
        arrays = {name: np.load(buffer, allow_pickle=False) for name in _BLOCK_TYPES}
        rest = json.loads(buffer.read())
        message = dict(zip(rest["rows"], rest["texts"], strict=True))
        return cls(**arrays, message=message, seconds=rest["seconds"])


_BLOCK_TYPES: dict[str, type[np.generic]] = {
    "value": np.float64,
    "reason": np.int8,
    "status": np.int32,
    "run_status": np.int32,
    "route": np.int8,
    "solves": np.int32,
    "audit": np.float64,
    "error": np.float32,  # as many digits as an error has
    "trust": np.float32,
}
