"""Cords that slip on rims: the capstan on a peg and on a wheel, wraps that change, blows, messages.

References are closed forms of motions with constant accelerations, piece by piece, and Cartesian equations
integrated by scipy, in which each strand is a line from a mass to its tangent point.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest

from tests.scenes import ROUTES, G, answers, on_route

Vector = npt.NDArray[np.float64]

ATWOOD = """
parameters = { m = "1 kg", M = "2 kg", mu = 0.3, e = 0, slack = 0 }
ground.circles.peg = { radius = "0.1 m", center = [0, "3 m"] }
bodies.A = { mass = "m", at = ["-0.1 m", "1 m"] }
bodies.B = { mass = "M", at = ["0.1 m", "1 m"] }
"""
ASKS = """
[ask]
T1 = "cable.tension[1]"
T2 = "cable.tension[2]"
slip = "cable.slip"
"""
HELD = """
couplings.cable = { cord = ["A", "ground.peg cw", "B"], friction = "mu" }
until = "t = 0.5 s"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.9, 2.5, 2.6, 4])
def test_two_weights_on_a_rough_peg(route: str, ratio: float) -> None:
    found = answers(ATWOOD + HELD + ASKS + 'y = "B.y"', route, M=f"{ratio} kg")
    most = math.exp(0.3 * math.pi)
    if 1 / most < ratio < most:
        wanted = (G, ratio * G, 0.0, 1.0)
    else:
        factor = most if ratio > 1 else 1 / most
        a = G * (ratio - factor) / (ratio + factor)
        wanted = (G + a, factor * (G + a), 0.5 * a, 1 - 0.125 * a)
    assert tuple(found.values()) == pytest.approx(wanted, abs=1e-9, rel=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_a_rope_wound_three_times_holds_a_hundred_times_its_end(route: str) -> None:
    scene = ATWOOD + HELD.replace('"mu" }', '"mu", turns = 3 }') + ASKS
    factor = math.exp(0.3 * 7 * math.pi)
    held = answers(scene, route, M=f"{0.999 * factor} kg")
    slips = answers(scene, route, M=f"{1.1 * factor} kg")
    assert held["slip"] == pytest.approx(0, abs=1e-9)
    assert slips["T2"] / slips["T1"] == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize("route", ROUTES)
def test_a_smooth_rim_or_ring_lets_it_run(route: str) -> None:
    rim = answers(ATWOOD + HELD.replace('"mu"', '"smooth"') + ASKS, route)
    ring = ATWOOD.replace("ground.circles.peg", "#") + 'ground.points.O = [0, "4 m"]\n'
    ring += HELD.replace('"ground.peg cw"', '"ground.O"').replace('"mu"', '"smooth"')
    assert rim["T1"] == pytest.approx(4 / 3 * G, rel=1e-12)
    assert rim["T1"] == rim["T2"]
    through = answers(ring + ASKS + 'v1 = "A.velocity.norm"', route)
    assert through["T1"] == pytest.approx(through["T2"], rel=1e-12)


# ---- a wheel that the cord slips on, by pieces with constant accelerations ----
WHEEL = """
until = "t = 0.5 s"
bodies.wheel = {{ disk = "0.1 m", mass = "{wheel} kg", at = [0, "3 m"] }}
bodies.A = {{ mass = "m", at = ["-0.1 m", "1 m"] }}
bodies.B = {{ mass = "M", at = ["0.1 m", "1 m"] }}
joints.O = {{ pin = ["wheel.center", "ground"] }}
couplings.cable = {{ cord = ["A", "wheel.rim cw", "B"], friction = {{ static = "mu", kinetic = "mu_k" }} }}
forces.motor = {{ couple = "wheel", value = "C" }}
start.wheel.omega = "w0"
start.A.velocity = [0, 0]
start.B.velocity = [0, 0]
events.slips = "cable slips"
events.sticks = "cable sticks"

[parameters]
mu = {static}
mu_k = {kinetic}
m = "{m} kg"
M = "{M} kg"
w0 = "{w0} rad/s"
C = "{couple} N*m"
{asks}
omega = "wheel.omega"
y = "B.y"
slips = "slips.count"
sticks = "sticks.count"
"""


@dataclass
class OnWheel:
    """Two weights over a disk of 0.1 m that a couple drives."""

    m: float = 1
    M: float = 2
    wheel: float = 2
    w0: float = 0
    couple: float = 0
    static: float = 0.3
    kinetic: float = 0.3

    def accelerations(self, sense: int) -> tuple[float, float, float, float]:
        """Of B downwards and of the wheel, and both tensions; it holds (0), passes to B (1) or to A (-1)."""
        inertia, r = 0.5 * self.wheel * 0.01, 0.1
        if sense == 0:
            a = (G * (self.M - self.m) - self.couple / r) / (self.M + self.m + inertia / r**2)
            return a, -a / r, self.m * (G + a), self.M * (G - a)
        factor = math.exp(sense * self.kinetic * math.pi)
        a = G * (self.M - factor * self.m) / (self.M + factor * self.m)
        one, other = self.m * (G + a), self.M * (G - a)
        return a, (self.couple - r * (other - one)) / inertia, one, other

    def holds_or(self) -> int:
        """0 where it holds, or the way in which it begins to slip."""
        *_, one, other = self.accelerations(0)
        most = math.exp(self.static * math.pi)
        return 0 if one <= most * other and other <= most * one else 1 if other > one else -1

    def after(self, time: float) -> dict[str, float]:
        v, omega, y, slips, sticks = 0.0, self.w0, 1.0, 0, 0
        sense = int(np.sign(self.w0)) or self.holds_or()
        while True:
            a, alpha, one, other = self.accelerations(sense)
            rate, slip = a + 0.1 * alpha, v + 0.1 * omega
            end = -slip / rate if sense and slip * rate < 0 else math.inf
            step = min(time, end)
            y -= v * step + 0.5 * a * step**2
            v, omega, time = v + a * step, omega + alpha * step, time - step
            if step < end:
                return {
                    "T1": one, "T2": other, "slip": v + 0.1 * omega, "omega": omega, "y": y,
                    "slips": slips, "sticks": sticks,
                }  # fmt: skip
            omega, sense = -v / 0.1, self.holds_or()
            sticks += sense == 0


WHEELS = [
    OnWheel(M=4),
    OnWheel(m=3, M=3.5, w0=-20),
    OnWheel(M=1.2, w0=15, static=0.5, kinetic=0.4),
    OnWheel(M=8, wheel=20, static=0.2, kinetic=0.15),
    OnWheel(m=2, couple=3),
    OnWheel(wheel=1, w0=60, static=0.25, kinetic=0.25),
    OnWheel(m=2, M=2.2, couple=0.5, static=0.35, kinetic=0.1),
    *(
        OnWheel(m, M, wheel, w0, couple, 0.3, 0.25)
        for m, M, wheel, w0, couple in np.random.default_rng(1)
        .uniform((0.5, 0.5, 0.5, -30, -3), (3, 3, 5, 30, 3), (6, 5))
        .tolist()
    ),
]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("one", WHEELS)
def test_a_wheel_that_the_cord_slips_on(route: str, one: OnWheel) -> None:
    found = answers(WHEEL.format(**vars(one), asks=ASKS), route)
    assert found == pytest.approx(one.after(0.5), rel=1e-9, abs=1e-9)


# ---- slack, and blows ----
JERK = """
couplings.cable = { cord = ["A", "ground.peg cw", "B"], friction = "mu", slack = "slack", restitution = "e" }
ground.lines.floor = { through = [0, "1 m"] }
contacts.stands = { touch = ["A", "ground.floor"] }
events.jerk = "cable tightens"
until = "jerk"
[ask]
P1 = "cable.impulse[1]"
P2 = "cable.impulse[2]"
up = "A.velocity.y"
down = "-B.velocity.y"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("e", [0, 0.5])
@pytest.mark.parametrize("mu", [0.05, 0.3])
def test_a_cord_that_tightens_over_a_rough_peg(route: str, e: float, mu: float) -> None:
    found = answers(ATWOOD + JERK, route, mu=mu, e=e, slack="0.2 m")
    v, factor = math.sqrt(2 * G * 0.2), math.exp(mu * math.pi)
    impulse = (1 + e) * v / (1 + factor / 2)
    wanted = {"P1": impulse, "P2": factor * impulse, "up": impulse, "down": v - factor * impulse / 2}
    assert found == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_the_cord_goes_slack_where_the_weight_that_falls_lands(route: str) -> None:
    scene = """
couplings.cable = { cord = ["A", "ground.peg cw", "B"], friction = "mu" }
ground.lines.floor = { through = [0, "0.5 m"] }
contacts.lands = { touch = ["B", "ground.floor"] }
events.slack = "cable slackens"
events.again = "cable tightens"
until = "again"
[ask]
when = { of = "t", at = "slack" }
pull = { of = "cable.tension[2]", at = "slack" }
flight = "again.time - slack.time"
"""
    found = answers(ATWOOD + scene, route, M="4 kg", mu=0.1)
    factor = math.exp(0.1 * math.pi)
    a = G * (4 - factor) / (4 + factor)
    v = math.sqrt(a)
    assert found == pytest.approx({"when": v / a, "pull": 0, "flight": 2 * v / G}, rel=1e-9, abs=1e-9)


# ---- what is said ----
def test_a_cord_that_leaves_its_rim() -> None:
    scene = """
until = "t = 5 s"
plane = "horizontal"
ground.circles.peg = { radius = "0.2 m", center = [0, 0] }
bodies.A = { mass = "1 kg", at = ["-1 m", "-0.3 m"] }
bodies.B = { mass = "1 kg", at = ["1 m", "-0.3 m"] }
couplings.cable = { cord = ["A", "ground.peg cw", "B"], friction = 0.3 }
forces.pull = { force = "A", value = ["-3 N", "1 N"] }
forces.draw = { force = "B", value = ["3 N", "1 N"] }
ask.t = "t"
"""
    found = on_route(scene)
    assert found.status == "strand_ends"
    assert "the cord leaves the rim that it may slip on" in found.error


@pytest.mark.parametrize(
    ("cord", "words"),
    [
        ('cord = ["A", "B"], friction = 0.3', "passes no rim between its ends"),
        ('cord = ["A", "ground.peg cw", "B"], friction = -0.3', "must not be negative"),
        ('cord = ["A", "ground.peg cw", "B"], friction = "ruff"', '"smooth", "rough"'),
        (
            'cord = ["A", "ground.peg cw", "B"], friction = [0.3, 0.2]',
            "passes 1 rims: give one friction for each",
        ),
        ('cord = ["A", "ground.peg cw", "B"], turns = 2', "turns are of a rim that the cord may slip on"),
        ('cord = ["A", "ground.peg cw", "B"], friction = 0.3, turns = 1.5', "full turns are counted"),
        ('cord = ["A", "ground.O", "B"], friction = 0.3', "lies along no part of a point"),
        (
            'cord = ["A", "ground.peg cw", "ground.nail cw", "B"], friction = 0.3',
            "two rims one after the other",
        ),
        (
            'cord = ["A", "ground.peg cw", "B"], friction = 0.3, length = "4 m"',
            "has no length; give its slack",
        ),
    ],
)
def test_messages(cord: str, words: str) -> None:
    scene = (
        ATWOOD
        + f"""
ground.circles.nail = {{ radius = "0.1 m", center = ["0.5 m", "3 m"] }}
ground.points.O = [0, "5 m"]
couplings.cable = {{ {cord} }}
until = "t = 1 s"
ask.y = "B.y"
"""
    )
    with pytest.raises(Exception, match=words.replace('"', ".")):
        answers(scene)


def test_a_cord_that_grips_has_no_slip() -> None:
    with pytest.raises(Exception, match="grips its rims"):
        answers(ATWOOD + HELD.replace(', friction = "mu"', "") + ASKS)
    with pytest.raises(Exception, match="neither slips nor sticks"):
        answers(ATWOOD + HELD.replace(', friction = "mu"', "") + 'events.e = "cable slips"\nask.y = "B.y"')
