"""Words that are given as a list, or as one text with commas."""

from __future__ import annotations

from collections.abc import Iterable


def listed(given: str | Iterable[str]) -> tuple[str, ...]:
    """The words."""
    texts = given.split(",") if isinstance(given, str) else given
    return tuple(text.strip() for text in texts if text.strip())
