"""Coming to rest on inclines by ever smaller blows: no decision of the last of them makes a run undecided."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests.scenes import number

FALLING = """
until = "rest"
[ground]
lines = {{ floor = {{ through = [0, 0], angle = "{slope!r} deg" }} }}
[bodies]
k = {{ {shape}mass = "1 kg", at = ["0.02 m", "0.5 m"] }}
[contacts]
c = {{ touch = ["k.{mark}", "ground.floor"], friction = {friction!r}, restitution = {restitution!r} }}
[ask]
x = "k.x"
"""
ROLLING = FALLING.replace('until = "rest"', 'until = "t = 3 s"')
PLATE = 'plate = ["{width!r} m", "{height!r} m"], corners = ["A", "B", "C", "D"], angle = "{tilt!r} deg", '
POINT, DISK = "", 'disk = "0.1 m", '


def place(text: str, route: str) -> float:
    result = planemotion.load_text(text).run(**{"solve.route": route})
    assert result.status == "ok", result.error
    return number(result.asks["x"].value)


@pytest.mark.parametrize("shape", ["plate", "point", "disk"])
def test_rest_is_decided(shape: str) -> None:
    draw = random.Random(len(shape))
    for _ in range(12):
        slope, restitution = draw.uniform(-40, 40), draw.uniform(0, 0.8)
        friction = math.tan(math.radians(abs(slope))) * draw.uniform(1.1, 2) + 0.1
        sizes = {"width": draw.uniform(0.2, 0.4), "height": draw.uniform(0.05, 0.1)}
        drawn = PLATE.format(tilt=draw.uniform(-30, 30), **sizes) if shape == "plate" else POINT
        text = (ROLLING if shape == "disk" else FALLING).format(
            slope=slope,
            friction=friction,
            restitution=restitution,
            shape=DISK if shape == "disk" else drawn,
            mark={"plate": "corners", "point": "G", "disk": "rim"}[shape],
        )
        assert place(text, "rk") == pytest.approx(place(text, "auto"), abs=1e-6)
