"""An answer: its number, its unit, and what is known of it; the same in words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

_SHOWN_OF_LIST = 6
_DIGITS = 8  # significant, of an answer, at most
_OF_ERROR = 2  # significant, of an error: what an answer has beyond them says nothing

Estimate = float | list[float | None] | None
Answer = Estimate | str


@dataclass(frozen=True)
class AskValue:
    """The answer to one ask: `value` in `unit`; None, with the `reason`, where there is none.

    The answer which events happened is a text, "" if none did.

    A list has None for each value that was not reached; `reason` then says why, and also where an event
    fired more often than the list "each EVENT" is long.  `error`: the estimated
    absolute error, in `unit`, shaped as `value`; None where nothing was estimated.  `margin`, of an integer
    or a yes or no: distance over error of the closest decision on which it depends; below 1 it is not
    certain; None if no decision was taken.
    """

    value: Answer
    unit: str
    reason: str = ""
    error: Estimate = None
    margin: float | None = None

    def to_json(self) -> dict[str, Any]:
        """Value and unit, what is known of error and margin, and the reason where something is missing."""
        entry: dict[str, Any] = {"value": self.value, "unit": self.unit}
        if self.error is not None:
            entry["error"] = self.error
        if self.margin is not None:
            entry["margin"] = self.margin
        return {**entry, "reason": self.reason} if self.reason else entry


def value_text(ask: AskValue) -> str:
    """The number, the word of events, or the first of a list; "-" where there is none."""
    if isinstance(ask.value, str):
        return f'"{ask.value}"'
    if not isinstance(ask.value, list):
        return _number(ask.value, _errors(ask)[0])
    shown = [_number(*one) for one in zip(ask.value[:_SHOWN_OF_LIST], _errors(ask), strict=False)]
    more = [f"... {len(ask.value)} values"] if len(ask.value) > _SHOWN_OF_LIST else []
    return ", ".join([*shown, *more]) or "-"


def unit_text(ask: AskValue) -> str:
    """The unit; "" of a plain number."""
    return "" if ask.unit == "1" else ask.unit


def note_text(ask: AskValue) -> str:
    """The estimated error, of a list the greatest, or the margin; and why something is missing."""
    notes = [f"({ask.reason})"] if ask.reason else []
    known = [error for error in _errors(ask) if error is not None]
    if ask.margin is not None:
        notes.insert(0, f"margin {ask.margin:.1e}")
    elif known:
        notes.insert(0, f"\u00b1 {max(known):.{_OF_ERROR - 1}e}")
    return "  ".join(notes)


def _errors(ask: AskValue) -> list[float | None]:
    """The error of each value."""
    if isinstance(ask.error, list):
        return ask.error
    return [ask.error] * (len(ask.value) if isinstance(ask.value, list) else 1)


def _number(value: float | None, error: float | None) -> str:
    """The digits that its error leaves: what is smaller than all of these is 0."""
    if value is None:
        return "-"
    if error and math.isfinite(error):
        last = math.floor(math.log10(error)) - (_OF_ERROR - 1)
        value = round(value, -last) + 0.0  # no -0
    return f"{value:.{_DIGITS}g}"
