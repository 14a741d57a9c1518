"""Events `X every STEP` beside others, by closed forms: each multiple is met once, on every route."""

# ruff: noqa: E501

from __future__ import annotations

import math
import random
from functools import partial
from typing import Any

import pytest

import planemotion
from tests.stress.kinds.multiples import OTHERS, flying, oscillator, passages, swing

ROUTES = ["auto", "rk", "ida"]


def run(text: str, route: str) -> Any:
    asks = 'ask.n = "e.count"\nask.times = { of = "t", at = "each e", unit = "s" }\n'
    return planemotion.load_text(f'{text}\n{asks}solve.route = "{route}"\n').run()


def check(found: Any, times: list[float], within: float) -> None:
    assert (found.status, found["n"]) == ("ok", len(times))
    assert found["times"] or not times
    assert list(found["times"]) == pytest.approx(times[: len(found["times"])], abs=within)


@pytest.mark.parametrize("other", OTHERS)
@pytest.mark.parametrize("route", ROUTES)
def test_times_and_places_beside_others(route: str, other: str) -> None:
    draw = random.Random(other)
    for _ in range(8):
        end = math.exp(draw.uniform(-2, 2))
        step = end * math.exp(draw.uniform(-5, -0.7))
        beside = end * math.exp(draw.uniform(-3, -0.2))
        what, unit = draw.choice([("t", "s"), ("b.x", "m")])
        text = f"""
            until = "t = {end!r} s"
            bodies.b = {{ mass = "1 kg", at = [0, 0] }}
            start.b.velocity = ["1 m/s", "{4.2 * end!r} m/s"]
            events.e = "{what} every {step!r} {unit}"
            events.f = "{other.format(a=repr(beside))}"
            """
        check(run(text, route), [k * step for k in range(1, math.floor(end / step) + 1)], 1e-9 * end)


@pytest.mark.parametrize("other", ["", "b.x > 0.1 m", "b.velocity.x < 0", "t every 0.071 s"])
@pytest.mark.parametrize("route", ROUTES)
def test_an_oscillator_turns_back_between_multiples(route: str, other: str) -> None:
    draw = random.Random(7)
    for begins_on_one in (False, True, False):
        stiffness, size, phase = draw.uniform(5, 50), draw.uniform(0.2, 1), draw.uniform(0, 6)
        rate, step = math.sqrt(stiffness), size * math.exp(draw.uniform(-4, 0.2))
        x, v = size * math.cos(phase), -size * rate * math.sin(phase)
        x = step * round(x / step) if begins_on_one else x
        size, phase = math.hypot(x, v / rate), math.atan2(-v / rate, x)
        end = draw.uniform(0.5, 4) * 2 * math.pi / rate
        turns = [(k * math.pi - phase) / rate for k in range(-3, 20)]
        text = oscillator(end, x, v, stiffness, step, other)
        swings = partial(swing, size / step, rate, phase)
        times = passages(swings, [0, *(t for t in turns if 0 < t < end), end])
        check(run(text, route), times, 1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_heights_of_a_ball_that_bounces(route: str) -> None:
    draw = random.Random(3)
    for _ in range(8):
        height, restitution = draw.uniform(0.3, 2), draw.uniform(0.5, 0.95)
        step = height * math.exp(draw.uniform(-4, -0.3))
        floor, g = 0.31 * step, 9.81
        y, v, begin, times = floor + height, 0.0, 0.0, []
        for _ in range(6):
            speed = math.sqrt(v * v + 2 * g * (y - floor))
            flight = (v + speed) / g
            inner = passages(partial(flying, y / step, v / step, g / step), [0, v / g, flight])
            times += [begin + t for t in inner]
            y, v, begin = floor, restitution * speed, begin + flight
        text = f"""
            until = "t = {begin + 1e-3 * v!r} s"
            ground.lines.f = {{ through = [0, "{floor!r} m"] }}
            bodies.b = {{ mass = "1 kg", at = [0, "{floor + height!r} m"] }}
            contacts.c = {{ touch = ["b", "ground.f"], restitution = {restitution!r} }}
            events.e = "b.y every {step!r} m"
            """
        last = passages(partial(flying, y / step, v / step, g / step), [0, 1e-3 * v])
        times += [begin + t for t in last]
        check(run(text, route), times, 1e-9)


@pytest.mark.parametrize("other", ["", "r.angle = -90 deg", "r.angle every 7 deg", "r.omega = 0"])
@pytest.mark.parametrize("route", ["auto", "path", "rk", "ida"])
def test_times_of_a_pendulum(route: str, other: str) -> None:
    draw = random.Random(5)
    for _ in range(4):
        end = draw.uniform(0.3, 4)
        step = end * math.exp(draw.uniform(-5, -0.5))
        text = f"""
            until = "t = {end!r} s"
            bodies.r = {{ rod = ["A", "B"], length = "1 m", mass = "1 kg", at = {{ A = [0, 0] }}, angle = "-3.3 deg" }}
            joints.A = {{ pin = ["r.A", "ground"] }}
            events.e = "t every {step!r} s"
            {f'events.f = "{other}"' if other else ""}
            """
        check(run(text, route), [k * step for k in range(1, math.floor(end / step) + 1)], 1e-10)


@pytest.mark.parametrize("route", ROUTES)
def test_twenty_thousand_of_them(route: str) -> None:
    end, n = 1.234, 20_000
    text = f"""
        until = "t = {end} s"
        plane = "horizontal"
        bodies.b = {{ mass = "1 kg", at = [0, 0] }}
        start.b.velocity = ["1 m/s", 0]
        events.e = "b.x every {end / (n + 0.3)!r} m"
        events.f = "t every {end / (0.077 * n + 0.2)!r} s"
        solve.max_events = 1000000
        ask.m = "f.count"
        """
    found = run(text, route)
    assert (found.status, found["n"], found["m"]) == ("ok", n, 1540)
