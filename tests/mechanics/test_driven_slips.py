"""Slips that joints and drives give: they turn back without a hold, and friction with them."""

# ruff: noqa: E501

from __future__ import annotations

import math

import pytest

import planemotion
from tests.mechanics.test_geneva import INERTIA, STUDY, Drive
from tests.scenes import ROUTES, G, answers, close, number

RATE, SWING, MU = 7.0, 0.2, 0.3


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("end", [0.1, 0.4, 0.6, 1.0, 1.7])
def test_friction_turns_back_with_a_table_that_goes_to_and_fro(end: float, route: str) -> None:
    """Under a block between guides: mu N against the slip, and the drive works mu N over all of its way."""
    got = answers(
        f"""
        until = "t = {end} s"
        ground.lines.guide = {{ through = [0, 0], angle = "90 deg" }}
        bodies.table = {{ plate = ["4 m", "0.2 m"], mass = "1 kg", at = [0, "-0.1 m"], driven.at = ["({SWING} m)*sin(({RATE} rad/s)*t)", "-0.1 m"] }}
        bodies.block = {{ disk = "0.1 m", mass = "1 kg", at = [0, "0.1 m"] }}
        joints.guide = {{ slider = ["block", "ground.guide"], turning = false }}
        contacts.c = {{ touch = ["block.rim", "table.top"], friction = {MU} }}
        ask.F = {{ of = "c.force.x on block", unit = "N" }}
        ask.N = {{ of = "c.normal", unit = "N" }}
        ask.work = {{ integral = "c.force.x on block * table.velocity.x", unit = "J" }}
        """,
        route,
    )
    quarters = math.floor(RATE * end / (math.pi / 2))
    from_turn = abs(math.sin(RATE * end) - round(math.sin(quarters * math.pi / 2)))
    way = SWING * (quarters + from_turn)
    assert got["N"] == pytest.approx(G, rel=close(route))
    assert got["F"] == pytest.approx(math.copysign(MU * G, math.cos(RATE * end)), rel=close(route))
    assert got["work"] == pytest.approx(MU * G * way, rel=10 * close(route))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mu", [0.1, 0.3])
def test_the_pin_of_a_geneva_drive_rubs_both_ways(mu: float, route: str) -> None:
    """Inwards and outwards along its slot: N (way of the pin along the slot +- mu half the width) = load - I a."""
    text = STUDY.whole_text
    for edge in ("left", "right"):
        text = text.replace(f'wheel.{edge}[i]"] }}', f'wheel.{edge}[i]"], friction = {mu} }}')
    early = 'early = { of = "pushed[1].normal", at = "soon", unit = "N" }\n'
    text = text.replace("[sweep]", early + "[sweep]").replace("[events]", '[events]\nsoon = "t = 0.45*turn"')
    assert text.count("friction =") == 2
    drive = Drive(4)
    asks = planemotion.load_text(text).run(**{"solve.route": route, **drive.parameters}).asks
    for key, a, way in (("push", 0.0, -1), ("early", -0.1 * math.pi, 1)):
        arm = math.sqrt(float(drive.distance(a)) ** 2 - drive.play**2) + way * mu * (drive.pin + drive.play)
        exact = (drive.load - INERTIA * drive.rate(a, 2)) / arm
        assert number(asks[key].value) == pytest.approx(exact, rel=close(route))
