"""Lists as long as an event fires: nothing is cut off without a word."""

from __future__ import annotations

import pytest

import planemotion
from planemotion.compile import asks
from tests.scenes import numbers

PASSES = """
plane = "horizontal"
until = "t = 1 s"
[bodies]
a = { mass = "1 kg", at = ["-0.001 m", 0] }
[start]
a.velocity.x = "1 m/s"
[events]
mark = "a.x every 0.005 m"
[ask]
count = "mark.count"
places = { of = "a.x", at = "each mark" }
"""


def test_a_list_is_as_long_as_the_event_fires() -> None:
    run = planemotion.load_text(PASSES).run()
    places = numbers(run.asks["places"].value)
    assert run.asks["count"].value == 200 > asks.EACH_FIRINGS
    assert places == pytest.approx([0.005 * i for i in range(200)], abs=1e-12)
    assert run.asks["places"].reason == ""
    assert len(numbers(run.asks["places"].error)) == 200


def test_a_list_beyond_the_longest_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planemotion.run.MOST_FIRINGS", 100)
    run = planemotion.load_text(PASSES).run()
    places = numbers(run.asks["places"].value)
    assert places == pytest.approx([0.005 * i for i in range(100)], abs=1e-12)
    assert run.asks["places"].reason == "the event fired more often than the list is long, which is 100"


def test_a_sweep_says_that_its_lists_are_cut() -> None:
    swept = planemotion.load_text(PASSES.replace("1 m/s", "v") + '[parameters]\nv = "1 m/s"\n').sweep(
        v=["0.1 m/s", "1 m/s"]
    )
    reason = swept["reason"].sel(ask="places")
    assert [int(one) for one in reason] == [0, 6]
    assert "cut" in reason.attrs["flag_meanings"].split()
