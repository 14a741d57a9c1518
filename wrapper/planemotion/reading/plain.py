"""Values of a scene given in Python, as TOML would give them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..base.bounded import check_table
from ..base.errors import SceneError
from ..base.toml import parse_toml
from ..language.units import parse_quantity


def literal(value: Any) -> Any:
    """A setting given as a text, such as "200", "true" or "[1, 2]", read as TOML reads it; else the text."""
    if not isinstance(value, str):
        return value
    try:
        read = parse_toml(f"value = {value}")
    except SceneError:
        return value
    return read["value"] if set(read) == {"value"} else value


def plain(value: Any) -> Any:
    """A value as TOML has it: quantities of pint become texts, arrays lists, numbers of numpy plain
    ones, tables of pandas lists by column."""
    check_table(value)
    return _plain_value(value)


def plain_text(value: Any) -> str:
    """A text, or a quantity or number as one.  Raises SceneError for what is none."""
    found = plain(value)
    if isinstance(found, str | int | float):
        return str(found)
    raise SceneError(f"a quantity or a name is wanted, not a {type(value).__name__}")


def _plain_value(value: Any) -> Any:
    if isinstance(value, str | bool | int | float):
        return value if type(value) in (str, bool, int, float) else _builtin(value)
    if isinstance(value, Mapping):
        return {str(key): _plain_value(one) for key, one in value.items()}
    if isinstance(value, list | tuple | range):
        return [_plain_value(one) for one in value]
    if hasattr(value, "columns") and hasattr(value, "to_dict"):  # a table of pandas
        return _plain_value(value.to_dict("list"))
    if hasattr(value, "dimensionality"):
        if np.ndim(value.magnitude):
            return [_plain_value(one) for one in value]
        quantity = parse_quantity(value)
        return f"{quantity.value!r} {quantity.unit_text}".strip()
    if hasattr(value, "tolist"):
        return _plain_value(value.tolist())
    raise SceneError(f"a scene has no values of type {type(value).__name__}")


def _builtin(value: str | int | float) -> str | int | float:
    """The plain value of a subclass, such as a float of numpy."""
    for plain in (str, int, float):
        if isinstance(value, plain):
            return plain(value)
    return value
