"""What comes to zero and stays there: speeds that friction ends, springs in their free position, bounces."""

# ruff: noqa: E501

from __future__ import annotations

import math
import random

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
LOOSE = """
until = "t = {end!r} s"
ground.lines.l = {{ through = [0, 0], angle = "{angle!r} rad" }}
bodies.b = {{ mass = "{m!r} kg", at = [0, 0] }}
contacts.c = {{ touch = ["b", "ground.l"], friction = "{mu!r}" }}
start.b.velocity = {{ polar = ["{v!r} m/s", "{angle!r} rad"] }}
forces.f = {{ force = "b", value = {{ polar = ["{push}", "{angle!r} rad"] }} }}
events.right = "b.velocity.x > 0"
events.left = "b.velocity.x < 0"
events.turn = "b.velocity.x = 0"
ask.word = {{ events = ["right", "left", "turn"] }}
ask.t = {{ of = "t", at = "{way}", unit = "s" }}
solve.route = "{route}"
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


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("load", ["grows", "swings", "the other way first"])
def test_what_friction_holds_comes_loose_once(load: str, route: str) -> None:
    """It is at rest, or friction has stopped it; a push begins later.  Until that is more than friction holds no speed is."""
    rng = random.Random(1)
    for seed in range(12):
        angle, way = rng.choice([0.0, rng.uniform(-0.5, 0.5)]), 1 - 2 * (seed // 2 % 2)
        mu, m, v = (
            math.tan(abs(angle)) + rng.uniform(0.05, 0.6),
            math.exp(rng.uniform(-3, 3)),
            rng.uniform(-3, 3),
        )
        v *= seed % 2
        down, holds = -m * G * math.sin(angle), mu * m * G * math.cos(angle)
        begins = rng.uniform(0, 5) + (v / (math.copysign(holds, v) - down) * m if v else 0)
        loose, back = holds - way * down, holds + way * down
        since, rate, other = f"max(t - ({begins!r} s), 0 s)", loose * math.exp(rng.uniform(-2, 1)), 0.0
        push, t = f"({way * rate!r} N/s)*{since}", begins + loose / rate
        if load == "swings":
            size, omega = 2 * loose, math.exp(rng.uniform(-2, 2))
            push, t = f"({way * size!r} N)*sin(({omega!r} rad/s)*{since})", begins + math.pi / 6 / omega
        if load == "the other way first":
            other, half = 0.7 * min(back, loose), rng.uniform(0.5, 3)
            first = f"({-way * other!r} N)*sin(({math.pi / half!r} rad/s)*min({since}, {half!r} s))"
            push, t = f"{first} + ({way * rate!r} N/s)*max({since} - ({half!r} s), 0 s)", t + half
        scene = {"angle": angle, "m": m, "mu": mu, "v": v, "push": push}
        name = "right" if way > 0 else "left"
        text = LOOSE.format(end=t + 0.2 * (t - begins), way=name, route=route, **scene)
        run = planemotion.load_text(text).run()
        assert (run.status, run["word"]) == ("ok", f"turn {name}" if v else name)
        assert run["t"] == pytest.approx(t, rel=1e-6)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("what", ["b.x", "3*b.x", "norm(b.x, b.y)", "abs(-b.x)", "b.velocity.x"])
def test_what_begins_on_its_value_fires_as_it_comes_back(what: str, route: str) -> None:
    rng = random.Random(3)
    for way in (1, -1):
        x, v = rng.choice([0.5, 0.1, 0.3]), way * rng.uniform(0.1, 0.2)
        omega, middle = rng.uniform(1, 3), x
        unit, size = ("m/s", v) if "velocity" in what else ("m", 3 * x if what[0] == "3" else x)
        force = f"-({omega**2!r} N/m)*(b.x - ({middle!r} m))"
        text = f"""
            until = "t = {1.3 * math.pi / omega!r} s"
            plane = "horizontal"
            bodies.b = {{ mass = "1 kg", at = ["{x!r} m", 0] }}
            start.b.velocity = ["{v!r} m/s", 0]
            forces.f = {{ force = "b", value = ["{force}", 0] }}
            events.rise = "{what} > ({size!r} {unit})"
            events.fall = "{what} < ({size!r} {unit})"
            ask.word = {{ events = ["rise", "fall"] }}
            solve.route = "{route}"
            """
        run = planemotion.load_text(text).run()
        back = "fall" if way > 0 else "rise"
        assert (run.status, run["word"]) == ("ok", "" if unit == "m/s" else back)
