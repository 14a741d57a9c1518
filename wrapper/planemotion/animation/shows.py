"""What an animation shows beside bodies, names and blows, in the words of the command line."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..base.themes import require_theme
from ..base.words import listed
from ..model.words import shown_words

WORDS = ("energies", "velocities", "forces", "slow")
USUAL = ("energies",)


@dataclass(frozen=True)
class Shows:
    """`words`: of WORDS; "slow": time passes slower around events.  `traces`: points of bodies, such as
    "AB.B", whose ways are drawn (none: of all particles).  `theme`: None is that of the reader's system."""

    words: tuple[str, ...] = USUAL
    traces: tuple[str, ...] = ()
    theme: str | None = None

    def told(self) -> dict[str, Any]:
        """As the player reads it."""
        return {"theme": self.theme, **{word: word in self.words for word in WORDS}}


USUALLY = Shows()


def shows_of(show: str | Iterable[str], trace: str | Iterable[str], theme: str | None) -> Shows:
    """Words and points as lists, or as one text with commas.

    Raises StudyError for a word or a theme that there is not."""
    words = shown_words(show, WORDS)
    if theme is not None:
        require_theme(theme)
    return Shows(words, listed(trace), theme)
