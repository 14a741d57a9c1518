"""Changes of a scene at random: of its structure, of its texts, of its numbers, of its characters."""

from __future__ import annotations

import copy
import pickle
import random
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from planemotion.file import to_toml

Path = tuple[str | int, ...]
# What stands where something else is meant.
_ODD_VALUES: tuple[Any, ...] = (
    *(
        0,
        -1,
        1,
        2**31,
        2**63,
        -(2**31),
        10**400,
        0.0,
        -0.0,
        1e-320,
        1e308,
        -1e308,
        float("inf"),
        float("nan"),
    ),
    *(
        "",
        " ",
        "0",
        "-1",
        "1e400",
        "nan",
        "0 m",
        "1 m",
        "-1 m",
        "1e-300 m",
        "1e300 m",
        "1e-9 s",
        "1e9 s",
        "90 deg",
    ),
    *(
        "1 kg",
        "0 kg",
        "1e30 kg",
        "t",
        "t < 0",
        "1/0",
        "0/0 m",
        "sqrt(-1)",
        "(1 m)^0.5",
        "(" * 80,
        "1" + "+1" * 300,
    ),
    *(
        "end",
        "start",
        "rest",
        "ground",
        "ground.O",
        "A",
        "A.B",
        "x every 1",
        "a.b.c.d",
        "a[0]",
        "a[999999999]",
    ),
    *(
        "before e 2",
        "each e",
        "e 2",
        "e 99999999999",
        "energy.kinetic",
        "momentum about A",
        "\u00e9\u4e2d",
        "\x00",
    ),
    *(
        True,
        False,
        [],
        [0],
        [0, 0],
        ["0 m", "0 m"],
        ["1 m", "2 m", "3 m"],
        {},
        {"a": 1},
        {"polar": ["1 m", "1"]},
    ),
    *({"from": "0 s", "to": "1 s", "step": "1e-9 s"}, {"from": 0, "to": 1, "num": 10**9}, [[[[[[]]]]]]),
)
_UNITS = (
    "m",
    "in",
    "kg",
    "s",
    "N",
    "rad",
    "deg",
    "m/s",
    "rad/s",
    "N*m",
    "N/m",
    "lb",
    "slug",
    "1/s",
    "m^2",
    "furlong",
)
_SIGNS = "abxyzABPOt0123456789.,;:+-*/^=<>()[]{}\"'#_ \n\te\u00e9\u2028\ud7ff"


def mutated(text: str, chosen: random.Random) -> str:
    """The scene with some changes; mostly TOML still."""
    if chosen.random() < 0.15:
        return _characters(text, chosen)
    raw = pickle.loads(_table(text))
    for _ in range(1 + int(chosen.expovariate(1.2))):
        chosen.choices(_CHANGES, _WEIGHTS)[0](raw, chosen)
    try:
        return to_toml(raw)
    except (TypeError, ValueError):
        return _characters(text, chosen)


@cache
def _table(text: str) -> bytes:
    """The table of a text, read once; what is changed is a copy."""
    return pickle.dumps(tomllib.loads(text))


def _places(value: Any, path: Path = ()) -> Iterator[Path]:
    if path:
        yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in items:
        yield from _places(one, (*path, key))


def _at(raw: Any, path: Path) -> Any:
    for key in path:
        raw = raw[key]
    return raw


def _pick(raw: Any, chosen: random.Random, wanted: Callable[[Any], bool] = lambda _: True) -> Path | None:
    found = [path for path in _places(raw) if wanted(_at(raw, path))]
    return chosen.choice(found) if found else None


def _put(raw: Any, path: Path, value: Any) -> None:
    _at(raw, path[:-1])[path[-1]] = value


def _odd(raw: Any, chosen: random.Random) -> None:
    if path := _pick(raw, chosen):
        _put(raw, path, copy.deepcopy(chosen.choice(_ODD_VALUES)))


def _remove(raw: Any, chosen: random.Random) -> None:
    if path := _pick(raw, chosen):
        del _at(raw, path[:-1])[path[-1]]


def _swap(raw: Any, chosen: random.Random) -> None:
    one, other = _pick(raw, chosen), _pick(raw, chosen)
    if one and other and one[: len(other)] != other and other[: len(one)] != one:
        first, second = _at(raw, one), _at(raw, other)
        _put(raw, one, second)
        _put(raw, other, first)


def _copy(raw: Any, chosen: random.Random) -> None:
    one, other = _pick(raw, chosen), _pick(raw, chosen)
    if one and other:
        _put(raw, other, copy.deepcopy(_at(raw, one)))


def _double(raw: Any, chosen: random.Random) -> None:
    """A table's entry once more under another name."""
    path = _pick(raw, chosen, lambda value: isinstance(value, dict) and bool(value))
    if path:
        table = _at(raw, path)
        table[f"{chosen.choice(list(table))}{chosen.randrange(3)}"] = copy.deepcopy(
            chosen.choice(list(table.values()))
        )


def _rename(raw: Any, chosen: random.Random) -> None:
    path = _pick(raw, chosen)
    if path and isinstance(path[-1], str):
        table = _at(raw, path[:-1])
        name = chosen.choice((path[-1] + "x", path[-1].upper(), "start", "active", "find", "rod", "pin", ""))
        table[name] = table.pop(path[-1])


def _number(raw: Any, chosen: random.Random) -> None:
    """Another size, sign or unit."""
    path = _pick(
        raw, chosen, lambda value: isinstance(value, str | int | float) and not isinstance(value, bool)
    )
    if path is None:
        return
    value, factor = (
        _at(raw, path),
        chosen.choice((0, -1, 1e-12, 1e-6, 1e-3, 0.5, 0.999999, 2, 10, 1e3, 1e6, 1e12, 1e150)),
    )
    if not isinstance(value, str):
        _put(raw, path, value * factor if abs(value) < 1e150 else 0)
        return
    number, _, unit = value.partition(" ")
    try:
        unit = chosen.choice(_UNITS) if chosen.random() < 0.2 else unit
        _put(raw, path, f"{float(number) * factor!r} {unit}".strip())
    except ValueError:
        _put(raw, path, f"{factor!r}*({value})" if chosen.random() < 0.7 else _characters(value, chosen))


def _text(raw: Any, chosen: random.Random) -> None:
    if path := _pick(raw, chosen, lambda value: isinstance(value, str)):
        _put(raw, path, _characters(_at(raw, path), chosen))


def _setting(raw: Any, chosen: random.Random) -> None:
    settings = {
        "route": ("auto", "rk", "ida", "path", "uniform", "state", "jump"),
        "accuracy": (1e-3, 1e-6, 1e-13, 1, 0, 1e-15),
        "estimate": (True, False),
        "impacts": ("simultaneous", "sequential"),
        "max_events": (1, 10, 0),
        "max_steps": (1, 100, 0),
        "max_time": ("1 s", "1e-9 s", "0 s", "1e6 s"),
        "assembly_tolerance": (1e-3, 1e-300, 1),
    }
    key = chosen.choice(list(settings))
    solve = raw.setdefault("solve", {})
    if isinstance(solve, dict):
        solve[key] = chosen.choice(settings[key])


def _characters(text: str, chosen: random.Random) -> str:
    """Some characters more, less or others, or a piece cut out or put elsewhere."""
    signs = list(text)
    for _ in range(1 + int(chosen.expovariate(0.5))):
        place = chosen.randrange(len(signs) + 1)
        match chosen.randrange(4):
            case 0:
                signs[place:place] = chosen.choice(_SIGNS)
            case 1:
                signs[place : place + 1] = chosen.choice(_SIGNS)
            case 2:
                del signs[place : place + chosen.choice((1, 1, 1, 5, 50))]
            case _:
                begin = chosen.randrange(len(signs) + 1)
                signs[place:place] = signs[begin : begin + chosen.choice((1, 3, 10, 60))]
    return "".join(signs)


_CHANGES = (_odd, _remove, _swap, _copy, _double, _rename, _number, _text, _setting)
_WEIGHTS = (3, 2, 1, 2, 2, 1, 12, 1, 3)
