"""What jumps at an instant: off zero, to zero, across it, by a blow, a closing, a release or another mode."""

from __future__ import annotations

import math

import pytest

import planemotion
from tests.scenes import ROUTES, G, answers, within
from tests.scenes.parts import FLOOR, body, touching

DROP = 1.0  # m, that the ball falls
FALL = math.sqrt(2 * DROP / G)


def ball(event: str, restitution: float = 0, extra: str = "", until: str = "t = 2 s", fall: float = 0) -> str:
    """A ball over a floor, and an event."""
    return f"""
until = "{until}"
{FLOOR}{body("ball", disk="0.1 m", mass="1 kg", at={"center": ["0 m", f"{0.1 + DROP} m"]})}
{touching("floor", "ball.rim", friction=0, restitution=restitution)}
{extra}
[start]
ball.velocity.y = "{-fall} m/s"
[events]
hit = "floor strikes"
x = "{event}"
[ask]
count = "x.count"
time = "x.time"
end = "t"
"""


def block(event: str, push: str = "0 N", speed: float = 0, until: str = "t = 2 s") -> str:
    """A block that a force pushes along a rough floor, and an event."""
    return f"""
until = "{until}"
{FLOOR}{body("block", mass="1 kg", at=[0, 0])}
{touching("floor", "block.G", friction=0.2, restitution=0)}
forces.push = {{ force = "block.G", value = ["{push}", 0] }}
start.block.velocity.x = "{speed} m/s"
[events]
x = "{event}"
[ask]
count = "x.count"
time = "x.time"
"""


# Of a ball that falls on a floor and stays there, without a rebound: how often each fires, all as it strikes.
STRIKES = {
    "floor.normal > 0": 1,
    "floor.normal > (5 N)": 1,
    "floor.normal = (9.81 N)": 1,
    "floor.normal > (9.81 N)": 0,
    "floor.normal < 0": 0,
    "0 > -floor.normal": 1,
    "-floor.normal < 0": 1,
    "floor.closed = 1": 1,
    "floor.closed > 0": 1,
    "floor.closed > 1": 0,
    "ball.velocity.y = 0": 1,
    "ball.velocity.y > 0": 0,
    "ball.acceleration.y = 0": 1,
    "ball.acceleration.y > (-1 m/s^2)": 1,
    "energy.lost > 0": 1,
    "hit.count = 1": 1,
    "hit.count > 0": 1,
    "hit.count > 0.5": 1,
    "hit.count > 1": 0,
}


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("event", "count"), STRIKES.items())
def test_what_a_strike_makes_true_fires_then(event: str, count: int, route: str) -> None:
    values = answers(ball(event), route)
    assert values["count"] == count
    assert values["time"] == (pytest.approx(FALL, rel=within(route)) if count else None)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("event", ["floor.closed = 1", "floor.normal > 0", "hit.count > 0"])
def test_the_run_ends_where_a_jump_makes_its_end_true(event: str, route: str) -> None:
    assert answers(ball("hit.count = 1", until=event), route)["end"] == pytest.approx(FALL, rel=within(route))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    "event", ["floor.normal > 0", "floor.normal > (5 N)", "floor.closed = 1", "floor.closed > 0.5"]
)
def test_what_holds_from_the_start_on_does_not_become_true(event: str, route: str) -> None:
    assert answers(block(event), route) == {"count": 0, "time": None}


@pytest.mark.parametrize("route", ROUTES)
def test_a_blow_at_the_start_makes_true_what_was_not(route: str) -> None:
    scene = ball("ball.velocity.y > 0", 0.5, fall=2, until="t = 0.05 s").replace(f"{0.1 + DROP} m", "0.1 m")
    assert answers(scene, route) == {"count": 1, "time": 0, "end": 0.05}


LIFT = 'lift = { when = "t = 1 s", do = [{ impulse = "ball.center", value = [0, "3 N*s"] }] }'


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    ("event", "times"),
    [
        ("floor.closed < 1", [1.0]),
        ("floor.closed = 0", [1.0]),
        ("floor.normal = 0", [1.0]),
        ("floor.normal < (5 N)", [1.0]),
        ("ball.velocity.y > 0", [1.0]),
        ("floor.closed = 1", [FALL, 1 + 6 / G]),
        ("floor.closed > 0", [FALL, 1 + 6 / G]),
        ("floor.normal > 0", [FALL, 1 + 6 / G]),
        ("ball.velocity.y < 0", [1 + 3 / G]),
    ],
)
def test_a_contact_that_opens_again_fires_both_ways(event: str, times: list[float], route: str) -> None:
    scene = ball(event).replace("[events]", "[events]\n" + LIFT)
    values = answers(scene + 'all = { of = "t", at = "each x" }', route)
    assert values["all"] == pytest.approx(times, rel=within(route))
    assert values["count"] == len(times)


SLIPS = math.sqrt(0.2 * G / 4)  # s, where 4 N/s^2 t^2 is what friction holds


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    ("event", "count"),
    [
        ("block.velocity.x > 0", 1),
        ("block.x > 0", 1),
        ("-block.velocity.x < 0", 1),
        ("block.velocity.x < 0", 0),
        ("block.velocity.x = 0", 0),
    ],
)
def test_what_has_rested_on_zero_fires_as_it_leaves(event: str, count: int, route: str) -> None:
    values = answers(block(event, push="(4 N/s^2)*t*t", until="t = 1 s"), route)
    assert values["count"] == count
    assert values["time"] == (pytest.approx(SLIPS, rel=within(route)) if count else None)


@pytest.mark.parametrize("route", ROUTES)
def test_friction_that_vanishes_as_slip_ends_is_seen(route: str) -> None:
    values = answers(block("floor.friction = 0", speed=1), route)
    assert values == {"count": 1, "time": pytest.approx(1 / (0.2 * G), rel=within(route))}


@pytest.mark.parametrize("event", ["ball.velocity.y > 0", "ball.velocity.y < 0", "ball.velocity.y = 0"])
def test_what_every_rebound_of_an_endless_series_fires_is_counted_without_end(event: str) -> None:
    run = planemotion.load_text(ball(event, 0.5)).run()
    assert run.status == "ok"
    assert run.asks["count"].reason == "infinite"
    assert run.asks["time"].value == pytest.approx(3 * FALL)


def test_what_only_the_first_rebounds_fire_is_counted_exactly() -> None:
    """Speeds after rebounds are v/2, v/4, ...: those above 0.1 m/s."""
    count = math.floor(math.log2(G * FALL / 0.1))
    assert answers(ball("ball.velocity.y > (0.1 m/s)", 0.5))["count"] == count


CHAIN = """
[events]
hit = "floor strikes"
third = { when = "hit.count > 2", do = [{ impulse = "ball.center", value = ["2 N*s", 0] }] }
after = "third.count = 1"
[ask]
x = { of = "ball.velocity.x", at = "after" }
times = { of = "t", at = "each third" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_events_that_wait_for_counts_act_at_the_instant_of_the_count(route: str) -> None:
    scene = ball("hit.count = 3", 0.9).split("[events]")[0] + CHAIN
    values = answers(scene, route)
    assert values["x"] == pytest.approx(2)
    assert values["times"] == pytest.approx([FALL * (1 + 2 * 0.9 + 2 * 0.81)], rel=within(route))
