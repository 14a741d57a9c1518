"""What was seen of a function over the places of a lattice: each place is computed once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..base.arrays import Ints
from .lattice import Places

# Outcomes [n] of places [n, 2].
Look = Callable[[Places], Ints]
_SHIFT = 32


class Looks:
    """Remembers outcomes by place, in the order in which they were computed."""

    def __init__(self, compute: Look) -> None:
        self._compute = compute
        self._known: dict[int, int] = {}

    def __len__(self) -> int:
        return len(self._known)

    def __call__(self, places: Places) -> Ints:
        """The outcomes [n] of places [n, 2]; those that are new are computed together."""
        keys, back = np.unique((places[:, 0] << _SHIFT) | places[:, 1], return_inverse=True)
        listed = keys.tolist()
        new = [key for key in listed if key not in self._known]
        if new:
            self._known.update(zip(new, self._compute(_places(new)).tolist(), strict=True))
        return np.array([self._known[key] for key in listed], np.int32)[back]

    def at(self, i: int, j: int) -> int | None:
        """The outcome at one place, if that was seen."""
        return self._known.get((i << _SHIFT) | j)

    def places(self) -> Places:
        """All that was seen [n, 2]."""
        return _places(list(self._known))

    def outcomes(self) -> Ints:
        """The outcomes of `places`."""
        return np.fromiter(self._known.values(), np.int32, len(self._known))


def _places(keys: list[int]) -> npt.NDArray[np.int64]:
    packed = np.array(keys, np.int64)
    return np.stack([packed >> _SHIFT, packed & ((1 << _SHIFT) - 1)], axis=1)
