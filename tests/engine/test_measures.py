"""Measures that are composed of several, against the kernel's own motion."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planemotion import SceneError, load_text
from planemotion.compile.flatten import flatten
from tests.engine.scenes import PENDULUM, answers_to
from tests.scenes.parts import on_axle, plate


def test_directions_and_moving_axes_agree_with_their_components() -> None:
    a = answers_to(
        {
            "angle": "AB.angle",
            "spin": "AB.omega",
            "x": "AB.B.velocity.x",
            "y": "AB.B.velocity.y",
            "norm": "AB.B.speed",
            "heading": "AB.B.velocity.angle",
            "along": "AB.B.velocity along 25 deg",
            "along_slope": "AB.B.velocity along ground.slope",
            "along_own": "AB.B.velocity along AB.own",
            "seen": "AB.B.velocity.y in C",
            "seen_along": "AB.A.velocity along AB.own in AB",
            "fx": "A.force.x",
            "fy": "A.force.y",
            "fx_own": "A.force.x in AB",
            "f_norm_own": "A.force.norm in AB",
            "f_along": "A.force along AB.own",
            "fx_ground": "A.force.x on ground",
            "relative": "C.omega in AB",
            "C_spin": "C.omega",
        }
    )
    c, s = math.cos(a["angle"]), math.sin(a["angle"])
    phi = math.radians(20)
    assert a["norm"] == pytest.approx(math.hypot(a["x"], a["y"]))
    assert a["heading"] == pytest.approx(math.atan2(a["y"], a["x"]))
    assert a["along"] == pytest.approx(
        a["x"] * math.cos(math.radians(25)) + a["y"] * math.sin(math.radians(25))
    )
    assert a["along_slope"] == pytest.approx(a["x"] * math.cos(phi) + a["y"] * math.sin(phi))
    turned = a["angle"] + phi
    assert a["along_own"] == pytest.approx(a["x"] * math.cos(turned) + a["y"] * math.sin(turned))
    assert a["seen"] == pytest.approx(0, abs=1e-12)
    assert a["seen_along"] == pytest.approx(0, abs=1e-12)
    assert a["fx_own"] == pytest.approx(a["fx"] * c + a["fy"] * s)
    assert a["f_norm_own"] == pytest.approx(math.hypot(a["fx"], a["fy"]))
    assert a["f_along"] == pytest.approx(a["fx"] * math.cos(turned) + a["fy"] * math.sin(turned))
    assert a["fx_ground"] == -a["fx"]
    assert a["relative"] == pytest.approx(a["C_spin"] - a["spin"])
    assert a["C_spin"] == pytest.approx(3)


def test_sums_of_the_scene() -> None:
    a = answers_to(
        {
            "weight": "weight",
            "weights": "AB.weight + C.weight",
            "px": "momentum.x",
            "own_px": "AB.momentum.x + C.momentum.x",
            "kinetic": "energy.kinetic",
            "own_kinetic": "AB.kinetic_energy + C.kinetic_energy",
            "total": "energy.total",
            "parts": "energy.kinetic + energy.potential",
            "spin": "angular_momentum about ground.O",
            "own_spin": "AB.angular_momentum about ground.O + C.angular_momentum about ground.O",
            "inertia": "AB.inertia about AB.A",
        },
        PENDULUM + "ground.points.O = [0, 0]\n",
    )
    assert a["weight"] == pytest.approx(4 * 9.81)
    for one, other in (
        ("weight", "weights"),
        ("px", "own_px"),
        ("kinetic", "own_kinetic"),
        ("total", "parts"),
    ):
        assert a[one] == pytest.approx(a[other])
    assert a["spin"] == pytest.approx(a["own_spin"])
    assert a["inertia"] == pytest.approx(3 * 1.44 / 3)


SLIDING_BOX = f"""
until = "t = 0.1 s"
ground.lines.floor = {{ through = [0, 0], angle = "-30 deg" }}
{plate("box", "2 m", "1 m", "4 kg", at={"A": [0, 0]}, angle="-30 deg")}
[contacts]
floor = {{ touch = ["ground.floor", "box.corners"], friction = 0.1 }}
"""


def test_the_members_of_a_set_add_up_and_signs_follow_the_first_partner() -> None:
    scene = load_text(SLIDING_BOX)
    for key, ask in {
        "normal": "floor.normal",
        "first": "floor[0].normal",
        "second": "floor[1].normal",
        "closed": "floor.closed",
        "force_y": "floor.force.y",
        "on_box": "floor.force.y on box",
        "gap": "floor.gap",
        "gap_3": "floor[2].gap",
        "friction": "floor.friction",
        "needed": "floor.friction_needed",
        "acceleration": "box.acceleration along -30 deg",
    }.items():
        scene.ask(key, ask)
    a: dict[str, Any] = {key: ask.value for key, ask in scene.run().asks.items()}
    weight, c, s = 4 * 9.81, math.cos(math.pi / 6), math.sin(math.pi / 6)
    assert a["normal"] == pytest.approx(weight * c)
    assert a["first"] + a["second"] == pytest.approx(a["normal"])
    assert a["closed"] == 2
    # The first partner is the ground, which the box presses down.
    assert a["force_y"] == -a["on_box"]
    assert a["on_box"] == pytest.approx(weight * c * (c + 0.1 * s))
    assert abs(a["friction"]) == pytest.approx(0.1 * weight * c)
    assert a["needed"] == pytest.approx(0.1)
    assert a["gap"] == pytest.approx(0, abs=1e-9)
    assert a["gap_3"] == pytest.approx(1)
    assert a["acceleration"] == pytest.approx(9.81 * (s - 0.1 * c))


def test_the_normal_force_of_a_slider_is_on_the_left_of_its_line() -> None:
    text = """
until = "t = 0.1 s"
ground.lines.slope = { through = [0, 0], angle = "30 deg" }
bodies.P = { mass = "2 kg", at = [0, 0] }
joints.j = { slider = ["P", "ground.slope"] }
ask.normal = "j.normal"
"""
    assert load_text(text).run().normal == pytest.approx(2 * 9.81 * math.cos(math.pi / 6))


def test_a_mass_may_be_left_out_where_it_cannot_matter() -> None:
    text = f"""
until = "t = 1 s"
{on_axle(inertia="2 kg*m^2")}
forces.motor = {{ couple = "wheel", value = "4 N*m" }}
ask.omega = "wheel.omega"
"""
    scene = load_text(text)
    assert scene.run().omega == pytest.approx(2)
    for measure in ("wheel.mass", "axle.force.y", "weight", "momentum.x"):
        with pytest.raises(
            SceneError, match=r"the mass of wheel is needed for this; give bodies\.wheel\.mass"
        ):
            flatten(load_text(text + f'ask.a = "{measure}"\n'))
