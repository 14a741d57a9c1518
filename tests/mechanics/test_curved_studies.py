"""The studies of curves and of gears: a cam and its follower, a race of beads, a train with losses."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import planemotion
from tests import STUDIES
from tests.scenes import ROUTES, G, number, within


@pytest.mark.parametrize("route", ROUTES)
def test_the_cam_pushes_as_its_follower_accelerates(route: str) -> None:
    """y = r - a cos 2 theta; the couple on the cam is dy/dtheta (m (y'' + g) + k y)."""
    asks = planemotion.load(STUDIES / "cam_and_follower.toml").run(**{"solve.route": route}).asks
    r, a, n, k, m = 0.04, 0.012, 10 * math.pi, 4e3, 0.5

    def force(theta: float) -> float:
        y, bend = r - a * math.cos(2 * theta), 4 * a * n**2 * math.cos(2 * theta)
        return m * (bend + G) + k * y

    def couple(theta: float) -> float:
        return 2 * a * math.sin(2 * theta) * force(theta)

    square = quad(lambda theta: couple(theta) ** 2, 0, math.pi)[0] / math.pi
    close = within(route, ida=1e-7)
    assert number(asks["height"].value) == pytest.approx(28, rel=close)
    assert number(asks["highest"].value) == pytest.approx(52, rel=close)
    assert number(asks["rms_torque"].value) == pytest.approx(math.sqrt(square), rel=close)
    most = max(couple(i * math.pi / 200000) for i in range(200000))
    assert number(asks["most_torque"].value) == pytest.approx(most, rel=1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_no_bead_beats_the_one_on_the_cycloid(route: str) -> None:
    asks = planemotion.load(STUDIES / "brachistochrone.toml").run(**{"solve.route": route}).asks
    a, begin, close = 0.5172, 0.01, within(route, ida=1e-7)
    end = brentq(lambda s: a * (s - math.sin(s)) - 2, 3, 4, xtol=1e-15)
    quickest = 2 * math.sqrt(a / G) * math.acos(math.cos(end / 2) / math.cos(begin / 2))
    parabola = 2 / math.sqrt(2 * G) * quad(lambda x: math.sqrt(1 + math.sin(x) ** 2), 0, math.pi / 2)[0]
    assert number(asks["on_the_line"].value) == pytest.approx(math.sqrt(2 * 5 / G), rel=close)
    assert number(asks["on_the_parabola"].value) == pytest.approx(parabola, rel=close)
    assert number(asks["on_the_cycloid"].value) == pytest.approx(quickest, rel=close)
    assert quickest < parabola < math.sqrt(2 * 5 / G)


def test_a_gear_train_loses_what_its_teeth_rub() -> None:
    """The work put in goes into the motion, the height of the load, and the losses."""
    scene = planemotion.load(STUDIES / "gear_train.toml")
    asks, ideal = scene.run().asks, scene.run(eta=1).asks
    motor, load = number(asks["motor_speed"].value) * math.pi / 30, number(asks["speed"].value)
    speeds = [motor, motor * 20 / 60, motor * 20 / 60 * 25 / 75, motor * 20 / 60 * 25 / 75 * 30 / 90]
    inertias = [2e-3, 4e-3, 9e-3, 0.05]
    kinetic = sum(0.5 * i * w**2 for i, w in zip(inertias, speeds, strict=True)) + 20 * load**2
    height = number(asks["height"].value)
    put_in, lost = number(asks["put_in"].value), number(asks["lost"].value)
    assert put_in - lost == pytest.approx(kinetic + 40 * G * height, rel=1e-9)
    assert lost > 0.05 * put_in
    assert number(ideal["lost"].value) == pytest.approx(0, abs=1e-9)
    assert number(ideal["speed"].value) > load


@pytest.mark.parametrize("route", ROUTES)
def test_a_ball_rolls_down_the_wavy_ramp_as_integrated(route: str) -> None:
    """Its centre goes (1 - r b) along the ramp, u' = -5/7 g t_y; then it flies.

    N/m = g n_y + u^2 b/(1 - r b), F/m = 2/7 g t_y.
    """
    asks = planemotion.load(STUDIES / "wavy_ramp.toml").run(**{"solve.route": route}).asks
    r, a, k, slope, end = 0.05, 0.03, 5.0, 0.4, 1.6

    def along(s: float) -> tuple[float, float, float]:
        """The slope, the length by s, the curvature."""
        first, size = -slope - a * k * math.sin(k * s), math.hypot(1, slope + a * k * math.sin(k * s))
        return first, size, -a * k * k * math.cos(k * s) / size**3

    def motion(_: float, y: list[float]) -> list[float]:
        first, size, bend = along(y[0])
        return [y[1] / (1 - r * bend) / size, -5 / 7 * G * first / size]

    def off(_: float, y: list[float]) -> float:
        return y[0] - end

    off.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(
        motion, (0, 3), [0.1, 0], method="DOP853", rtol=1e-13, atol=1e-14, events=off, dense_output=True
    )
    t, u = found.t[-1], found.y[1, -1]
    first, size, _ = along(end)
    x, y = end - r * first / size, -slope * end + a * math.cos(k * end) + r / size
    fall = u * first / size
    flight = (fall + math.sqrt(fall * fall + 2 * G * (y + 2))) / G

    def normal(s: float, u: float) -> float:
        _, size, bend = along(s)
        return G / size + u * u * bend / (1 - r * bend)

    pressed = [normal(*found.sol(t * i / 20000)) for i in range(20001)]
    needed = [
        2 / 7 * G * abs(along(s)[0]) / along(s)[1] / n
        for s, n in ((found.sol(t * i / 20000)[0], n) for i, n in enumerate(pressed))
    ]
    near = within(route, ida=1e-8)
    assert number(asks["t_off"].value) == pytest.approx(t, rel=near)
    assert number(asks["x_off"].value) == pytest.approx(x, rel=near)
    assert number(asks["v_off"].value) == pytest.approx(u, rel=near)
    assert number(asks["far"].value) == pytest.approx(x + u / size * flight, rel=near)
    assert number(asks["hardest"].value) == pytest.approx(2 * max(pressed), rel=1e-7)
    assert number(asks["friction_needed"].value) == pytest.approx(max(needed), rel=1e-7)
