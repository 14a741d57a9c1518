"""Beads on curves: closed forms, an independent integration, and what holds on any curve, on every route."""

# ruff: noqa: E501

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad, solve_ivp

from planemotion import SceneError, SimulationError
from tests.scenes import ROUTES, G, asked, close, on_route


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("begin", [0.3, 1.0, 2.5])
def test_a_bead_on_a_cycloid_takes_the_same_time_from_anywhere(route: str, begin: float) -> None:
    result = on_route(
        f"""
        until = "bead.x = pi*(0.5 m)"
        ground.curves.wire = {{ cycloid = "0.5 m", from = 0.01, to = 6.2, angle = "180 deg", at = ["pi m", 0] }}
        bodies.bead = {{ mass = "2 kg", at = ["pi - 0.5*({begin} - sin({begin})) m", "0"] }}
        """.replace('"pi - 0.5*(', '"(1 m)*(pi - 0.5*(')
        .replace(f'sin({begin})) m"', f'sin({begin})))"')
        .replace('["pi m", 0]', '["(1 m)*pi", 0]')
        .replace(', "0"] }', f', "-0.5*(1 - cos({begin}))*(1 m)"] }}')
        + """
        joints.slot = { slot = ["bead", "ground.wire"] }
        ask.t = "t"
        ask.N = { of = "slot.force.y", unit = "N" }
        """,
        route,
    )
    speed = math.sqrt(2 * G * 0.5 * (1 + math.cos(begin)))
    assert asked(result, "t") == pytest.approx(math.pi * math.sqrt(0.5 / G), rel=close(route))
    assert asked(result, "N") == pytest.approx(2 * (G + speed**2 / 2.0), rel=close(route))


@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_goes_round_an_ellipse_as_a_quadrature_says(route: str) -> None:
    result = on_route(
        """
        plane = "horizontal"
        until = "bead.y > 0"
        ground.curves.ring = { ellipse = ["2 m", "1 m"] }
        bodies.bead = { mass = "1 kg", at = [0, "-1 m"] }
        joints.slot = { slot = ["bead", "ground.ring"] }
        start.bead.velocity.x = "3 m/s"
        ask.t = "t"
        """,
        route,
    )
    way = quad(lambda s: math.hypot(2 * math.sin(s), math.cos(s)), -math.pi / 2, 0, epsabs=1e-13)[0]
    assert asked(result, "t") == pytest.approx(way / 3, rel=close(route))


@pytest.mark.parametrize("route", ROUTES)
def test_a_curve_that_crosses_itself_is_followed(route: str) -> None:
    result = on_route(
        """
        plane = "horizontal"
        until = "t = 10 s"
        ground.curves.eight = { x = "(2 m)*cos(s)", y = "(1 m)*sin(2*s)", from = 0, to = "2*pi", closed = true }
        bodies.bead = { mass = "1 kg", at = ["2 m", 0] }
        joints.slot = { slot = ["bead", "ground.eight"] }
        start.bead.velocity.y = "3 m/s"
        ask.x = { of = "bead.x", unit = "m" }
        ask.y = { of = "bead.y", unit = "m" }
        """,
        route,
    )
    found = solve_ivp(
        lambda t, s: [3 / math.hypot(2 * math.sin(s[0]), 2 * math.cos(2 * s[0]))],
        (0, 10), [0], rtol=1e-12, atol=1e-13, method="DOP853",
    )  # fmt: skip
    s = found.y[0, -1]
    assert asked(result, "x") == pytest.approx(2 * math.cos(s), abs=1e-8)
    assert asked(result, "y") == pytest.approx(math.sin(2 * s), abs=1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_a_curve_on_a_body_that_turns_keeps_energy_and_angular_momentum(route: str) -> None:
    result = on_route(
        """
        plane = "horizontal"
        until = "t = 3 s"
        bodies.wheel = { inertia = "2 kg*m^2", mass = "3 kg", at = [0, 0], curves.track = { ellipse = ["2 m", "1 m"] } }
        bodies.bead = { mass = "1 kg", at = ["2 m", 0] }
        joints.axle = { pin = ["wheel", "ground"] }
        joints.slot = { slot = ["bead", "wheel.track"] }
        start.bead.velocity.y = "3 m/s"
        start.wheel.omega = 0
        ask.E = { of = "energy.total", unit = "J" }
        ask.H = { of = "angular_momentum", unit = "kg*m^2/s" }
        """,
        route,
    )
    assert asked(result, "E") == pytest.approx(4.5, rel=1e-8)
    assert asked(result, "H") == pytest.approx(6.0, rel=1e-8)


def test_a_bead_with_friction_slides_down_a_circular_curve_as_on_a_circle() -> None:
    """The same slot twice, once as a circle and once as a curve."""
    common = """
        until = "t = 0.3 s"
        bodies.bead = { mass = "1 kg", at = ["1 m", 0] }
        joints.slot = { slot = ["bead", "ground.ring"], friction = 0.2 }
        ask.y = { of = "bead.y", unit = "m" }
    """
    circle, curve = (
        asked(on_route(f"ground.{mark}\n{common}"), "y")
        for mark in ('circles.ring = "1 m"', 'curves.ring = { ellipse = ["1 m", "1 m"] }')
    )
    assert curve == pytest.approx(circle, rel=1e-8)


END = """
    until = "t = 10 s"
    ground.curves.bowl = { parabola = "1 m", from = "-2 m", to = "1 m" }
    bodies.bead = { mass = "1 kg", at = ["-1.9 m", "1.9^2/4*(1 m)"] }
    joints.slot = { slot = ["bead", "ground.bowl"] }
    events.low = "bead.x > 0"
    ask.v = { of = "bead.speed", at = "low", unit = "m/s" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_the_end_of_a_curve_ends_the_run(route: str) -> None:
    result = on_route(END, route)
    assert result.status == "curve_ends"
    assert asked(result, "v") == pytest.approx(math.sqrt(2 * G * 1.9**2 / 4), rel=close(route))


@pytest.mark.parametrize(
    ("curve", "says"),
    [
        ('{ cycloid = "1 m", from = 0, to = 3 }', "at s = 0 it has a cusp"),
        ('{ x = "(1 m)*s", y = "(1 m)*s^2", from = 0, to = 1, closed = true }', "does not close"),
        ('{ x = "(1 m)*s", y = "(1 m)*abs(s)", from = -1, to = 1 }', "abs has a corner"),
        ('{ x = "(1 m)*s", y = "h(s)", from = 0, to = 1 }', "the table h has a corner"),
        ('{ x = "(1 m)*s", from = 0, to = 1 }', "a curve is"),
        ('{ arc = "1 m" }', "where s begins and ends"),
        ('{ parabola = "1 m", from = "1 m", to = "-1 m" }', "it must end later"),
    ],
)
def test_what_is_no_curve_is_told(curve: str, says: str) -> None:
    text = f"""
        until = "t = 1 s"
        tables.h = {{ at = [0, 1], value = [0, "1 m"] }}
        ground.curves.wire = {curve}
        bodies.bead = {{ mass = "1 kg", at = [0, 0] }}
        joints.slot = {{ slot = ["bead", "ground.wire"] }}
        ask.x = {{ of = "bead.x", unit = "m" }}
    """
    with pytest.raises((SceneError, SimulationError), match=says):
        on_route(text)
