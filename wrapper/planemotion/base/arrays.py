"""The types of arrays that are handed around."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Integers = npt.NDArray[np.signedinteger[Any]]
Ints = npt.NDArray[np.int32]
Longs = npt.NDArray[np.int64]
