"""Parts: a scene within a scene, from [templates] or from another file, under a name.

    [parts.left]
    use = "fourbar.toml"
    with = { crank = "0.2 m" }

Whatever the part defines - parameters, bodies, joints, marks of the ground, events, asks - is called
`left.NAME`; words that it does not define are those of the scene around it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..base.bounded import read_bytes
from ..base.errors import SceneError
from ..base.lines import Origin
from ..base.toml import parse_toml
from ..model import words
from ..model.tables import Part
from .repeated import FOR, Counts, Repeats
from .terms import renamed

PARTS, TEMPLATES = "parts", "templates"
# Of one scene, and of parts within parts.
MOST_PARTS = 10_000
MOST_DEEP = 16
# A file that is larger is no scene.
_MOST_BYTES = 10_000_000
# What a part brings; the rest of its file - until, sweep, find, runs, solve - is for the file alone.
_NAMED = (
    "parameters",
    "tables",
    "bodies",
    "joints",
    "couplings",
    "contacts",
    "forces",
    "events",
    "ask",
    PARTS,
)
_MARKS = ("points", "lines", "circles", "curves", "rows")
_TAKEN = (*_NAMED, "ground", "start")
_LEFT = ("id", "title", "description", "until", "plane", "sweep", "find", "runs", "solve", TEMPLATES)
# Keys whose text names nothing of the scene.
_AS_THEY_ARE = (
    "unit",
    "law",
    "capture",
    "painleve",
    "between",
    "outside",
    "file",
    "use",
    "rod",
    "corners",
    "title",
    "description",
)
_WORDS = ("smooth", "rough", "start", "end", "rest")


@dataclass(frozen=True)
class _Context:
    """Where templates are looked up: a table of them, its file and text, and the way to it."""

    templates: Mapping[str, Any]
    file: str | None
    text: str | None
    way: tuple[str, ...] = ()


@dataclass
class Whole:
    """The table of a scene with its parts in it; `origins`: where their keys stand; `files`: others read;
    `counted`: parameters that were."""

    table: dict[str, Any]
    origins: dict[str, Origin] = field(default_factory=dict)
    files: set[str] = field(default_factory=set)
    counted: set[str] = field(default_factory=set)
    number: int = 0


def with_parts(raw: Mapping[str, Any], file: str | None, text: str | None) -> Whole:
    """The table with what its parts bring, and theirs.  Raises SceneError with the place of the fault."""
    whole = Whole({key: dict(one) if isinstance(one, Mapping) else one for key, one in raw.items()})
    ground = words.table(raw, "ground")
    if ground:
        marks = {key: dict(one) if isinstance(one, Mapping) else one for key, one in ground.items()}
        whole.table["ground"] = marks
    whole.table.pop(PARTS, None)
    templates = whole.table.pop(TEMPLATES, {})
    context = _Context(words.mapping(templates, TEMPLATES), file, text)
    _place(whole, words.table(raw, PARTS), context, PARTS)
    return whole


def _place(whole: Whole, parts: Mapping[str, Any], context: _Context, path: str) -> None:
    counts = Counts(words.table(whole.table, "parameters"))
    repeats = Repeats(counts)
    for written, one in parts.items():
        for name, part in repeats.table({written: one}, PARTS).items():
            try:
                _place_one(whole, name, words.mapping(part, f"{PARTS}.{name}"), context)
            except SceneError as error:
                raise error.at(path=f"{path}.{written}") from None
    whole.counted |= counts.used


def _place_one(whole: Whole, name: str, part: Mapping[str, Any], context: _Context) -> None:
    path = f"{PARTS}.{name}"
    words.check_name(name, PARTS)
    whole.number += 1
    if whole.number > MOST_PARTS:
        raise SceneError(f"more than {MOST_PARTS} parts", path=path)
    for key in part:
        if key not in Part.file_keys():
            reason = f"unknown key; a part has {', '.join((*Part.file_keys(), FOR))}"
            raise SceneError(reason, path=f"{path}.{key}")
    use = part.get("use")
    if not isinstance(use, str):
        reason = 'what the part is: the name of one of [templates], or a file such as "fourbar.toml"'
        raise SceneError(reason, path=f"{path}.use", value=use)
    template, origin, inside = _template(whole, use, context, f"{path}.use")
    given = words.mapping(part.get("with", {}), f"{path}.with")
    _check_given(given, words.table(template, "parameters"), f"{path}.with")
    _Placing(whole, name, template, origin).add(given)
    nested = words.table(template, PARTS)
    if nested:
        own = _Renaming(name, template)
        below = {f"{name}.{key}": own.content(one, "") for key, one in nested.items()}
        _place(whole, below, inside, path)


def _check_given(given: Mapping[str, Any], known: Mapping[str, Any], path: str) -> None:
    for key in given:
        if key not in known:
            raise SceneError(words.unknown(key, known, "parameter of this part"), path=f"{path}.{key}")


def _template(
    whole: Whole, use: str, context: _Context, path: str
) -> tuple[Mapping[str, Any], Origin, _Context]:
    """What a part is made of, where it stands, and where its own templates do."""
    is_file = use not in context.templates and use.endswith(".toml")
    if not is_file and use not in context.templates:
        reason = words.unknown(use, context.templates, "template") + '; a file ends in ".toml"'
        raise SceneError(reason, path=path, value=use)
    mark = f"{context.file or ''}#{use}"
    if is_file:
        mark = os.path.normpath(Path(context.file or "").parent / use)
    if mark in context.way or (is_file and context.file and mark == os.path.normpath(context.file)):
        told = " -> ".join(one.rpartition("#")[2] for one in (*context.way, mark))
        raise SceneError(f"it contains itself: {told}", path=path, value=use)
    if len(context.way) >= MOST_DEEP:
        raise SceneError(f"parts more than {MOST_DEEP} levels deep", path=path, value=use)
    way = (*context.way, mark)
    if not is_file:
        template = words.mapping(context.templates[use], f"{TEMPLATES}.{use}")
        origin = Origin(context.file if context.way else None, context.text, f"{TEMPLATES}.{use}")
        inside = _Context(context.templates, context.file, context.text, way)
        _check_keys(template, origin)
        return template, origin, inside
    text = _read(mark, use, path)
    template = parse_toml(text, mark)
    origin = Origin(mark, text, "")
    _check_keys(template, origin)
    whole.files.add(mark)
    inside = _Context(words.table(template, TEMPLATES), mark, text, way)
    return template, origin, inside


def _read(file: str, use: str, path: str) -> str:
    try:
        return read_bytes(Path(file), _MOST_BYTES).decode("utf-8")
    except UnicodeDecodeError:
        raise SceneError("the file is not text in UTF-8", path=path, value=use) from None
    except OSError as error:
        raise SceneError(f"cannot be read: {error.strerror or error}", path=path, value=use) from None


def _check_keys(template: Mapping[str, Any], origin: Origin) -> None:
    for key in template:
        if key in _TAKEN or key in _LEFT:
            continue
        reason = f"a part brings {', '.join(_TAKEN)}, no {key}"
        raise SceneError(reason, path=f"{origin.path}.{key}".removeprefix("."), file=origin.file)


def _plain(name: str) -> str:
    """The first word of a name, without its index."""
    return name.partition("[")[0].partition(".")[0]


class _Renaming:
    """Puts the name of a part in front of what the part defines."""

    def __init__(self, name: str, template: Mapping[str, Any]) -> None:
        self.name = name
        self.own = {_plain(key) for group in _NAMED for key in words.table(template, group)} - {"g"}
        ground = words.table(template, "ground")
        self.marks = {_plain(key) for group in _MARKS for key in words.table(ground, group)}

    def word(self, chain: str) -> str:
        """A dotted name of the part as the scene has it."""
        if _plain(chain) in self.own:
            return f"{self.name}.{chain}"
        first, _, rest = chain.partition(".")
        return f"ground.{self.name}.{rest}" if first == "ground" and _plain(rest) in self.marks else chain

    def text(self, text: str) -> str:
        return text if text in _WORDS else renamed(text, self.word)

    def content(self, one: Any, key: str) -> Any:
        if isinstance(one, str):
            # A point is drawn from another one of its own body.
            return one if key in (*_AS_THEY_ARE, "from") else self.text(one)
        if isinstance(one, Mapping):
            return {name: self.content(value, name) for name, value in one.items()}
        if isinstance(one, list | tuple):
            return [self.content(item, key) for item in one]
        return one


class _Placing:
    """Adds what one part brings to the scene."""

    def __init__(self, whole: Whole, name: str, template: Mapping[str, Any], origin: Origin) -> None:
        self.whole = whole
        self.name = name
        self.template = template
        self.origin = origin
        self.own = _Renaming(name, template)

    def add(self, given: Mapping[str, Any]) -> None:
        for path, name, new, one in self._entries(given):
            group = self._group(path)
            place = f"{path}.{new}"
            if new in group:
                if path == "parameters":
                    continue  # [parameters] of the scene gives it another value
                raise SceneError("the name is taken", path=place)
            group[new] = one
            where = f"{self.origin.path}.{path}.{name}".removeprefix(".")
            self.whole.origins[place] = Origin(self.origin.file, self.origin.text, where)

    def _group(self, path: str) -> dict[str, Any]:
        """The table of the scene at a key path, made where there is none."""
        table = self.whole.table
        for key in path.split("."):
            table = table.setdefault(key, {})
            words.mapping(table, path)
        return table

    def _entries(self, given: Mapping[str, Any]) -> Iterator[tuple[str, str, str, Any]]:
        """Group, name in the part, name in the scene and content of all that there is."""
        for group in _NAMED[:-1]:
            for name, one in words.table(self.template, group).items():
                if name == "g":
                    continue  # one weight for all
                new = f"{self.name}.{name}"
                is_given = group == "parameters" and name in given
                yield group, name, new, given[name] if is_given else self._content(group, one)
        ground = words.table(self.template, "ground")
        for group in _MARKS:
            for name, one in words.table(ground, group).items():
                yield f"ground.{group}", name, f"{self.name}.{name}", self.own.content(one, "")
        for name, one in words.table(self.template, "start").items():
            yield "start", name, self.own.text(name), self.own.content(one, "")

    def _content(self, group: str, one: Any) -> Any:
        if group == "tables" and isinstance(one, Mapping) and self.origin.file and "file" in one:
            # It stands beside the file of the part.
            place = os.path.join(os.path.dirname(self.origin.file), str(one["file"]))
            one = {**one, "file": os.path.abspath(place)}
        return self.own.content(one, "")
