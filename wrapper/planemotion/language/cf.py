"""Units in files for other programs: the attribute `units` of CF is read by UDUNITS.

There `lb` is a mass, and `deg` and `rev` are nothing.  Where its word is another one the attribute `unit`
says what the scene has.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

# What UDUNITS does not know, takes for something else, or rounds.
_UDUNITS: Mapping[str, str] = {
    "deg": "degree",
    "rev": "turn",
    "lb": "lbf",
    "oz": "(0.0625 lbf)",
    "lbm": "pound",
    "slug": "(lbf.s2/ft)",
    "mph": "(mile/hour)",
    "hp": "(550 ft.lbf/s)",
}
_WORD = re.compile(r"[^\W\d_]+")


def cf_units(unit: str) -> dict[str, str]:
    """The attributes of a variable in a unit as scenes write it."""
    units = _WORD.sub(lambda word: _UDUNITS.get(word[0], word[0]), unit) or "1"
    return {"units": units} if units == (unit or "1") else {"units": units, "unit": unit}


def unit_of(attributes: Mapping[str, Any]) -> str:
    """The unit of a variable as scenes write it, "1" for a plain number or what has no unit."""
    return str(attributes.get("unit", attributes.get("units", "1")))
