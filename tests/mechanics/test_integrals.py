"""Integrals, means and root mean squares over the time of a run: laws, and closed forms."""

from __future__ import annotations

import math

import pytest

from planemotion import SceneError, load_text
from tests.scenes import ROUTES, G, answers, within

OSCILLATOR = """
plane = "horizontal"
ground.points.O = [0, 0]
ground.lines.track = { through = [0, 0], angle = 0 }
bodies.m = { mass = "2 kg", at = ["0.3 m", 0] }
joints.guide = { slider = ["m", "ground.track"] }
until = "t = 40 s"
[parameters]
c = "3 N*s/m"
k = "50 N/m"
w = "4 rad/s"
[forces]
spring = { spring = ["m", "ground.O"], stiffness = "k", free_length = 0 }
damper = { damper = ["m", "ground.O"], rate = "c" }
push = { force = "m", value = ["(10 N)*sin(w*t)", 0] }
[ask]
x0 = { of = "m.x", at = "begin", unit = "m" }
x = "m.x"
v = "m.velocity.x"
work = "push.work"
E = "energy.total"
moved = { integral = "m.velocity.x" }
impulse = { integral = "push.force.x - c*m.velocity.x - k*m.x" }
power = { integral = "push.force.x*m.velocity.x", unit = "J" }
lost = { integral = "c*m.velocity.x^2" }
sway = { rms = "m.x", during = "t > (40 s) - 8*(2*pi)/w" }
bias = { mean = "m.x", during = "t > (40 s) - 8*(2*pi)/w" }
right = { integral = 1, during = "m.x > (0.01 m)" }
left = { integral = 1, during = "not m.x > (0.01 m)" }
there = { integral = "m.x", during = "m.x > (0.01 m) and t < (9 s)" }
later = { integral = "m.x", during = "m.x > (0.01 m) and t >= (9 s)" }
back = { integral = "m.x", during = "m.x <= (0.01 m)" }
all = { integral = "m.x" }
[events]
begin = "start"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_laws_of_a_driven_oscillator(route: str) -> None:
    a = answers(OSCILLATOR, route)
    near = within(route, ida=1e-8)
    assert a["moved"] == pytest.approx(a["x"] - 0.3, abs=near)
    assert a["impulse"] == pytest.approx(2 * a["v"], abs=100 * near)
    assert a["power"] == pytest.approx(a["work"], abs=100 * near)
    assert a["E"] == pytest.approx(0.5 * 50 * 0.3**2 + a["power"] - a["lost"], abs=100 * near)
    amplitude = 10 / math.hypot(50 - 2 * 16, 3 * 4)
    assert a["sway"] == pytest.approx(amplitude / math.sqrt(2), rel=1e-8)
    assert a["bias"] == pytest.approx(0, abs=1e-8)
    assert a["right"] + a["left"] == pytest.approx(40, rel=near)
    assert a["there"] + a["later"] + a["back"] == pytest.approx(a["all"], abs=10 * near)


PENDULUM = """
bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "2 kg", at = { A = [0, 0] }, angle = "-10 deg" }
joints.pin = { pin = ["rod.A", "ground"] }
until = "rod.omega = 0 rad/s"
[ask]
time = "t"
kinetic = { mean = "energy.kinetic" }
potential = { mean = "energy.potential" }
total = { of = "energy.total" }
swing = { mean = "rod.angle", unit = "deg" }
load = { mean = "pin.force.y" }
low = { integral = 1, during = "abs(rod.angle + (90 deg)) < (1e-4 rad)", unit = "s" }
omega = { max = "abs(rod.omega)" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_means_of_half_a_swing(route: str) -> None:
    """The motion is symmetric about the lowest position; on average the pin carries the weight."""
    a = answers(PENDULUM, route)
    near = within(route, ida=1e-8)
    assert a["kinetic"] + a["potential"] == pytest.approx(a["total"], abs=10 * near)
    assert a["swing"] == pytest.approx(-90, rel=near)
    assert a["load"] == pytest.approx(2 * G, rel=10 * near)
    assert a["low"] == pytest.approx(2e-4 / a["omega"], rel=1e-6)


def test_blows_are_no_part_of_the_integral_of_a_force() -> None:
    scene = load_text(
        """
        bodies.ball = { mass = "2 kg", at = [0, "1 m"] }
        ground.lines.floor = { through = [0, 0] }
        contacts.c = { touch = ["ball", "ground.floor"], restitution = 0.5, friction = 0 }
        until = "t = 3 s"
        [ask]
        force = { integral = "c.normal", unit = "N*s" }
        rest = { integral = "1", during = "c.normal > (1 N)", unit = "s" }
        rises = { integral = "1", during = "ball.velocity.y > (0 m/s)", unit = "s" }
        """
    )
    result = scene.run()
    fall = math.sqrt(2 / G)
    assert result["rest"] == pytest.approx(3 - 3 * fall, rel=1e-9)
    assert result["force"] == pytest.approx(2 * G * (3 - 3 * fall), rel=1e-9)
    assert result["rises"] == pytest.approx(fall, rel=1e-9)


def test_a_mean_over_no_time_is_undefined() -> None:
    scene = load_text(
        """
        bodies.ball = { mass = "2 kg", at = [0, "1 m"] }
        until = "t = 1 s"
        [ask]
        never = { mean = "ball.y", during = "ball.y > (5 m)" }
        nothing = { integral = "ball.y", during = "ball.y > (5 m)" }
        """
    )
    result = scene.run()
    assert result["never"] is None
    assert result["nothing"] == 0


def test_the_mean_of_a_force_that_nothing_tells_is_not_unique() -> None:
    """Of two pins that hold a rod at its ends the forces along it are shared as one likes."""
    result = load_text(
        """
        bodies.rod = { rod = ["A", "B"], length = "1 m", mass = "2 kg", at = { A = [0, 0] } }
        ground.points.P = ["1 m", 0]
        joints.a = { pin = ["rod.A", "ground"] }
        joints.b = { pin = ["rod.B", "ground.P"] }
        until = "t = 1 s"
        [ask]
        along = { mean = "a.force.x" }
        impulse = { integral = "a.force.x" }
        across = { mean = "a.force.y" }
        """
    ).run()
    assert result["along"] is None
    assert result["impulse"] is None
    assert result.asks["along"].reason.startswith("not unique")
    assert result["across"] == pytest.approx(G, rel=1e-9)


def test_integrals_are_swept() -> None:
    scene = load_text(
        """
        parameters.v = "1 m/s"
        bodies.ball = { mass = "2 kg", at = [0, 0] }
        start.ball.velocity.y = "v"
        until = "ball.y = 0 m"
        [ask]
        mean = { mean = "ball.y" }
        [sweep]
        v = { from = "1 m/s", to = "5 m/s", num = 5 }
        """
    )
    found = scene.sweep()["mean"]
    assert list(found) == pytest.approx([v**2 / 3 / G for v in range(1, 6)], rel=1e-9)


@pytest.mark.parametrize(
    ("ask", "told"),
    [
        ('{ mean = "ball.y", at = "end" }', '"mean" is over the time of the whole run'),
        (
            '{ max = "ball.y", during = "t < (1 s)" }',
            "median, percentile, amplitude, phase, not with max",
        ),
        (
            '{ mean = "ball.y", max = "ball.y" }',
            "one of of, max, min, integral, mean",
        ),
        ('{ mean = "ball.y", during = "ball.y" }', "a condition is wanted"),
        ('{ mean = "ball.y", during = "ball.y < (1 s)" }', "a length"),
        ('{ integral = "ball.y", unit = "m" }', "the answer is a quantity of length*time"),
        ('{ integral = "ball.y", during = "x > (1 s)" }', '"x"'),
    ],
)
def test_messages(ask: str, told: str) -> None:
    text = f'bodies.ball = {{ mass = "2 kg", at = [0, 0] }}\nuntil = "t = 1 s"\nask.a = {ask}\n'
    with pytest.raises(SceneError) as caught:
        load_text(text).run()
    assert told in str(caught.value)
    assert "ask.a" in str(caught.value)
