"""In which line and column of a TOML text a key stands: tomllib does not tell it of the tables that it reads.

The text is known to be TOML, so that the headers of its tables, the begins of its values and the keys within
inline tables are all that has to be seen.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

_NAME = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_KEYS = rf"{_NAME}(?:[ \t]*\.[ \t]*{_NAME})*"
_HEADER = re.compile(rf"[ \t]*\[\[?[ \t]*({_KEYS})[ \t]*\]\]?")
_KEY = re.compile(rf"[ \t]*({_KEYS})[ \t]*=")
_ONE = re.compile(_NAME)
_INDEX = re.compile(r"\[[^\]]*\]")
_MULTILINE = re.compile(r'"""|\'\'\'')


@dataclass(frozen=True)
class Origin:
    """Where a key stands: in which file (None: that of the scene) with which text, at which path."""

    file: str | None
    text: str | None
    path: str


@dataclass(frozen=True)
class Written:
    """The TOML of a scene, and by key path where what stands elsewhere was written: parts do."""

    text: str | None
    origins: Mapping[str, Origin] = field(default_factory=dict)

    def place(self, path: str) -> tuple[str | None, int, int] | None:
        """File (None: that of the scene), line and column, from 1, of a key path; None if it is not there."""
        origin = self._origin(path)
        if origin.text is None:
            return None
        place = place_of(origin.text, origin.path)
        return (origin.file, *place) if place is not None else None

    def _origin(self, path: str) -> Origin:
        words = path.split(".")
        for count in range(len(words) if self.origins else 0, 0, -1):
            origin = self.origins.get(".".join(words[:count]))
            if origin is not None:
                return Origin(origin.file, origin.text, ".".join((origin.path, *words[count:])))
        return Origin(None, self.text, path)


@lru_cache(maxsize=64)
def place_of(text: str, path: str) -> tuple[int, int] | None:
    """Line and column, from 1, of the key at a path such as "bodies.AB.mass", or of the table around it.

    None where nothing of it stands in the text.
    """
    wanted = _INDEX.sub("", path)
    best: tuple[int, int] | None = None  # how much of the path fits, where the key begins
    for keys, begin, end in _values(text):
        if not (_leads_to(keys, wanted) or _leads_to(wanted, keys)):
            continue
        place, fits, at = begin, min(len(keys), len(wanted)), _begin(text, begin)
        for name in wanted[len(keys) + 1 :].split("."):
            key = re.compile(rf"[{{,]\s*([\"']?{re.escape(name)}[\"']?\s*=)").search(text, place, end)
            if key is None:
                break
            place, fits, at = key.end(), fits + 1 + len(name), key.start(1)
        if best is None or fits > best[0]:
            best = fits, at
    if best is None:
        return None
    return text.count("\n", 0, best[1]) + 1, best[1] - text.rfind("\n", 0, best[1])


def _begin(text: str, place: int) -> int:
    """Where in its line a header or key begins."""
    while text[place] in " \t":
        place += 1
    return place


def _leads_to(keys: str, others: str) -> bool:
    """Whether the names of one path begin another."""
    return f"{others}.".startswith(f"{keys}.")


def _path(keys: str) -> str:
    return _INDEX.sub("", ".".join(name.strip("\"'") for name in _ONE.findall(keys)))


def _values(text: str) -> Iterator[tuple[str, int, int]]:
    """Paths of headers and keys, where they begin, and where the next one does."""
    found: list[tuple[str, int]] = []
    table = ""
    place = depth = 0
    quotes = ""  # of a text over several lines that is open
    for line in text.splitlines(keepends=True):
        header, key = _HEADER.match(line), _KEY.match(line)
        if depth == 0 and not quotes and header:
            table = _path(header[1])
            found.append((table, place))
        elif depth == 0 and not quotes and key:
            found.append((f"{table}.{_path(key[1])}".removeprefix("."), place))
        for mark in _MULTILINE.findall(line):
            quotes = "" if mark == quotes else quotes or mark
        bare = re.sub(r'"[^"\n]*"|\'[^\'\n]*\'|#.*', "", line)
        if not (header and depth == 0) and not quotes:
            depth = max(0, depth + sum(map(bare.count, "[{")) - sum(map(bare.count, "]}")))
        place += len(line)
    ends = [begin for _, begin in found[1:]] + [len(text)]
    return ((keys, begin, end) for (keys, begin), end in zip(found, ends, strict=False))
