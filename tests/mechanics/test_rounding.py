"""What is lost in last digits, and adds up: many blows, many bars, circles that graze each other."""

from __future__ import annotations

import math
import random
from functools import partial
from typing import Any

import mpmath as mp
import numpy as np
import pytest

import planemotion


def elastic_ball(height: float, drift: float, blows: int, route: str) -> Any:
    scene: dict[str, Any] = {
        "id": "ball",
        "until": f"blow {blows}",
        "ground": {"lines": {"floor": {"through": [0, 0]}}},
        "bodies": {"ball": {"mass": "1 kg", "at": [0, f"{height!r} m"]}},
        "contacts": {"floor": {"touch": ["ball", "ground.floor"], "restitution": 1}},
        "start": {"ball.velocity": [f"{drift!r} m/s", 0]},
        "events": {"blow": "floor strikes"},
        "solve": {"route": route, "accuracy": 1e-9},
        "ask": {
            "y": {"of": "ball.y", "at": "each blow", "unit": "m"},
            "x": {"of": "ball.x", "unit": "m"},
            "speed": {"of": "ball.velocity.y", "unit": "m/s"},
        },
    }
    return planemotion.Scene.from_table(scene).run()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("route", ["auto", "rk"])
def test_elastic_blows_lose_nothing(route: str, seed: int) -> None:
    draw = random.Random(seed)
    height, drift, blows = draw.uniform(0.5, 5), draw.uniform(-1, 1), 200
    found = elastic_ball(height, drift, blows, route)
    with mp.workdps(30):
        g = mp.mpf(9.81)
        speed = mp.sqrt(2 * g * mp.mpf(height))
        x = float(mp.mpf(drift) * speed / g * (2 * blows - 1))
    assert found["speed"] == pytest.approx(float(speed), rel=2e-13)
    assert found["x"] == pytest.approx(x, rel=1e-13)
    assert np.abs(np.array(found["y"], float)).max() < 1e-14 * height


def last_speed(spacing: float, radius: float, omega: float) -> tuple[int, float]:
    """A sphere over bars: T + W from bar to bar, and the ratio of the blows, in 40 digits."""
    with mp.workdps(40):
        g, r, d, square = mp.mpf(9.81), mp.mpf(radius), mp.mpf(spacing), mp.mpf(omega) ** 2
        half = mp.asin(d / (2 * r))
        drop = 10 * g * (1 - mp.cos(half)) / (7 * r)
        kept = ((mp.mpf(2) / 5 + mp.cos(2 * half)) / (mp.mpf(7) / 5)) ** 2
        bars = 0
        while (left := (square + drop) * kept - drop) >= 0:
            bars, square = bars + 1, left
        return bars, float(mp.sqrt(square))


@pytest.mark.parametrize("seed", range(6))
def test_the_last_speed_over_bars_is_within_its_error(seed: int) -> None:
    draw = random.Random(seed)
    radius = draw.uniform(0.1, 1)
    spacing, omega = radius * draw.uniform(0.05, 0.2), draw.uniform(1, 3)
    scene: dict[str, Any] = {
        "id": "bars",
        "until": "back",
        "ground": {"rows": {"bars": {"from": [0, 0], "step": [f"{spacing!r} m", 0]}}},
        "bodies": {"s": {"sphere": f"{radius!r} m", "mass": "1 kg", "at": [0, f"{radius!r} m"]}},
        "contacts": {"bars": {"touch": ["s.rim", "ground.bars"], "friction": "rough"}},
        "start": {"s.omega": f"{-omega!r} rad/s"},
        "events": {"over": f"s.x every {spacing!r} m", "back": "s.omega > 0"},
        "ask": {"last": {"of": "-s.omega", "at": {"max": "over.count"}, "unit": "rad/s"}, "n": "over.count"},
    }
    found: Any = planemotion.Scene.from_table(scene).run()
    bars, speed = last_speed(spacing, radius, omega)
    wrong, told = abs(found["last"] - speed), found.asks["last"].error
    assert found.status == "ok"
    assert found["n"] == bars
    assert wrong <= told < 1e-6 * speed


def driven_plate(gap: float, swing: float, rate: float, restitution: float, blows: int) -> dict[str, Any]:
    """A ball falls on a plate that goes up and down; plate and ball are at the origin but for the gap."""
    return {
        "id": "plate",
        "until": f"blow {blows}",
        "bodies": {
            "plate": {
                "plate": ["10 m", "0.25 m"],
                "mass": "1 kg",
                "at": [0, "-0.125 m"],
                "driven": {"at": [0, f"({swing!r} m)*sin(({rate!r} rad/s)*t) - (0.125 m)"]},
            },
            "ball": {"mass": "1 kg", "at": [0, f"{gap!r} m"]},
        },
        "contacts": {"c": {"touch": ["ball", "plate.top"], "restitution": restitution}},
        "events": {"blow": "c strikes"},
        "ask": {
            "t": {"of": "t", "unit": "s"},
            "v": {"of": "ball.velocity.y", "unit": "m/s"},
            "plate": {"of": "plate.y", "unit": "m"},
        },
    }


def last_blow(
    gap: float, swing: float, rate: float, restitution: float, blows: int
) -> tuple[Any, Any] | None:
    """Its time, and the speed after it, in 40 digits; None where a blow is so slow that it may be missed."""
    with mp.workdps(40):
        g, y, v, t = mp.mpf(9.81), mp.mpf(gap), mp.mpf(0), mp.mpf(0)
        for blow in range(blows):
            above = partial(height_above, t, y, v, swing, rate)
            step = mp.mpf(0.02) / rate
            flight = step / 50 if blow else mp.mpf(0)
            while above(flight + step) > 0:
                flight += step
            flight = mp.findroot(above, (flight, flight + step), solver="anderson", tol=1e-70)
            y, v, t = y + v * flight - g * flight**2 / 2, v - g * flight, t + flight
            plate = swing * rate * mp.cos(rate * t)
            if abs(v - plate) < 0.05:
                return None
            v = plate + restitution * (plate - v)
        return t, v


def height_above(t: Any, y: Any, v: Any, swing: float, rate: float, s: Any) -> Any:
    return y + v * s - mp.mpf(9.81) * s**2 / 2 - swing * mp.sin(rate * (t + s))


@pytest.mark.parametrize("accuracy", [1e-6, 1e-10])
def test_what_blows_make_of_rounding_is_told(accuracy: float) -> None:
    """A ball that a plate throws makes up to 1e7 times of it in seven blows: flights have no other error."""
    draw, over = random.Random(17), []
    for _ in range(30):
        given = (draw.uniform(0.1, 1), draw.uniform(0.01, 0.1), draw.uniform(5, 30), draw.uniform(0.5, 0.95))
        exact = last_blow(*given, 7)
        if exact is None:
            continue
        scene = driven_plate(*given, 7) | {"solve": {"route": "rk", "accuracy": accuracy}}
        found: Any = planemotion.Scene.from_table(scene).run()
        assert found.status == "ok"
        for key, value in zip("tv", exact, strict=True):
            over.append(abs(float(value - mp.mpf(found[key]))) / found.asks[key].error)
    assert len(over) > 40
    assert max(over) < 5
    assert sum(x <= 1 for x in over) >= 0.95 * len(over)


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_what_is_driven_is_where_the_drive_says(route: str) -> None:
    """Of a scene of 10 m, to the rounding of 0.1 m: a blow by it is no less exact than where it strikes."""
    draw, wrong = random.Random(18), []
    for _ in range(20):
        swing, rate = draw.uniform(0.01, 0.1), draw.uniform(5, 30)
        scene = driven_plate(draw.uniform(0.1, 1), swing, rate, 0.5, 1) | {"solve": {"route": route}}
        found: Any = planemotion.Scene.from_table(scene).run()
        with mp.workdps(30):
            exact = swing * mp.sin(rate * mp.mpf(found["t"])) - mp.mpf(0.125)
            wrong.append(abs(float(mp.mpf(found["plate"]) - exact)))
    assert max(wrong) < 2e-15, wrong


def grazing(draw: random.Random, route: str) -> tuple[dict[str, Any], bool]:
    """A disk passes another: they touch where the centres come nearer than the sum of the radii."""
    radii = [draw.uniform(0.02, 0.2) for _ in "ab"]
    both = sum(radii)
    beside = both * (1 + draw.choice([-1, 1]) * 10 ** draw.uniform(-4, -1))
    angle, speed = draw.uniform(0, 2 * math.pi), draw.uniform(0.5, 3)
    away = both * draw.uniform(2.2, 7)
    along, across = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    shared = [draw.uniform(-2, 2) for _ in "xy"]
    at = [beside * across[i] - away * along[i] for i in (0, 1)]
    velocity = [speed * along[i] + shared[i] for i in (0, 1)]
    scene = {
        "id": "graze",
        "until": f"t = {2 * away / speed!r} s",
        "bodies": {
            "a": {"disk": f"{radii[0]!r} m", "mass": "1 kg", "at": [f"{x!r} m" for x in at]},
            "b": {"disk": f"{radii[1]!r} m", "mass": "1 kg", "at": [0, 0]},
        },
        "contacts": {"c": {"touch": ["a.rim", "b.rim"], "restitution": 1}},
        "start": {
            "a.velocity": [f"{x!r} m/s" for x in velocity],
            "b.velocity": [f"{x!r} m/s" for x in shared],
        },
        "events": {"hit": "c strikes"},
        "ask": {"n": "hit.count"},
        "solve": {"route": route, "accuracy": 10 ** -draw.uniform(5, 10)},
    }
    return scene, beside < both


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_disks_that_graze_are_struck(route: str) -> None:
    draw = random.Random(5)
    for _ in range(150 if route == "rk" else 40):
        scene, touches = grazing(draw, route)
        found = planemotion.Scene.from_table(scene).run()
        assert (found.status, found["n"]) == ("ok", touches), scene
