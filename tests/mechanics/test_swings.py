"""Periods, frequencies, amplitudes and phases of what swings: beside closed forms."""

from __future__ import annotations

import math

import pytest

import planemotion
from planemotion import SceneError
from tests.scenes import ROUTES, G, answers, within

SPRING = """
until = "t = END s"
plane = "horizontal"
[bodies.b]
mass = "2 kg"
at = ["1.3 m", 0]
[ground]
points.W = [0, 0]
lines.rail = { through = [0, 0], angle = 0 }
[joints.guide]
slider = ["b.G", "ground.rail"]
[forces.k]
spring = ["b", "ground.W"]
stiffness = "50 N/m"
free_length = "1 m"
"""

DRIVE = """
[forces.drive]
force = "b"
value = ["(3 N) * cos((2 rad/s)*t + 0.7)", 0]
"""


def spring(end: float, asks: str, more: str = "") -> str:
    return SPRING.replace("END", repr(end)) + more + "[ask]\n" + asks


@pytest.mark.parametrize("route", ROUTES)
def test_a_mass_on_a_spring(route: str) -> None:
    """w = 5 rad/s; it begins at its greatest displacement."""
    found = answers(
        spring(
            10,
            """
T = { period = "b.x", about = "1 m" }
f = { frequency = "b.x", about = "1 m" }
T2 = { period = "b.x", about = "1 m", nth = 2 }
of_speed = { period = "b.G.velocity.x" }
A = { amplitude = "b.x", omega = "5 rad/s", during = "t > (0.3 s)" }
p = { phase = "b.G.velocity.x", omega = "5 rad/s", unit = "deg" }
twice = "2 * T"
""",
        ),
        route,
    )
    tolerance = within(route)
    true = 2 * math.pi / 5
    for key in ("T", "T2", "of_speed"):
        assert found[key] == pytest.approx(true, rel=tolerance)
    assert found["f"] == pytest.approx(1 / true, rel=tolerance)
    assert found["twice"] == pytest.approx(2 * true, rel=tolerance)
    assert found["A"] == pytest.approx(0.3, rel=tolerance)
    assert found["p"] == pytest.approx(90, rel=100 * tolerance)  # -sin = cos(wt + 90 deg)


def test_a_pendulum_of_great_amplitude() -> None:
    """T = 4 K(sin(a/2)) sqrt(l/g)."""
    from scipy.special import ellipk

    text = """
until = "t = 20 s"
bodies.bob = { mass = "1 kg", at = { polar = ["2 m", "40 deg"] } }
joints.string = { link = ["bob", "ground.O"] }
ground.points.O = [0, 0]
ask = { T = { period = "bob.x" } }
"""
    true = 4 * ellipk(math.sin(math.radians(130) / 2) ** 2) * math.sqrt(2 / G)
    result = planemotion.load_text(text).run().asks["T"]
    assert isinstance(result.value, float)
    assert isinstance(result.error, float)
    assert result.value == pytest.approx(true, rel=1e-9)
    assert abs(result.value - true) <= result.error < 1e-7


@pytest.mark.parametrize("end", [2 * math.pi, 4 * math.pi])
def test_whole_periods_are_fourier_integrals(end: float) -> None:
    """x = 1 + a cos 5t + b cos(2t + 0.7): both are found apart, since both have whole periods."""
    found = answers(
        spring(
            end,
            """
A = { amplitude = "b.x", omega = "2 rad/s" }
p = { phase = "b.x", omega = "2 rad/s" }
n = { amplitude = "b.x", omega = "3 rad/s" }
""",
            DRIVE,
        )
    )
    forced = 3 / 2 / (25 - 4)
    assert found["A"] == pytest.approx(forced, rel=1e-9)
    assert found["p"] == pytest.approx(0.7, rel=1e-9)
    assert found["n"] == pytest.approx(0, abs=1e-10)


def test_a_part_of_a_period_says_nothing() -> None:
    result = planemotion.load_text(
        spring(1.2, 'T = { period = "b.x", about = "1 m" }\nA = { amplitude = "b.x", omega = "5 rad/s" }\n')
    ).run()
    assert result.asks["T"].value is None
    assert "not reached" in result.asks["T"].reason
    assert result.asks["A"].value is None
    assert "no value" in result.asks["A"].reason


def test_first_and_last_times_are_those_of_events() -> None:
    found = answers(
        spring(4, 'first = { of = "t", at = "low" }\nlast = "low.time"\nn = "low.count"\n')
        + '[events]\nlow = "b.x < (0.85 m)"\n'
    )
    first = math.acos(-0.5) / 5
    assert found["first"] == pytest.approx(first, rel=1e-9)
    assert found["last"] == pytest.approx(first + 2 * 2 * math.pi / 5, rel=1e-9)
    assert found["n"] == 3


@pytest.mark.parametrize(
    ("ask", "path", "reason"),
    [
        ('{ period = "b.x", at = "end" }', "at", "whole run"),
        ('{ period = "b.x", omega = "2 rad/s" }', "omega", "goes with amplitude, phase"),
        ('{ amplitude = "b.x" }', "omega", "wanted"),
        ('{ phase = "b.x", omega = "2 s" }', "omega", "rad/s"),
        ('{ period = "b.x", about = "2 s" }', "about", "length"),
        ('{ of = "b.x", nth = 2 }', "nth", "goes with period, frequency"),
        ('{ period = "b.x", nth = 0 }', "nth", "greater"),
        ('{ frequency = "b.x", during = "t < (1 s)" }', "during", "goes with"),
        ('{ amplitude = "b.x", omega = "2 rad/s", during = "t" }', "during", "condition"),
        ('{ period = "b.x", unit = "m" }', "unit", "a time"),
    ],
)
def test_what_is_written_wrong(ask: str, path: str, reason: str) -> None:
    with pytest.raises(SceneError, match=reason) as error:
        planemotion.load_text(spring(1, f"T = {ask}\n")).run()
    assert error.value.path == f"ask.T.{path}"


def test_in_sweeps_and_words_of_the_results() -> None:
    text = spring(10, 'T = { period = "b.x", about = "1 m" }\nx = "b.x"\n').replace('"50 N/m"', '"k"')
    scene = planemotion.load_text(text + '[parameters]\nk = "50 N/m"\n[sweep]\nk = ["50 N/m", "200 N/m"]\n')
    found = scene.sweep()
    assert found["T"].values == pytest.approx([2 * math.pi / 5, 2 * math.pi / 10], rel=1e-9)
    assert found["x"].values[0] == pytest.approx(1 + 0.3 * math.cos(50), rel=1e-8)
    assert "period b.x" in found["T"].attrs["long_name"]
