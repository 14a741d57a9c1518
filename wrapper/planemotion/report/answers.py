"""An answer in words: its number, its unit, and what is known of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..engine.result import AskValue

_SHOWN_OF_LIST = 6
_DIGITS = 8  # significant, of an answer, at most
_OF_ERROR = 2  # significant, of an error: what an answer has beyond them says nothing


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
