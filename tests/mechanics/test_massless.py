"""Bodies without mass: what the rest of the scene makes of them, and what is said where it makes nothing."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests.scenes import G, answers
from tests.scenes.parts import body, on_axle

PULLED = f"""
until = "t = 1.5 s"
parameters = {{ P = "7 N" }}
ground.lines.up = {{ through = ["0.2 m", 0], angle = "90 deg" }}
{on_axle("drum", disk="0.2 m", mass="15 kg")}
{body("hook", mass=0, at=["0.2 m", "1 m"])}
joints.guide = {{ slider = ["hook", "ground.up"] }}
couplings.cord = {{ cord = ["drum.rim ccw", "hook"] }}
forces.pull = {{ force = "hook", value = [0, "P"] }}
[ask]
omega = "drum.omega"
tension = "cord.tension"
side = "guide.normal"
work = "pull.work"
"""


@pytest.mark.parametrize("route", ["auto", "rk"])
def test_the_end_of_a_cord_is_pulled(route: str) -> None:
    values = answers(PULLED, route)
    omega = 7 * 0.2 / 0.3 * 1.5
    assert values["omega"] == pytest.approx(omega, rel=1e-10)
    assert values["tension"] == pytest.approx(7, rel=1e-10)
    assert values["side"] == pytest.approx(0, abs=1e-10)
    assert values["work"] == pytest.approx(0.5 * 0.3 * omega**2, rel=1e-10)


def test_what_nothing_determines_is_told() -> None:
    with pytest.raises(planemotion.SimulationError, match=r"bodies\.hook: it has no mass, and nothing else"):
        planemotion.load_text(PULLED).run(P="-7 N")


def test_mass_is_not_negative() -> None:
    with pytest.raises(planemotion.SceneError, match=r"bodies\.hook\.mass .* must not be negative"):
        planemotion.load_text(PULLED.replace("mass = 0", 'mass = "-1 kg"')).run()


SHAKEN = """
until = "t = 0.3 s"
bodies.p = {{ mass = "{driven} kg", at = [0, 0], driven = {{ at = ["({a} m)*sin(({w} rad/s)*t)", "0 m"] }} }}
bodies.rod = {{ rod = ["A", "B"], length = "{l} m", mass = 0, at = {{ A = [0, 0] }}, angle = "{q} rad" }}
bodies.bob = {{ mass = "{bob} kg", at = "rod.B" }}
joints.A = {{ pin = ["rod.A", "p"] }}
joints.B = {{ pin = ["rod.B", "bob"] }}
[ask]
angle = "rod.angle"
alpha = "rod.alpha"
"""


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("ratio", [1.0, 1e3, 1e6, 1e9, 1e12])
def test_what_is_driven_may_be_heavy_beside_the_bob(route: str, ratio: float) -> None:
    """l alpha = -g cos(angle) - (acceleration of the pin) sin(angle), whatever both masses are."""
    draw = random.Random(ratio)
    for _ in range(4):
        l, a, w = draw.uniform(0.3, 2), draw.uniform(0.05, 0.3), draw.uniform(3, 12)
        q, driven = draw.uniform(-3, 0), 10 ** draw.uniform(-3, 3)
        text = SHAKEN.format(driven=driven, bob=driven / ratio, l=l, a=a, w=w, q=q)
        found = answers(text, route)
        pin = -a * w**2 * math.sin(w * 0.3)
        wanted = (-G * math.cos(found["angle"]) + pin * math.sin(found["angle"])) / l
        assert found["alpha"] == pytest.approx(wanted, abs=1e-9 * (G + a * w**2) / l)
