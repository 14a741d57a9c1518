"""Forces and couples of given power: what they do in a time is what is written."""

from __future__ import annotations

import math

import pytest

import planemotion
from tests.scenes import answers
from tests.scenes.parts import on_axle

CART = """
until = "t = 3 s"
plane = "horizontal"
parameters = { v0 = "1 m/s", P = "6 W" }
start.cart.velocity = { polar = ["v0", "30 deg"] }
[bodies]
cart = { mass = "2 kg", at = [0, 0] }
[forces]
engine = { force = "cart", power = "P" }
[ask]
speed = "cart.speed"
work = "engine.work"
direction = "cart.velocity.angle"
force = "engine.force.norm"
power = "engine.power"
"""

SHAFTS = f"""
until = "t = 2 s"
start.A.omega = "5 rad/s"
{on_axle("A", "a", inertia="3 kg*m^2", circles={"rim": "0.1 m"})}
{on_axle("B", "b", inertia="8 kg*m^2", circles={"rim": "0.2 m"}, x="0.3 m")}
[couplings]
mesh = {{ gears = ["A.rim", "B.rim"] }}
[forces]
motor = {{ couple = "A", power = "30 W" }}
brake = {{ couple = ["B", "A"], power = "-(12 W)*t/(2 s)" }}
[ask]
omega = "A.omega"
motor = "motor.work"
brake = "brake.work"
couple = "brake.couple"
"""


def test_a_force_of_given_power_goes_the_way_of_the_motion() -> None:
    values = answers(CART)
    speed = math.sqrt(1 + 2 * 18 / 2)
    assert values["speed"] == pytest.approx(speed, rel=1e-10)
    assert values["work"] == pytest.approx(18, rel=1e-10)
    assert values["direction"] == pytest.approx(math.pi / 6, rel=1e-10)
    assert values["force"] == pytest.approx(6 / speed, rel=1e-10)
    assert values["power"] == pytest.approx(6, rel=1e-12)


def test_against_the_motion_it_takes_energy() -> None:
    values = answers(CART, P="-0.2 W")
    assert values["speed"] == pytest.approx(math.sqrt(1 - 0.6), rel=1e-9)


def test_couples_of_given_power_work_on_spins_relative_to_each_other() -> None:
    values = answers(SHAFTS)
    energy = 0.5 * (3 + 8 / 4) * 25 + 60 - 12
    omega = math.sqrt(2 * energy / 5)
    assert values["motor"] == pytest.approx(60, rel=1e-10)
    assert values["brake"] == pytest.approx(-12, rel=1e-10)
    assert values["omega"] == pytest.approx(omega, rel=1e-10)
    assert values["couple"] == pytest.approx(-12 / (-0.5 * omega - omega), rel=1e-10)


def test_a_power_needs_a_motion() -> None:
    with pytest.raises(planemotion.SimulationError, match=r"forces.engine: .* a power needs a motion"):
        planemotion.load_text(CART).run(v0="0 m/s")
