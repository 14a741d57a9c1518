"""The studies of curves and of gears: a cam and its follower, a race of beads, a train with losses."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad
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
