"""Bodies without mass: what the rest of the scene makes of them, and what is said where it makes nothing."""

from __future__ import annotations

import pytest

import planemotion
from tests.scenes import answers
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
