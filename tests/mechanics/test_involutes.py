"""Involute flanks that touch, beside toothed wheels with a pressure angle, and beside their closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

import planemotion
from tests import STUDIES
from tests.scenes import ROUTES, G, number, within

STUDY = planemotion.load(STUDIES / "involute_teeth.toml")
PINION, WHEEL = 2e-4, 9e-4  # kg*m^2


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(4))
def test_involute_flanks_push_as_gears_with_a_pressure_angle_do(seed: int, route: str) -> None:
    """The wheels turn in the ratio of their base circles, whatever their distance, under constant couples."""
    rng = np.random.default_rng(seed)
    base, ratio = float(rng.uniform(0.02, 0.05)), float(rng.uniform(0.7, 2.5))
    phi, begin = math.radians(rng.uniform(17, 28)), float(rng.uniform(0.1, 0.2))
    drive, load = float(rng.uniform(1, 3)), float(rng.uniform(0, 1))
    rate = (drive - load / ratio) / (PINION + WHEEL / ratio**2)
    # as far as both flanks are there
    end = math.sqrt(2 * min(0.5, 0.8 * (1 + ratio) * math.tan(phi) - begin) / rate)
    values = {
        "base": f"{base!r} m",
        "ratio": repr(ratio),
        "distance": f"{base * (1 + ratio) / math.cos(phi)!r} m",
        "begin": repr(begin),
        "T": f"{drive!r} N*m",
        "M": f"{load!r} N*m",
    }
    scene = planemotion.load_text(STUDY.whole_text.replace("t = 20 ms", f"t = {end!r} s"))
    asks = scene.run(**{"solve.route": route, **values}).asks
    push = (drive - PINION * rate) / base
    turned, near = math.degrees(rate * end**2 / 2), within(route, ida=1e-8)
    bearing = math.hypot(push * math.sin(phi), push * math.cos(phi) + 0.5 * G)
    for key, exact in (
        ("turned", turned),
        ("turned_by_gears", turned),
        ("ratio", ratio),
        ("push", push),
        ("push_by_gears", push),
        ("bearing", bearing),
        ("bearing_by_gears", bearing),
        ("angle_of_push", 90 - math.degrees(phi)),
    ):
        assert number(asks[key].value) == pytest.approx(exact, rel=near), key
        assert abs(number(asks[key].value) - exact) <= 3 * number(asks[key].error) + 1e-13 * abs(exact), key
