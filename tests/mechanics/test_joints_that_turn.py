"""Joints that share loads on bodies that turn: which of their constraints are left out changes on the way."""

from __future__ import annotations

import math
import random

import pytest
from scipy.integrate import solve_ivp

import planemotion
from tests.scenes import ROUTES, G, number

FASTENED = """
until = "t = {end!r} s"
[bodies.arm]
rod = ["A", "B"]
length = "1 m"
mass = "2 kg"
at = {{ A = [0, 0] }}
angle = "{tilt!r} rad"
points = {{ P = ["{p!r} m", 0], Q = ["{q!r} m", 0] }}
[bodies.box]
plate = ["0.4 m", "0.1 m"]
mass = "1 kg"
at = {{ P = "arm.P" }}
angle = "{tilt!r} rad"
points = {{ P = ["-0.1 m", 0], Q = ["{apart!r} m", 0] }}
[joints]
A = {{ pin = ["arm.A", "ground"] }}
p = {{ pin = ["box.P", "arm.P"] }}
q = {{ pin = ["box.Q", "arm.Q"] }}
[start]
arm.omega = "{omega!r} rad/s"
[ask]
turned = {{ of = "arm.turned", unit = "rad" }}
omega = "arm.omega"
"""

HELD = """
until = "t = {end!r} s"
plane = "horizontal"
[bodies.table]
disk = "2 m"
mass = "5 kg"
at = [0, 0]
driven = {{ omega = "{omega!r} rad/s" }}
points.H = ["{x!r} m", "{y!r} m"]
lines.slot = {{ through = [0, "{y!r} m"], angle = 0 }}
[bodies]
bead = {{ mass = "1 kg", at = ["{x!r} m", "{y!r} m"] }}
[joints]
slot = {{ slider = ["bead", "table.slot"] }}
hold = {{ pin = ["bead", "table.H"] }}
[events]
go = {{ when = "table.turned = {free!r} rad", do = [{{ remove = "hold" }}] }}
[ask]
x = "bead.x in table"
speed = "bead.speed"
"""


def answers(text: str, route: str) -> dict[str, tuple[float, float]]:
    """Values with their errors."""
    run = planemotion.load_text(text).run(**{"solve.route": route})
    assert run.status == "ok", run.error
    return {key: (number(ask.value), number(ask.error)) for key, ask in run.asks.items()}


def within(found: tuple[float, float], true: float) -> None:
    value, error = found
    assert error < 1e-7
    assert abs(value - true) <= 10 * error + 1e-11 * max(1, abs(true))


@pytest.mark.parametrize("route", ROUTES)
def test_a_box_that_two_pins_fasten_to_an_arm_that_goes_round(route: str) -> None:
    draw = random.Random(17)
    for _ in range(4):
        p, q = draw.uniform(-0.3, 0), draw.uniform(0.1, 0.4)  # from the middle of the arm
        tilt, omega, end = draw.uniform(-3, 3), draw.uniform(-12, 12), draw.uniform(1, 3)
        inertia = 2 / 3 + (0.4**2 + 0.1**2) / 12 + (p + 0.6) ** 2
        moment = (2 * 0.5 + p + 0.6) * G
        swing = solve_ivp(
            lambda _, y, c=moment / inertia: [y[1], -c * math.cos(y[0])],
            (0, end),
            [tilt, omega],
            method="DOP853",
            rtol=1e-13,
            atol=1e-14,
        ).y[:, -1]
        found = answers(FASTENED.format(end=end, tilt=tilt, p=p, q=q, apart=q - p - 0.1, omega=omega), route)
        within(found["turned"], swing[0] - tilt)
        within(found["omega"], swing[1])


@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_that_a_pin_holds_in_a_slot_until_it_is_let_go(route: str) -> None:
    draw = random.Random(3)
    for _ in range(6):
        x, y, omega = draw.uniform(0.1, 1), draw.choice([0, draw.uniform(-0.3, 0.3)]), draw.uniform(2, 8)
        free, more = draw.uniform(1.7, 9), draw.uniform(0.5, 2)
        found = answers(HELD.format(end=(free + more) / omega, x=x, y=y, omega=omega, free=free), route)
        out, rate = x * math.cosh(more), omega * x * math.sinh(more)
        within(found["x"], out)
        within(found["speed"], math.hypot(rate - omega * y, omega * out))
