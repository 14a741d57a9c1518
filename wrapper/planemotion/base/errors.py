"""The exceptions of the package: what was wrong, where, with which value, and the nearest right word.

Every error derives from `PlanemotionError`.  A fault in what the user wrote is a `SceneError` and names file
and key path; a run that could not be trusted is a `SimulationError` and carries the status of the kernel;
sweeps and their files raise `StudyError`.
"""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TypeVar

from .lines import Written
from .written import written

_T = TypeVar("_T")
_Made = TypeVar("_Made")

# Similarity (0 to 1) from which on a word is offered as "did you mean": keeps "frictoin", drops unrelated
# words.
_SIMILAR_ENOUGH = 0.6
# What others call it -> the words of the language, the likeliest first.
_MEANT: Mapping[str, tuple[str, ...]] = {
    "angular_acceleration": ("alpha",),
    "angular_velocity": ("omega",),
    "ball": ("sphere",),
    "bar": ("rod",),
    "beam": ("rod",),
    "bounce": ("restitution",),
    "bounces": ("strikes",),
    "bounds": ("vary",),
    "box": ("plate",),
    "c": ("rate",),
    "cable": ("cord",),
    "chain": ("cord",),
    "circle": ("disk",),
    "closes": ("strikes",),
    "collar": ("slider",),
    "collide": ("touch",),
    "collides": ("strikes",),
    "collisions": ("contacts",),
    "condition": ("where", "when"),
    "constraints": ("joints",),
    "cor": ("restitution",),
    "count": ("num",),
    "damping": ("rate",),
    "dashpot": ("damper",),
    "drive": ("motor",),
    "duration": ("until",),
    "e": ("restitution",),
    "elasticity": ("restitution",),
    "end": ("until",),
    "ends": ("rod",),
    "expression": ("of",),
    "fixed": ("weld",),
    "from": ("vary",),
    "g": ("parameters.g",),
    "goal": ("where",),
    "gravity": ("g", "parameters.g"),
    "grips": ("sticks",),
    "guide": ("slider",),
    "hinge": ("pin",),
    "hits": ("strikes",),
    "initial": ("start",),
    "k": ("stiffness",),
    "l0": ("free_length",),
    "leaves": ("opens",),
    "lifts": ("opens",),
    "load": ("force",),
    "max": ("greatest",),
    "maximize": ("greatest",),
    "maximum": ("greatest", "max"),
    "min": ("least",),
    "minimize": ("least",),
    "minimum": ("least", "min"),
    "moment": ("couple",),
    "moment_of_inertia": ("inertia",),
    "mu": ("friction",),
    "n": ("num",),
    "natural_length": ("free_length",),
    "number": ("num",),
    "omega": ("value",),
    "options": ("solve",),
    "outputs": ("ask",),
    "parts": ("opens",),
    "pivot": ("pin",),
    "pos": ("at", "position"),
    "position": ("at",),
    "prismatic": ("slider",),
    "pull": ("force",),
    "push": ("force",),
    "questions": ("ask",),
    "radius": ("disk",),
    "range": ("vary",),
    "reaction": ("force",),
    "rectangle": ("plate",),
    "rest_length": ("free_length",),
    "revolute": ("pin",),
    "ring": ("hoop",),
    "roller": ("slider",),
    "rolls": ("rolling", "sticks"),
    "rope": ("cord",),
    "rotation": ("turned", "angle"),
    "samples": ("num",),
    "separates": ("opens",),
    "slides": ("slips",),
    "solver": ("solve",),
    "speed": ("value", "velocity"),
    "spin": ("omega",),
    "steps": ("num",),
    "stops": ("sticks",),
    "string": ("cord",),
    "target": ("where",),
    "theta": ("angle",),
    "time": ("until",),
    "to": ("vary",),
    "torque": ("couple",),
    "touches": ("strikes",),
    "v": ("velocity",),
    "value": ("of",),
    "wall": ("line", "lines"),
    "walls": ("lines",),
    "wheel": ("disk", "rolling"),
}
# Characters of a value that a message shows.
_MOST_SHOWN = 500
# The key path with which a sentence begins.
_PATH = re.compile(r"\w+(?:\.\w+|\[[-\d,]+\])*")


class PlanemotionError(Exception):
    """Base of all errors that this package raises on purpose."""


class SceneHint(UserWarning):
    """A scene has an old word, which is still read; the text names file, key and the new word."""


class SceneError(PlanemotionError, ValueError):
    """Something written in a scene, a study or an override is wrong; nothing has been computed.

    Attributes: `reason` (what is wrong and what would be right), `file`, `line` and `column` (from 1),
    `path` (key path such as "bodies.AB.mass") and `value` (as it was written), None where they are not known
    (yet); `others`: further faults of the same scene.
    """

    def __init__(
        self,
        reason: str,
        *,
        file: str | os.PathLike[str] | None = None,
        path: str | None = None,
        value: object = None,
        line: int | None = None,
        column: int | None = None,
        others: Sequence[SceneError] = (),
    ) -> None:
        super().__init__(reason)
        self.reason = reason
        self.file = None if file is None else os.fspath(file)
        self.path = path
        self.value = value
        self.line = line
        self.column = column
        self.others = tuple(others)

    def at(
        self,
        *,
        file: str | os.PathLike[str] | None = None,
        path: str | None = None,
        value: object = None,
        text: Written | None = None,
    ) -> SceneError:
        """The same error with the missing pieces of its place filled in; pieces that it has are kept.

        `text`: the TOML of the scene, where its line and column are looked up.
        """
        path = self.path if self.path is not None else path
        line, column, found = self.line, self.column, None
        if line is None and self.file is None and text is not None and path is not None:
            found, line, column = text.place(path) or (None, None, None)
        placed = SceneError(
            self.reason,
            file=self.file or found or file,
            path=path,
            value=self.value if self.value is not None else value,
            line=line,
            column=column,
        )
        others = [other.at(file=file, text=text) for other in self.others]
        # One fault of what is repeated is told once.
        told = {placed._spot: placed}
        for other in others:
            told.setdefault(other._spot, other)
        placed.others = tuple(told.values())[1:]
        return placed

    @property
    def _spot(self) -> object:
        """What is told where; that of an unknown place is its own."""
        return (self.file, self.line, self.column, self.reason) if self.line is not None else id(self)

    def __str__(self) -> str:
        """`file:line:column: path = value: reason` without what is missing; further faults below."""
        place = self.path or ""
        if self.value is not None:
            shown = _as_written(self.value)
            place = f"{place} = {shown}" if place else shown
        where = placed(self.file, self.line, self.column)
        text = ": ".join(piece for piece in (where, place, self.reason) if piece)
        return "\n".join((text, *map(str, self.others)))


def placed(file: str | None, line: int | None, column: int | None) -> str:
    """`file:line:column` without what is missing."""
    numbers = [str(number) for number in (line, column) if number is not None]
    if file is None:
        return f"line {numbers[0]}" if numbers else ""
    return ":".join([file, *numbers])


def located(sentence: str, file: str | None, text: Written | None) -> str:
    """A sentence that begins with a key path, behind the file, if there is one, and the place of that key."""
    if file is None:
        return sentence
    path = _PATH.match(sentence)
    place = text.place(path[0]) if path and text is not None else None
    found, line, column = place or (None, None, None)
    return f"{placed(found or file, line, column)}: {sentence}"


class Faults:
    """Faults of one scene that do not depend on each other: found one by one, told together."""

    def __init__(self) -> None:
        self._found: list[SceneError] = []

    @contextmanager
    def noted(self) -> Iterator[None]:
        """What is raised inside is kept, and the next one is looked for."""
        try:
            yield
        except SceneError as error:
            if (error.path, error.reason) not in {(one.path, one.reason) for one in self._found}:
                self._found.append(error)

    def make(self, named: Mapping[str, _T], maker: Callable[[str, _T], _Made]) -> dict[str, _Made]:
        """What `maker` makes of each, by name; those with a fault are left out, and all faults told then."""
        made = {}
        for name, one in named.items():
            with self.noted():
                made[name] = maker(name, one)
        self.tell()
        return made

    def tell(self) -> None:
        """Raises SceneError if there are any: the first, with the others."""
        if self._found:
            first, *others = self._found
            first.others = (*first.others, *others)
            raise first


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

    def at(self, *, file: str | os.PathLike[str] | None) -> StudyError:
        """The same error behind the file, where there is one."""
        return self if file is None else StudyError(f"{os.fspath(file)}: {self}")


def nearest(word: str, candidates: Iterable[str]) -> str | None:
    """The candidate that `word` was probably meant to be, or None if none is near."""
    known = list(candidates)
    for candidate in known:
        if candidate.casefold() == word.casefold():
            return candidate
    for meant in _MEANT.get(word.casefold(), ()):
        if meant in known:
            return meant
    close = difflib.get_close_matches(word, known, n=1, cutoff=_SIMILAR_ENOUGH)
    return close[0] if close else None


def _as_written(value: object) -> str:
    """A value as it would stand in a TOML file; of a long one its beginning."""
    try:
        text = written(value)
    except TypeError:
        text = str(value)
    if len(text) <= _MOST_SHOWN:
        return text
    return f"{text[:_MOST_SHOWN]}..." + ('"' if isinstance(value, str) else "")
