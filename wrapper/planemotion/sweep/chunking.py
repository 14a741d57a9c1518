"""How the cases of a grid are cut into chunks of consecutive cases, each a box of the grid."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Chunking:
    """Chunks of a C-ordered grid `shape`: `along` one axis so many steps, one step of those before it, and
    all of those behind it.  So each chunk is a box, and its cases follow each other."""

    shape: tuple[int, ...]
    axis: int
    along: int

    @classmethod
    def of(cls, shape: Sequence[int], wanted: int) -> Chunking:
        """Chunks of about `wanted` cases, no more."""
        row, axis = 1, len(shape)
        while axis > 0 and row * shape[axis - 1] <= wanted:
            axis -= 1
            row *= shape[axis]
        if axis == 0:
            return cls(tuple(shape), 0, shape[0])
        return cls(tuple(shape), axis - 1, max(1, min(shape[axis - 1], wanted // row)))

    @property
    def box(self) -> tuple[int, ...]:
        """The sides of a whole chunk."""
        return (*[1] * self.axis, self.along, *self.shape[self.axis + 1 :])

    @property
    def _row(self) -> int:
        """Cases of one step along the axis."""
        return math.prod(self.shape[self.axis + 1 :])

    @property
    def _of_line(self) -> int:
        """Chunks along the axis: the last of them may be smaller."""
        return -(-self.shape[self.axis] // self.along)

    @property
    def count(self) -> int:
        """Of all chunks."""
        return math.prod(self.shape[: self.axis]) * self._of_line

    def start(self, chunk: int) -> int:
        """The first case of a chunk; of the number of all chunks the number of all cases."""
        line, step = divmod(chunk, self._of_line)
        return (line * self.shape[self.axis] + step * self.along) * self._row

    def at(self, case: int) -> int:
        """The chunk in which a case lies."""
        line, rest = divmod(case, self.shape[self.axis] * self._row)
        return line * self._of_line + rest // (self.along * self._row)

    def end_near(self, first: int, count: int, end: int) -> int:
        """Where about `count` cases from `first`, where a chunk begins, end with a chunk; at most `end`."""
        chunk = self.at(min(first + count, end) - 1)
        whole = self.start(chunk + 1)
        begun = self.start(chunk)
        return whole if whole <= first + count or begun <= first else begun

    def boxes(self, first: int, end: int) -> Iterator[tuple[int, int, tuple[slice, ...]]]:
        """Number, size and box of each chunk of the cases first .. end-1, which are whole chunks."""
        for chunk in range(self.at(first), self.at(end - 1) + 1):
            line, step = divmod(chunk, self._of_line)
            place = []
            for size in reversed(self.shape[: self.axis]):
                line, at = divmod(line, size)
                place.append(slice(at, at + 1))
            low = step * self.along
            box = (*reversed(place), slice(low, min(low + self.along, self.shape[self.axis])))
            rest = tuple(slice(0, size) for size in self.shape[self.axis + 1 :])
            yield chunk, self.start(chunk + 1) - self.start(chunk), (*box, *rest)
