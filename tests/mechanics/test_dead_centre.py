"""A slip that is zero because the mechanism reverses there: friction does not hold it."""

import pytest

import planemotion

CRANK = """
until = "rest"
[parameters]
mu = 0.1
[ground]
lines = { guide = { through = [0, 0] } }
points = { O = [0, 0] }
[bodies.crank]
rod = ["A", "B"]
length = "0.1 m"
mass = "0.1 kg"
at = { A = [0, 0] }
angle = "60 deg"
[bodies.link]
rod = ["P", "Q"]
length = "0.3 m"
mass = "0.1 kg"
at = { P = ["0.05 m", "0.0866025403784438647 m"] }
angle = "~-16.7786549 deg"
[bodies.block]
plate = ["0.02 m", "0.02 m"]
points = { C = [0, 0] }
mass = "5 kg"
[joints]
a = { pin = ["ground.O", "crank.A"] }
b = { pin = ["crank.B", "link.P"] }
c = { pin = ["link.Q", "block.C"] }
d = { slider = ["block.C", "ground.guide"], turning = false, friction = "mu" }
[start]
crank.omega = "5 rad/s"
[events]
dead = "crank.angle > (180 deg)"
[ask]
time = { of = "t", at = "dead", unit = "s" }
omega = { of = "crank.omega", at = "dead", unit = "rad/s" }
end = { of = "crank.angle", unit = "deg" }
"""


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_a_slider_crank_with_friction_passes_its_dead_centre(route: str) -> None:
    """Beside the equation of its one coordinate, integrated independently."""
    # just behind it: there the slip is zero at the same instant, and which of the two comes first is rounding
    text = CRANK.replace("(180 deg)", "(180.0001 deg)")
    result = planemotion.load_text(text + f'[solve]\nroute = "{route}"\n').run()
    assert result.ok, result.error
    assert result.asks["time"].value == pytest.approx(0.481153, abs=1e-6)
    assert result.omega == pytest.approx(14.41, abs=5e-3)
    assert result.end == pytest.approx(234.17, abs=5e-3)


def test_friction_of_nothing_does_not_stop_it() -> None:
    text = CRANK.replace('until = "rest"', 'until = "t = 0.6 s"')
    result = planemotion.load_text(text).run(mu=0)
    smooth = planemotion.load_text(text.replace(', friction = "mu"', "")).run()
    assert result.ok
    assert result.end == pytest.approx(smooth.end, rel=1e-10)
