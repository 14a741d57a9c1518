"""Starts in an equilibrium with contacts and cords: what carries, what sticks where it is drawn, what hangs
on a slack cord; beside balances of forces by hand."""

from __future__ import annotations

import math

import pytest

from tests.scenes import ROUTES, G, answers, fault
from tests.scenes.equilibria import STARTS, pendulum

BLOCK = """
until = "t = 0.2 s"
[ground.lines.slope]
through = [0, 0]
angle = "30 deg"
[ground.points]
W = { polar = ["2 m", "30 deg"] }
[bodies.block]
plate = ["0.4 m", "0.2 m"]
corners = ["A", "B", "C", "D"]
mass = "5 kg"
at = { A = [0, 0] }
angle = "30 deg"
"""


def block(friction: str, spring: str = "", **more: str) -> str:
    feet = "".join(
        f'{k} = {{ touch = ["block.{k}", "ground.slope"], friction = {friction} }}\n' for k in "AB"
    )
    return STARTS + BLOCK + "[contacts]\n" + feet + spring + more.get("rest", "")


SPRING = """
[forces.spring]
spring = ["block.G", "ground.H"]
stiffness = "100 N/m"
free_length = "1 m"
[ground.points.H]
from = "W"
by = { polar = ["0.1 m", "120 deg"] }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_block_on_a_smooth_slope_hangs_on_a_spring(route: str) -> None:
    """The spring runs along the slope through its centre; both feet carry."""
    text = (
        block('"smooth"', SPRING)
        + """
[ask]
stretch = "spring.stretch"
normal = "A.normal + B.normal"
speed = "block.G.speed"
"""
    )
    found = answers(text, route)
    assert found["stretch"] == pytest.approx(5 * G * 0.5 / 100, rel=1e-11)
    assert found["normal"] == pytest.approx(5 * G * math.cos(math.pi / 6), rel=1e-11)
    assert found["speed"] < 1e-10


def test_what_sticks_stays_where_it_is_drawn() -> None:
    text = block("0.6") + '[ask]\nmoved = "block.G.moved.norm"\nf = "A.friction + B.friction"\n'
    found = answers(text)
    assert found["moved"] < 1e-14
    assert abs(found["f"]) == pytest.approx(5 * G / 2, rel=1e-12)


def test_friction_that_cannot_hold_it_is_told() -> None:
    text = fault(block("0.5"))
    assert "many equilibria" in text
    assert "contacts." in text
    assert "has 0.5" in text
    bearing = pendulum(-40, "").replace(
        'pin = ["AB.A", "ground"]', 'pin = ["AB.A", "ground"]\nfriction_couple = "FR N*m"'
    )
    assert "joints.A" in fault(STARTS + bearing.replace("FR", "2"))
    held = answers(STARTS + bearing.replace("FR", "60"))
    assert held["angle"] == pytest.approx(-math.radians(40), abs=1e-14)


def test_a_block_on_a_running_belt() -> None:
    """It slides, the spring holds what the belt draws."""
    text = """
start = "equilibrium"
until = "t = 0.3 s"
[ground]
lines.belt = { through = [0, 0], angle = 0 }
points.W = ["-1 m", "0.1 m"]
[bodies.block]
plate = ["0.4 m", "0.2 m"]
corners = ["A", "B", "C", "D"]
mass = "5 kg"
at = [0, "0.1 m"]
[contacts]
A = { touch = ["block.A", "ground.belt"], friction = 0.3, surface_speed = "2 m/s" }
B = { touch = ["block.B", "ground.belt"], friction = 0.3, surface_speed = "2 m/s" }
[forces.spring]
spring = ["block.G", "ground.W"]
stiffness = "50 N/m"
free_length = "1 m"
[ask]
stretch = "spring.stretch"
speed = "block.G.speed"
"""
    found = answers(text)
    assert found["stretch"] == pytest.approx(0.3 * 5 * G / 50, rel=1e-9)
    assert found["speed"] < 1e-9


BALL = """
start = "equilibrium"
until = "t = 0.2 s"
[ground]
lines.floor = { through = [0, 0], angle = 0 }
points.W = [0, "2 m"]
[bodies.ball]
disk = "0.1 m"
mass = "2 kg"
at = [0, "HEIGHT m"]
[contacts.floor]
touch = ["ball.rim", "ground.floor"]
friction = "smooth"
[forces.spring]
spring = ["ball.center", "ground.W"]
stiffness = "K N/m"
free_length = "1 m"
[ask]
height = "ball.y"
normal = "floor.normal"
"""


@pytest.mark.parametrize(("height", "stiffness"), [(0.1, 10), (0.5, 10), (0.1, 100), (0.7, 100)])
def test_a_ball_on_a_spring_above_a_floor(height: float, stiffness: float) -> None:
    """A weak spring lets it down to the floor; a strong one lifts it off."""
    found = answers(BALL.replace("HEIGHT", str(height)).replace('"K N', f'"{stiffness} N'))
    free = 1 - 2 * G / stiffness
    assert found["height"] == pytest.approx(max(0.1, free), rel=1e-12)
    assert found["normal"] == pytest.approx(max(0.0, 2 * G - stiffness * 0.9), abs=1e-10)


def test_where_friction_would_come_to_hold_is_fault() -> None:
    text = BALL.replace("HEIGHT", "0.5").replace('"K N', '"10 N').replace('"smooth"', "0.3")
    assert "come to touch" in fault(text)


def test_a_weight_on_a_slack_cord() -> None:
    """It sinks and swings below the hook until the cord carries it."""
    text = """
start = "equilibrium"
until = "t = 0.2 s"
bodies.bob = { mass = "2 kg", at = ["0.3 m", "-0.4 m"] }
ground.points.hook = [0, 0]
couplings.cord = { cord = ["ground.hook", "bob"], slack = "0.1 m" }
ask = { x = "bob.x", y = "bob.y", pull = "cord.tension" }
"""
    found = answers(text)
    assert found["y"] == pytest.approx(-0.6, rel=1e-12)
    assert abs(found["x"]) < 1e-12
    assert found["pull"] == pytest.approx(2 * G, rel=1e-12)
