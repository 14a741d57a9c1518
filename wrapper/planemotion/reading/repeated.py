"""Many equal parts: what a table says for each value of an index, written out.

    [bodies."link[i]"]
    for = "i in 1..n"

`for` may stand in any table that has a name, and in tables of a list.  A table with nothing but `for` and
`value` is that value.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from ..base.errors import SceneError
from ..language.address import KEYWORDS
from ..language.leaves import Leaf, evaluate
from ..language.parser import parse
from ..language.tree import WRITTEN_FUNCTIONS
from ..language.units import is_common
from ..model import words
from .terms import filled, whole

FOR = "for"
# Of one scene, in all: far beyond what can be computed.
MOST_REPEATED = 100_000
_RANGE = re.compile(r"\s*([^\W\d]\w*)\s+in\s+(.+?)\s*\.\.\s*(.+?)\s*")
_TOLD = 'such as for = "i in 1..n", or a list of these'
# Keys with text for people, and with long lists in which nothing is repeated.
_AS_THEY_ARE = ("title", "description", "id", "tables", "sweep")


class Counts:
    """Values of parameters that say how many parts there are; `used`: the names of those that were read."""

    def __init__(self, parameters: Mapping[str, Any]) -> None:
        self._written = parameters
        self._values: dict[str, float] = {}
        self._open: list[str] = []
        self.used: set[str] = set()

    def __contains__(self, name: str) -> bool:
        return name in self._written

    def value(self, name: str) -> float | None:
        """That of a parameter; None if there is no such one."""
        if name not in self._written:
            return None
        self.used.add(name)
        if name not in self._values:
            path = f"parameters.{name}"
            if name in self._open:
                raise SceneError("it needs itself", path=path)
            self._open.append(name)
            self._values[name] = evaluate(parse(self._written[name], where=path), self._leaf)
            self._open.pop()
        return self._values[name]

    def _leaf(self, leaf: Leaf) -> float:
        value = self.value(str(leaf))
        if value is None:
            raise SceneError(words.unknown(str(leaf), self._written, "parameter"))
        return value


class Repeats:
    """Writes out what is repeated in the table of a scene; `made`: how many tables came of it."""

    def __init__(self, counts: Counts) -> None:
        self.counts = counts
        self.made = 0
        # Key paths of what came of a name with an index -> those as written.
        self.copies: dict[str, str] = {}

    def table(self, raw: Mapping[str, Any], path: str = "", indices: dict[str, int] | None = None) -> Any:
        """The table with a number for every index.  Raises SceneError with the key path."""
        indices = indices or {}
        told: dict[str, Any] = {}
        for key, one in raw.items():
            where = f"{path}.{key}" if path else key
            if not path and key in _AS_THEY_ARE:
                told[key] = one
                continue
            try:
                for own in self._each(one, where, indices, key):
                    name = filled(key, own, self._value(own))
                    if name in told:
                        raise SceneError(f'"{name}" is given twice')
                    told[name] = self._content(one, where, own)
                    if name != key:
                        self.copies[f"{path}.{name}"] = where
            except SceneError as error:
                raise error.at(path=where) from None
        return told

    def _content(self, one: Any, where: str, indices: dict[str, int]) -> Any:
        if isinstance(one, str):
            return filled(one, indices, self._value(indices))
        if isinstance(one, Mapping):
            repeats = FOR in one
            rest = {key: value for key, value in one.items() if key != FOR} if repeats else one
            content = self.table(rest, where, indices)
            return content["value"] if repeats and set(content) == {"value"} else content
        if isinstance(one, list | tuple):
            return [
                self._content(item, f"{where}[{k}]", own)
                for k, item in enumerate(one)
                for own in self._each(item, f"{where}[{k}]", indices, None)
            ]
        return one

    def _each(
        self, one: Any, where: str, indices: dict[str, int], key: str | None
    ) -> Iterator[dict[str, int]]:
        """The indices of each table that `one` stands for."""
        if not isinstance(one, Mapping) or FOR not in one:
            yield indices
            return
        written = [one[FOR]] if isinstance(one[FOR], str) else one[FOR]
        if not isinstance(written, list) or not written or not all(isinstance(text, str) for text in written):
            raise SceneError(f"an index and its range are wanted, {_TOLD}", path=f"{where}.{FOR}")
        if key is not None and "[" not in key:
            raise SceneError(f'the name needs the index, such as "{key}[i]"', path=where)
        for own in self._ranges(written, f"{where}.{FOR}", indices):
            self.made += 1
            if self.made > MOST_REPEATED:
                raise SceneError(f"more than {MOST_REPEATED} parts", path=f"{where}.{FOR}")
            yield own

    def _ranges(self, written: list[str], path: str, indices: dict[str, int]) -> Iterator[dict[str, int]]:
        if not written:
            yield indices
            return
        try:
            found = _RANGE.fullmatch(written[0])
            if found is None:
                raise SceneError(f"an index and its range are wanted, {_TOLD}")
            name = found[1]
            self._check_index(name, indices)
            value = self._value(indices)
            first, last = (whole(text, value, f"the range of {name}") for text in (found[2], found[3]))
        except SceneError as error:
            raise error.at(path=path, value=written[0]) from None
        for number in range(first, last + 1):
            yield from self._ranges(written[1:], path, {**indices, name: number})

    def _check_index(self, name: str, indices: dict[str, int]) -> None:
        if name in indices:
            raise SceneError(f"{name} is an index already")
        taken = name in words.RESERVED or name in KEYWORDS or name in WRITTEN_FUNCTIONS
        if taken or is_common(name):
            what = "is a unit" if is_common(name) else "has a meaning of its own"
            raise SceneError(f"{name} {what}; choose another letter, such as i, j or k")
        if name in self.counts:
            raise SceneError(f"{name} is a parameter; choose another letter")

    def _value(self, indices: dict[str, int]) -> Any:
        return lambda name: indices[name] if name in indices else self.counts.value(name)
