"""Belts with what stands beside them: bearings that rub, blows, drives, wheels out of balance, equilibria."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from scipy import integrate, optimize

from tests.mechanics.belt_scenes import Vector, Wheels
from tests.scenes import ROUTES, G, answers, close


@pytest.mark.parametrize("route", ROUTES)
def test_bearings_rub_by_what_the_belt_draws(route: str) -> None:
    """The belt drives b; both bearings feel its pull, and b turns on at what is left."""
    one = replace(Wheels(), time=0.3)
    text = one.text.replace(
        'pin = ["b", "ground"]', 'pin = ["b", "ground"], friction = { mu = 0.2, radius = "2 cm" }'
    )
    found = answers(text, route)
    force = -one.most()
    rubs = 0.2 * 0.02 * math.hypot(*one.load(force))
    assert found["wb"] == pytest.approx((-force * one.r2 - rubs) / one.i2 * 0.3, rel=1e-10)


def test_a_belt_that_grips_has_tensions() -> None:
    """Of a wheel that a couple turns: T_1 - T_2 turns the other one."""
    text = replace(Wheels(), w1=0.0, time=1.0).text.replace("friction = 0.3\n", "")
    text = (
        text.replace("events.", "#").replace("slip = ", "#").replace("heat = ", "#").replace("sticks = ", "#")
    )
    found = answers(
        text.replace("[couplings", 'forces.C = { couple = "a", value = "30 N*m" }\n[couplings', 1)
    )
    ratio = 0.1 / 0.25
    alpha = 30 / (0.3 + 0.8 * ratio**2)
    force = (0.3 * alpha - 30) / 0.1
    assert found["wb"] == pytest.approx(ratio * alpha, rel=1e-11)
    assert found["T1"] == pytest.approx(50 + force / 2, rel=1e-11)
    assert found["T2"] == pytest.approx(50 - force / 2, rel=1e-11)


@pytest.mark.parametrize("route", ROUTES)
def test_an_impulse_is_not_passed_on(route: str) -> None:
    """A wheel that is struck slips, until the belt has taken the other one along."""
    text = replace(Wheels(), w1=0.0, time=3.0).text
    text = text.replace(
        "[couplings.belt]",
        'events.hit = { when = "t = 1 s", do = [{ impulse = "a", value = "12 N*m*s" }] }\n[couplings.belt]',
    )
    found = answers(
        text + 'just = { of = "b.omega", at = "hit" }\nwhen = "sticks.time - slips.time"\n', route
    )
    wanted = Wheels(time=2.0).after()
    assert found["just"] == pytest.approx(0, abs=1e-12)
    assert found["when"] == pytest.approx(0.9022118603443253, rel=1e-9)
    assert {key: found[key] for key in ("wa", "wb", "heat")} == pytest.approx(
        {key: wanted[key] for key in ("wa", "wb", "heat")}, rel=1e-9
    )


@pytest.mark.parametrize("friction", ["", ", friction = 0.4"])
def test_a_jerk_at_a_wheel(friction: str) -> None:
    """A block falls into a cord that is wound on one wheel: a belt that grips takes the other wheel along."""
    found = answers(f"""
until = "jerk"
bodies.a = {{ disk = "0.2 m", mass = "4 kg", at = [0, 0] }}
bodies.b = {{ disk = "0.1 m", mass = "6 kg", at = ["-0.7 m", 0] }}
bodies.block = {{ mass = "2 kg", at = ["0.2 m", "-1 m"] }}
joints.A = {{ pin = ["a.center", "ground"] }}
joints.B = {{ pin = ["b.center", "ground"] }}
couplings.cord = {{ cord = ["a.rim cw", "block"], slack = "0.5 m" }}
couplings.belt = {{ belt = ["a.rim", "b.rim"], pretension = "70 N"{friction} }}
events.jerk = "cord tightens"
[ask]
a = "a.omega"
b = "b.omega"
impulse = "cord.impulse"
""")
    inertia = 0.5 * 4 * 0.04 + (0 if friction else 0.5 * 6 * 0.01 * 4)
    speed = math.sqrt(2 * G * 0.5)
    omega = -2 * speed * 0.2 / (inertia + 2 * 0.04)
    wanted = {"a": omega, "b": 0 if friction else 2 * omega, "impulse": -inertia * omega / 0.2}
    assert found == pytest.approx(wanted, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("route", ROUTES)
def test_a_belt_that_comes_and_goes(route: str) -> None:
    """Put on at 1 s, and taken off at 1.4 s: until then and from then on nothing draws at the axles."""
    text = (
        replace(Wheels(), time=2.0)
        .text.replace("friction = 0.3", "friction = 0.3\nactive = false")
        .replace(
            "[couplings.belt]",
            'events.put = { when = "t = 1 s", do = [{ add = "belt" }] }\n'
            'events.taken = { when = "t = 1.4 s", do = [{ remove = "belt" }] }\n[couplings.belt]',
        )
    )
    asked = "".join(
        f'{name} = {{ of = "{of}", at = {{ each = "t", values = ["0.9 s", "1.1 s", "1.5 s"] }} }}\n'
        for name, of in (("axle", "A.force.x on a"), ("pull", "belt.tension[2]"), ("spin", "b.omega"))
    )
    found = answers(text.replace("heat =", "#").replace('slip = "belt.slip"', "") + asked, route)
    one = replace(Wheels(), time=0.1)
    wanted = one.after()
    assert found["axle"] == pytest.approx([0, wanted["Ax"], 0], rel=1e-9, abs=1e-9)
    assert found["pull"] == pytest.approx([0, wanted["T2"], 0], rel=1e-9, abs=1e-9)
    assert found["spin"] == pytest.approx([0, wanted["wb"], 4 * wanted["wb"]], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("driven", ['omega = "w"', 'at = [0, 0], angle = "w*t"'])
def test_a_wheel_that_is_driven(route: str, driven: str) -> None:
    """Its axle is its drive; the other wheel gains speed by the belt, until it runs along."""
    one = Wheels(time=2.0)
    text = one.text.replace("at = [0, 0]", f"at = [0, 0], driven = {{ {driven} }}")
    for line in ('joints.A = { pin = ["a.center", "ground"] }\n', 'a.omega = "40.0 rad/s"\n'):
        text = text.replace(line, "")
    text = text.replace("plane =", 'parameters.w = "40 rad/s"\nplane =').replace("A.force", "a.driven.force")
    text = text.replace(" on a\n", "\n").replace(' on a"', '"')
    asked = (
        'end = "sticks.time"\ncouple = { of = "a.driven.couple", at = { each = "t", values = ["0.2 s"] } }\n'
    )
    found = answers(text + asked, route)
    assert found["wb"] == pytest.approx(40 * one.r1 / one.r2, rel=1e-9)
    assert found["end"] == pytest.approx(40 * one.r1 / one.r2 * one.i2 / (one.r2 * one.most()), rel=1e-9)
    assert found["couple"] == pytest.approx([one.most() * one.r1], rel=1e-9)
    assert found["heat"] == pytest.approx(0.5 * one.i2 * found["wb"] ** 2, rel=1e-9)
    assert found["Ax"] == pytest.approx(one.after()["Ax"], rel=1e-3)


LEVER = """
until = "a.turned = -60 deg"
bodies.a = { disk = "0.2 m", mass = "3 kg", mass_center = ["5 cm", 0], at = [0, 0] }
bodies.b = { disk = "0.1 m", mass = "2 kg", at = ["0.8 m", 0] }
joints.A = { pin = ["a.center", "ground"] }
joints.B = { pin = ["b.center", "ground"] }
couplings.belt = { belt = ["a.rim", "b.rim"], pretension = "T", friction = 0.3 }
parameters.T = "80 N"
ask.wa = "a.omega"
ask.wb = "b.omega"
ask.t = "t"
"""


@pytest.mark.parametrize("route", [*ROUTES, "path"])
def test_a_wheel_that_falls_out_of_balance(route: str) -> None:
    """While the belt holds, by work and energy; along the path no friction is there that may be overcome."""
    found = answers(LEVER.replace(", friction = 0.3", "") if route == "path" else LEVER, route)
    inertia = 0.5 * 3 * 0.04 + 3 * 0.05**2 + 0.5 * 2 * 0.01 * 4
    omega = -math.sqrt(2 * 3 * G * 0.05 * math.sin(math.pi / 3) / inertia)
    assert found["wa"] == pytest.approx(omega, rel=1e-8)
    assert found["wb"] == pytest.approx(2 * omega, rel=1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_a_wheel_that_falls_out_of_balance_under_a_loose_belt(route: str) -> None:
    """Beside scipy: it slips at once, for its moment is greatest there."""
    found = answers(LEVER, route, T="2 N")
    most = Wheels(r1=0.2, r2=0.1, d=(0.8, 0), tension=2).most()
    inertia = 0.5 * 3 * 0.04 + 3 * 0.05**2

    def rates(_: float, y: Vector) -> list[float]:
        moment = -3 * G * 0.05 * math.cos(y[0]) + most * 0.2
        return [y[1], moment / inertia, -most * 0.1 / (0.5 * 2 * 0.01)]

    def end(_: float, y: Vector) -> float:
        return y[0] + math.pi / 3

    end.terminal = True  # type: ignore[attr-defined]
    solved = integrate.solve_ivp(
        rates, (0, 5), [0, 0, 0], method="DOP853", rtol=1e-13, atol=1e-14, events=end
    )
    wanted = {"wa": solved.y[1, -1], "wb": solved.y[2, -1], "t": solved.t[-1]}
    assert found == pytest.approx(wanted, rel=close(route))
    assert found["wa"] * 0.2 - found["wb"] * 0.1 < -0.05


def test_it_starts_in_an_equilibrium_that_it_holds() -> None:
    """A weight on a lever turns one wheel, a spring holds the other one."""
    text = """
until = "t = 1 s"
start = "equilibrium"
bodies.a = { disk = "0.1 m", mass = "1 kg", points = { P = ["0.3 m", 0] }, at = [0, 0] }
bodies.b = { disk = "0.2 m", mass = "1 kg", at = ["1 m", 0] }
bodies.m = { mass = "2 kg", at = ["0.3 m", "-0.5 m"] }
joints.A = { pin = ["a", "ground"] }
joints.B = { pin = ["b", "ground"] }
joints.hangs = { link = ["a.P", "m"] }
couplings.belt = { belt = ["a.rim", "b.rim"], pretension = "90 N", friction = 0.6 }
forces.spring = { torsion = ["b", "ground"], stiffness = "20 N*m", free_angle = 0 }
ask.a = "a.angle"
ask.b = "b.angle"
"""
    found = answers(text)
    turned = optimize.brentq(lambda b: 2 * 2 * G * 0.3 * math.cos(2 * b) + 20 * b, -1, 0)
    assert found["b"] == pytest.approx(turned, rel=1e-6)
    assert found["a"] == pytest.approx(2 * turned, rel=1e-6)
