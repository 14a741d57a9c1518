"""What a scene says that is right and perhaps not meant: one sentence each, for who runs its file."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from ..model import words

_NAME = re.compile(r"[^\W\d]\w*")
# An angle that is compared with a plain number: "rod.turned = -90".
_ANGLE_IS = re.compile(r"([\w.\[\]]+\.(?:angle|turned) *[=<>]) *\(?([-+]? *\d[\d.]*)\)?")
# A size that is compared with zero: "ball.speed = 0".
_SIZE_IS_ZERO = re.compile(r"([\w.\[\]]+)\.(speed|norm) *={1,2} *\(?0(\.0*)?( *[a-z][\w/*^]*)?\)?")


def advice(raw: Mapping[str, Any], elsewhere: Collection[str] = ()) -> tuple[str, ...]:
    """That of a scene whose words are known; `elsewhere`: parameters that are read otherwise."""
    return (
        *(one for one in _unused(raw) if one.partition(":")[0].removeprefix("parameters.") not in elsewhere),
        *_bare_angles(raw, ""),
        *_bare_turns(raw),
        *_nothing_asked(raw),
        *_touching_zero(raw),
    )


def _unused(raw: Mapping[str, Any]) -> Iterator[str]:
    """Parameters that nothing reads."""
    parameters = words.table(raw, "parameters")
    elsewhere = {key: value for key, value in raw.items() if key not in ("sweep", "runs", "find")}
    read = set(_NAME.findall(" ".join(_texts(elsewhere))))
    conditions = [run.get("find") for run in words.table(raw, "runs").values() if isinstance(run, Mapping)]
    for find in (raw.get("find"), *conditions):
        if isinstance(find, Mapping):
            read |= set(_NAME.findall(" ".join(_texts({**find, "vary": {}}))))
    for name in parameters:
        if name not in read and name not in ("g", "t"):
            yield f"parameters.{name}: nothing in the scene reads it"


def _texts(value: Any) -> Iterator[str]:
    """All texts in a table, but for its keys."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for one in value.values():
            yield from _texts(one)
    elif isinstance(value, list | tuple):
        for one in value:
            yield from _texts(one)


def _bare_angles(value: Any, path: str) -> Iterator[str]:
    """Angles without a unit that are more than a turn: a number alone is in radians."""
    if isinstance(value, Mapping):
        for key, one in value.items():
            below = f"{path}.{key}" if path else str(key)
            if key == "angle" and _is_more_than_a_turn(one):
                bare = str(one).strip()
                yield f'{below} = {bare}: without a unit it is in radians; "{bare} deg" are degrees'
            else:
                yield from _bare_angles(one, below)


def _is_more_than_a_turn(value: Any) -> bool:
    """Whether it is a number without a unit, also as a text, that is more than a turn in radians."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return False
    try:
        return 2 * math.pi < abs(float(str(value).strip().removeprefix("~"))) < math.inf
    except ValueError:
        return False


def _bare_turns(raw: Mapping[str, Any]) -> Iterator[str]:
    """Conditions that wait for an angle whose number has no unit: -90 are radians."""
    for path, written in (("until", raw.get("until")), *_conditions(raw)):
        for condition in _texts(written):
            found = _ANGLE_IS.fullmatch(condition.strip())
            if found and _is_more_than_a_turn(found[2]):
                meant = f"{found[1]} {found[2]} deg"
                yield f'{path} = "{condition}": without a unit it is in radians; "{meant}" are degrees'


def _nothing_asked(raw: Mapping[str, Any]) -> Iterator[str]:
    if not words.table(raw, "ask"):
        yield 'ask: nothing is asked; a line such as omega = "BODY.omega" in [ask] is answered'


def _touching_zero(raw: Mapping[str, Any]) -> Iterator[str]:
    """Conditions that wait for the zero of a size, which may be touched between two looks."""
    for path, condition in (("until", raw.get("until")), *_conditions(raw)):
        found = _SIZE_IS_ZERO.fullmatch(condition.strip()) if isinstance(condition, str) else None
        if found:
            of = f"{found[1]}.velocity.x" if found[2] == "speed" else f"{found[1]}.x"
            yield (
                f'{path} = "{condition}": a size never passes through 0, so that this may not be met; '
                f'name what changes its sign, such as "{of} = 0", or "rest"'
            )


def _conditions(raw: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """The conditions of events by their paths."""
    for name, event in words.table(raw, "events").items():
        yield f"events.{name}", event.get("when") if isinstance(event, Mapping) else event
