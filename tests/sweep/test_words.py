"""Which events happened, in which order: beside the formulas of a ball that bounces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import planemotion
from planemotion import SceneError, load_text
from planemotion.compile.asks import longest_word
from planemotion.engine.words import spelled
from planemotion.run import simulate
from tests.scenes import G

BALL = """
id = "ball"
until = "blow 4"
parameters = {{ h = "1 m", e = 0.8, c = "0.6 m" }}
ground.lines.floor = {{ through = [0, 0] }}
bodies.ball = {{ sphere = "30 mm", mass = "0.1 kg", at = [0, "h + (30 mm)"] }}
contacts.floor = {{ touch = ["ball.rim", "ground.floor"], restitution = "e" }}
events.blow = "floor strikes"
events.top = "ball.velocity.y < 0"
events.high = "ball.y > c + (30 mm)"
ask.word = {{ events = {events} }}
{more}
"""
ALL = '["blow", "top", "high"]'


def ball(events: str = ALL, more: str = "") -> planemotion.Scene:
    return load_text(BALL.format(events=events, more=more))


def expected(e: float, c: float, blows: int = 4) -> str:
    """The ball is let go at 1 m; each rebound has e^2 of the height of the one before."""
    word = ["blow"]
    for k in range(1, blows):
        word += [*(["high"] if e ** (2 * k) > c else []), "top", "blow"]
    return " ".join(word)


@pytest.mark.parametrize("route", ["auto", "rk"])
def test_words_of_a_bouncing_ball(route: str) -> None:
    values = np.random.default_rng(7).uniform(0.1, 0.95, (2, 14))
    scene = ball().solve(route=route)
    result = scene.sweep(e=values[0].tolist(), c=[f"{value!r} m" for value in values[1].tolist()])
    assert (result["status"] == 0).all()
    wanted = [[expected(e, c) for c in values[1].tolist()] for e in values[0].tolist()]
    assert planemotion.words(result["word"]).values.tolist() == wanted


def test_blows_that_a_run_waits_for_are_in_its_word() -> None:
    """Though the rest of their series is taken at once."""
    answer = simulate(ball().solve(route="rk").with_values({"e": 0.05})).asks["word"]
    assert answer.value == expected(0.05, 0.6)
    assert answer.reason == ""


def test_of_a_series_that_is_taken_at_once_there_is_the_beginning() -> None:
    """Blows that shrink to nothing are counted no more: the word says that it is not whole."""
    text = BALL.format(events=ALL, more="").replace('until = "blow 4"', 'until = "t = 2 s"')
    answer = simulate(load_text(text).solve(route="rk").with_values({"e": 0.05})).asks["word"]
    assert str(answer.value).startswith("blow top blow top blow")
    assert "more events" in answer.reason


def test_a_word_has_only_the_events_that_are_asked_for() -> None:
    assert ball('["top"]').run()["word"] == "top*3"
    assert ball('["high", "top"]').run()["word"] == "high top*3"


def test_what_fires_at_one_instant_has_the_order_of_the_ask() -> None:
    twice = 'events.again = "floor strikes"'
    assert ball('["blow", "again"]', twice).run()["word"] == " ".join(["blow again"] * 4)
    assert ball('["again", "blow"]', twice).run()["word"] == " ".join(["again blow"] * 4)


def test_nothing_happened_is_a_word() -> None:
    assert ball('["high"]').run(c="3 m")["word"] == ""


def test_a_word_that_is_too_long_keeps_its_beginning() -> None:
    scene = ball('["blow", "top"]')
    scene.until("blow 60")
    answer = simulate(scene.solve(max_events=100_000)).asks["word"]
    assert longest_word(2) == 33
    assert answer.value == " ".join(["blow", *["top blow"] * 16])
    assert "33" in answer.reason
    dataset = scene.sweep(e=[0.9])
    assert planemotion.words(dataset["word"]).values.tolist() == [answer.value]
    assert dataset["reason"].values.tolist() == [[6]]


def test_a_run_that_ends_early_has_the_word_so_far() -> None:
    result = simulate(ball().solve(max_time="1 s"))
    assert result.status == "limit_time"
    assert G * 0.9**2 > 2  # one fall of 1 m, and some of the first rebound
    assert result["word"] == "blow high top"


def test_a_case_that_fails_has_no_word(tmp_path: Path) -> None:
    scene = ball()
    dataset = scene.sweep(out=tmp_path, e=[0.5, 2.0])
    assert np.isnan(dataset["word"][1])
    assert planemotion.words(dataset["word"]).values.tolist() == [expected(0.5, 0.6), "failed"]
    dataset.close()
    lines = (tmp_path / "ball.csv").read_text().splitlines()
    column = lines[0].split(",").index("word [1]")
    assert [line.split(",")[column] for line in lines[1:]] == [expected(0.5, 0.6), "failed"]


def test_the_number_of_a_word() -> None:
    """Digits to the base letters + 1: as the docs say."""
    assert ball(ALL).sweep(e=[0.1])["word"].attrs["letters"] == "blow top high"
    assert spelled(0, ("tip", "fall")) == ""
    assert spelled(1, ("tip", "fall")) == "tip"
    assert spelled(5, ("tip", "fall")) == "tip fall"
    assert spelled(1 * 9 + 1 * 3 + 1, ("tip", "fall")) == "tip*3"
    assert longest_word(1) == 53


@pytest.mark.parametrize(
    ("events", "more", "said"),
    [
        ("[]", "", "ask.word.events"),
        ('["blwo"]', "", "ask.word.events[0]"),
        ('["blow", "blow"]', "", "stands there twice"),
        (f'{ALL}, at = "blow"', "", "whole run"),
        (ALL, "n = 'word + 1'", "is a word of events"),
        (f'{ALL}, of = "t"', "", "not of and events"),
    ],
)
def test_faults_are_told(events: str, more: str, said: str) -> None:
    with pytest.raises(SceneError) as raised:
        ball(events, f"ask.{more}" if more else "").tables()
    assert said in str(raised.value)


def test_another_answer_is_no_word() -> None:
    with pytest.raises(ValueError, match="is no answer which events happened"):
        planemotion.words(ball(more='ask.t = "t"').sweep(e=[0.5])["t"])
