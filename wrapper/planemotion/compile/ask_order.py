"""Which asks read the answers of others, and the order in which they can be answered."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from ..base.errors import SceneError
from ..language.leaves import names
from ..language.tree import Name, Node
from ..model.tables import Ask, At
from ..model.words import ASK_WORDS


def in_order(
    asks: Mapping[str, Ask],
    all_asks: Mapping[str, Ask],
    knows: Callable[[str], bool],
    read: Callable[[str, str], Node],
) -> list[str]:
    """The keys of `asks`, each after those that it reads.

    `all_asks`: those of other runs, too; `knows`: whether a name stands for something else, which goes first.
    `read`: the expression of a text and its key path.  Raises SceneError where an ask reads what it cannot.
    """
    found = {key: _read_by(key, asks, all_asks, knows, read) for key in asks}
    order: dict[str, None] = {}
    for key in asks:
        _place(key, found, order, ())
    return list(order)


def _read_by(
    key: str,
    asks: Mapping[str, Ask],
    all_asks: Mapping[str, Ask],
    knows: Callable[[str], bool],
    read: Callable[[str, str], Node],
) -> list[str]:
    """The asks that one ask reads."""
    found = []
    for written, where in _expressions(asks[key], f"ask.{key}"):
        for leaf in names(read(written, where)):
            if not isinstance(leaf, Name) or leaf.text not in all_asks or knows(leaf.text):
                continue
            reason = _refusal(asks[key], leaf.text, asks)
            if reason:
                raise SceneError(reason, path=where, value=written)
            found.append(leaf.text)
    return found


def _expressions(ask: Ask, path: str) -> Iterator[tuple[str, str]]:
    """What is written in an ask, and where."""
    for word in (*ASK_WORDS, "during"):
        written = getattr(ask, word)
        if isinstance(written, str):
            yield written, path if word == "of" else f"{path}.{word}"
    if isinstance(ask.at, At):
        for word in ("max", "min", "each"):
            written = getattr(ask.at, word)
            if isinstance(written, str):
                yield written, f"{path}.at.{word}"


def _refusal(ask: Ask, name: str, asks: Mapping[str, Ask]) -> str | None:
    """Why an ask cannot read another; None if it can."""
    if ask.of is None or not (ask.at is None or ask.at == "end"):
        said = f'"{name}" is an ask, whose answer is there at the end; only an ask at the end reads others'
        return f"{said}: write its expression in its place"
    if name not in asks:
        return f'"{name}" is an ask of another run'
    if asks[name].events is not None:
        return f'"{name}" is a word of events, no number; an expression reads EVENT.count'
    at = asks[name].at
    if (isinstance(at, At) and at.each is not None) or (isinstance(at, str) and at.startswith("each ")):
        return f'"{name}" is a list; an expression reads asks that are one number'
    return None


def _place(key: str, read: Mapping[str, list[str]], order: dict[str, None], reading: tuple[str, ...]) -> None:
    """Adds an ask behind those that it reads; `reading`: those that wait for it."""
    if key in reading:
        circle = " reads ".join((*reading[reading.index(key) :], key))
        raise SceneError(f"it reads itself: {circle}", path=f"ask.{key}")
    for other in read[key]:
        _place(other, read, order, (*reading, key))
    order.setdefault(key)
