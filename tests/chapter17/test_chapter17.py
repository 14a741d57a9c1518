"""Every scene of the chapter against reference figures derived elsewhere (reference.py)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import planemotion
from planemotion.engine.result import RunResult
from tests.chapter17.chapter import REFERENCE, SCENES

RELATIVE = 1e-8


def as_list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def scales(asks: dict[str, Any]) -> dict[str, float]:
    """For each unit the greatest figure: what an error is compared with where the figure itself is 0."""
    greatest: dict[str, float] = {}
    for ask in asks.values():
        for value in as_list(ask.get("value", 0)):
            greatest[ask["unit"]] = max(greatest.get(ask["unit"], 0), abs(value))
    return {unit: value or 1 for unit, value in greatest.items()}


def compare(result: RunResult, asks: dict[str, Any]) -> list[str]:
    """What is wrong with the answers."""
    faults = []
    for key, ask in asks.items():
        answer, expected = as_list(result.asks[key].value), as_list(ask["value"])
        if len(answer) != len(expected) or None in answer:
            faults.append(f"{key}: {answer}, wanted {expected}")
            continue
        for got, wanted in zip(answer, expected, strict=True):
            error = abs(got - wanted) / (abs(wanted) or scales(asks)[ask["unit"]])
            if not error <= RELATIVE:
                faults.append(f"{key}: {got!r}, wanted {wanted!r}, off by {error:.1e}")
    return faults


@pytest.mark.reference
@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_scene_gives_the_reference_figures(path: Path) -> None:
    scene = planemotion.load(path)
    result = scene.run()
    asks = dict(REFERENCE[result.id])
    instances = asks.pop("instances", [])
    assert {key: answer.unit for key, answer in result.asks.items()} == {
        key: ask["unit"] for key, ask in asks.items()
    }
    assert result.status == "ok", result.error
    assert compare(result, {key: ask for key, ask in asks.items() if "value" in ask}) == []
    for number, parameters in enumerate(instances):
        other = scene.run(**parameters)
        assert other.status == "ok", other.error
        assert None not in [value for answer in other.asks.values() for value in as_list(answer.value)]
        if number == 0:  # the parameters as written
            assert other.asks == result.asks
