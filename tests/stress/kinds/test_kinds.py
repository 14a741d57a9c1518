"""A quick part of `python -m tests.stress.kinds`."""

from __future__ import annotations

from collections import Counter

import pytest

from tests.stress.kinds.__main__ import KINDS, draw
from tests.stress.kinds.drawn import FAILED, judged
from tests.stress.misses.verdict import BEYOND, MISSED, NOT_JUDGED, RIGHT


@pytest.mark.parametrize("kind", KINDS)
def test_scenes_of_a_kind_are_right(kind: str) -> None:
    found: Counter[str] = Counter()
    for number in range(30):
        _, route, accuracy, drawn = draw(number, kind)
        what = judged(drawn, route, accuracy)
        found[what.word] += 1
        assert what.word not in (BEYOND, MISSED, FAILED), (number, what.detail)
    assert found[RIGHT] + found[NOT_JUDGED] >= 26
