"""A scene that was drawn, with its truth, and what becomes of it on a route."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import planemotion
from planemotion.engine.result import AskValue
from tests.stress.misses.verdict import BEYOND, BEYOND_BY, MISS, MISSED, NOT_JUDGED, RIGHT, TOLD, Errors

FAILED = "failed"  # no scene of a kind has a reason to
UNDECIDED = "undecided"  # by its status, where nothing is on an edge
ROUNDING = 1e-13  # of the size of an answer: what doubles may take from scene and truth
Value = float | list[float]


@dataclass(frozen=True)
class Drawn:
    """A scene without its `[solve]`; `truth`: by ask, a list where there are many; counts are int.

    size: of an answer, where that is more than its value, of which doubles keep a part; edge: its counts lie
    within rounding of others.
    """

    text: str
    truth: Mapping[str, Value]
    size: Mapping[str, float] = field(default_factory=dict)
    edge: bool = False


Kind = Callable[[random.Random], Drawn]


@dataclass(frozen=True)
class Judged:
    word: str
    errors: Errors
    detail: str


def judged(drawn: Drawn, route: str, accuracy: float) -> Judged:
    """What becomes of it, and of which ask the word is."""
    none = Errors(np.zeros(0), np.zeros(0))
    solve = f'\n[solve]\nroute = "{route}"\naccuracy = {accuracy!r}\n'
    try:
        result = planemotion.load_text(drawn.text + solve).run()
    except planemotion.SimulationError as error:
        return Judged(FAILED, none, str(error).splitlines()[0])
    if result.status != "ok":
        word = UNDECIDED if result.status == "undecided" and not drawn.edge else TOLD
        return Judged(word, none, result.status)
    without = [name for name in drawn.truth if _is_missing(result.asks[name].value)]
    if without:
        word = NOT_JUDGED if drawn.edge else MISSED
        return Judged(word, none, f"{without[0]} has no value, true is {drawn.truth[without[0]]}")
    if any(ask.error is None for ask in result.asks.values()):
        return Judged(TOLD, none, "errors that nobody knows")
    words, true, told = [(RIGHT, "")], [], []
    for name, truth in drawn.truth.items():
        ask = result.asks[name]
        word, off, errors = _beside(ask, truth, drawn.size.get(name, 0.0))
        words.append((word, f"{name}: {ask.value} +- {ask.error}, true is {truth}"))
        true += off
        told += errors
    word, detail = max(words, key=lambda one: (RIGHT, BEYOND, MISSED).index(one[0]))
    if drawn.edge and word != RIGHT:
        return Judged(NOT_JUDGED, none, detail)
    return Judged(word, Errors(np.array(true), np.array(told)), detail)


def _beside(ask: AskValue, truth: Value, size: float) -> tuple[str, list[float], list[float]]:
    """The word for one ask, its true errors and those told; a count has none that is told."""
    found, true = _listed(ask.value), [*truth] if isinstance(truth, list) else [truth]
    if len(found) != len(true):
        return MISSED, [], []
    if isinstance(truth, int):
        return (RIGHT if found == true else MISSED), [], []
    told = _listed(ask.error) if isinstance(ask.error, list) else _listed(ask.error) * len(true)
    off = [abs(one - other) for one, other in zip(found, true, strict=True)]
    sizes = [max(size, abs(one)) for one in true]
    word = RIGHT
    for one, error, most in zip(off, told, sizes, strict=True):
        if not one <= BEYOND_BY * error + ROUNDING * most:
            word = MISSED if word == MISSED or not one <= MISS * most else BEYOND
    least = [max(one, np.finfo(float).eps * most) for one, most in zip(off, sizes, strict=True)]
    return word, least, told


def _is_missing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _listed(value: Any) -> list[float]:
    return [
        math.nan if one is None else float(one) for one in (value if isinstance(value, list) else [value])
    ]
