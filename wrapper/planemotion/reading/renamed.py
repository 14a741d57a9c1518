"""Words of the scene language that have a clearer form now: the old one is read with the same meaning.

Each old word that a scene has gives a hint that names its key, the old and the new word.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ..base.errors import SceneError, SceneHint, located
from ..base.lines import Written


@dataclass(frozen=True)
class _Renamed:
    """A key of the elements of `group`, or of the table `group` itself, and of its values."""

    group: str
    old: str
    new: str
    values: Mapping[str, str] = field(default_factory=dict)
    applies: Callable[[Mapping[str, Any]], bool] = lambda element: True
    of_elements: bool = True


def _has_friction_couple(joint: Mapping[str, Any]) -> bool:
    return "pin" in joint and not isinstance(joint.get("friction"), Mapping)


_RENAMED = (
    # A couple here and a coefficient at a slider: the word said two things.
    _Renamed("joints", "friction", "friction_couple", applies=_has_friction_couple),
    # The same word is an option of a damper.
    _Renamed("couplings", "rate", "motor"),
    # What is captured at a point is pinned there.
    _Renamed("contacts", "capture", "capture", values={"point": "pin"}),
    _Renamed("solve", "assembly", "assembly_tolerance", of_elements=False),
    # Impacts one by one are not simultaneous.
    _Renamed(
        "solve",
        "simultaneous",
        "impacts",
        values={"together": "simultaneous", "one by one": "sequential"},
        of_elements=False,
    ),
)
_HIDDEN_TIME = (
    "parameters.t: a parameter t hides the time, which expressions then have to call time; "
    "give the parameter another name"
)


def renewed(raw: Mapping[str, Any]) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The table of a scene with new words for old ones, and a hint for each.

    Raises SceneError where both forms of a word are given.
    """
    table = dict(raw)
    hints: list[str] = []
    for word in _RENAMED:
        group = table.get(word.group)
        if not isinstance(group, Mapping):
            continue  # the check of the keys says what is wrong with it
        if word.of_elements:
            table[word.group] = {
                name: _renewed(word, element, f"{word.group}.{name}", hints)
                for name, element in group.items()
            }
        else:
            table[word.group] = _renewed(word, group, word.group, hints)
    parameters = table.get("parameters")
    if isinstance(parameters, Mapping) and "t" in parameters:
        hints.append(_HIDDEN_TIME)
    return table, tuple(hints)


def _renewed(word: _Renamed, element: Any, path: str, hints: list[str]) -> Any:
    """An element, or a table, with the new form of one word."""
    if not isinstance(element, Mapping) or word.old not in element or not word.applies(element):
        return element
    given = element[word.old]
    meant = word.values.get(given, given) if isinstance(given, str) else given
    if (word.new, meant) == (word.old, given):
        return element
    if word.new != word.old and word.new in element:
        reason = f"this is the old word for {word.new}, which is given too"
        raise SceneError(reason, path=f"{path}.{word.old}")
    hints.append(f"{path}.{word.old}: {_change(word, given, meant)}; the old form is still read")
    return dict((word.new, meant) if key == word.old else (key, one) for key, one in element.items())


def _change(word: _Renamed, given: Any, meant: Any) -> str:
    if given == meant:
        return f"write {word.new} instead of {word.old}"
    return f'write {word.new} = "{meant}" instead of {word.old} = "{given}"'


class Hints:
    """The hints at old words of a scene and its copies with other values: each is given once."""

    def __init__(self) -> None:
        self._given: set[str] = set()

    def tell(self, hints: Iterable[str], file: str | None, text: str | None) -> None:
        """Warns whoever asked for the data of the scene."""
        for hint in hints:
            if hint not in self._given:
                self._given.add(hint)
                warnings.warn(located(hint, file, Written(text)), SceneHint, stacklevel=4)
