"""The route ida on scenes that anybody can compute: it starts, goes on and is as accurate as asked."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests.scenes import G, answers

ACCURACIES = ("1e-6", "1e-8", "1e-10")


def on_ida(text: str, accuracy: str) -> dict[str, float]:
    return answers(text, "ida", **{"solve.accuracy": float(accuracy)})


@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_a_force_that_rises_from_nothing(accuracy: str) -> None:
    values = on_ida(
        """
until = "t = 2 s"
plane = "horizontal"
bodies.P = { mass = "1 kg", at = [0, 0] }
forces.f = { force = "P", value = ["(1 N)*sin((9 rad/s)*t)", 0] }
start.P.velocity = ["0 m/s", "0 m/s"]
ask = { x = "P.x", v = "P.velocity.x" }
""",
        accuracy,
    )
    close = float(accuracy)
    assert values["v"] == pytest.approx((1 - math.cos(18)) / 9, rel=close)
    assert values["x"] == pytest.approx((2 - math.sin(18) / 9) / 9, rel=close)


@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize(("radius", "depth"), [("0.1 m", "-0.3 m"), ("1 cm", "-2 m"), ("1 mm", "-30 m")])
def test_a_wheel_unrolls_from_a_long_cord(radius: str, depth: str, accuracy: str) -> None:
    """Rounding of its length moves the turn of a light wheel by far more than rounding of an angle."""
    values = on_ida(
        f"""
until = "t = 1 s"
ground.points.S = [0, 0]
bodies.wheel = {{ disk = "{radius}", mass = "1 kg", at = ["{radius}", "{depth}"] }}
couplings.cord = {{ cord = ["ground.S", "wheel.rim ccw"] }}
[ask]
fallen = "wheel.velocity.y"
tension = "cord.tension"
""",
        accuracy,
    )
    assert values["fallen"] == pytest.approx(-2 / 3 * G, rel=float(accuracy))
    assert values["tension"] == pytest.approx(G / 3, rel=float(accuracy))


@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize("radius", ["3 cm", "3 mm"])
def test_a_ball_slides_and_rolls_far_away(radius: str, accuracy: str) -> None:
    values = on_ida(
        f"""
until = "t = 12 s"
ground.lines.table = {{ through = [0, 0] }}
bodies.ball = {{ sphere = "{radius}", mass = "0.2 kg", at = [0, "{radius}"] }}
contacts.c = {{ touch = ["ball.rim", "ground.table"], friction = 0.2 }}
start.ball.velocity = ["5 m/s", 0]
start.ball.omega = 0
[ask]
x = "ball.x"
v = "ball.velocity.x"
""",
        accuracy,
    )
    slid = 2 / 7 * 5 / (0.2 * G)
    assert values["v"] == pytest.approx(25 / 7, rel=1e-10)
    assert values["x"] == pytest.approx(5 * slid - 0.1 * G * slid**2 + 25 / 7 * (12 - slid), rel=1e-10)


@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_a_damper_of_a_thousand_million(accuracy: str) -> None:
    """A force of 10 N has its steady speed after some 1e-9 s: far shorter than any first step."""
    values = on_ida(
        """
until = "t = 1 s"
ground = { points.S = [0, 0], lines.track = { through = [0, 0] } }
bodies.P = { mass = "1 kg", at = ["1 m", 0] }
joints.s = { slider = ["P", "ground.track"] }
[forces]
damper = { damper = ["P", "ground.S"], rate = "1e9 N*s/m" }
push = { force = "P", value = ["10 N", 0] }
[ask]
v = "P.velocity.x"
x = "P.x - (1 m)"
""",
        accuracy,
    )
    assert values["v"] == pytest.approx(1e-8, rel=1e-6)
    assert values["x"] == pytest.approx(1e-8, rel=1e-6)


DOUBLE_PENDULUM = """
until = "t = 3 s"
bodies.a = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "0 deg" }
bodies.b = { rod = ["B", "C"], length = "0.7 m", mass = "0.3 kg", at = { B = "a.B" }, angle = "-40 deg" }
joints.A = { pin = ["a.A", "ground"] }
joints.B = { pin = ["a.B", "b.B"] }
[ask]
x = "b.C.x"
omega = "b.omega"
force = "B.force.norm"
"""


@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_it_is_as_accurate_as_it_is_asked_to_be(accuracy: str) -> None:
    """A double pendulum, which amplifies errors, against the explicit route in other coordinates."""
    other = answers(DOUBLE_PENDULUM, "rk", **{"solve.accuracy": 1e-12})
    values = answers(DOUBLE_PENDULUM, "ida", **{"solve.accuracy": float(accuracy), "solve.estimate": False})
    assert values == pytest.approx(other, rel=3 * float(accuracy), abs=0)


@pytest.mark.parametrize("peg", ["1 cm", "10 um"])
@pytest.mark.parametrize("route", ["rk", "ida"])
def test_a_small_peg_far_away_makes_no_step_shorter(route: str, peg: str) -> None:
    text = f"""
until = "t = 2 s"
ground = {{ points.O = ["3 m", "-1 m"], circles.peg = {{ center = ["1 m", "5 m"], radius = "{peg}" }} }}
bodies.P = {{ mass = "1 kg", at = [0, 0] }}
contacts.c = {{ touch = ["P", "ground.peg"] }}
forces.d = {{ damper = ["P", "ground.O"], rate = "0.1 N*s/m" }}
start.P.velocity = ["3 m/s", "2 m/s"]
ask.x = "P.x"
"""
    result = planemotion.load_text(text).run(**{"solve.route": route, "solve.max_steps": 5000})
    assert result.status == "ok", result.error
    assert result.x == pytest.approx(5.621146342503826, rel=1e-9)


def test_a_yo_yo_may_hang_from_far_above() -> None:
    """Its cord is long: rounding of the point that it hangs from exceeds that of all that moves."""
    draw = random.Random(7)
    for _ in range(20):
        radius, drop, away = (
            math.exp(draw.uniform(*map(math.log, ends))) for ends in ((0.01, 0.5), (0.1, 5), (6, 50))
        )
        found = planemotion.load_text(
            f"""
            until = "b.moved.y < -({drop!r} m)"
            ground.points.P = ["-{radius!r} m", "{away!r} m"]
            bodies.b = {{ disk = "{radius!r} m", mass = "1 kg", at = [0, 0] }}
            couplings.c = {{ cord = ["ground.P", "b.rim ccw"] }}
            ask.v = "b.speed"
            ask.T = "c.tension"
            solve = {{ route = "ida", accuracy = 1e-12 }}
            """
        ).run()
        assert found.status == "ok"
        assert found["v"] == pytest.approx(math.sqrt(4 / 3 * G * drop), rel=2e-13)
        assert found["T"] == pytest.approx(G / 3, rel=2e-13)
