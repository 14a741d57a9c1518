"""Medians and percentiles over the time of a run: beside closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

import planemotion
from planemotion import SceneError
from tests.mechanics.test_swings import spring
from tests.scenes import ROUTES, G, answers, within

PERIOD = 2 * math.pi / 5


@pytest.mark.parametrize("route", ROUTES)
def test_a_mass_on_a_spring(route: str) -> None:
    """x = 1 + 0.3 cos 5t is below 1 - 0.3 cos(pi p) for the part p of a period."""
    found = answers(
        spring(
            PERIOD,
            """
half = { median = "b.x" }
most = { percentile = "b.x", percent = 90 }
size = { percentile = "abs(b.x - (1 m))", percent = 30 }
right = { percentile = "b.x", percent = 25, during = "b.x > (1 m)" }
""",
        ),
        route,
    )
    tolerance = within(route)
    assert found["half"] == pytest.approx(1, rel=tolerance)
    assert found["most"] == pytest.approx(1 + 0.3 * math.cos(math.pi * 0.1), rel=tolerance)
    assert found["size"] == pytest.approx(0.3 * math.sin(math.pi * 0.15), rel=10 * tolerance)
    assert found["right"] == pytest.approx(1 + 0.3 * math.sin(math.pi * 0.125), rel=tolerance)


def test_a_ball_that_bounces_to_rest() -> None:
    """Of its heights, beside many of them at even times; then it lies still for most of the time."""
    text = """
until = "t = END s"
ground.lines.floor = { through = [0, 0] }
bodies.ball = { mass = "1 kg", at = [0, "1 m"] }
contacts.floor = { touch = ["ball", "ground.floor"], restitution = 0.5 }
ask = { high = { percentile = "ball.y", percent = 80 }, half = { median = "ball.y" } }
"""
    first = math.sqrt(2 / G)
    end = 3 * first  # all bounces take 2 first (e + e^2 + ...) = 2 first
    speed = G * first
    found = answers(text.replace("END", repr(end)))
    times = (np.arange(2_000_000) + 0.5) / 2_000_000 * end
    height = np.where(times < first, 1 - G * times**2 / 2, 0.0)
    begin, v = first, speed
    for _ in range(40):
        v /= 2
        t = times - begin
        height = np.where((t > 0) & (t < 2 * v / G), v * t - G * t**2 / 2, height)
        begin += 2 * v / G
    assert found["high"] == pytest.approx(np.quantile(height, 0.8), abs=1e-6)
    assert found["half"] == pytest.approx(np.quantile(height, 0.5), abs=1e-6)
    assert answers(text.replace("END", "20"))["high"] == pytest.approx(0, abs=1e-12)


def test_the_estimate_covers_the_error() -> None:
    result = planemotion.load_text(spring(PERIOD, 'most = { percentile = "b.x", percent = 70 }\n')).run()
    ask = result.asks["most"]
    assert isinstance(ask.value, float)
    assert isinstance(ask.error, float)
    assert abs(ask.value - (1 + 0.3 * math.cos(math.pi * 0.3))) <= ask.error < 1e-9


@pytest.mark.parametrize(
    ("ask", "path", "reason"),
    [
        ('{ percentile = "b.x" }', "percent", "wanted"),
        ('{ percentile = "b.x", percent = 100 }', "percent", "between 0 and 100"),
        ('{ percentile = "b.x", percent = "2 m" }', "percent", "length"),
        ('{ median = "b.x", percent = 20 }', "percent", "goes with percentile"),
        ('{ median = "b.x", at = "end" }', "at", "whole run"),
        ('{ median = "b.x", unit = "s" }', "unit", "a length"),
    ],
)
def test_what_is_written_wrong(ask: str, path: str, reason: str) -> None:
    with pytest.raises(SceneError, match=reason) as error:
        planemotion.load_text(spring(1, f"T = {ask}\n")).run()
    assert error.value.path == f"ask.T.{path}"


def test_in_a_sweep_over_the_percentage() -> None:
    text = spring(PERIOD, 'q = { percentile = "b.x", percent = "p" }\n') + "[parameters]\np = 50\n"
    found = planemotion.load_text(text + "[sweep]\np = [10, 50, 90]\n").sweep()
    true = [1 - 0.3 * math.cos(math.pi * p) for p in (0.1, 0.5, 0.9)]
    assert found["q"].values == pytest.approx(true, rel=1e-9)
