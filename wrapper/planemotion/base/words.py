"""Words as people write them: lists with commas, numbers of things."""

from __future__ import annotations

from collections.abc import Iterable


def listed(given: str | Iterable[str]) -> tuple[str, ...]:
    """The words."""
    texts = given.split(",") if isinstance(given, str) else given
    return tuple(text.strip() for text in texts if text.strip())


def counted(number: int, thing: str) -> str:
    """So many of a thing: "1 case", "2 cases"."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"
