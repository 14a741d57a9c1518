"""What comes to zero and stays there: speeds that friction ends, springs in their free position, bounces."""

# ruff: noqa: E501

from __future__ import annotations

import math

import numpy as np
import pytest

import planemotion
from tests.scenes import ROUTES, G

SWINGS = """
until = "b rests"
ground.lines.l = {{ through = [0, 0] }}
ground.points.w = ["-9 m", 0]
bodies.b = {{ mass = "{m} kg", at = ["{x} m", 0] }}
joints.s = {{ slider = ["b", "ground.l"], friction = "{mu}" }}
forces.k = {{ spring = ["b", "ground.w"], stiffness = "{k} N/m", free_length = "9 m" }}
events.right = "b.velocity.x > 0"
events.left = "b.velocity.x < 0"
events.turn = "b.velocity.x = 0"
ask.word = {{ events = ["right", "left"] }}
ask.turns = "turn.count"
ask.x = "b.x"
ask.back = {{ integral = 1, during = "b.velocity.x > 0" }}
solve.route = "{route}"
"""
CAUGHT = """
until = "rod.omega < 0"
plane = "horizontal"
bodies.rod = {{ rod = ["A", "B"], length = "1 m", mass = "1 kg", at = {{ A = [0, 0] }}, angle = "{angle} deg" }}
joints.A = {{ pin = ["rod.A", "ground"] }}
forces.k = {{ torsion = ["rod", "ground"], stiffness = "{k} N*m" }}
events.e = {{ when = "t = {t} s", do = [{{ impulse = "rod", value = "{blow} N*m*s" }}] }}
ask.t = "t"
"""
INCLINE = """
until = "t = {t} s"
ground.lines.l = {{ through = [0, 0], angle = "-{angle}" }}
bodies.b = {{ mass = "1 kg", at = ["({h} m)*sin({angle})", "({h} m)*cos({angle})"] }}
contacts.c = {{ touch = ["b", "ground.l"], restitution = "{e}" }}
ask.v = "b.speed"
"""


def words(n: int) -> str:
    return " ".join(["right", "left"][i % 2] for i in range(n))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(6))
def test_a_swing_that_friction_stops_has_not_gone_on(seed: int, route: str) -> None:
    """Each half swing is 2 mu m g/k shorter; it begins to the left, and turns where another one follows."""
    rng = np.random.default_rng(seed)
    m, k, mu = rng.uniform(0.5, 3), rng.uniform(10, 500), rng.uniform(0.1, 0.6)
    halves, short = seed + 1, mu * m * G / k
    x = short * (2 * halves + rng.uniform(-0.8, 0.8))
    result = planemotion.load_text(SWINGS.format(m=m, x=x, mu=mu, k=k, route=route)).run()
    assert result.status == "ok"
    assert result["word"] == words(halves - 1)
    assert result["turns"] == halves
    assert result["x"] == pytest.approx((-1) ** halves * (x - 2 * halves * short), abs=1e-7)
    assert result["back"] == pytest.approx((halves // 2) * math.pi / math.sqrt(k / m), abs=1e-6)


@pytest.mark.parametrize("angle", [-90, 0, 37, 45, 143])
@pytest.mark.parametrize("seed", range(6))
def test_a_rod_that_rests_in_its_spring_is_kicked_once(seed: int, angle: float) -> None:
    rng = np.random.default_rng(seed)
    k, blow, t = np.exp(rng.uniform(np.log([0.1, 1e-3, 0.01]), np.log([1000, 1, 3])))
    run = planemotion.load_text(CAUGHT.format(angle=angle, k=k, t=t, blow=blow)).run()
    assert run.status == "ok"
    assert run["t"] == pytest.approx(t + math.pi / 2 / math.sqrt(3 * k), rel=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_what_has_bounced_out_on_an_incline_is_no_doubt(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle, e, h = rng.uniform(0.01, 0.8), rng.uniform(0.05, 0.9), rng.uniform(0.05, 3)
    rests = math.sqrt(2 * h / G / math.cos(angle)) * (1 + e) / (1 - e)
    t = rests * rng.uniform(1.01, 3)
    run = planemotion.load_text(INCLINE.format(t=t, angle=angle, e=e, h=h)).run()
    assert run.status == "ok"
    assert run["v"] == pytest.approx(G * math.sin(angle) * t, rel=1e-9)
