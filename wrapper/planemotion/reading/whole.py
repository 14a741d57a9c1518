"""The whole table of a scene: with its parts, and with what is repeated written out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..base.bounded import check_table
from ..base.errors import SceneError
from ..base.lines import Written
from ..model import words
from .parts import PARTS, TEMPLATES, with_parts
from .repeated import FOR, Counts, Repeats

_NAMED = ("parameters", "tables", "bodies", "joints", "couplings", "contacts", "forces", "events", "ask")
_MARKS = ("points", "lines", "circles", "curves", "rows")


@dataclass(frozen=True)
class Whole:
    """The table; `joined`: its names that are no plain words; `counted`: the parameters by which it is made;
    `written`: where its keys stand; `from_files`: whether other files say some of it."""

    table: Mapping[str, Any]
    written: Written
    joined: frozenset[str] = frozenset()
    counted: frozenset[str] = frozenset()
    from_files: bool = False


def whole_scene(raw: Mapping[str, Any], file: str | None, text: str | None) -> Whole:
    """The whole table of a scene as it is written.  Raises SceneError."""
    if not _is_made(raw):
        return Whole(raw, Written(text))
    placed = with_parts(raw, file, text)
    origins = placed.origins
    counts = Counts(words.table(placed.table, "parameters"))
    repeats = Repeats(counts)
    try:
        table = repeats.table(placed.table)
        check_table(table)
    except SceneError as error:
        raise error.at(text=Written(text, origins)) from None
    origins.update({new: origins[old] for new, old in repeats.copies.items() if old in origins})
    joined = frozenset(name for name in _names(table) if "." in name or "[" in name)
    return Whole(
        table, Written(text, origins), joined, frozenset(counts.used | placed.counted), bool(placed.files)
    )


def _is_made(raw: Mapping[str, Any]) -> bool:
    """Whether anything in the table is not written out with plain names."""
    if PARTS in raw or TEMPLATES in raw or any(_has_index(one, key) for key, one in raw.items()):
        return True
    return any("." in name for name in _names(raw))


def _has_index(one: Any, key: str) -> bool:
    if key in ("tables", "sweep"):
        return False
    if isinstance(one, Mapping):
        return any("[" in name or name == FOR or _has_index(below, name) for name, below in one.items())
    if isinstance(one, list | tuple):
        return any(isinstance(below, Mapping | list) and _has_index(below, "") for below in one)
    return False


def _names(table: Mapping[str, Any]) -> Iterator[str]:
    for group in _NAMED:
        yield from words.table(table, group)
    owners = [words.table(table, "ground"), *words.table(table, "bodies").values()]
    for owner in owners:
        if isinstance(owner, Mapping):
            for group in _MARKS:
                yield from words.table(owner, group)
