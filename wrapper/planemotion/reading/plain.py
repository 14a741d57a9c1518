"""Values of a scene given in Python, as TOML would give them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from numbers import Integral, Number, Real
from typing import Any, TypeAlias

import numpy as np

from ..base.bounded import check_table, place_of
from ..base.errors import SceneError
from ..base.toml import parse_toml
from ..language.units import number, parse_quantity

# A key path, told only where something is wrong: a text, or the place above with a key or an index in it.
_Place: TypeAlias = "str | tuple[_Place, object]"


def literal(value: Any) -> Any:
    """A setting given as a text, such as "200", "true" or "[1, 2]", read as TOML reads it; else the text."""
    if not isinstance(value, str):
        return value
    try:
        read = parse_toml(f"value = {value}")
    except SceneError:
        return value
    return read["value"] if set(read) == {"value"} else value


def plain(value: Any, path: str = "") -> Any:
    """A value as TOML has it: quantities of pint become texts, arrays lists, numbers of numpy plain
    ones, tables of pandas lists by column.  Raises SceneError, with the key path, for what TOML has not."""
    check_table(value, path)
    return _plain_value(value, path)


def plain_text(value: Any, path: str) -> str:
    """A text, or a quantity or number as one.  Raises SceneError for what is none."""
    found = plain(value, path)
    if isinstance(found, str | int | float):
        return str(found)
    raise SceneError("a quantity or a name is wanted", path=path, value=value)


def _plain_value(value: Any, place: _Place) -> Any:
    if isinstance(value, str | bool | int | float):
        return value if type(value) in (str, bool, int, float) else _builtin(value)
    if isinstance(value, Mapping):
        return {str(key): _plain_value(one, (place, key)) for key, one in value.items()}
    if isinstance(value, list | tuple | range):
        return [_plain_value(one, (place, index)) for index, one in enumerate(value)]
    if hasattr(value, "columns") and hasattr(value, "to_dict"):  # a table of pandas
        return _plain_value(value.to_dict("list"), place)
    if hasattr(value, "dimensionality"):
        return _plain_quantity(value, place)
    if isinstance(value, Number):
        return _plain_number(value, place)
    if hasattr(value, "tolist"):
        return _plain_value(value.tolist(), place)
    raise _refused(value, place)


def _plain_quantity(value: Any, place: _Place) -> Any:
    if np.ndim(value.magnitude):
        return [_plain_value(one, (place, index)) for index, one in enumerate(value)]
    try:
        quantity = parse_quantity(value)
    except SceneError as error:
        raise error.at(path=_path_of(place)) from None
    return f"{quantity.value!r} {quantity.unit_text}".strip()


def _plain_number(value: Number, place: _Place) -> int | float:
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return number(value)
    raise _refused(value, place)


def _refused(value: Any, place: _Place) -> SceneError:
    path = _path_of(place)
    if value is None:
        return SceneError("None is no value; leave it out for what is taken without it", path=path)
    kind = type(value).__name__
    return SceneError(f"a scene has no values of type {kind}", path=path, value=value)


def _path_of(place: _Place) -> str | None:
    """The key path; None at the top."""
    keys = []
    while isinstance(place, tuple):
        place, key = place
        keys.append(key)
    return reduce(place_of, reversed(keys), place) or None


def _builtin(value: str | int | float) -> str | int | float:
    """The plain value of a subclass, such as a float of numpy."""
    for plain in (str, int, float):
        if isinstance(value, plain):
            return plain(value)
    return value
