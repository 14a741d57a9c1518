"""Addresses: the one way to name what can be read off a scene.

    THING[.POINT].QUANTITY[.PART] [in BODY] [on BODY] [about POINT] [along ANGLE or LINE]

"AB.B.x in DE", "A.force.y on AB", "bars[3].normal", "energy.kinetic", "angular_momentum about P", "t".  Here
an address is only read; what its words mean is decided by the scene that it is used in.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

from ..base.errors import SceneError
from .names import PLAIN_NAMES, Names
from .tree import Node
from .units import NUMBER, UNIT

# Words that join expressions or the pieces of an address, and so name nothing.
KEYWORDS = frozenset({"and", "or", "not", "in", "on", "about", "along"})

_NAME = r"[^\W\d]\w*"
# At most nine digits: what an index of the kernel can hold.
_INDEX = r"(?:\[-?\d{1,9}(?:,-?\d{1,9})*\])?"
DOTTED = rf"{_NAME}{_INDEX}(?:\.{_NAME}{_INDEX})*"


def is_energy(address: str) -> bool:
    """Whether an address names an energy or a work: given in J, where a couple is in N*m."""
    words = address.split(" ")[0].split(".")
    return "energy" in words or words[-1] in ("kinetic_energy", "work")


@dataclass(frozen=True)
class Address(Node):
    """`THING.PATH[0].PATH[1]... in .. on .. about .. along ..`, words as written.

    `member` is the index in brackets ("bars[3].normal", "belt.tension[2]"), `member_after` says which word
    it follows: 0 the thing, 1 the first word of `path`.  `along` is the text of an angle or the name of a
    line, to be parsed as an expression by whoever resolves the address.
    """

    thing: str
    path: tuple[str, ...] = ()
    member: int | None = None
    in_: str | None = None
    on: str | None = None
    about: str | None = None
    along: str | None = None
    member_after: int = 0

    def __str__(self) -> str:
        words = [self.thing, *self.path]
        if self.member is not None:
            words[self.member_after] += f"[{self.member}]"
        along = self.along
        if along is not None and not _PLAIN_ALONG.fullmatch(along):
            along = f"({along})"
        pieces = (("in", self.in_), ("on", self.on), ("about", self.about), ("along", along))
        return " ".join([".".join(words), *(f"{key} {text}" for key, text in pieces if text is not None)])


@cache
def _compiled(pattern: str) -> re.Pattern[str]:
    """The patterns are few, and each is used for every word of a scene."""
    return re.compile(pattern)


class Scanner:
    """A place in a text that is read from left to right; addresses and expressions share it."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0
        self.take(r"")

    def peek(self, pattern: str) -> str | None:
        """What `pattern` matches here, without taking it."""
        match = _compiled(pattern).match(self.text, self.position)
        return match[0] if match else None

    def take(self, pattern: str) -> str | None:
        """What `pattern` matches here, taken together with the space behind it; None if it does not match."""
        found = self.peek(pattern)
        if found is not None:
            self.position += len(found)
            self.position += len(self.peek(r"\s*") or "")
        return found

    def take_word(self) -> str | None:
        """A dotted name, if there is one here that is no keyword."""
        word = self.peek(DOTTED)
        return None if word is None or word in KEYWORDS else self.take(DOTTED)

    def take_keyword(self, *keywords: str) -> str | None:
        """One of the keywords, if it is next."""
        return self.take(rf"(?:{'|'.join(keywords)})\b")

    def at_end(self) -> bool:
        return self.position == len(self.text)

    def unexpected(self, wanted: str) -> SceneError:
        """The error that something else than `wanted` stands here."""
        if self.at_end():
            return SceneError(f"it ends where {wanted} is wanted", value=self.text)
        found = self.peek(rf"{DOTTED}|{NUMBER}|\S")
        reason = f'{wanted} is wanted, not "{found}" (character {self.position + 1})'
        if re.search(r"\d$", self.text[: self.position]) and self.peek(r",\d"):
            reason += "; a number has a decimal point, no comma"
        return SceneError(reason, value=self.text)


def parse_address(text: str, names: Names = PLAIN_NAMES) -> Address:
    """The address written in `text`; `names` are those that are no plain words.

    Raises SceneError, saying where it is not one."""
    scanner = Scanner(text)
    word = scanner.take_word()
    if word is None:
        raise scanner.unexpected("a name")
    address = read_address(scanner, word, names)
    if not scanner.at_end():
        raise scanner.unexpected("in, on, about, along or the end")
    return address


def read_address(scanner: Scanner, word: str, names: Names = PLAIN_NAMES) -> Address:
    """The address that begins with the dotted `word` just taken, with the in, on, about, along behind it."""
    words, member, member_after = _split(word, scanner, names)
    given: dict[str, str] = {}
    while keyword := scanner.take_keyword("in", "on", "about", "along"):
        if keyword in given:
            raise SceneError(f'"{keyword}" is said twice', value=scanner.text)
        given[keyword] = (
            _read_along(scanner) if keyword == "along" else _read_partner(scanner, keyword, names)
        )
    return Address(
        thing=words[0],
        path=tuple(words[1:]),
        member=member,
        in_=given.get("in"),
        on=given.get("on"),
        about=given.get("about"),
        along=given.get("along"),
        member_after=member_after,
    )


def _split(word: str, scanner: Scanner, names: Names) -> tuple[list[str], int | None, int]:
    """The words of a dotted name, the index in brackets and the number of the word that it follows."""
    words: list[str] = []
    member, member_after = None, 0
    for piece in names.split(word):
        name, bracket, index = (piece, "", "") if piece in names else piece.partition("[")
        if bracket:
            if member is not None or "," in index:
                raise SceneError(f'"{word}" has two indices; one is possible', value=scanner.text)
            member, member_after = int(index.rstrip("]")), len(words)
        words.append(name)
    return words, member, member_after


def _read_partner(scanner: Scanner, keyword: str, names: Names) -> str:
    """The dotted name behind in, on or about."""
    word = scanner.take_word()
    if word is None:
        raise scanner.unexpected(f'a {"point" if keyword == "about" else "body"} after "{keyword}"')
    if any("[" in piece and piece not in names for piece in names.split(word)):
        raise SceneError(f'"{word}" has an index; "{keyword}" takes a plain name', value=scanner.text)
    return word


_ANGLE = rf"-?\s*{NUMBER}(?:\s*(?!(?:{'|'.join(sorted(KEYWORDS))})\b){UNIT})?"
_PLAIN_ALONG = re.compile(rf"{_ANGLE}|{DOTTED}")


def _read_along(scanner: Scanner) -> str:
    """The text of the direction behind along: an angle, a name, or an expression in parentheses."""
    angle = scanner.take(_ANGLE)
    if angle is not None:
        return angle
    word = scanner.take_word()
    if word is not None:
        return word
    if scanner.peek(r"\("):
        return _read_parentheses(scanner)
    raise scanner.unexpected('an angle or a line after "along"')


def _read_parentheses(scanner: Scanner) -> str:
    """What stands between the parenthesis here and the one that closes it."""
    first = scanner.position + 1
    depth = 0
    for position in range(scanner.position, len(scanner.text)):
        depth += {"(": 1, ")": -1}.get(scanner.text[position], 0)
        if depth == 0:
            scanner.position = position
            scanner.take(r"\)")
            return scanner.text[first:position].strip()
    raise SceneError('the parenthesis after "along" is not closed', value=scanner.text)
