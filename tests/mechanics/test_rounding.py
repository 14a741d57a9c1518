"""What is lost in last digits, and adds up: many blows, many bars, circles that graze each other."""

from __future__ import annotations

import math
import random
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
