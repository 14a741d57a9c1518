"""Grids that are finer than a picture: what of them is drawn.  Every n-th case alone would make patterns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats


def evenly(count: int, most: int) -> npt.NDArray[np.int64]:
    """At most so many of the numbers from 0 to count - 1."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.int64)


def condensed(values: npt.NDArray[Any], steps: Sequence[int]) -> Floats:
    """The lower median of blocks of steps[0] x steps[1] values [n, m]: always one of the values.

    NaN where a block has no value; blocks at the far edges are smaller.  Of booleans: whether one is true."""
    n, m = (-(-size // step) for size, step in zip(values.shape, steps, strict=True))
    room = np.full((n * steps[0], m * steps[1]), np.nan)
    room[: values.shape[0], : values.shape[1]] = values
    blocks = room.reshape(n, steps[0], m, steps[1]).swapaxes(1, 2).reshape(n, m, -1)
    blocks.sort(axis=-1)  # NaN come last
    known = np.count_nonzero(~np.isnan(blocks), axis=-1)
    chosen = known - 1 if values.dtype == bool else (known - 1) // 2
    median: Floats = np.take_along_axis(blocks, np.maximum(chosen, 0)[..., None], axis=-1)[..., 0]
    return median


def middles(values: Floats, step: int) -> Floats:
    """The middle of every `step` neighbouring values [n]."""
    return np.array([float(np.mean(values[i : i + step])) for i in range(0, len(values), step)])


def outline(x: Floats, y: Floats, most: int) -> tuple[Floats, Floats]:
    """Of a curve y [n] over x [n] the least and the greatest value of each of `most` runs of neighbours,
    where they are: it looks like the whole curve.  A value that is missing leaves a gap (NaN)."""
    if len(x) <= 2 * most:
        return x, y
    kept: list[int] = []
    for part in np.array_split(np.arange(len(x)), most):
        known = part[np.isfinite(y[part])]
        if len(known) < len(part):
            kept.append(int(part[~np.isfinite(y[part])][0]))
        if len(known):
            kept += [int(known[np.argmin(y[known])]), int(known[np.argmax(y[known])])]
    chosen = sorted(set(kept))
    return x[chosen], y[chosen]
