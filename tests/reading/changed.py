"""A scene that is right, changed by a line, and what is said of it."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from planemotion import SceneError
from planemotion.compile.flatten import flatten
from planemotion.scene import Scene

BASE = """
until = "t = 1 s"
parameters = { L = "1 m", m = "2 kg" }
ground = { points = { O = [0, 0] }, lines = { floor = { through = [0, 0] } } }
[bodies]
AB = { rod = ["A", "B"], length = "L", mass = "m", at = { A = [0, 0] }, angle = "0 deg" }
disk = { disk = "0.1 m", mass = "1 kg", at = [0, "0.1 m"] }
P = { mass = "1 kg", at = ["1 m", "2 m"] }
"""


def merged(change: str) -> dict[str, Any]:
    """The base scene with the change put over it."""

    def merge(table: dict[str, Any], other: dict[str, Any]) -> None:
        for key, value in other.items():
            if isinstance(value, dict) and isinstance(table.get(key), dict):
                merge(table[key], value)
            else:
                table[key] = value

    raw = tomllib.loads(BASE)
    merge(raw, tomllib.loads(change))
    return raw


def message(change: str) -> str:
    with pytest.raises(SceneError) as caught:
        flatten(Scene.from_table(merged(change), file="x.toml"))
    assert caught.value.file == "x.toml"
    return str(caught.value)


def assert_told(change: str, expected: str) -> None:
    """The message names the file first, and has what is expected."""
    text = message(change)
    assert text.startswith("x.toml: ")
    assert expected in text
