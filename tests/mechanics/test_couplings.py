"""Couplings and drives from scenes: what is written means what the kernel does."""

from __future__ import annotations

import math

import pytest

import planemotion
from tests import CHAPTER
from tests.scenes import ROUTES, G, answers, within
from tests.scenes.parts import body, drum_and_block, on_axle

BLOCK = f"""
until = "t = 0.5 s"
{drum_and_block()}
[ask]
v = "block.velocity.y"
tension = "cord.tension"
on_block = "cord.force.y on block"
on_drum = "cord.force.y on drum"
spin = "drum.omega"
slack = "cord.slack"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_block_on_a_drum(route: str) -> None:
    values = answers(BLOCK, route)
    acceleration, close = 3 * G / (3 + 2), within(route)
    assert values["v"] == pytest.approx(-0.5 * acceleration, rel=close)
    assert values["spin"] == pytest.approx(-0.5 * acceleration / 0.2, rel=close)
    assert values["tension"] == pytest.approx(2 * acceleration, rel=close)
    assert values["on_block"] == pytest.approx(2 * acceleration, rel=close)
    assert values["on_drum"] == pytest.approx(-2 * acceleration, rel=close)
    assert values["slack"] == pytest.approx(0, abs=1e-9)


def test_a_tape_over_drums_has_a_tension_for_each_span() -> None:
    """Two equal drums between two weights: the tension drops where a drum must be turned."""
    values = answers(f"""
until = "t = 0.3 s"
{body("left", mass="5 kg", at=["-0.2 m", "-1 m"])}
{on_axle("a", "axle_a", disk="0.2 m", mass="2 kg")}
{on_axle("b", "axle_b", disk="0.2 m", mass="2 kg", x="1 m")}
{body("right", mass="3 kg", at=["1.2 m", "-1 m"])}
[couplings]
tape = {{ cord = ["left", "a.rim cw", "b.rim cw", "right"] }}
[ask]
one = "tape.tension[1]"
two = "tape.tension[2]"
three = "tape.tension[3]"
v = "left.velocity.y"
level = "a.omega - b.omega"
""")
    acceleration = (5 - 3) * G / (5 + 3 + 1 + 1)
    assert values["one"] == pytest.approx(5 * (G - acceleration), rel=1e-9)
    assert values["two"] == pytest.approx(5 * (G - acceleration) - acceleration, rel=1e-9)
    assert values["three"] == pytest.approx(3 * (G + acceleration), rel=1e-9)
    assert values["v"] == pytest.approx(-0.3 * acceleration, rel=1e-9)
    assert values["level"] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("e", "rebound"), [(0, 0), (0.5, 0.5)])
def test_a_slack_cord_becomes_taut(e: float, rebound: float) -> None:
    values = answers(
        """
until = "taut"
parameters.e = 0
[ground.points]
S = [0, 0]
[bodies]
P = { mass = "1.5 kg", at = [0, "-1 m"] }
[couplings]
cord = { cord = ["P", "ground.S"], length = "3 m", restitution = "e" }
[events]
taut = "cord tightens"
[ask]
v = "P.velocity.y"
y = "P.y"
impulse = "cord.impulse"
lost = "energy.lost"
""",
        e=e,
    )
    speed = math.sqrt(2 * G * 2)
    assert values["v"] == pytest.approx(rebound * speed, abs=1e-9)
    assert values["y"] == pytest.approx(-3, rel=1e-12)
    assert values["impulse"] == pytest.approx(1.5 * (1 + rebound) * speed, rel=1e-10)
    assert values["lost"] == pytest.approx(0.75 * speed**2 * (1 - rebound**2), rel=1e-10)


def test_a_cord_slackens_where_it_would_push() -> None:
    """A particle thrown round on a cord from below leaves the circle where its tension is nothing."""
    values = answers("""
until = "cord slackens"
parameters = { v = "6 m/s", L = "1 m" }
ground.points.S = [0, 0]
bodies.P = { mass = "1 kg", at = [0, "-L"] }
couplings.cord = { cord = ["P", "ground.S"] }
start.P.velocity.x = "v"
start.P.velocity.y = "0 m/s"
[ask]
y = "P.y"
speed = "P.speed"
""")
    # v^2 - 2 g (L + y) = g y
    height = (36 - 2 * G) / (3 * G)
    assert values["y"] == pytest.approx(height, rel=1e-9)
    assert values["speed"] == pytest.approx(math.sqrt(G * height), rel=1e-9)


@pytest.mark.parametrize(("crossed", "sense"), [("false", 1), ("true", -1)])
def test_belt(crossed: str, sense: int) -> None:
    values = answers(f"""
until = "a.turned = 100 rad"
{on_axle("a", "axle_a", disk="0.1 m", mass="2 kg")}
{on_axle("b", "axle_b", disk="0.3 m", mass="5 kg", x="1 m")}
[couplings]
belt = {{ belt = ["a.rim", "b.rim"], crossed = {crossed} }}
[forces]
drive = {{ couple = "a", value = "2 N*m" }}
[ask]
turned = "b.turned"
omega = "a.omega"
""")
    reduced = 0.5 * 2 * 0.01 + 0.5 * 5 * 0.09 / 9
    assert values["turned"] == pytest.approx(sense * 100 / 3, rel=1e-11)
    assert values["omega"] == pytest.approx(math.sqrt(2 * 2 * 100 / reduced), rel=1e-10)


def test_internal_gears_turn_the_same_way() -> None:
    values = answers(f"""
until = "t = 2 s"
{on_axle("ring", "axle_a", inertia="0.5 kg*m^2", circles={"teeth": "0.4 m"})}
{on_axle("pinion", "axle_b", inertia="0.01 kg*m^2", circles={"teeth": "0.1 m"}, x="0.3 m")}
[couplings]
mesh = {{ gears = ["pinion.teeth", "ring.teeth"] }}
[forces]
drive = {{ couple = "pinion", value = "3 N*m" }}
[ask]
ring = "ring.omega"
pinion = "pinion.omega"
tooth = "mesh.force.y on ring"
""")
    alpha = 3 / (0.01 + 0.5 / 16)
    assert values["pinion"] == pytest.approx(2 * alpha, rel=1e-10)
    assert values["ring"] == pytest.approx(alpha / 2, rel=1e-10)
    assert values["tooth"] == pytest.approx(0.5 * alpha / 4 / 0.4, rel=1e-10)


def test_motor_and_driven_body() -> None:
    """A cart that speeds up carries a rotor on a motor; its couple is that of the rotor's own spin."""
    values = answers(
        """
until = "t = 3 s"
[bodies]
cart = { driven = { velocity = ["(2 m/s^2)*t", "1 m/s"] }, disk = "1 m", mass = "1 kg", at = [0, 0] }
rotor = { disk = "0.1 m", mass = "4 kg", at = [0, 0] }
[joints]
axle = { pin = ["rotor.center", "cart.center"] }
[couplings]
motor = { motor = ["rotor", "cart"], value = "(10 rad/s^2)*t + 3 rad/s" }
[start]
rotor.omega = "3 rad/s"
[ask]
x = "cart.x"
y = "cart.y"
turned = "rotor.turned"
couple = "motor.couple on rotor"
back = "motor.couple on cart"
pull = "axle.force.x on rotor"
""".replace("+ 3 rad/s", "+ (3 rad/s)")
    )
    assert values["x"] == pytest.approx(9, rel=1e-10)
    assert values["y"] == pytest.approx(3, rel=1e-10)
    assert values["turned"] == pytest.approx(45 + 9, rel=1e-10)
    assert values["couple"] == pytest.approx(0.02 * 10, rel=1e-10)
    assert values["back"] == pytest.approx(-0.02 * 10, rel=1e-10)
    assert values["pull"] == pytest.approx(8, rel=1e-10)


def test_gears_that_do_not_touch_are_told() -> None:
    scene = planemotion.load_text(f"""
until = "t = 1 s"
{on_axle("a", "axle_a", disk="0.1 m", mass="2 kg")}
{on_axle("b", "axle_b", disk="0.3 m", mass="5 kg", x="0.45 m")}
[couplings]
mesh = {{ gears = ["a.rim", "b.rim"] }}
""")
    with pytest.raises(
        planemotion.SimulationError, match=r"the pitch circles are drawn 0\.05 m from touching"
    ):
        scene.run()


def test_a_strand_needs_a_way() -> None:
    scene = planemotion.load_text(f"""
until = "t = 1 s"
{on_axle("a", "axle_a", disk="0.3 m", mass="2 kg")}
{body("P", mass="5 kg", at=["0.1 m", 0])}
[couplings]
cord = {{ cord = ["a.rim cw", "P"] }}
""")
    with pytest.raises(planemotion.SimulationError, match=r"couplings\.cord: no straight strand as drawn"):
        scene.run()


SHAFTS = f"""
plane = "horizontal"
parameters = {{ r = 2.5, Ia = "0.3 kg*m^2", Ib = "0.7 kg*m^2" }}
{on_axle("A", "a", mass="2 kg", inertia="Ia")}
{on_axle("B", "b", mass="3 kg", inertia="Ib", x="1 m")}
couplings.box.ratio = {{ "A.turned" = 1, "B.turned" = "r" }}
"""
GEAR_BOX = f"""
until = "t = 0.8 s"
{SHAFTS}
[forces]
bar = {{ torsion = ["A", "ground"], stiffness = "5 N*m" }}
[start]
A.omega = "2 rad/s"
[ask]
turned = "A.turned"
omega = "A.omega"
on_a = "box.couple"
on_b = "box.couple on B"
"""


@pytest.mark.parametrize("route", ["path", "rk", "ida"])
@pytest.mark.parametrize("r", [2.5, -0.4])
def test_a_gear_box_on_a_torsion_bar_swings(route: str, r: float) -> None:
    """B turns -1/r times as fast as A, which swings with the inertia Ia + Ib / r^2."""
    values = answers(GEAR_BOX, route, r=r)
    inertia = 0.3 + 0.7 / r**2
    w, close = math.sqrt(5 / inertia), within(route)
    turned = 2 / w * math.sin(w * 0.8)
    assert values["turned"] == pytest.approx(turned, rel=close)
    assert values["omega"] == pytest.approx(2 * math.cos(w * 0.8), rel=close)
    on_a = -0.7 / r**2 * (-5 * turned / inertia)  # what turns B is taken from A
    assert values["on_a"] == pytest.approx(on_a, rel=close)
    assert values["on_b"] == pytest.approx(r * on_a, rel=close)


def test_a_gear_box_shares_a_blow_and_can_be_disengaged() -> None:
    """An impulse of moment H on A, then free turning; removed, both keep what they have."""
    values = answers(
        'until = "t = 3 s"\n'
        + SHAFTS
        + """
[events]
blow = { when = "t = 1 s", do = [{ impulse = "A", value = "4 N*m*s" }] }
gap = { when = "t = 2 s", do = [{ remove = "box" }] }
more = { when = "t = 2.5 s", do = [{ impulse = "A", value = "1 N*m*s" }] }
[start]
A.omega = 0
[ask]
a = { of = "A.omega", at = "gap" }
b = { of = "B.omega", at = "gap" }
a_end = "A.omega"
b_end = "B.omega"
"""
    )
    omega = 4 / (0.3 + 0.7 / 2.5**2)
    assert values["a"] == pytest.approx(omega, rel=1e-12)
    assert values["b"] == pytest.approx(-omega / 2.5, rel=1e-12)
    assert values["a_end"] == pytest.approx(omega + 1 / 0.3, rel=1e-12)
    assert values["b_end"] == pytest.approx(-omega / 2.5, rel=1e-12)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("changed", [{"k_pulley": "11 in"}, {"W_A": "75 lb"}, {"r_outer": "3 in"}])
def test_a_block_that_its_cord_pulls_to_the_drum_ends_the_run(changed: dict[str, str], route: str) -> None:
    run = planemotion.load(CHAPTER / "17-011.toml").run(**{"solve.route": route}, **changed)
    assert run.status == "strand_ends"
    assert "couplings.cord_B" in run.error
    assert run.asks["b_distance_B"].value is None


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("times", [1.25, 2, 3, 5])
@pytest.mark.parametrize("problem", ["17-060", "17-061"])
def test_a_hoist_that_coasts_beyond_its_drum_ends_there(problem: str, times: float, route: str) -> None:
    """Started faster: either what is asked comes before the block is at the drum, or the run ends there."""
    scene = planemotion.load(CHAPTER / f"{problem}.toml")
    value, unit = str(scene.table["parameters"]["omega_0"]).split()
    run = scene.run(**{"solve.route": route}, omega_0=f"{float(value) * times!r} {unit}")
    assert run.status in ("ok", "strand_ends")
    assert run.ok or "couplings.cable" in run.error
