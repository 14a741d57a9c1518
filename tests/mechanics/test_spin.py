"""Planes that turn about an axis in them, from scenes: what is written means what the kernel does."""

from __future__ import annotations

import math

import pytest

import planemotion
from planemotion import SimulationError
from planemotion.compile.flatten import flatten
from planemotion.engine import call
from tests.scenes import G, answers
from tests.scenes.parts import rod_on_pin

# Bodies that the joints hold as drawn, off the axis and turned.
INERTIA = """
until = "start"
plane = "horizontal"
parameters = {{ m = "2 kg", a = "0.3 m", d = "0.5 m", turn = "25 deg" }}
[spin]
through = [0, 0]
angle = "0 deg"
[bodies]
one = {{ {shape}, mass = "m", at = [0, "d"], angle = "turn" }}
[start]
spin.omega = "3 rad/s"
[ask]
J = {{ of = "spin.inertia" }}
H = {{ of = "spin.momentum" }}
T = {{ of = "energy.kinetic" }}
own = {{ of = "one.kinetic_energy" }}
"""
SIN, COS = math.sin(math.radians(25)) ** 2, math.cos(math.radians(25)) ** 2


@pytest.mark.parametrize(
    ("shape", "about_centre"),  # over m a^2, about the parallel to the axis
    [
        ('rod = ["A", "B"], length = "a"', SIN / 12),
        ('rod = ["A", "B"], length = "a", depth = "2*a"', SIN / 12 + 4 / 12),
        ('disk = "a"', 1 / 4),
        ('disk = "a", edge_on = true', SIN / 4 + 1 / 4),
        ('hoop = "a", edge_on = true', SIN / 2 + 1 / 2),
        ('cylinder = "a", depth = "3*a"', 1 / 4 + 9 / 12),
        ('hoop = "a"', 1 / 2),
        ('sphere = "a"', 2 / 5),
        ('plate = ["a", "2*a"]', SIN / 12 + 4 * COS / 12),
    ],
)
def test_inertia_about_the_axis(shape: str, about_centre: float) -> None:
    values = answers(INERTIA.format(shape=shape))
    inertia = 2 * (0.5**2 + 0.3**2 * about_centre)
    assert values["J"] == pytest.approx(inertia, rel=1e-12)
    assert values["H"] == pytest.approx(3 * inertia, rel=1e-12)
    assert values["T"] == pytest.approx(4.5 * inertia, rel=1e-12)
    assert values["own"] == pytest.approx(values["T"], rel=1e-12)


def test_half_ring_about_the_line_through_its_ends() -> None:
    """Drawn so that the arc's centre is on the axis and its ends, too: m a^2 / 2."""
    text = INERTIA.format(shape='half_ring = "a"').replace('at = [0, "d"]', "at = [0, 0]")
    assert answers(text, turn="90 deg")["J"] == pytest.approx(2 * 0.3**2 / 2, rel=1e-12)


GOVERNOR = """
until = "t = 1 s"
parameters = { L = "0.4 m", m = "1.5 kg", J = "0.2 kg*m^2" }
[spin]
through = [0, 0]
angle = "90 deg"
inertia = "J"
[ground]
points = { O = [0, 0] }
[bodies]
left = { mass = "m", at = ["-L*sin(0.7)", "-L*cos(0.7)"] }
right = { mass = "m", at = ["L*sin(0.7)", "-L*cos(0.7)"] }
[joints]
l = { link = ["left", "ground.O"] }
r = { link = ["right", "ground.O"] }
[start]
spin.omega = "sqrt(g/(L*cos(0.7)))"
[ask]
x = { of = "right.x" }
omega = { of = "spin.omega" }
angle = { of = "spin.angle" }
force = { of = "r.force.norm" }
"""


def test_governor_in_equilibrium() -> None:
    values = answers(GOVERNOR)
    omega = math.sqrt(G / (0.4 * math.cos(0.7)))
    assert values["x"] == pytest.approx(0.4 * math.sin(0.7), rel=1e-9)
    assert values["omega"] == pytest.approx(omega, rel=1e-9)
    assert values["angle"] == pytest.approx(omega, rel=1e-9)
    assert values["force"] == pytest.approx(1.5 * G / math.cos(0.7), rel=1e-9)


@pytest.mark.parametrize("route", ["rk", "ida"])
def test_a_couple_turns_the_plane(route: str) -> None:
    text = GOVERNOR.replace('inertia = "J"', 'inertia = "J"\ncouple = "(0.1 N*m/s)*t"').replace(
        "[ask]", '[ask]\nH = "spin.momentum"\nE = "energy.total"'
    )
    values = answers(text, route)
    start = math.sqrt(G / (0.4 * math.cos(0.7))) * (0.2 + 3 * (0.4 * math.sin(0.7)) ** 2)
    assert values["H"] == pytest.approx(start + 0.05, rel=1e-8)
    assert values["x"] > 0.4 * math.sin(0.7)


LAPS = f"""
until = "laps"
{rod_on_pin(joint="pin", length="0.3 m", mass="0.5 kg", angle="-90 deg")}
[spin]
through = [0, 0]
angle = "90 deg"
inertia = "0.02 kg*m^2"
[start]
spin.omega = "9 rad/s"
AB.omega = "40 rad/s"
[events]
laps = "AB.turned = 40*(360 deg) + (1.1 rad)"
[ask]
swing = "AB.omega"
slowest = {{ min = "spin.omega" }}
force = {{ max = "pin.force.norm" }}
"""


def test_laps_that_repeat() -> None:
    """Round and round in the turning plane: laps computed once agree with steps in time."""
    scene = planemotion.load_text(LAPS)
    path, steps = scene.run(), scene.with_values({"solve.route": "rk"}).run()
    assert path.asks["slowest"].value == pytest.approx(9 * 0.02 / (0.02 + 0.5 * 0.3**2 / 3), rel=1e-10)
    for key, answer in path.asks.items():
        assert answer.value == pytest.approx(steps.asks[key].value, rel=1e-8)


def test_what_the_numbers_of_a_case_forbid() -> None:
    slanting = GOVERNOR.replace('angle = "90 deg"', 'angle = "80 deg"')
    with pytest.raises(
        SimulationError, match=r"spin\.angle: 1\.70349 m/s\^2 of the weight act across the axis"
    ):
        planemotion.load_text(slanting).run()
    light = 'bodies.P = { mass = "1 kg", at = [0, 0] }\nspin = { through = [0, 0], angle = "90 deg" }\n'
    with pytest.raises(SimulationError, match=r"spin\.inertia: nothing that turns has an inertia"):
        planemotion.load_text('until = "t = 1 s"\n' + light).run()


def test_recorded_in_histories() -> None:
    flat = flatten(planemotion.load_text(GOVERNOR))
    recorded = call.trace(flat, flat.defaults)
    omega = math.sqrt(G / (0.4 * math.cos(0.7)))
    assert recorded.columns["spin.omega"] == pytest.approx(omega, rel=1e-9)
    assert recorded.units["spin.inertia"] == "kg*m^2"


def test_explained_and_drawn() -> None:
    from planemotion.pictures.scene import figure, start_of
    from planemotion.report.explain import explain

    scene = planemotion.load_text(
        GOVERNOR.replace("right = {", 'fan = { disk = "5 cm", edge_on = true, mass = "1 kg" }\nright = {')
    )
    text = explain(scene).text
    assert "plane that turns about an axis in it, weight acts along -y" in text
    assert "  inertia  J" in text
    words = {one.get_text() for one in figure(start_of(scene)).axes[0].texts}
    assert {"spin", "fan"} <= words
