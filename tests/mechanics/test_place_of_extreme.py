"""What is asked where another value is extreme: the place is known as well as is told, on each route."""

from __future__ import annotations

import math
import random

import pytest

from planemotion import load_text
from tests.scenes import number

SWING = """
until = "rod.angle = -170 deg"
bodies.rod.rod = ["A", "B"]
bodies.rod.length = "{length} m"
bodies.rod.mass = "3 kg"
bodies.rod.at = {{ A = [0, 0] }}
bodies.rod.angle = "{angle} deg"
joints.A = {{ pin = ["rod.A", "ground"] }}
ask.place = {{ of = "rod.angle", at = {{ min = "rod.B.velocity.y" }}, unit = "rad" }}
solve = {{ route = "{route}", accuracy = {accuracy} }}
"""


@pytest.mark.parametrize(("route", "accuracy"), [("auto", 1e-10), ("rk", 1e-8), ("rk", 1e-10), ("ida", 1e-8)])
def test_where_the_end_of_a_rod_falls_fastest(route: str, accuracy: float) -> None:
    """From the lowest position, (cos a - cos a0) sin^2 a is greatest: 3 cos^2 a - 2 cos a cos a0 = 1."""
    draw = random.Random(17)
    for _ in range(10):
        begin = draw.uniform(-5, 75)
        text = SWING.format(length=draw.uniform(0.1, 5), angle=begin, route=route, accuracy=accuracy)
        ask = load_text(text).run().asks["place"]
        c = math.cos(math.radians(begin + 90))
        true = math.acos((c + math.sqrt(c * c + 3)) / 3) - math.pi / 2
        off = abs(number(ask.value) - true)
        assert off <= 5 * number(ask.error) <= 1e3 * accuracy, (begin, off, ask.error)
        assert route != "auto" or off < 2e-13, (begin, off)
