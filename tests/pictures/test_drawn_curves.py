"""Curves in pictures: places beside them are the nearest ones, and in motion a curve is computed once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import planemotion
from planemotion.geometry.curves import CurveMark
from planemotion.pen.sketch import Sketch
from planemotion.pictures import scene as pictures
from tests import STUDIES

OVAL = """
until = "t = 1 s"
ask.x = "oval.x"
[bodies.oval]
mass = "1 kg"
inertia = "1 kg*m^2"
mass_center = ["0.1 m", "0.2 m"]
at = ["{x} m", "{y} m"]
angle = "{turn} deg"
curves.rim = {{ ellipse = ["{a} m", "{b} m"] }}
"""


@pytest.mark.parametrize("seed", range(6))
def test_the_nearest_place_of_an_ellipse(seed: int) -> None:
    """Beside a search along the ellipse that is turned and moved by hand."""
    rng = np.random.default_rng(seed)
    given = {name: float(rng.uniform(0.5, 2)) for name in "xyab"} | {"turn": float(rng.uniform(-180, 180))}
    start = pictures.start_of(planemotion.load_text(OVAL.format(**given)))
    sketch = Sketch(start.drawing, start.poses, "mm")
    mark = start.drawing.marks("oval").curves["rim"]
    turn = math.radians(given["turn"])
    turned = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])

    def place(s: float) -> np.ndarray:
        own = np.array([given["a"] * math.cos(s), given["b"] * math.sin(s)])
        return np.asarray(1000 * (np.array([given["x"], given["y"]]) + turned @ own))

    for at in rng.uniform(-3000, 4000, (20, 2)):
        far = min(
            float(minimize_scalar(lambda s, at=at: np.hypot(*(place(s) - at)), (s, s + 0.1)).fun)
            for s in np.linspace(0, 2 * math.pi, 24)
        )
        near, along = sketch.along_curve("oval", mark, (float(at[0]), float(at[1])))
        assert math.dist(near, at) == pytest.approx(far, abs=0.02)
        # The way to it stands across the curve, unless it is as short as the error.
        if far > 20:
            away = math.atan2(near[1] - at[1], near[0] - at[0])
            assert abs(math.cos(away - along)) < 0.02


def test_a_curve_in_motion_is_computed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The cam turns in some 300 frames; each computed all places of it, and 28 s went by."""
    made = [0]
    real = CurveMark.at

    def counted(self: CurveMark, s: object) -> object:
        made[0] += 1
        return real(self, s)  # type: ignore[arg-type]

    monkeypatch.setattr(CurveMark, "at", counted)
    shown = planemotion.load(STUDIES / "cam_and_follower.toml").animate()
    assert "cam" in shown.html()
    assert 241 <= made[0] < 3000
