"""The exceptions of the package: what was wrong, where, with which value, and the nearest right word.

Every error derives from `PlanemotionError`.  A fault in what the user wrote is a `SceneError` and names file
and key path; a run that could not be trusted is a `SimulationError` and carries the status of the kernel;
sweeps and their files raise `StudyError`.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable

# Similarity (0 to 1) from which on a word is offered as "did you mean": keeps "frictoin", drops unrelated
# words.
_SIMILAR_ENOUGH = 0.6
# Characters of a value that a message shows.
_MOST_SHOWN = 500


class PlanemotionError(Exception):
    """Base of all errors that this package raises on purpose."""


class SceneHint(UserWarning):
    """A scene has an old word, which is still read; the text names file, key and the new word."""


class SceneError(PlanemotionError, ValueError):
    """Something written in a scene, a study or an override is wrong; nothing has been computed.

    Attributes: `reason` (what is wrong and what would be right), `file`, `path` (key path such as
    "bodies.AB.mass") and `value` (as it was written); the last three are None where they are not known (yet).
    """

    def __init__(
        self,
        reason: str,
        *,
        file: str | os.PathLike[str] | None = None,
        path: str | None = None,
        value: object = None,
    ) -> None:
        super().__init__(reason)
        self.reason = reason
        self.file = None if file is None else os.fspath(file)
        self.path = path
        self.value = value

    def at(
        self,
        *,
        file: str | os.PathLike[str] | None = None,
        path: str | None = None,
        value: object = None,
    ) -> SceneError:
        """The same error with the missing pieces of its place filled in; pieces that it has are kept."""
        return SceneError(
            self.reason,
            file=self.file if self.file is not None else file,
            path=self.path if self.path is not None else path,
            value=self.value if self.value is not None else value,
        )

    def __str__(self) -> str:
        """`file: path = value: reason`, with missing pieces left out."""
        place = self.path or ""
        if self.value is not None:
            shown = _as_written(self.value)
            place = f"{place} = {shown}" if place else shown
        return ": ".join(piece for piece in (self.file, place, self.reason) if piece)


class SimulationError(PlanemotionError, RuntimeError):
    """A run failed: no number of it can be trusted beyond what `result` holds.

    Attributes: `status` (of enum pm_status, < 0), `reason` (its text with place and numbers), `time` (s,
    None if the run did not begin) and `result` (what was answered before the failure, or None).
    """

    def __init__(
        self, reason: str, *, status: int = 0, time: float | None = None, result: object = None
    ) -> None:
        super().__init__(reason)
        self.status = status
        self.reason = reason
        self.time = time
        self.result = result


class StudyError(PlanemotionError):
    """A sweep cannot be planned, stored, resumed or exported; stored parts that were good are still good."""


def nearest(word: str, candidates: Iterable[str]) -> str | None:
    """The candidate that `word` was probably meant to be, or None if none is near."""
    known = list(candidates)
    for candidate in known:
        if candidate.casefold() == word.casefold():
            return candidate
    close = difflib.get_close_matches(word, known, n=1, cutoff=_SIMILAR_ENOUGH)
    return close[0] if close else None


def _as_written(value: object) -> str:
    """A value as it would stand in a TOML file; of a long text its beginning."""
    if isinstance(value, bool):
        return "true" if value else "false"
    text = str(value)
    text = text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."
    return f'"{text}"' if isinstance(value, str) else text
