"""Two blocks and a wall: without a loss the blows count digits of pi, and velocities turn in circles."""

from __future__ import annotations

import math
from typing import Any

import pytest

import planemotion

SCENE = """
until = "t = 10 s"
plane = "horizontal"
[ground]
lines = { wall = { through = [0, 0], angle = "-90 deg" } }
[bodies]
light = { sphere = "0.1 m", mass = "1 kg", at = ["1 m", 0] }
heavy = { sphere = "0.1 m", mass = "RATIO kg", at = ["2 m", 0] }
[contacts]
wall = { touch = ["light.rim", "ground.wall"], restitution = 1 }
meet = { touch = ["light.rim", "heavy.rim"], restitution = 1 }
[start]
heavy.velocity = ["-1 m/s", 0]
[events]
knock = "wall strikes"
clack = "meet strikes"
[solve]
estimate = ESTIMATE
[ask]
blows = "knock.count + clack.count"
light = { of = "light.velocity.x", unit = "m/s" }
heavy = { of = "heavy.velocity.x", unit = "m/s" }
"""


def velocities(ratio: float, blows: int) -> tuple[float, float]:
    """In (v_light, sqrt(ratio) v_heavy) a blow is a reflection, and two turn by a fixed angle."""
    turn, pairs = 2 * math.atan(ratio**-0.5), blows // 2
    heavy, light = -math.cos(pairs * turn), math.sqrt(ratio) * math.sin(pairs * turn)
    if blows % 2 == 0:
        return light, heavy
    common = (light + ratio * heavy) / (1 + ratio)
    return 2 * common - light, 2 * common - heavy


@pytest.mark.parametrize("estimate", ["true", "false"])
@pytest.mark.parametrize(
    ("power", "blows"), [(0, 3), (1, 31), (2, 314), (3, 3141), (4, 31415), (5, 314159), (6, 3141592)]
)
def test_blows_count_the_digits_of_pi(power: int, blows: int, estimate: str) -> None:
    ratio = 100.0**power
    scene = planemotion.load_text(SCENE.replace("RATIO", f"{ratio:.0f}").replace("ESTIMATE", estimate))
    result: Any = scene.run()
    light, heavy = velocities(ratio, blows)
    assert (result.status, result["blows"]) == ("ok", blows)
    assert result["heavy"] == pytest.approx(heavy, abs=1e-9)
    assert result["light"] == pytest.approx(light, abs=1e-9 * math.sqrt(ratio))
    if estimate == "true":
        assert abs(result["heavy"] - heavy) <= max(10 * result.asks["heavy"].error, 1e-15)
        assert abs(result["light"] - light) <= 10 * result.asks["light"].error


def test_a_limit_of_events_is_named() -> None:
    """With an extreme that is asked for no blow is passed over."""
    text = (
        SCENE.replace("RATIO", "10000").replace("ESTIMATE", "false") + 'fastest = { max = "light.speed" }\n'
    )
    result = planemotion.load_text(text.replace("[solve]", "[solve]\nmax_events = 100")).run()
    assert result.status == "limit_events"
    assert "solve.max_events (100)" in result.error
