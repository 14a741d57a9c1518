"""Numbers as text that a page unpacks at once: base64 of 32-bit or of 16-bit numbers."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from ..base.arrays import Floats

_STEPS = 65535  # of a 16-bit number


def packed(values: Floats) -> dict[str, Any]:
    """As 32-bit numbers: seven digits of each."""
    return {"f": _text(np.asarray(values, "<f4"))}


def packed_coarsely(values: Floats) -> dict[str, Any]:
    """As steps between the least and the greatest, 65535 of them; one number where there is but one."""
    given = np.nan_to_num(np.asarray(values, np.float64))
    low, high = float(given.min()), float(given.max())
    if not high > low:
        return {"one": float(f"{low:.7g}"), "n": len(given)}
    steps = np.round((given - low) / (high - low) * _STEPS).astype("<u2")
    return {"u": _text(steps), "low": low, "high": high}


def _text(values: Any) -> str:
    return base64.b64encode(values.tobytes()).decode("ascii")
