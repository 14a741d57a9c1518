"""Numbers that stand in lists of a scene, each with its unit."""

from __future__ import annotations

import math
from typing import Any

from ..base.errors import SceneError
from ..language.units import Quantity, parse_quantity


def finite(written: Any, path: str) -> Quantity:
    """A quantity that is a finite number.  Raises SceneError for what is none."""
    try:
        quantity = parse_quantity(written)
    except SceneError as error:
        raise SceneError(error.reason, path=path, value=written) from None
    if not math.isfinite(quantity.value_si):
        raise SceneError("a finite number is wanted", path=path, value=written)
    return quantity
