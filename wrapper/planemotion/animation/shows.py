"""What an animation shows beside bodies, names and blows, in the words of the command line."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..base.errors import StudyError
from ..base.themes import require_theme
from ..base.words import listed
from ..model.words import unknown

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
    words, traces = listed(show), listed(trace)
    for word in words:
        if word not in WORDS:
            raise StudyError(f'show = "{word}": {unknown(word, WORDS, "word")}')
    if theme is not None:
        require_theme(theme)
    return Shows(words, traces, theme)
