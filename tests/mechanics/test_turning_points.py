"""A run that ends close to a turning point ends where the motion is then, on every route."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import mpmath
import pytest

from planemotion import load_text
from tests.scenes import number


def watched(rate: str, place: str) -> str:
    """It turns the second time; what is asked."""
    return f"""
[events]
turn = {{ when = "{rate} = 0", nth = 2 }}
[ask]
end = "t"
rate = "{rate}"
place = "{place}"
"""


def pendulum(draw: random.Random) -> str:
    length = draw.uniform(0.2, 2)
    return f"""
[bodies]
AB = {{ rod = ["A","B"], length = "{length} m", mass = "1 kg", at = {{ A = [0, 0] }}, \
angle = "{draw.uniform(-170, -10)} deg" }}
[joints]
A = {{ pin = ["AB.A","ground"] }}
[start]
AB.omega = "{draw.uniform(-0.3, 0.3) * math.sqrt(9.81 / length)} rad/s"
{watched("AB.omega", "AB.angle")}"""


def slider(draw: random.Random) -> str:
    return f"""
plane = "horizontal"
[ground]
points = {{ O = [0, 0] }}
lines = {{ L = {{ through = [0, 0] }} }}
[bodies]
P = {{ mass = "{draw.uniform(0.1, 5)} kg", at = ["{draw.uniform(0.4, 1)} m", 0] }}
[joints]
s = {{ slider = ["P.G", "ground.L"] }}
[forces]
k = {{ spring = ["P.G", "ground.O"], stiffness = "{draw.uniform(10, 900)} N/m", free_length = "0.36 m" }}
[start]
P.velocity = ["{draw.uniform(-0.5, 0.5)} m/s", 0]
{watched("P.velocity.x", "P.x")}"""


@pytest.mark.parametrize("kind", [pendulum, slider])
@pytest.mark.parametrize("seed", range(6))
def test_ends_close_to_turning_points(kind: Callable[[random.Random], str], seed: int) -> None:
    draw = random.Random(seed)
    text = kind(draw)
    turn = number(load_text(f'until = "turn"\n{text}').run().asks["end"].value)
    for power in (-2, -3, -3.5, -4, -4.5, -5):
        for sign in (-1, 1):
            t = turn * (1 + sign * 10**power * draw.uniform(0.3, 1))
            path, rk = (
                load_text(f'until = "t = {t!r} s"\n{text}').run(
                    **{"solve.route": route, "solve.accuracy": accuracy}
                )
                for route, accuracy in (("auto", 1e-10), ("rk", 1e-12))
            )
            assert path.route == ("path",)
            # A route that follows energy knows its square: of a slow motion it knows less.
            expected = number(rk.asks["rate"].value)
            assert path.asks["rate"].value == pytest.approx(expected, abs=1e-9 + 5e-12 / abs(expected))
            assert path.asks["place"].value == pytest.approx(number(rk.asks["place"].value), abs=1e-9)


# A rod on a pin, let go from the level.
LET_GO = """
[bodies]
rod = { rod = ["A", "B"], length = "1.2 m", mass = "1 kg", at.A = [0, 0] }
[joints]
A = { pin = ["rod.A", "ground"] }
[ask]
omega = "rod.omega"
angle = "rod.angle"
"""


def swing(half: int, early: str) -> tuple[float, mpmath.mpf, mpmath.mpf]:
    """A time so close to the end of a half swing; angle and omega then, by Jacobi's elliptic functions."""
    with mpmath.workdps(40):
        pace, m = mpmath.sqrt(mpmath.mpf("9.81") * 3 / (2 * mpmath.mpf("1.2"))), mpmath.mpf(1) / 2
        t = float(2 * half * mpmath.ellipk(m) / pace - mpmath.mpf(early))
        sn, cn, dn = (mpmath.ellipfun(name, pace * mpmath.mpf(t), m=m) for name in ("sn", "cn", "dn"))
        k, cd = mpmath.sqrt(m), cn / dn
        omega = -2 * k * pace * (1 - m) * sn / dn**2 / mpmath.sqrt(1 - m * cd**2)
        return t, 2 * mpmath.asin(k * cd) - mpmath.pi / 2, omega


@pytest.mark.parametrize("early", ["1e-2", "1e-4", "1e-6", "1e-8", "-1e-8", "-1e-6", "-1e-4", "-1e-2"])
@pytest.mark.parametrize("half", [1, 2, 5])
def test_what_is_told_next_to_a_turning_point_holds(half: int, early: str) -> None:
    """A speed is what is left of the energy there: known as well as rounding lets it, and no better told."""
    t, angle, omega = swing(half, early)
    result = load_text(f'until = "t = {t!r} s"\n{LET_GO}').run()
    assert result.ok
    asks = result.asks
    assert abs(number(asks["angle"].value) - angle) <= number(asks["angle"].error) <= 1e-12
    assert abs(number(asks["omega"].value) - omega) <= number(asks["omega"].error)
    assert abs(number(asks["omega"].value) - omega) <= 1e-15 / abs(float(early)) + 1e-13
