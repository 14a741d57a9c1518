"""A quick part of `make stress`: some hundred changed scenes, each of which is answered or told."""

from __future__ import annotations

import os
import random
import time
from typing import NoReturn

import pytest

import planemotion.file as reader
from tests.stress import fuzz as harness
from tests.stress.fuzz import Table, fuzz, outcome
from tests.stress.mutate import mutated

SCENES = 300


def test_no_changed_scene_falls_hangs_or_answers_what_is_no_number() -> None:
    table = Table()
    for ended in fuzz(range(SCENES), len(os.sched_getaffinity(0))):
        table.add(*ended)
    assert table.wrong == []
    assert table.outcomes.total() == SCENES
    # Neither is everything refused, nor everything let through.
    assert min(table.outcomes["ok"], table.outcomes["told"]) > SCENES / 20


def _divide(text: str, file: str | None = None) -> NoReturn:
    raise ZeroDivisionError


def _fall(text: str, file: str | None = None) -> NoReturn:
    os._exit(3)


def test_what_must_not_be_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The harness itself: faults that are planted are outcomes of their own."""
    assert outcome("until")[0] == "told"
    monkeypatch.setattr(reader, "parse_toml", _divide)
    assert outcome("")[0] == "traceback"
    monkeypatch.setattr(reader, "parse_toml", _fall)
    assert [(word, detail) for _, word, detail, _ in fuzz([1], 1)] == [("crash", "exit status 3")]
    monkeypatch.setattr(reader, "parse_toml", lambda text, file=None: time.sleep(100))
    monkeypatch.setattr(harness, "HANG", 0.5)
    assert [word for _, word, _, _ in fuzz([1, 2], 1)] == ["hang", "hang"]


def test_a_number_is_always_the_same_scene() -> None:
    text = 'until = "t = 1 s"\nbodies.P = { mass = "1 kg", at = [0, 0] }\n'
    assert len({mutated(text, random.Random(7)) for _ in range(3)}) == 1
    assert len({mutated(text, random.Random(number)) for number in range(50)}) > 40
