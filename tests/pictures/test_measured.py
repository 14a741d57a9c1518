"""Dimensions and velocities on request: the numbers that stand in the scene, at the start and later."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.patches import FancyArrowPatch

import planemotion
from planemotion.base.errors import SceneError, StudyError
from planemotion.pen.page import VELOCITY
from planemotion.pictures.instants import instant_of
from planemotion.pictures.measured import shown_with
from planemotion.pictures.scene import figure as figure_of
from tests import STUDIES
from tests.cli.calls import invoke, write
from tests.pictures.figures import texts

BODIES = """
until = "t = 0.5 s"
[bodies]
AB = { rod = ["A", "B"], ROD, mass = "1 kg", at = { A = [0, 0] }, angle = "30 deg", POINTS }
w = { disk = "0.25 m", mass = "2 kg", at = ["1.8 m", "0.25 m"] }
p = { plate = ["0.6 m", "0.4 m"], mass = "2 kg", at = ["1.7 m", "1 m"], angle = "15 deg" }
[ground]
lines = { floor = { through = [0, 0] } }
[joints]
A = { pin = ["AB.A", "ground"] }
[contacts]
r = { touch = ["w.rim", "ground.floor"], friction = "rough" }
[start]
AB.omega = "2 rad/s"
w.velocity.x = "1 m/s"
w.omega = "-4 rad/s"
""".replace("ROD", 'length = "1.2 m"').replace("POINTS", 'points = { C = ["0.2 m", 0] }')


def test_the_dimensions_are_those_of_the_bodies() -> None:
    figure = planemotion.load_text(BODIES).draw(show="dimensions").figure
    shown = texts(figure).split(" | ") if isinstance(texts(figure), str) else texts(figure)
    for text in ("1.2 m", "0.8 m", "0.4 m", "0.6 m", "r = 0.25 m", "30 deg"):
        assert text in shown, text
    assert not any("m/s" in text for text in shown)


def test_the_unit_is_that_of_the_scene() -> None:
    scene = planemotion.load_text(BODIES.replace('"1.2 m"', '"47.24 in"').replace(' m"', ' in"'))
    assert "47.24 in" in texts(scene.draw(show="dimensions").figure)


def test_a_number_lies_along_what_it_measures_and_is_never_upside_down() -> None:
    for degrees in (30, 100, 170, 200, 290):
        scene = planemotion.load_text(BODIES.replace("30 deg", f"{degrees} deg"))
        figure = scene.draw(show="dimensions").figure
        (text,) = [one for one in figure.axes[0].texts if one.get_text() == "1.2 m"]
        turn = (float(text.get_rotation()) + 90) % 360 - 90
        assert math.isclose((turn - degrees) % 180, 0, abs_tol=1e-6) or math.isclose(
            (turn - degrees) % 180, 180, abs_tol=1e-6
        )
        assert -90.001 <= turn <= 90.001


@pytest.mark.parametrize("at", [None, "0.2 s"])
def test_velocities_are_those_of_the_run(at: str | None) -> None:
    scene = planemotion.load_text(BODIES)
    figure = scene.draw(at=at, show=["velocities"]).figure
    FigureCanvasAgg(figure).draw()
    row = scene.history("AB.omega", "AB.velocity.norm", every="0.2 s").sel(t=0.2 if at else 0.0)
    omega, speed = (float(np.ravel(row[name])[0]) for name in ("AB.omega", "AB.velocity.norm"))
    shown = texts(figure)
    for text in (f"{abs(omega):.4g} rad/s", f"{speed:.4g} m/s", "1 m/s", "4 rad/s"):
        assert text in shown, text
    arrows = [one for one in figure.axes[0].patches if to_hex(one.get_edgecolor()) == VELOCITY]
    still = 1 if at is None else 0  # the plate falls
    assert len(arrows) == 7 - still, "three velocities, and an arc with its tip for each that turns"


def test_what_is_only_rounding_does_not_move() -> None:
    """The centre of a wheel on a pin had an arrow with 1e-15 m/s beside it."""
    scene = planemotion.load_text("""
until = "t = 1 s"
plane = "horizontal"
bodies.wheel = { disk = "0.2 m", mass = "1 kg", at = [0, 0] }
joints.A = { pin = ["wheel", "ground"] }
start.wheel.omega = "2 rad/s"
""")
    start = instant_of(scene, "0.5 s")
    moved = replace(start, velocities={"wheel": (1e-15, -1e-16, 2.0)})
    assert "m/s" not in texts(figure_of(moved, shown_with(["velocities"])))
    moved = replace(start, velocities={"wheel": (1.0, 0.0, 1e-17)})
    shown = texts(figure_of(moved, shown_with(["velocities"])))
    assert "1 m/s" in shown
    assert "rad/s" not in shown


def test_what_cannot_be_shown_is_told() -> None:
    scene = planemotion.load_text(BODIES)
    with pytest.raises(StudyError, match=r'show = "speed": unknown word "speed"; there is velo'):
        scene.draw(show="speed")
    with pytest.raises(SceneError, match="give show or as_, not both"):
        scene.draw(show="dimensions", as_="kinetic")


def test_the_command_draws_them(tmp_path: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(str(tmp_path))

    done = invoke(
        "draw", write(Path(), "a.toml", BODIES), "--show", "dimensions,velocities", "--out", "a.svg"
    )
    assert done.exit_code == 0, done.stderr
    assert Path("a.svg").read_text(encoding="utf-8").startswith("<?xml")


@pytest.mark.parametrize("study", ["slider_crank", "bouncing_ball", "thrown_ball"])
def test_velocities_end_in_the_picture(study: str) -> None:
    """The arrow of a piston at the end of its stroke left the picture, and its name pointed out of it."""
    figure = planemotion.load(STUDIES / f"{study}.toml").draw(at="0.3 s", show=["velocities"]).figure
    [axes] = figure.axes
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    arrows = [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]
    assert arrows
    for patch in arrows:
        for x, y in patch._posA_posB:  # type: ignore[attr-defined]
            assert x0 < x < x1
            assert y0 < y < y1
