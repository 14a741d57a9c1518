"""The places at which a map can look: the grid of the study, each of its cells halved again and again.

A place is a pair of whole numbers; neighbours are apart by at most half the tolerance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..sweep.plan import Axis

Places = npt.NDArray[np.int64]
# The most places along one axis; they are pairs of whole numbers in one of 64 bits.
_MOST = 1 << 31


@dataclass(frozen=True)
class Side:
    """One axis of a map: the parameter with its grid, and `steps` places from each of its values to the next.

    `log`: what lies between is divided by equal ratios, as the grid is.
    """

    axis: Axis
    steps: int
    log: bool

    @property
    def last(self) -> int:
        """The place of the last value; the first is 0."""
        return self.steps * (len(self.axis.values) - 1)

    @cached_property
    def _scaled(self) -> Floats:
        """The values as parts of the range, from 0 to 1."""
        values = np.log(np.abs(self.axis.values)) if self.log else self.axis.values
        parts: Floats = (values - values[0]) / (values[-1] - values[0])
        return parts

    @cached_property
    def _nodes(self) -> Floats:
        return self.steps * np.arange(len(self.axis.values), dtype=np.float64)

    def part(self, place: npt.NDArray[Any]) -> Floats:
        """How far along the range places are, from 0 to 1."""
        part: Any = np.interp(place, self._nodes, self._scaled)
        return np.asarray(part, np.float64)

    def place(self, part: Floats) -> Places:
        """The places next to these parts of the range."""
        return np.rint(np.interp(part, self._scaled, self._nodes)).astype(np.int64)

    def value(self, place: npt.NDArray[Any]) -> Floats:
        """The values at places, in the unit of the grid; at its own values with the same bits."""
        node = np.minimum(place // self.steps, len(self.axis.values) - 2).astype(np.int64)
        rest = place / self.steps - node
        low, high = self.axis.values[node], self.axis.values[node + 1]
        between = low * (high / low) ** rest if self.log else low + (high - low) * rest
        return np.where(rest == 0, low, np.where(rest == 1, high, between))


def halvings_for(axis: Axis, tolerance: float, log: bool) -> int:
    """How often the cells of a grid must be halved until none is longer than half the tolerance.

    Raises SceneError with a key path for a grid that is no range, or a tolerance that is too fine.
    """
    path = f"sweep.{axis.name}"
    if len(axis.values) < 2:
        raise SceneError("a map needs at least two values of each parameter", path=path)
    rising = np.diff(axis.values) > 0
    if rising.any() != rising.all() or not np.diff(axis.values).all():
        raise SceneError("a map needs values that rise, or that fall", path=path)
    longest = float(np.diff(Side(axis, 1, log).part(np.arange(len(axis.values)))).max())
    halvings = max(0, math.ceil(math.log2(2 * longest / tolerance)))
    if (len(axis.values) - 1) << halvings > _MOST:
        reason = f"with this grid it must be at least {2 * longest * len(axis.values) / _MOST:.1g}"
        raise SceneError(reason, path="sweep.refine.tolerance", value=tolerance)
    return halvings
