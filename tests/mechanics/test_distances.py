"""Distances and speeds that are small for a moment are seen, wherever in a step that is."""

from __future__ import annotations

import pytest

from planemotion import load_text

FLIGHT = """
until = "t = 2 * d / (1 m/s)"
plane = "horizontal"
parameters = {{ d = "1 km", b = "0.05 m" }}
ground.points.O = [0, 0]
bodies.p = {{ mass = "1 kg", at = ["-d", "b"] }}
start.p.velocity = ["1 m/s", 0]
forces.f = {{ spring = ["p", "ground.O"], stiffness = "0 N/m", free_length = "0.2 m" }}
events.near = "{distance} < 0.1 m"
ask.n = "near.count"
ask.least = {{ min = "{distance}" }}
solve = {{ route = "{route}", max_time = "1 h", estimate = false }}
"""


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("distance", ["p.position.norm", "norm(p.x, p.y)", "f.stretch + (0.2 m)"])
def test_a_point_is_passed_right_before_a_step_ends(distance: str, route: str) -> None:
    scene = load_text(FLIGHT.format(distance=distance, route=route))
    ways = [*range(1090, 1150), *(1.07**k for k in range(110))]
    swept = scene.sweep(d=[f"{one} m" for one in ways])
    assert (swept["status"] == 0).all()
    assert (swept["n"] == 1).all()
    assert abs(swept["least"] - 0.05).max() < 1e-6
