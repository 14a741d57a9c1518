"""Points and circles that touch curves: blow by blow, and integrated or in closed form beside them, on every route."""

# ruff: noqa: E501

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from planemotion import SceneError, SimulationError
from tests.mechanics.curve_scenes import PARABOLA, ROLLS
from tests.scenes import ROUTES, G, asked, close, on_route

# ---- what slides and rolls ----


@pytest.mark.parametrize("mu", [0, 0.2])
@pytest.mark.parametrize("route", ROUTES)
def test_a_point_slides_in_a_bowl_as_integrated(route: str, mu: float) -> None:
    """On y = x^2/4: N = (g + v^2/2) / sqrt(1 + y'^2) in all, and friction mu N against the motion, up to its first stop."""
    result = on_route(
        f"""
        until = "{"p.velocity.x > 0" if mu == 0 else "t = 1.2 s"}"
        ground.curves.bowl = {PARABOLA}
        bodies.p = {{ mass = "2 kg", at = ["1 m", "0.25 m"] }}
        contacts.c = {{ touch = ["p", "ground.bowl"], friction = {mu} }}
        events.low = "p.x < 0"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.v = {{ of = "p.velocity.x", at = "low", unit = "m/s" }}
        ask.N = {{ of = "c.normal", at = "low", unit = "N" }}
        """,
        route,
    )

    def motion(t: float, y: np.ndarray) -> list[float]:
        x, v = y
        slope = x / 2
        size = math.hypot(1, slope)
        normal = (G + v * v / 2) / size  # per mass
        along = -G * slope / size + mu * normal  # it slides to the left
        return [v, (along - v * v / 2 * slope / size) / size]

    def bottom(t: float, y: np.ndarray) -> float:
        return float(y[0])

    bottom.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(motion, (0, 1.3), [1, 0], method="DOP853", rtol=1e-13, atol=1e-14, events=bottom)
    v = found.y_events[0][0][1]
    assert asked(result, "v") == pytest.approx(v, rel=close(route))
    assert asked(result, "N") == pytest.approx(2 * (G + v * v / 2), rel=close(route))
    if mu == 0:
        assert asked(result, "x") == pytest.approx(-1, rel=close(route))
    else:
        whole = solve_ivp(motion, (0, 1.2), [1, 0], method="DOP853", rtol=1e-13, atol=1e-14)
        assert whole.y[1, -1] < 0
        assert asked(result, "x") == pytest.approx(whole.y[0, -1], abs=close(route))


@pytest.mark.parametrize("how", sorted(ROLLS))
@pytest.mark.parametrize("route", ROUTES)
def test_a_disk_rolls_in_a_parabola_as_a_quadrature_says(route: str, how: str) -> None:
    """Its centre goes (1 - R b) ds, with 3/2 of the energy of a particle; at the bottom N = m (g + v^2 / (1/b - R))."""
    radius, begin = 0.2, 1.1
    size = math.hypot(1, begin / 2)
    at = begin - radius * begin / 2 / size, begin**2 / 4 + radius / size
    result = on_route(
        f"""
        until = "p.x < 0"
        ground.curves.bowl = {PARABOLA}
        bodies.p = {{ disk = "{radius} m", mass = "2 kg", at = ["{at[0]!r} m", "{at[1]!r} m"] }}
        {ROLLS[how]}
        ask.t = "t"
        ask.w = {{ of = "p.omega", unit = "rad/s" }}
        ask.N = {{ of = "c.normal", unit = "N" }}
        ask.F = {{ of = "c.friction", unit = "N" }}
        """,
        route,
    )

    def height(s: float) -> float:
        return s * s / 4 + radius / math.hypot(1, s / 2)

    def pace(u: float) -> float:
        """dt/du with s = s0 (1 - u^2), so that nothing is singular at the start."""
        s = begin * (1 - u * u)
        rate = math.hypot(1, s / 2)
        way = (1 - radius / 2 / rate**3) * rate
        fallen = height(begin) - height(s)
        return way / math.sqrt(2 * G * fallen / 1.5) * 2 * begin * u if u > 0 else 0

    speed = math.sqrt(2 * G * (height(begin) - radius) / 1.5)
    time = quad(pace, 1e-9, 1, epsabs=1e-13, epsrel=1e-13, limit=200)[0]
    assert asked(result, "t") == pytest.approx(time, rel=1e-8)
    assert asked(result, "w") == pytest.approx(speed / radius, rel=close(route))
    assert asked(result, "N") == pytest.approx(2 * (G + speed**2 / (2 - radius)), rel=close(route))
    assert asked(result, "F") == pytest.approx(0, abs=1e-7)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("swing", [0.05, 0.6])
def test_a_disk_rolls_in_a_cycloid_isochronously(route: str, swing: float) -> None:
    """The rim goes on the curve parallel to a cycloid at the distance R, so that the centre goes on that: its period is
    2 pi sqrt(3/2 4 a / g) whatever the swing."""
    a, radius = 1.0, 0.2
    # centre x = a (p + sin p), y = -a (1 + cos p) + 2 a ..., p from -pi to pi; the wire lies R below it.
    x, y = a * (swing + math.sin(swing)), a * (1 - math.cos(swing))
    result = on_route(
        f"""
        until = "p.velocity.x > 0"
        ground.curves.bowl = {{ x = "(1 m)*(s + sin(s)) + (0.2 m)*sin(s/2)", y = "(1 m)*(1 - cos(s)) - (0.2 m)*cos(s/2)", from = -2, to = 2 }}
        bodies.p = {{ disk = "{radius} m", mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        joints.c = {{ rolling = ["p.rim", "ground.bowl"] }}
        ask.t = "t"
        """,
        route,
    )
    assert asked(result, "t") == pytest.approx(math.pi * math.sqrt(1.5 * 4 * a / G), rel=1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_what_rolls_on_a_curve_comes_back_to_where_it_was(route: str) -> None:
    """Round an ellipse, outside, without weight: a disk turns by the way over R and once more."""
    result = on_route(
        """
        plane = "horizontal"
        until = "p.y > 0"
        ground.curves.cam = { ellipse = ["2 m", "1 m"], side = "right" }
        bodies.p = { disk = "0.5 m", mass = "1 kg", at = [0, "-1.5 m"] }
        joints.c = { rolling = ["p.rim", "ground.cam"] }
        start.p.velocity.x = "1 m/s"
        ask.turned = "p.turned"
        """,
        route,
    )
    way = quad(lambda s: math.hypot(2 * math.sin(s), math.cos(s)), -math.pi / 2, 0, epsabs=1e-14)[0]
    assert asked(result, "turned") == pytest.approx(way / 0.5 + math.pi / 2, rel=close(route))


# ---- several feet, and parting ----


@pytest.mark.parametrize("route", ROUTES)
def test_a_wheel_in_a_narrow_hollow_rests_on_both_sides(route: str) -> None:
    """R = 1 m in y = x^2: at feet s = sqrt(3)/2 the centre is 1.25 m high; each foot carries m g / (2 cos) = m g."""
    result = on_route(
        """
        until = "t = 2 s"
        ground.curves.bowl = { x = "(1 m)*s", y = "(1 m)*s^2", from = -3, to = 3 }
        bodies.p = { disk = "1 m", mass = "2 kg", at = ["0.2 m", "2 m"] }
        contacts.c = { touch = ["p.rim", "ground.bowl"] }
        ask.x = { of = "p.x", unit = "m" }
        ask.y = { of = "p.y", unit = "m" }
        ask.N = { of = "c.normal", unit = "N" }
        ask.feet = "c.closed"
        """,
        route,
    )
    assert asked(result, "feet") == 2
    assert asked(result, "x") == pytest.approx(0, abs=1e-9)
    assert asked(result, "y") == pytest.approx(1.25, rel=1e-9)
    assert asked(result, "N") == pytest.approx(4 * G, rel=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_a_point_leaves_a_round_hill_where_it_must(route: str) -> None:
    """It slides from an angle a off the top of a circle, and parts where cos b = 2/3 cos a."""
    result = on_route(
        """
        until = "c opens"
        ground.curves.hill = { ellipse = ["2 m", "2 m"], side = "right" }
        bodies.p = { mass = "1 kg", at = { polar = ["2 m", "80 deg"] } }
        contacts.c = { touch = ["p", "ground.hill"] }
        ask.y = { of = "p.y", unit = "m" }
        """,
        route,
    )
    assert asked(result, "y") == pytest.approx(4 / 3 * math.sin(math.radians(80)), rel=close(route))


@pytest.mark.parametrize("route", ROUTES)
def test_a_roller_lifts_off_its_cam_where_it_would_be_pulled(route: str) -> None:
    """Eccentric by e: y = e cos a + sqrt(L^2 - e^2 sin^2 a), L of both radii; it parts where y'' = -g."""
    e, both, rate = 0.02, 0.06, 25.0
    result = on_route(
        f"""
        until = "c opens"
        bodies.cam = {{ inertia = "1 kg*m^2", mass = "1 kg", at = [0, 0], driven.angle = "({rate} rad/s)*t", curves.profile = {{ ellipse = ["50 mm", "50 mm"], at = [0, "-20 mm"], side = "right" }} }}
        bodies.roller = {{ disk = "10 mm", mass = "0.1 kg", at = [0, "40 mm"] }}
        ground.lines.guide = {{ through = [0, 0], angle = "90 deg" }}
        joints.axle = {{ pin = ["cam", "ground"] }}
        joints.guide = {{ slider = ["roller", "ground.guide"], turning = false }}
        contacts.c = {{ touch = ["roller.rim", "cam.profile"] }}
        ask.t = "t"
        """,
        route,
    )

    def bend(angle: float) -> float:
        """y'' over the rate squared, plus g likewise; the eccentric begins below."""
        root = math.sqrt(both**2 - (e * math.sin(angle)) ** 2)
        first = -(e**2) * math.sin(angle) * math.cos(angle) / root
        second = -(e**2) * (math.cos(angle) ** 2 - math.sin(angle) ** 2) / root - first**2 / root
        return e * math.cos(angle) + second + G / rate**2

    angle = brentq(bend, 0.3, math.pi - 0.01, xtol=1e-15)
    assert asked(result, "t") == pytest.approx(angle / rate, rel=1e-8)


# ---- ends ----


@pytest.mark.parametrize("route", ROUTES)
def test_a_point_flies_off_the_end_of_a_ramp(route: str) -> None:
    """Down from 1 m to the lip at (1, 1/4) with the slope 1/2, and on as thrown."""
    result = on_route(
        """
        until = "p.y < -2 m"
        ground.curves.ramp = { x = "(1 m)*s", y = "(0.25 m)*s^2", from = -3, to = 1 }
        bodies.p = { mass = "2 kg", at = ["-2 m", "1 m"] }
        contacts.c = { touch = ["p", "ground.ramp"] }
        ask.x = { of = "p.x", unit = "m" }
        """,
        route,
    )
    v = math.sqrt(2 * G * 0.75)
    vx, vy = v / math.hypot(1, 0.5), v / 2 / math.hypot(1, 0.5)
    t = (vy + math.sqrt(vy**2 + 2 * G * 2.25)) / G
    assert result.status == "ok"
    assert asked(result, "x") == pytest.approx(1 + vx * t, rel=1e-9)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("friction", ['"rough"', "0.3", '"smooth"'])
def test_a_disk_goes_over_the_end_of_a_curve_as_over_that_of_a_line(route: str, friction: str) -> None:
    common = f"""
        until = "p.y < -2 m"
        bodies.p = {{ disk = "0.5 m", mass = "2 kg", at = ["0.3 m", "0.5 m"] }}
        contacts.c = {{ touch = ["p.rim", "ground.ramp"], friction = {friction} }}
        start.p.velocity.x = "0.3 m/s"
        start.p.omega = "-0.6 rad/s"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.w = {{ of = "p.omega", unit = "rad/s" }}
    """
    line = on_route('ground.lines.ramp = { from = ["-3 m", 0], to = ["1 m", 0] }\n' + common, route)
    curve = on_route(
        'ground.curves.ramp = { x = "(1 m)*s", y = "(0 m)*s", from = -3, to = 1 }\n' + common, route
    )
    assert line.status == curve.status == "ok"
    for ask in ("x", "w"):
        assert asked(curve, ask) == pytest.approx(asked(line, ask), rel=1e-8, abs=1e-8)


# ---- messages ----


@pytest.mark.parametrize(
    ("curve", "touch", "says"),
    [
        ('{ x = "(2 m)*cos(s)", y = "(1 m)*sin(2*s)", from = 0, to = "2*pi", closed = true }', '["p.rim", "ground.c"]', "crosses itself"),
        ('{ x = "(1 m)*s", y = "(0.015 m)*cos(60*s)", from = 0, to = 10 }', '["p.rim", "ground.c"]', "bends too sharply"),
        ('{ x = "(1 m)*s", y = "(4e149 m)*s", from = 0, to = 1e12 }', '["p.rim", "ground.c"]', "more than 1e.30 m away"),
        ('{ ellipse = ["2 m", "1 m"], side = "right" }', '["p.rim", "ground.c"]', "overlap"),
        ('{ ellipse = ["2 m", "1 m"] }', '["p.rim", "ground.c"], capture = "pin"', "a curve captures nothing"),
    ],
)  # fmt: skip
def test_what_cannot_touch_is_told(curve: str, touch: str, says: str) -> None:
    with pytest.raises((SceneError, SimulationError), match=says):
        on_route(
            f"""
            until = "t = 1.2 s"
            ground.curves.c = {curve}
            bodies.p = {{ disk = "0.1 m", mass = "1 kg", at = [0, 0], lines.edge = {{ through = [0, 0], angle = 0 }} }}
            contacts.k = {{ touch = {touch} }}
            ask.x = {{ of = "p.x", unit = "m" }}
            """
        )
