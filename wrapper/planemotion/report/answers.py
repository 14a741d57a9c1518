"""An answer in words: its number, its unit, and what is known of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..engine.result import AskValue

_SHOWN_OF_LIST = 6
_DIGITS = 8  # significant, of an answer


def value_text(ask: AskValue) -> str:
    """The number, the word of events, or the first of a list; "-" where there is none."""
    if isinstance(ask.value, str):
        return f'"{ask.value}"'
    if not isinstance(ask.value, list):
        return _number(ask.value)
    shown = [_number(value) for value in ask.value[:_SHOWN_OF_LIST]]
    more = [f"... {len(ask.value)} values"] if len(ask.value) > _SHOWN_OF_LIST else []
    return ", ".join([*shown, *more]) or "-"


def unit_text(ask: AskValue) -> str:
    """The unit; "" of a plain number."""
    return "" if ask.unit == "1" else ask.unit


def note_text(ask: AskValue) -> str:
    """The estimated error, of a list the greatest, or the margin; and why something is missing."""
    notes = [f"({ask.reason})"] if ask.reason else []
    errors = ask.error if isinstance(ask.error, list) else [ask.error]
    known = [error for error in errors if error is not None]
    if ask.margin is not None:
        notes.insert(0, f"margin {ask.margin:.1e}")
    elif known:
        notes.insert(0, f"\u00b1 {max(known):.1e}")
    return "  ".join(notes)


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.{_DIGITS}g}"
