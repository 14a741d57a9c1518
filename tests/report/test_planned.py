"""What `explain` tells of the planner: routes, sizes, what is left out; before a run and after it."""

from __future__ import annotations

import re

import numpy as np
import pytest

import planemotion
from planemotion.compile.flatten import flatten
from planemotion.engine import call
from planemotion.report.explain import explain, explain_run
from tests import STUDIES
from tests.scenes.parts import body, rod, rod_on_pin


def plan_of(text: str) -> str:
    return explain(planemotion.load_text(text)).text.partition("\nplan\n")[2]


FALL = """
until = "t = 1 s"
bodies.ball = { mass = "1 kg", at = [0, 0] }
ask.y = { of = "ball.y", unit = "m" }
"""
SWING = f"""
until = "rod.angle = -90 deg"
{rod_on_pin("rod", angle="0 deg")}
ask.omega = {{ of = "rod.omega", unit = "rad/s" }}
"""


def test_each_rule_says_why() -> None:
    assert "uniform (no force changes" in plan_of(FALL)
    assert "path (one degree of freedom" in plan_of(SWING)
    assert "rk (solve.route says so)" in plan_of(SWING + 'solve.route = "rk"\n')
    cart = 'bodies.cart = { mass = "2 kg", at = [0, 0] }\nstart.cart.velocity = [0, 0]\n'
    free = SWING.replace('"ground"', '"cart"') + cart + 'start.rod.omega = "1 rad/s"\n'
    assert "rk (smooth motion in time" in plan_of(free)


def test_what_is_skipped() -> None:
    assert "skipped: the time (nothing asks for it)" in plan_of(SWING)
    timed = plan_of(SWING + 'ask.t = { of = "t", unit = "s" }\n')
    assert "skipped: the time" not in timed
    assert "skipped: accelerations" in timed
    felt = plan_of(SWING + 'ask.most = { max = "A.force.norm", unit = "N" }\n')
    assert "skipped: accelerations" not in felt
    assert "1 coordinate (they meet 2 constraints by themselves), 0 constraints to be solved with" in felt


TRUSS = f"""
until = "t = 1 s"
{rod_on_pin("left", "P", at={"A": ["5 m", 0]}, angle="60 deg")}
{rod("right", at={"A": "left.B"}, angle="-60 deg")}
{body("ball", mass="1 kg", at=[0, 0])}
joints.Q = {{ pin = ["left.B", "right.A"] }}
joints.R = {{ pin = ["right.B", "ground"] }}
[ask]
total = {{ of = "energy.total", unit = "J" }}
"""


def test_bodies_fixed_by_joints() -> None:
    """They are no coordinates; whoever asks for a reaction between them has their equations."""
    told = plan_of(TRUSS)
    assert "skipped: 2 bodies (fixed by their joints)" in told
    assert "2 coordinates, 0 constraints to be solved with, 2 degrees of freedom" in told
    felt = planemotion.load_text(TRUSS + 'force = { of = "Q.force.norm", unit = "N" }\n')
    assert "fixed" not in explain(felt).text
    # Half of each bar's weight comes to Q, level by symmetry: H sin 60 deg = (W/2) cos 60 deg.
    assert felt.run().force == pytest.approx(9.81 / 2 / np.tan(np.pi / 3), rel=1e-9)


def test_no_motion() -> None:
    assert "no motion is computed" in plan_of(SWING.replace('"rod.angle = -90 deg"', '"start"'))


@pytest.mark.parametrize("bars", [5, 50])
def test_phases_that_repeat_stand_on_one_line(bars: int) -> None:
    scene = planemotion.load(STUDIES / "sphere_over_bars.toml").until(f"over {bars}")
    result = scene.run()
    assert result.bars_passed == bars
    text = explain_run(scene, result)
    assert text.count("path (one degree") == 1
    assert f"{result.counts['repeated_segments']} segments that repeat passed over" in text
    assert result.counts["repeated_segments"] > bars / 2 - 2


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_contacts_out_of_reach_are_dropped(route: str) -> None:
    line = 'ground.lines.floor = {{ through = [0, "{}"], angle = 0 }}\n'
    contact = 'contacts.floor = { touch = ["rod.B", "ground.floor"], restitution = 0.5 }\n'
    scene = SWING.replace("-90 deg", "-200 deg") + f'solve.route = "{route}"\nstart.rod.omega = "-6 rad/s"\n'
    far, near = (scene + line.format(y) + contact for y in ("-1.001 m", "-0.999 m"))
    told = "the gap of 1 contact (out of reach wherever the joints let the bodies go)"
    assert told in plan_of(far)
    assert told not in plan_of(near)
    assert planemotion.load_text(far).run().omega == planemotion.load_text(scene).run().omega


def test_contacts_out_of_reach_of_the_steps_are_told_after_a_run() -> None:
    floor = 'ground.lines.floor = { through = [0, "-30 m"], angle = 0 }\n'
    contact = 'contacts.floor = { touch = ["ball.rim", "ground.floor"], restitution = 0.5 }\n'
    ball = 'bodies.ball = { disk = "0.1 m", mass = "1 kg", at = [0, 0] }\n'
    ask = 'ask.y = { of = "ball.y", unit = "m" }\nsolve.route = "rk"\n'
    scene = planemotion.load_text('until = "t = 1 s"\n' + floor + ball + contact + ask)
    assert "out of reach of the step" not in explain(scene).text
    assert re.search(
        r"skipped: \d+ looks? at gaps \(out of reach of the step\)", explain_run(scene, scene.run())
    )


# ---- what nothing depends on ----
ASIDE = f"""
{rod_on_pin("aside", "C", at={"A": ["3 m", 0]}, angle="0 deg")}
bodies.ball = {{ mass = "1 kg", at = ["4 m", "7 m"] }}
forces.s = {{ spring = ["aside.B", "ball"], stiffness = "100 N/m", free_length = "1 m" }}
events.low = "aside.angle = -30 deg"
"""


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_idle_parts_are_left_out(route: str) -> None:
    solve = f'solve.route = "{route}"\n'
    alone = planemotion.load_text(SWING + solve).run()
    beside = planemotion.load_text(SWING + solve + ASIDE).run()
    assert beside.omega == alone.omega
    assert beside.counts == alone.counts


def test_idle_parts_are_told() -> None:
    left = (
        "skipped: bodies aside, ball; joints C; forces s; events low (nothing that is asked depends on them"
    )
    assert left in plan_of(SWING + ASIDE)
    scene = planemotion.load_text(SWING + ASIDE)
    assert left.replace("skipped", "skipped throughout") in explain_run(scene, scene.run())
    assert "bodies" not in plan_of(SWING + ASIDE + 'ask.all = { of = "energy.total", unit = "J" }\n')
    asked = plan_of(SWING + ASIDE + 'ask.y = { of = "ball.y", unit = "m" }\n')
    assert "skipped: events low (nothing" in asked


def test_a_history_holds_idle_parts_too() -> None:
    scene = planemotion.load_text(SWING + ASIDE)
    history = call.trace(flatten(scene), flatten(scene).defaults)
    assert np.ptp(history.columns["aside.omega"]) > 0
    assert history.columns["rod.omega"][-1] == pytest.approx(scene.run().omega, rel=1e-9)
