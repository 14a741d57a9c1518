"""How fast a viewer sees a run: a round number of its seconds in one of theirs, slower around events if
that is wanted, and for how long a blow is shown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..base.arrays import Floats

# Seconds of a viewer: a run between the first two is shown as fast as it is, others in about the last.
_SHORTEST, _LONGEST, _USUAL = 3.0, 12.0, 8.0
_ROUND = (1, 2, 5)  # times powers of ten
_SPEEDS = 7  # speeds that a viewer may choose below the usual one, and above
SLOWER = 6.0  # times, at an event
NEAR = 0.35  # seconds of a viewer before and after an event in which time slows down
FLASH = 0.7  # seconds of a viewer for which a blow is shown
_STEPS = 2000  # of the whole run and
_STEPS_NEAR = 24  # of each side of an event, over which the pace is added up


@dataclass(frozen=True)
class Timing:
    """A run of `end` seconds with `events` [n] at these times; `slow`: slower around them."""

    end: float
    events: Floats
    slow: bool

    @cached_property
    def speed(self) -> float:
        """Seconds of the run in one of a viewer, away from events."""
        return 1.0 if _SHORTEST <= self.end <= _LONGEST else _number(self._number)

    def told(self) -> dict[str, Any]:
        """As the player reads it."""
        middle = 0 if self.speed == 1.0 else self._number
        speeds = [_number(middle + i) for i in range(-_SPEEDS, _SPEEDS + 1)]
        return {"speed": self.speed, "speeds": speeds, "slower": SLOWER, "near": NEAR, "flash": FLASH}

    @property
    def _number(self) -> int:
        """Of the round number that is nearest to the speed with which the run takes the usual time."""
        if not self.end > 0:
            return 0
        wanted = math.log10(self.end / _USUAL)
        first = 3 * math.floor(wanted)
        return min(range(first, first + 4), key=lambda k: abs(math.log10(_number(k)) - wanted))

    def pace(self, times: Floats) -> Floats:
        """How much slower than usual time passes at `times` [n]: 1 is as usual."""
        if not self.slow or not len(self.events):
            return np.ones(len(times))
        after = np.searchsorted(self.events, times)
        before, last = np.maximum(after - 1, 0), np.minimum(after, len(self.events) - 1)
        far = np.minimum(np.abs(times - self.events[before]), np.abs(times - self.events[last]))
        part = np.minimum(far / (NEAR * self.speed), 1.0)
        return 1 / SLOWER + (1 - 1 / SLOWER) * part**2

    def frames(self, rate: float, most: int) -> tuple[Floats, float]:
        """The times of frames, `rate` for each second of a viewer or `most` in all, and the speed then."""
        grid = self._grid()
        slowness = 1 / self.pace(grid)
        passed = np.concatenate([[0.0], np.cumsum(0.5 * (slowness[1:] + slowness[:-1]) * np.diff(grid))])
        wanted = round(passed[-1] / self.speed * rate) + 1
        count = min(max(2, wanted), most)
        speed = self.speed if count == wanted else float(passed[-1]) * rate / (count - 1)
        return np.interp(np.linspace(0.0, passed[-1], count), passed, grid), speed

    def _grid(self) -> Floats:
        near = NEAR * self.speed * np.linspace(-1.0, 1.0, 2 * _STEPS_NEAR + 1)
        around = (self.events[:, None] + near).ravel() if self.slow else np.zeros(0)
        return np.unique(np.clip(np.concatenate([np.linspace(0, self.end, _STEPS), around]), 0.0, self.end))

    def fresh(self, time: float) -> tuple[int, float] | None:
        """The event that is still seen at a time, by its number, and how fresh it is: 1 as it happens."""
        number = int(np.searchsorted(self.events, time + 1e-9 * self.end, side="right")) - 1
        if number < 0:
            return None
        fresh = 1 - (time - self.events[number]) / (FLASH * self.speed / (SLOWER if self.slow else 1.0))
        return (number, min(float(fresh), 1.0)) if fresh > 0 else None


def _number(k: int) -> float:
    """..., 0.5, 1, 2, 5, 10, ...: 1 has the number 0."""
    return float(f"{_ROUND[k % 3]}e{k // 3}")
