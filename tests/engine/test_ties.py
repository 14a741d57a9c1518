"""A blow and a time of the scene that come together are undecided; apart, the order of both is right."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from planemotion.engine.result import RunResult
from tests.scenes import ROUTES, G, number

DROPPED = """
until = "t = {end!r} s"
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies]
p = {{ mass = "1 kg", at = [0, "{height!r} m"] }}
[events]
then = "t = {then!r} s"
[contacts]
c = {{ touch = ["p.G", "ground.floor"], restitution = 0.5 }}
[ask]
v = {{ of = "p.velocity.y", at = "{at}" }}
"""

CLOSING = """
until = "t = {end!r} s"
plane = "horizontal"
[bodies]
left = {{ plate = ["0.1 m", "1 m"], mass = "9 kg", at = ["-1 m", 0], \
driven = {{ velocity = ["1 m/s", 0] }}, lines = {{ face = {{ through = [0, 0], angle = "-90 deg" }} }} }}
right = {{ plate = ["0.1 m", "1 m"], mass = "9 kg", at = ["1 m", 0], \
driven = {{ velocity = ["-1 m/s", 0] }}, lines = {{ face = {{ through = [0, 0], angle = "90 deg" }} }} }}
p = {{ mass = "1 kg", at = [0, 0] }}
[start]
p.velocity.x = "{speed!r} m/s"
[contacts]
l = {{ touch = ["p.G", "left.face"], restitution = 1 }}
r = {{ touch = ["p.G", "right.face"], restitution = 1 }}
[ask]
v = "p.velocity.x"
"""

STOPPED = """
until = "t = 2 s"
plane = "horizontal"
[bodies]
p = { mass = "1 kg", at = [0, 0] }
[events]
kick = { when = "t = 2 s", do = [{ impulse = "p", value = ["1 N*s", 0] }] }
[ask]
v = "p.velocity.x"
"""


def dropped(route: str, height: float, end: float, then: float | None = None) -> RunResult:
    at = "end" if then is None else "then"
    text = DROPPED.format(end=end, height=height, then=then or end, at=at)
    return planemotion.load_text(text).run(**{"solve.route": route})


def last_blow_between_walls(speed: float, end: float) -> tuple[float, float]:
    """The last blow before `end` between walls at -1 m and 1 m that close at 1 m/s: its time, and the ball's
    velocity after it."""
    x, v, t = 0.0, speed, 0.0
    while True:
        step = (1 - t - x) / (v + 1) if v > 0 else (x + 1 - t) / (1 - v)
        if t + step > end:
            return t, v
        x, t = x + v * step, t + step
        v = -v - 2 if v > 0 else -v + 2


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("part", [1, 0.5])
def test_a_blow_at_a_time_that_is_asked_for_is_undecided(route: str, part: float) -> None:
    time = math.sqrt(2 * 0.5 / G)
    assert dropped(route, 0.5, time / part, time).status == "undecided"


@pytest.mark.parametrize("route", ROUTES)
def test_blows_beside_the_end_are_before_it_or_after_it(route: str) -> None:
    draw = random.Random(17)
    for _ in range(12):
        height = 10 ** draw.uniform(-2, 2)
        late = draw.choice((-1, 1)) * 10 ** draw.uniform(-11, -3)
        time = math.sqrt(2 * height / G)
        result = dropped(route, height, time + late * time)
        speed = -G * time * (1 if late < 0 else -0.5)
        answer = number(result.asks["v"].value)
        assert result.status == "undecided" or answer == pytest.approx(speed, rel=1e-2)
        assert number(result.margin) < 1e3 + 1e17 * abs(late)


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("late", [0.0, -1e-9, 1e-9, 1e-3])
def test_closing_walls_are_met_before_the_end_or_after_it(route: str, late: float) -> None:
    draw = random.Random(18)
    for _ in range(6):
        speed = draw.uniform(2, 9)
        time, _ = last_blow_between_walls(speed, draw.uniform(0.5, 0.8))
        text = CLOSING.format(end=time + late, speed=speed)
        result = planemotion.load_text(text).run(**{"solve.route": route})
        assert result.status == ("ok" if late else "undecided")
        expected = last_blow_between_walls(speed, time + late)[1]
        assert not late or number(result.asks["v"].value) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_what_a_time_of_the_scene_makes_jump_is_no_tie(route: str) -> None:
    result = planemotion.load_text(STOPPED).run(**{"solve.route": route})
    assert result.status == "ok"
    assert number(result.asks["v"].value) == pytest.approx(1)


KICKED = """
until = "t = 1 s"
[bodies]
p = { mass = "1 kg" }
[parameters]
first = "0.5 s"
later = "0.5 s"
[forces.drag]
force = "p"
value = ["-(1 kg/s)*p.velocity.x", 0]
[start]
p.velocity.x = "1 m/s"
[events]
one = { when = "t = first", do = [{ impulse = "p", value = ["1 N*s", 0] }] }
two = { when = "t = later", do = [{ impulse = "p", value = ["1 N*s", 0] }] }
[ask]
v = "p.velocity.x"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("ulps", [0, 1, 2, 5, 20, 100, 10**4])
def test_events_between_which_no_step_fits_both_happen(route: str, ulps: int) -> None:
    """v = exp(-1) + 2 exp(-1/2), by a drag that takes 1/s of the speed."""
    result = planemotion.load_text(KICKED).run(later=0.5 + ulps * math.ulp(0.5), **{"solve.route": route})
    assert result.status == "ok"
    assert result["v"] == pytest.approx(math.exp(-1) + 2 * math.exp(-0.5), abs=1e-9)
