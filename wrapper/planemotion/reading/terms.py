"""The names in a text of a scene, found without knowing what the text says: "link[i-1].B", "ground.O".

Words behind a number are its unit, as expressions have it; all other words begin a dotted name.  In brackets
stand whole numbers, given by expressions of indices and parameters.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache

from ..base.errors import SceneError
from ..language.address import KEYWORDS
from ..language.leaves import Leaf, evaluate
from ..language.parser import parse
from ..language.units import NUMBER, UNIT

# Not behind a word or its dot; behind the two dots of a range it is free.
_FREE = r"(?<!\w)(?<!(?<!\.)\.)"
# In brackets a name may have brackets of its own.
_IN_BRACKETS = r"\[(?:[^\[\]]|\[[^\[\]]*\])*\]"
_WORD = rf"[^\W\d]\w*(?:{_IN_BRACKETS})?"
_TOKEN = re.compile(
    rf"(?P<number>{_FREE}{NUMBER}(?:\s*(?!(?:and|or|not)\b){UNIT})?)|(?P<chain>{_FREE}{_WORD}(?:\.{_WORD})*)"
)
_BRACKETS = re.compile(_IN_BRACKETS)
# How far a number in brackets may be from a whole one, by rounding.
_WHOLE = 1e-9
_MOST_INDEX = 999_999_999
# A value of an index or a parameter by name; None: it has none here.
Value = Callable[[str], "float | None"]


@lru_cache(maxsize=4096)
def _pieces(text: str) -> tuple[tuple[str, bool], ...]:
    """The text in pieces, each with whether it is a dotted name."""
    pieces, place = [], 0
    for found in _TOKEN.finditer(text):
        if found["chain"] is not None and found["chain"] not in KEYWORDS:
            pieces += [(text[place : found.start()], False), (found["chain"], True)]
            place = found.end()
    return (*pieces, (text[place:], False))


def renamed(text: str, rename: Callable[[str], str]) -> str:
    """The text with every dotted name, also within brackets, as `rename` has it."""

    def one(chain: str) -> str:
        return rename(_BRACKETS.sub(lambda found: f"[{renamed(found[0][1:-1], rename)}]", chain))

    return "".join(one(piece) if is_name else piece for piece, is_name in _pieces(text))


def filled(text: str, indices: dict[str, int], value: Value) -> str:
    """The text with the numbers of indices, and of what stands in brackets."""
    if not indices and "[" not in text:
        return text

    def one(chain: str) -> str:
        if chain in indices:
            return str(indices[chain]) if chain == text else f"({indices[chain]})"
        return _BRACKETS.sub(
            lambda found: f"[{_index(filled(found[0][1:-1], indices, value), chain, value)}]", chain
        )

    return "".join(one(piece) if is_name else piece for piece, is_name in _pieces(text))


def _index(text: str, chain: str, value: Value) -> str:
    """What stands in brackets, as whole numbers."""
    if text.lstrip("-").isdecimal():
        return text
    return ",".join(str(whole(part, value, f"the index in {chain}")) for part in text.split(","))


def whole(text: str, value: Value, what: str) -> int:
    """The whole number that an expression is.  Raises SceneError, calling it `what`."""

    def leaf(one: Leaf) -> float:
        number = value(str(one))
        if number is None:
            reason = f'{what}: "{one}" is neither an index nor a parameter; for = "{one} in 1..n" makes one'
            raise SceneError(reason)
        return number

    found = evaluate(parse(text), leaf)
    if not abs(found) <= _MOST_INDEX or abs(found - round(found)) > _WHOLE:
        raise SceneError(f"{what}: {text} is {found:.6g}; a whole number is wanted")
    return round(found)
