"""Asks that read the answers of others: their values, their errors, and what they may not read."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planemotion import RunResult, SceneError, load_text
from tests.scenes import ROUTES, G, number

BALL = """
parameters.e = 0.5
bodies.ball = {{ mass = "1 kg", at = [0, "1 m"] }}
ground.lines.floor = {{ through = [0, 0] }}
contacts.c = {{ touch = ["ball", "ground.floor"], restitution = "e", friction = 0 }}
events.strike = "c strikes"
until = "strike 3"
[ask]
{asks}
t1 = {{ of = "t", at = "strike" }}
t3 = {{ of = "t", at = "strike 3" }}
t5 = {{ of = "t", at = "strike 5" }}
times = {{ of = "t", at = "each strike" }}
"""


def run(asks: str, **settings: Any) -> RunResult:
    return load_text(BALL.format(asks=asks)).run(**settings)


@pytest.mark.parametrize("route", ROUTES)
def test_values_and_errors(route: str) -> None:
    result = run(
        """
        T = "t3 - t1"
        ratio = { of = "T/t1", unit = "1" }
        nothing = "t3 - t1 - T"
        since = "t - t1"
        mixed = "ball.velocity.y*T"
        """,
        **{"solve.route": route},
    )
    fall = math.sqrt(2 / G)
    assert list(result.asks)[:5] == ["T", "ratio", "nothing", "since", "mixed"]  # as they are written
    expected = {
        "T": 1.5 * fall,
        "ratio": 1.5,
        "nothing": 0,
        "since": 1.5 * fall,
        "mixed": 0.125 * G * fall * 1.5 * fall,
    }
    for key, true in expected.items():
        answer = result.asks[key]
        assert answer.value == pytest.approx(true, abs=1e-9)
        assert abs(number(answer.value) - true) <= number(answer.error) <= 1e-7
    assert number(result.asks["nothing"].error) > 0  # where they cancel the rounding of what cancels is left


def test_what_is_not_reached_leaves_the_rest_open() -> None:
    result = run('wait = "t5 - t1"\ntwice = "2*wait"')
    assert result["wait"] is None
    assert result.asks["twice"].reason == result.asks["t5"].reason == "not reached"


def test_the_errors_of_a_path_are_handed_on() -> None:
    result = load_text(
        """
        bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "2 kg", at = { A = [0, 0] } }
        joints.pin = { pin = ["rod.A", "ground"] }
        until = "rod.omega = 0 rad/s"
        events.low = "rod.angle = -90 deg"
        [ask]
        half = "t"
        quarter = { of = "t", at = "low" }
        off = "half/2 - quarter"
        """
    ).run()
    assert result.route == ("path",)
    off = result.asks["off"]
    assert abs(number(off.value)) <= number(off.error) <= 1e-11


def test_a_find_reads_them() -> None:
    text = BALL.format(asks='T = "t3 - t1"') + '[find]\nvary = { e = [0.1, 0.9] }\nwhere = "T = 2*t1"\n'
    result = load_text(text).run()
    e = (math.sqrt(5) - 1) / 2  # 2 e + 2 e^2 = 2
    assert result.found["e"].value == pytest.approx(e, rel=1e-9)


@pytest.mark.parametrize(
    ("asks", "told"),
    [
        ('a = "b"\nb = "a"', "ask.a: it reads itself: a reads b reads a"),
        ('a = "2*a"', "ask.a: it reads itself: a reads a"),
        ('a = { max = "t1" }', 'ask.a.max = "t1": "t1" is an ask, whose answer is there at the end'),
        ('a = { of = "t1", at = "strike" }', '"t1" is an ask, whose answer is there at the end'),
        ('a = { mean = "ball.y", during = "t > t1" }', '"t1" is an ask, whose answer is there at the end'),
        ('a = "times"', '"times" is a list'),
        ('a = { of = "t1 - t3", unit = "m" }', "the answer is a time"),
        ('a = "t1 + ball.y"', "a length"),
    ],
)
def test_messages(asks: str, told: str) -> None:
    with pytest.raises(SceneError) as caught:
        run(asks)
    assert told in str(caught.value)


def test_a_parameter_of_that_name_goes_first() -> None:
    result = load_text(
        """
        parameters.T = "3 s"
        bodies.ball = { mass = "1 kg", at = [0, 0] }
        until = "t = 1 s"
        ask.T = "t"
        ask.twice = "2*T"
        """
    ).run()
    assert result["twice"] == 6
