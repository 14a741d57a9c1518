"""Bounces that end in finite time: a run computes the first of them, and waits for the end of all."""

from __future__ import annotations

import math

import numpy as np
import pytest

import planemotion

ROUTES = ["auto", "rk", "ida"]


def pressed(mass: float, stiffness: float, preload: float, e: float, away: float, more: str = "") -> str:
    """A mass that a spring presses on a wall at x = 0, let go at x = `away`; SI."""
    return f"""
until = "rest"
plane = "horizontal"
ground.lines.wall = {{ through = [0, 0], angle = "-90 deg" }}
ground.lines.track = {{ through = [0, 0] }}
ground.points.P = ["{-preload} m", 0]
bodies.m = {{ mass = "{mass} kg", at = ["{away} m", 0] }}
joints.g = {{ slider = ["m", "ground.track"] }}
forces.s = {{ spring = ["m", "ground.P"], stiffness = "{stiffness} N/m", free_length = 0 }}
contacts.w = {{ touch = ["m", "ground.wall"], restitution = {e} }}
events.hit = "w strikes"
{more}
[ask]
t = {{ of = "t", unit = "s" }}
hits = "hit.count"
"""


def end_of_series(mass: float, stiffness: float, preload: float, e: float, away: float) -> float:
    """x + preload = A cos(w t) until the wall; a flight that begins at v takes 2/w atan(v / (w preload))."""
    w = math.sqrt(stiffness / mass)
    first = math.acos(preload / (preload + away)) / w
    v = w * math.sqrt((preload + away) ** 2 - preload**2) * e ** np.arange(1, 4000)
    return first + float(np.sum(2 / w * np.arctan(v / (w * preload))))


def cases(n: int) -> list[tuple[float, float, float, float, float]]:
    rng = np.random.default_rng(20261125)
    return [
        (
            float(10 ** rng.uniform(-1, 1)),
            float(10 ** rng.uniform(0, 3)),
            float(10 ** rng.uniform(-1, 0.5)),
            float(rng.uniform(0.2, 0.9)),
            float(10 ** rng.uniform(-1, 0.5)),
        )
        for _ in range(n)
    ]


@pytest.mark.parametrize("route", ROUTES)
def test_a_mass_that_is_pressed_on_a_wall_rests_when_its_series_ends(route: str) -> None:
    for case in cases(6 if route == "ida" else 25):
        result = planemotion.load_text(pressed(*case)).with_values({"solve.route": route}).run()
        assert result.status == "ok", case
        true = end_of_series(*case)
        assert result["t"] == pytest.approx(true, rel=1e-7 if route == "ida" else 1e-9), case
        told = result.asks["t"].error
        assert isinstance(told, float)
        assert result["t"] == pytest.approx(true, rel=1e-12, abs=10 * told), case
        assert result["hits"] in (None, math.inf)


def test_a_hinged_rod_rests_on_its_stop_at_one_time_on_each_route() -> None:
    scene = planemotion.load("studies/hinged_rod.toml")
    found = [scene.with_values({"solve.route": route}).run() for route in ROUTES]
    assert [one.status for one in found] == ["ok"] * 3
    for one in found:
        assert one["rests_after"] == pytest.approx(found[1]["rests_after"], rel=1e-8)


def test_one_body_may_rest_while_another_moves_on() -> None:
    case = cases(3)[2]
    other = 'bodies.free = { mass = "1 kg", at = [0, "9 m"] }\nstart.free.velocity = ["1 m/s", 0]\n'
    text = pressed(*case, other + 'events.over = "m rests"\n').replace('"rest"', '"over"')
    text += 'gone = { of = "free.x", unit = "m" }\n'
    result = planemotion.load_text(text).run()
    assert result.status == "ok"
    assert result["t"] == pytest.approx(end_of_series(*case), rel=1e-9)
    assert result["gone"] == pytest.approx(result["t"], rel=1e-12)


def weakly_pressed(n: int) -> list[tuple[float, float, float, float, float]]:
    """The same masses, pressed from not at all to as much as they are pulled away."""
    rng = np.random.default_rng(17)
    return [
        (
            float(10 ** rng.uniform(-1, 1)),
            float(10 ** rng.uniform(0, 3)),
            float(rng.choice([0, 10 ** rng.uniform(-14, -1)])),
            float(rng.uniform(0.05, 0.95)),
            float(10 ** rng.uniform(-1, 0.5)),
        )
        for _ in range(n)
    ]


@pytest.mark.parametrize("route", ROUTES)
def test_a_mass_that_bounces_about_where_nothing_presses_it_is_not_called_at_rest(route: str) -> None:
    """Its flights take pi / w each, for as long as its speed is far above w times the preload."""
    seen = {"ok": 0, "bounces_on": 0, "undecided": 0}
    for case in weakly_pressed(8 if route == "ida" else 80):
        result = planemotion.load_text(pressed(*case)).with_values({"solve.route": route}).run()
        seen[result.status] += 1
        if result.status == "bounces_on":
            assert result["t"] is None
            assert result.asks["hits"].value is None
            assert case[2] < 1e-3 * case[4]
            flight = math.pi * math.sqrt(case[0] / case[1])
            assert result.stopped_at is not None
            assert result.stopped_at > 3 * flight
        elif result.status == "ok":
            assert case[2] > 0
            told = result.asks["t"].error
            assert isinstance(told, float)
            assert result["t"] == pytest.approx(end_of_series(*case), rel=1e-9, abs=4 * told), case
    assert min(seen["ok"], seen["bounces_on"]) > 0
    assert seen["undecided"] <= 0.15 * sum(seen.values())  # where one pass still sees them shrink


@pytest.mark.parametrize("route", ROUTES)
def test_such_a_mass_may_be_asked_for_later_on(route: str) -> None:
    """Its place is known, however small; how often it has struck is not."""
    text = pressed(1, 100, 0, 0.5, 0.1).replace('"rest"', '"t = 20 s"') + 'x = { of = "m.x", unit = "m" }\n'
    result = planemotion.load_text(text).with_values({"solve.route": route}).run()
    assert result.status == "ok"
    assert result["x"] == pytest.approx(0, abs=1e-8)
    assert result.asks["hits"].value is None
    assert result.asks["hits"].reason != "infinite"
    waits = text.replace('"t = 20 s"', '"hit.count > 40"')
    assert planemotion.load_text(waits).with_values({"solve.route": route}).run().status == "bounces_on"


def bouncing(until: str, e: float, route: str, asks: str) -> planemotion.RunResult:
    return planemotion.load_text(f"""
until = "{until}"
ground.lines.floor = {{ through = [0, 0] }}
bodies.b = {{ mass = "1 kg", at = [0, "1 m"] }}
contacts.floor = {{ touch = ["b", "ground.floor"], restitution = {e} }}
events.strike = "floor strikes"
events.up = "b.velocity.y > 0"
[ask]
strikes = "strike.count"
ups = "up.count"
times = {{ of = "t", at = "each up" }}
{asks}
[solve]
route = "{route}"
""").run()


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("e", [0.1, 0.5, 0.8])
def test_what_happens_at_each_bounce_is_as_countless_as_they_are(route: str, e: float) -> None:
    result = bouncing("b rests", e, route, 'period = { period = "b.velocity.y" }')
    assert result.status == "ok"
    for name in ("strikes", "ups"):
        assert result.asks[name].value is None
        assert result.asks[name].reason == "infinite"
    times = result["times"]
    assert isinstance(times, list)
    fall = math.sqrt(2 / 9.81)
    for k, time in enumerate(times[:12]):
        assert time == pytest.approx(fall * (1 + 2 * e * (1 - e**k) / (1 - e)), rel=1e-9)
    assert len(times) >= 12


@pytest.mark.parametrize("route", ROUTES)
def test_a_run_that_ends_among_them_counts_them(route: str) -> None:
    rng = np.random.default_rng(5)
    for _ in range(6):
        e, n = float(f"{rng.uniform(0.1, 0.6):.3g}"), int(rng.integers(2, 8))
        fall = math.sqrt(2 / 9.81)
        end = fall * (1 + 2 * e * (1 - e ** (n - 0.5)) / (1 - e))
        result = bouncing(f"t = {end!r} s", e, route, "")
        assert result.status == "ok"
        assert result["strikes"] == n
        assert result["ups"] == n


@pytest.mark.parametrize("word", ["period", "frequency"])
def test_endlessly_many_swings_have_no_mean(word: str) -> None:
    text = f"""
        until = "t = {{t}} s"
        ground.lines.l.through = [0, 0]
        bodies.b = {{{{ mass = "1 kg", at = [0, "1 m"] }}}}
        contacts.c = {{{{ touch = ["b", "ground.l"], restitution = 0.5 }}}}
        ask.mean = {{{{ {word} = "b.velocity.y" }}}}
        ask.second = {{{{ {word} = "b.velocity.y", nth = 2 }}}}
        """
    first = math.sqrt(2 / 9.81)
    runs = [planemotion.load_text(text.format(t=t)).run() for t in (2.6 * first, 4 * first)]
    power = 1 if word == "period" else -1
    assert runs[0]["mean"] == pytest.approx((0.75 * first) ** power)
    assert runs[1]["second"] == pytest.approx((0.5 * first) ** power)
    assert [run.status for run in runs] == ["ok", "ok"]
    assert runs[1]["mean"] is None
