"""Stiff motion: forces change far faster than it.  The default sees it on `rk` and goes on with `ida`."""

from __future__ import annotations

import pytest

import planemotion
from planemotion.report.explain import explain_run
from tests.scenes import answers, number


def block(rate: str) -> str:
    """A block that 10 N push against a damper: after 1/rate it has the speed 10 N/rate."""
    return f"""
until = "t = 1 s"
ground = {{ points.S = [0, 0], lines.track = {{ through = [0, 0] }} }}
bodies.P = {{ mass = "1 kg", at = ["1 m", 0] }}
joints.s = {{ slider = ["P", "ground.track"] }}
[forces]
damper = {{ damper = ["P", "ground.S"], rate = "{rate} N*s/m" }}
push = {{ force = "P", value = ["10 N", 0] }}
[ask]
v = "P.velocity.x"
"""


@pytest.mark.parametrize("rate", ["1e5", "1e7", "1e9"])
def test_the_default_hands_over(rate: str) -> None:
    result = planemotion.load_text(block(rate)).run()
    assert result.status == "ok"
    assert "ida" in result.route
    assert number(result.v) == pytest.approx(10 / float(rate), rel=1e-9)
    assert result.counts["steps"] < 4000
    assert any("stiff" in note and "ida went on" in note for note in result.notes)


def test_a_weak_damper_stays() -> None:
    result = planemotion.load_text(block("10")).run()
    assert result.route == ("rk",)
    assert result.counts["stiff_phases"] == 0


def test_a_route_that_was_asked_for_stays_and_says_why_it_ends() -> None:
    result = planemotion.load_text(block("1e9")).run(**{"solve.route": "rk", "solve.max_steps": 4000})
    assert result.status == "limit_steps"
    assert result.error is not None
    assert 'the motion is stiff: try solve.route = "ida"' in result.error


def test_explain_tells_where() -> None:
    made = planemotion.load_text(block("1e7"))
    text = explain_run(made, made.run())
    assert "stiff: stability, not accuracy, made the steps of rk short" in text


DOOR = """
until = "t = 20 s"
plane = "horizontal"
bodies.AB = { rod = ["A", "B"], length = "1 m", mass = "3 kg", at = { A = [0, 0] }, angle = "0 deg" }
bodies.BC = { rod = ["B", "C"], length = "1 m", mass = "3 kg", at = { B = "AB.B" }, angle = "~-90 deg" }
[bodies.DC]
rod = ["D", "C"]
length = "1.5 m"
mass = "3 kg"
at = { D = ["1.5 m", "-1.5 m"] }
angle = "~120 deg"
[joints]
A = { pin = ["AB.A", "ground"] }
B = { pin = ["AB.B", "BC.B"] }
C = { pin = ["BC.C", "DC.C"] }
D = { pin = ["DC.D", "ground"] }
[forces]
closer = { torsion = ["AB", "ground"], stiffness = "10 N*m", free_angle = 1 }
brake = { damper = ["DC", "ground"], rate = "2e6 N*m*s" }
[events]
mark = "DC.turned < -5e-5"
[ask]
turned = "AB.turned"
when = { of = "t", at = "mark" }
most = { max = "abs(AB.omega)*(1 s)", unit = "1" }
"""


def test_a_braked_linkage() -> None:
    default = planemotion.load_text(DOOR).run()
    assert default.status == "ok", default.error
    assert "ida" in default.route
    other = answers(DOOR, "ida")
    for key in ("turned", "when", "most"):
        assert number(default.asks[key].value) == pytest.approx(other[key], rel=1e-7), key
