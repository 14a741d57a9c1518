"""Cases that were once wrong without a word, by their number in the list of those found, on all routes.

The numbers that are missing, and the rest of 7, have tests of their own: gases and dampers of 7 are drawn in
studies/benchmarks/drawn.py, 1 and 2 tests/engine/test_waves.py and
tests/stress/misses, 11 test_dead_centre.py, 15 to 17 tests/cli/test_found_inputs.py.
"""

from __future__ import annotations

import math
import random
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipj, ellipk

import planemotion
from planemotion.base.errors import SceneError, SimulationError
from tests import CHAPTER

ROUTES = ("auto", "rk", "ida")
G = 9.81
FLOOR = """
contacts.floor = { touch = ["b", "ground.f"], restitution = RESTITUTION }
ground.lines.f = { through = [0, 0], angle = 0 }
"""


def _run(text: str, route: str = "auto", **words: Any) -> planemotion.RunResult:
    for word, value in words.items():
        text = text.replace(word, str(value))
    return planemotion.load_text(f'solve = {{ route = "{route}", max_time = "1e5 s" }}\n{text}').run()


def _values(found: planemotion.RunResult) -> dict[str, float]:
    return {key: float(ask.value) for key, ask in found.asks.items()}  # type: ignore[arg-type]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("height", [0.3, 1.0, 2.9])
def test_3_jumps_from_zero_are_seen(route: str, height: float) -> None:
    found = _run(
        """
        until = "t = 1 s"
        bodies.b = { mass = "1 kg", at = [0, "HEIGHT m"] }
        events = { pressed = "floor.normal > 0", closed = "floor.closed = 1", hard = "floor.normal > (5 N)" }
        ask.pressed = "pressed.count"
        ask.closed = "closed.count"
        ask.hard = "hard.count"
        ask.t = { of = "t", at = "hard" }
        """
        + FLOOR,
        route,
        HEIGHT=height,
        RESTITUTION=0,
    )
    assert found.status == "ok"
    value = _values(found)
    assert [value[key] for key in ("pressed", "closed", "hard")] == [1, 1, 1]
    assert value["t"] == pytest.approx(math.sqrt(2 * height / G), abs=1e-11)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("late", [-5e-11, -1e-14, 1e-14, 5e-11])
def test_4_ties_are_told(route: str, late: float) -> None:
    found = _run(
        """
        until = "t = 1 s"
        bodies.b = { mass = "1 kg", at = [0, "HEIGHT m"] }
        events.strike = "floor strikes"
        ask.n = "strike.count"
        """
        + FLOOR,
        route,
        HEIGHT=repr(G / 2 + late),
        RESTITUTION=0.5,
    )
    ask = found.asks["n"]
    if found.status == "ok":
        assert ask.value == (late < 0)
        assert abs(late) > 1e-11
    else:
        assert found.status == "undecided"
        assert ask.margin is not None
        assert ask.margin < 1


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("firings", [63, 64, 65, 100, 300])
def test_5_lists_are_not_cut(route: str, firings: int) -> None:
    found = _run(
        """
        until = "t = UNTIL s"
        bodies.b = { mass = "1 kg", at = [0, 0] }
        events.e = "sin(10*pi*t/(1 s)) < 0"
        ask = { each = { of = "t", at = "each e" }, n = "e.count" }
        """,
        route,
        UNTIL=0.2 * firings,
    )
    times = found.asks["each"].value
    assert isinstance(times, list)
    assert found.asks["n"].value == len(times) == firings
    assert np.array(times, float) == pytest.approx(0.1 + 0.2 * np.arange(firings), abs=1e-9)


def test_5_a_late_end_is_told_before_it_is_computed() -> None:
    with pytest.raises(SceneError, match=r"a run ends at 1000 s where solve\.max_time is not given"):
        planemotion.load_text(
            'until = "t = 2000 s"\nbodies.b = { mass = "1 kg", at = [0, 0] }\nask.x = "b.x"'
        ).run()


@pytest.mark.parametrize("route", ROUTES)
def test_6_zeros_are_within_their_error(route: str) -> None:
    bounce = _run(
        """
        until = "t = 3 s"
        bodies.b = { mass = "1 kg", at = [0, "1 m"] }
        events.s = "floor strikes"
        ask = { lost = { of = "energy.lost", at = "s" }, n = "s.count" }
        """
        + FLOOR,
        route,
        RESTITUTION=1,
    )
    rod = _run(
        """
        until = "t = 1 s"
        bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = 0 }
        ground.points.O = [0, 0]
        joints.A = { pin = ["rod.A", "ground.O"] }
        ask = { total = "energy.total", lost = "energy.lost", impulse = "A.impulse.x" }
        """,
        route,
    )
    assert bounce.status == rod.status == "ok"
    assert bounce.asks["n"].value == 3
    for ask in (bounce.asks["lost"], *rod.asks.values()):
        assert abs(float(ask.value)) <= float(ask.error) < 1e-8  # type: ignore[arg-type]
        assert float(ask.error) > 1e-15  # type: ignore[arg-type]


def _is_told(value: float, error: float | None, truth: float) -> bool:
    return error is not None and abs(value - truth) <= 10 * error + 1e-13 * abs(truth)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("light", [1e-8, 1e-4, 1.0])
def test_7_the_force_in_a_link_between_unlike_masses(route: str, light: float) -> None:
    """Two particles that turn about each other as they fall: m1 m2 / (m1 + m2) omega^2 d."""
    found = _run(
        """
        until = "t = 2 s"
        bodies.a = { mass = "1 kg", at = [0, 0] }
        bodies.b = { mass = "LIGHT kg", at = ["0.7 m", 0] }
        joints.l = { link = ["a", "b"] }
        start = { "b.velocity" = [0, "2.1 m/s"], "a.velocity" = [0, 0] }
        ask.force = { of = "l.force.norm", unit = "N" }
        """,
        route,
        LIGHT=light,
    )
    ask = found.asks["force"]
    assert found.status == "ok", found.error
    assert _is_told(float(ask.value), ask.error, light / (1 + light) * 3.0**2 * 0.7)  # type: ignore[arg-type]


@pytest.mark.parametrize("route", [*ROUTES, "uniform"])
@pytest.mark.parametrize("e", [0.3, 0.62, 0.9])
def test_7_losses_and_limits_of_bounces(route: str, e: float) -> None:
    text = """
        until = "UNTIL"
        bodies.b = { mass = "1 kg", at = [0, "1.3 m"] }
        events.blow = "floor strikes"
        ask.t = "t"
        ask.lost = { of = "energy.lost", unit = "J" }
        """
    first = math.sqrt(2 * 1.3 / G)
    for until, time, lost in (
        ("blow 6", first * (1 + 2 * sum(e**k for k in range(1, 6))), G * 1.3 * e**10 * (1 - e**2)),
        ("rest", first * (1 + e) / (1 - e), None),
    ):
        found = _run(text + FLOOR, route, UNTIL=until, RESTITUTION=e)
        assert found.status == "ok", found.error
        for ask, truth in ((found.asks["t"], time), (found.asks["lost"], lost)):
            assert truth is None or _is_told(float(ask.value), ask.error, truth), (until, ask, truth)  # type: ignore[arg-type]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("slope", [1, 15, 45])
def test_8_rest_on_an_incline_is_decided(route: str, slope: float) -> None:
    """A block that slides down until friction stops it."""
    s, mu = math.radians(slope), math.tan(math.radians(slope)) + 0.3
    found = _run(
        """
        until = "rest"
        bodies.b = { mass = "1 kg", at = [0, 0] }
        ground.lines.f = { through = [0, 0], angle = "SLOPE deg" }
        contacts.floor = { touch = ["b", "ground.f"], friction = MU }
        start."b.velocity" = ["(-2 m/s)*cos(SLOPE deg)", "(-2 m/s)*sin(SLOPE deg)"]
        ask.t = "t"
        """,
        route,
        SLOPE=slope,
        MU=mu,
    )
    ask = found.asks["t"]
    assert found.status == "ok", found.error
    assert _is_told(float(ask.value), ask.error, 2 / (G * (mu * math.cos(s) - math.sin(s))))  # type: ignore[arg-type]


def _dragged(p: dict[str, float]) -> tuple[float, float]:
    """17.11 by hand, in feet: the block's way if its cord is long enough, and its cylinder's speed."""
    g, r, q = 32.2, p["r_outer"] / 12, 0.5
    pulley, drag = 30 / g * (p["k_pulley"] / 12) ** 2, 0.25 * 20 * q
    alpha = (p["W_A"] * r - drag) / (pulley + p["W_A"] / g * r**2 + 20 / g * q**2)
    spin = math.sqrt(2 * alpha * 3 / r)
    return q * (3 / r + spin**2 / (2 * drag / (pulley + 20 / g * q**2))), spin * r


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(20))
def test_12_a_cord_that_has_no_length_left_says_so(route: str, seed: int) -> None:
    draw = random.Random(seed)
    units = {"k_pulley": "in", "W_A": "lb", "r_outer": "in"}
    drawn = {"k_pulley": draw.uniform(5, 11), "W_A": draw.uniform(20, 75), "r_outer": draw.uniform(5, 11)}
    distance, speed = _dragged(drawn)
    scene = planemotion.load(CHAPTER / "17-011.toml").with_values({"solve.route": route})
    found = scene.run(**{key: f"{value!r} {units[key]}" for key, value in drawn.items()})
    assert abs(float(found.asks["a_v_A"].value)) == pytest.approx(speed, rel=1e-8)  # type: ignore[arg-type]
    if distance > 10:
        assert found.status == "strand_ends"
        assert found.asks["b_distance_B"].value is None
    else:
        assert found.status == "ok", found.error
        assert float(found.asks["b_distance_B"].value) == pytest.approx(distance, rel=1e-8)  # type: ignore[arg-type]


@pytest.mark.parametrize("route", ["auto", "uniform"])
@pytest.mark.parametrize("too_far", [1e-2, 1e-4, 1e-5, 2e-6, -1e-6, -1e-5, -1e-3])
@pytest.mark.parametrize("seed", range(3))
def test_12_a_strand_that_ends_just_before_the_block_stops(route: str, too_far: float, seed: int) -> None:
    draw = random.Random(seed)
    drawn = {"W_A": draw.uniform(20, 75), "r_outer": draw.uniform(5, 11)}
    drawn["k_pulley"] = brentq(
        lambda k: _dragged({**drawn, "k_pulley": k})[0] - 10 * (1 + too_far), 1, 40, xtol=1e-14
    )
    scene = planemotion.load(CHAPTER / "17-011.toml").with_values({"solve.route": route})
    units = {"k_pulley": "in", "W_A": "lb", "r_outer": "in"}
    found = scene.run(**{key: f"{value!r} {units[key]}" for key, value in drawn.items()})
    assert found.status == ("strand_ends" if too_far > 0 else "ok"), found.error


def _angular_speed(damping: float) -> float:
    """Of a parallelogram of rods of 1 m and 1 kg that falls from upright with 4 rad/s, at -150 degrees."""

    def rates(_: float, x: np.ndarray) -> list[float]:
        return [x[1], (-2 * G * math.cos(x[0]) - damping * x[1]) / (5 / 3)]

    def there(_: float, x: np.ndarray) -> float:
        return float(x[0] + math.radians(150))

    there.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rates, (0, 10), [math.pi / 2, -4], "DOP853", events=there, rtol=1e-13, atol=1e-13)
    return float(found.y_events[0][0][1])


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("damping", [0, 0.1, 2])
def test_9_a_four_bar_passes_its_flat_position_in_any_order(route: str, damping: float) -> None:
    joints = [("a.P", "ground.O"), ("b.P", "a.Q"), ("c.Q", "b.Q"), ("c.P", "ground.E")]
    expected = _angular_speed(damping)
    for order in permutations(range(4)):
        lines = "\n".join(f'joints.J{i} = {{ pin = ["{joints[i][0]}", "{joints[i][1]}"] }}' for i in order)
        found = _run(
            """
            until = "a.angle < (-150 deg)"
            ground.points = { O = [0, 0], E = ["1 m", 0] }
            bodies.a = { rod = ["P", "Q"], length = "1 m", mass = "1 kg", angle = "90 deg", at.P = [0, 0] }
            bodies.b = { rod = ["P", "Q"], length = "1 m", mass = "1 kg", angle = 0, at.P = [0, "1 m"] }
            parameters.L = "1 m"
            bodies.c = { rod = ["P", "Q"], length = "L", mass = "1 kg", angle = "90 deg", at.P = ["L", 0] }
            forces.d = { damper = ["a", "ground"], rate = "DAMPING N*m*s" }
            start.a.omega = "-4 rad/s"
            ask.omega = "a.omega"
            """
            + lines,
            route,
            DAMPING=damping,
        )
        ask = found.asks["omega"]
        assert found.status == "ok"
        assert float(ask.value) == pytest.approx(expected, abs=1e-8)  # type: ignore[arg-type]
        assert abs(float(ask.value) - expected) <= 10 * float(ask.error) + 1e-10  # type: ignore[arg-type]
        assert found.counts["steps"] < 200


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("omega", "until"), [(9, 1), (9, 10), (3, 2)])
def test_10_a_force_that_begins_at_zero(route: str, omega: float, until: float) -> None:
    found = _run(
        """
        until = "t = UNTIL s"
        bodies.b = { mass = "1 kg", at = [0, 0] }
        forces.f = { force = "b", value = ["(1 N)*sin(OMEGA*t/(1 s))", 0] }
        ask.v = "b.velocity.x"
        """,
        route,
        UNTIL=until,
        OMEGA=omega,
    )
    assert found.status == "ok"
    assert _values(found)["v"] == pytest.approx((1 - math.cos(omega * until)) / omega, abs=1e-10)


@pytest.mark.parametrize("route", ROUTES)
def test_10_a_yo_yo(route: str) -> None:
    found = _run(
        """
        until = "t = 0.7 s"
        bodies.d = { disk = "0.1 m", mass = "1 kg", at = ["0.1 m", 0] }
        ground.points.O = [0, "2 m"]
        couplings.c = { cord = ["ground.O", "d.rim ccw"] }
        ask = { omega = "d.omega", y = "d.y" }
        """,
        route,
    )
    value = _values(found)
    assert found.status == "ok"
    assert abs(value["omega"]) == pytest.approx(2 / 3 * G * 0.7 / 0.1, rel=1e-11)
    assert value["y"] == pytest.approx(-G * 0.49 / 3, rel=1e-11)


@pytest.mark.parametrize("route", ["auto", "ida"])
@pytest.mark.parametrize("rate", [1e3, 1e6, 1e9])
def test_10_a_strong_damper_is_no_failure(route: str, rate: float) -> None:
    found = _run(
        """
        until = "t = 1 s"
        bodies.b = { mass = "1 kg", at = ["1 m", 0] }
        ground = { points.O = [0, 0], lines.l = { through = [0, 0], angle = 0 } }
        joints.s = { slider = ["b", "ground.l"] }
        forces.d = { damper = ["b", "ground.O"], rate = "RATE N*s/m" }
        start.b.velocity.x = "1 m/s"
        ask.x = "b.x"
        """,
        route,
        RATE=f"{rate:g}",
    )
    assert found.status == "ok"
    assert _values(found)["x"] == pytest.approx(1 + 1 / rate, abs=1e-11)


@pytest.mark.parametrize("until", [700, 1000, 3000, 10000])
def test_13_errors_do_not_collapse_on_long_runs(until: float) -> None:
    """A rod from 30 degrees off the vertical: sin(angle/2) = k sn(w t + K)."""
    found = _run(
        """
        until = "t = UNTIL s"
        bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at.A = [0, 0], angle = "-60 deg" }
        ground.points.O = [0, 0]
        joints.A = { pin = ["rod.A", "ground.O"] }
        ask = { angle = { of = "rod.angle", unit = "rad" }, omega = "rod.omega" }
        """,
        UNTIL=until,
    )
    k, w = math.sin(math.pi / 12), math.sqrt(1.5 * G)
    sn, cn, _, _ = ellipj(w * until + ellipk(k * k), k * k)
    expected = {"angle": 2 * math.asin(k * sn) - math.pi / 2, "omega": 2 * k * w * cn}
    assert found.status == "ok"
    for key, ask in found.asks.items():
        off = abs(float(ask.value) - expected[key])  # type: ignore[arg-type]
        assert off <= 1e-7
        assert off <= 10 * float(ask.error) + 1e-14 * w * until  # type: ignore[arg-type]


@pytest.mark.parametrize("side", ["5e6 m", "5e9 m"])
def test_14_an_audit_has_a_bound(side: str) -> None:
    with pytest.raises(SimulationError, match="the independent check of the run does not close"):
        planemotion.load(CHAPTER / "17-142.toml").with_values({"side_plate": side}).run()
