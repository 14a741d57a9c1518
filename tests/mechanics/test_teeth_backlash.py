"""Teeth with backlash: wheels that rattle, come to rest on a flank, and rub."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy import integrate

from tests.mechanics.tooth_scenes import I_A, I_B, PAIR, PHI, RACK
from tests.scenes import ROUTES, G, answers, within

LOOSE = PAIR.replace(
    'pressure_angle = "phi"', 'pressure_angle = "phi", backlash = "1 mm", restitution = "e"'
).replace("eta = 1", "e = 0")
HITS = """
first = { of = "t", at = "hit" }
impulse_x = { of = "mesh.impulse.x on B", at = "hit" }
impulse_y = { of = "mesh.impulse.y on B", at = "hit" }
n = "hit.count"
turned_A = "A.turned"
turned_B = "B.turned"
[events]
hit = "mesh strikes"
"""


class Falls:
    """A function that ends a step where it falls to zero."""

    terminal, direction = True, -1

    def __init__(self, of: Callable[[float, Any], float]) -> None:
        self.of = of

    def __call__(self, t: float, y: Any) -> float:
        return self.of(t, y)


def rattles(t_end: float) -> tuple[int, list[float]]:
    """Independently, e = 0: wheels apart, or together on one flank, by their ways along the pitch circles."""
    m_a, m_b = I_A / 0.1**2, I_B / 0.2**2
    t, y, flank, n = 0.0, np.zeros(4), 0, 0

    def rate(t: float, y: Any) -> list[float]:
        force = 30 * math.cos(20 * t + 0.3)
        a = [force / (m_a + m_b)] * 2 if flank else [force / m_a, 0.0]
        return [y[2], y[3], *a]

    meets = [Falls(lambda _, y, s=sense: 0.0005 - s * (y[0] - y[1])) for sense in (1, -1)]  # type: ignore[misc]
    reverses = Falls(lambda t, _: flank * math.cos(20 * t + 0.3))
    while t < t_end:
        watched = [reverses] if flank else meets
        found = integrate.solve_ivp(
            rate, (t, t_end), y, events=watched, rtol=1e-12, atol=1e-15, method="DOP853", max_step=0.01
        )
        t, y = found.t[-1], found.y[:, -1]
        if found.status == 0:
            break
        if flank:
            flank = 0
        else:
            flank, n = (1, n + 1) if len(found.t_events[0]) else (-1, n + 1)
            y[2] = y[3] = (m_a * y[2] + m_b * y[3]) / (m_a + m_b)
    return n, list(y)


@pytest.mark.parametrize("route", ROUTES)
def test_wheels_rattle_in_their_backlash(route: str) -> None:
    text = LOOSE.replace('value = "T"', 'value = "T*cos(t*(20 rad/s) + 0.3)"')
    values, close = answers(text + HITS, route), within(route, ida=1e-7)
    n, (a, b, _, speed) = rattles(0.5)
    assert n > 3
    assert values["n"] == n
    assert values["turned_A"] == pytest.approx(a / 0.1, rel=close)
    assert values["turned_B"] == pytest.approx(-b / 0.2, rel=close)
    assert values["omega"] == pytest.approx(-speed / 0.2, rel=20 * close)
    assert values["impulse_x"] == pytest.approx(abs(values["impulse_y"]) * math.tan(PHI), rel=close)
    assert values["apart"] == pytest.approx(abs(values["along"]) * math.tan(PHI), rel=close)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("e", [0, 0.6])
def test_a_wheel_that_bounces_on_a_flank_comes_to_rest_on_it(e: float, sense: int, route: str) -> None:
    """Whatever the blows: I_A omega_A + I_B omega_A/4 = T t; the first comes after half the backlash."""
    values, close = answers(LOOSE + HITS, route, e=e, T=f"{3 * sense} N*m"), within(route, ida=1e-8)
    omega = 3 * sense * 0.5 / (I_A + I_B / 4)
    first = math.sqrt(2 * 0.0005 / 0.1 * I_A / 3)
    along = (1 + e) * (3 * sense / I_A * first * 0.1) / (0.1**2 / I_A + 0.2**2 / I_B)
    assert values["omega"] == pytest.approx(-omega / 2, rel=close)
    assert values["first"] == pytest.approx(first, rel=close)
    assert values["impulse_y"] == pytest.approx(along, rel=close)
    assert values["impulse_x"] == pytest.approx(abs(along) * math.tan(PHI), rel=close)
    assert 0.1 * values["turned_A"] + 0.2 * values["turned_B"] == pytest.approx(sense * 0.0005, abs=1e-12)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("route", ROUTES)
def test_a_rack_with_backlash(route: str, sense: int) -> None:
    text = RACK.replace(
        'pressure_angle = "phi"', 'pressure_angle = "phi", backlash = "2 mm", restitution = 0.3'
    )
    values = answers(
        text + 'hit = { of = "t", at = "strike" }\n[events]\nstrike = "mesh strikes"\n',
        route,
        T=f"{3 * sense} N*m",
    )
    close = within(route, ida=1e-8)
    assert values["hit"] == pytest.approx(math.sqrt(2 * 0.001 / 0.1 * I_A / 3), rel=close)
    assert values["v"] == pytest.approx(0.4 * sense * 3 / 0.1 / 6, rel=close)
    assert 0.1 * values["omega"] == pytest.approx(values["v"], rel=close)
    assert values["axle"] == pytest.approx(2 * G - 5 * 3 / 0.1 / 6 * math.tan(PHI), rel=close)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("losses", ['friction = { mu = 0.2, radius = "3 cm" }', "efficiency = 0.9"])
def test_teeth_with_backlash_rub(losses: str, sense: int, route: str) -> None:
    """In the blow that closes the backlash, and while one flank pushes, a couple goes with the force."""
    text = LOOSE.replace('restitution = "e"', losses) + 'couple = "mesh.couple on A"\n'
    lead, c = math.cos(PHI), 0.2 * 0.03
    if "efficiency" in losses:  # (R_b cos - c) / (R_a cos + c) R_a / R_b
        c = 0.1 * lead / (0.9 / 0.1 + 1 / 0.2)
    first = math.sqrt(2 * 0.0005 / 0.1 * I_A / 3)
    into, out = 0.1 * lead + c, 0.2 * lead - c
    whole = 0.1 * into / I_A + 0.2 * out / I_B
    omega = 3 / I_A * first * (1 - 0.1 * into / I_A / whole)
    force = 0.1 * 3 / I_A / whole
    omega += (3 - into * force) / I_A * (0.5 - first)
    values, close = answers(text, route, T=f"{3 * sense} N*m"), within(route, ida=1e-8)
    assert values["omega"] == pytest.approx(-sense * omega / 2, rel=close)
    assert values["couple"] == pytest.approx(-sense * c * force, rel=close)
    assert values["size"] == pytest.approx(force, rel=close)


@pytest.mark.parametrize("route", ROUTES)
def test_no_backlash(route: str) -> None:
    text = PAIR.replace('pressure_angle = "phi"', 'pressure_angle = "phi", backlash = 0, restitution = 0.5')
    assert answers(text, route) == answers(PAIR, route)
