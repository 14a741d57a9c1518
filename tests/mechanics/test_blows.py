"""Laws of blows, sliding contacts in scenes: what is written means what the kernel does."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from planemotion.engine.result import RunResult
from planemotion.report.explain import explain
from tests.scenes import ROUTES, G, answers, within
from tests.scenes import answers_at_ties as run
from tests.scenes.parts import FLOOR, body, plate, rod, touching

ROD = f"""
until = "start"
{FLOOR}
{rod(mass="3 kg", angle="beta")}
{touching("hit", "AB.A", restitution="e", friction="mu", law="newton")}
[parameters]
beta = "45 deg"
mu = 0.4
e = 0.6
[start]
AB.velocity = ["0.3 m/s", "-2 m/s"]
AB.omega = 0
[ask]
omega = "AB.omega"
lost = "energy.lost"
p = "hit.impulse.y"
f = "hit.impulse.x"
slip = "AB.A.velocity.x"
"""


def test_laws_of_restitution_differ_with_friction_alone() -> None:
    laws = {law: run(ROD.replace("newton", law)) for law in ("newton", "poisson", "stronge")}
    for values in laws.values():
        assert values["slip"] < 0  # it ran to the right before
        assert 0 < abs(values["f"]) < 0.4 * values["p"]
        assert values["lost"] > 0
    assert len({round(values["p"], 6) for values in laws.values()}) == 3
    smooth = [run(ROD.replace("newton", law), mu=0) for law in ("newton", "poisson", "stronge")]
    assert smooth[1]["p"] == pytest.approx(smooth[0]["p"], rel=1e-12)
    assert smooth[2]["p"] == pytest.approx(smooth[0]["p"], rel=1e-12)


def test_explain_tells_the_laws() -> None:
    text = explain(planemotion.load_text(ROD.replace("newton", "stronge"))).text
    assert "restitution e, friction mu, law stronge" in text


def test_a_law_that_would_create_energy_is_limited() -> None:
    """Kane's paradox: the restitution is lowered until nothing is gained, and the result says so."""
    text = ROD.replace("e = 0.6", "e = 1").replace("0.3 m/s", "1 m/s")
    values, result = run(text), planemotion.load_text(text).run()
    assert values["lost"] == pytest.approx(0, abs=1e-12)
    assert 0 < abs(values["f"]) < 0.4 * values["p"]
    assert result.counts["limited_blows"] == 1
    assert "gained energy" in result.notes[0]
    assert run(text.replace("newton", "stronge"))["lost"] > 0


LANDING = f"""
until = "start"
{FLOOR}
{rod(mass="3 kg", at=[0, 0])}
{touching("a", "AB.A", friction=0.3, restitution=0.5, law="LAW")}
{touching("b", "AB.B", friction=0.3, restitution=0.5)}
[start]
AB.velocity = ["0.1 m/s", "-2 m/s"]
AB.omega = 0
[ask]
vy = "AB.velocity.y"
omega = "AB.omega"
"""


@pytest.mark.parametrize("law", ["poisson", "stronge"])
def test_several_contacts_are_followed_together(law: str) -> None:
    """A rod that lands flat rebounds flat, and the run says what was assumed."""
    result = planemotion.load_text(LANDING.replace("LAW", law)).run()
    assert result.asks["vy"].value == pytest.approx(1, rel=1e-12)
    assert result.asks["omega"].value == pytest.approx(0, abs=1e-12)
    assert result.counts["shared_blows"] == 1
    assert "a blow by the laws poisson and stronge took several contacts at once" in result.notes[0]
    sequential = LANDING.replace("LAW", law) + '[solve]\nimpacts = "sequential"\n'
    one_by_one = planemotion.load_text(sequential).run()
    assert one_by_one.counts["shared_blows"] == 0
    assert one_by_one.notes == ()


def test_restitution_along_a_contact_is_not_followed() -> None:
    text = LANDING.replace("LAW", "poisson").replace(
        'touch = ["AB.B", "ground.floor"]', 'touch = ["AB.B", "ground.floor"], tangential = 0.5'
    )
    refused = r"contacts\.b\.tangential: it is of the law newton"
    with pytest.raises(planemotion.SimulationError, match=refused):
        planemotion.load_text(text).run()


@pytest.mark.parametrize("route", ROUTES)
def test_what_was_before_a_blow_that_fails_is_kept(route: str) -> None:
    """A rod pinned above the floor jams: with so much friction no impulse stops its tip."""
    text = f"""
until = "t = 2 s"
{rod(mass="1 kg", at={"A": [0, "0.5 m"]}, angle="20 deg")}
{touching("tip", "AB.B", friction=3, restitution=0.5)}
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
points = {{ O = [0, "0.5 m"] }}
[joints]
pin = {{ pin = ["AB.A", "ground.O"] }}
[events]
level = "AB.angle = 0"
strike = "tip strikes"
[ask]
level = {{ of = "AB.omega", at = "level" }}
before = {{ of = "AB.omega", at = "before strike" }}
second = {{ of = "AB.omega", at = "before strike 2" }}
after = {{ of = "AB.omega", at = "strike" }}
[solve]
route = "{route}"
"""
    with pytest.raises(planemotion.SimulationError, match=r"contacts\.tip") as failure:
        planemotion.load_text(text).run()
    result = failure.value.result
    assert isinstance(result, RunResult)
    asks = result.asks
    assert asks["level"].value == pytest.approx(-math.sqrt(3 * G * math.sin(math.radians(20))), rel=1e-8)
    down = math.sin(math.radians(20)) + math.sin(math.radians(30))
    assert asks["before"].value == pytest.approx(-math.sqrt(3 * G * down), rel=1e-8)
    assert asks["second"].value is None
    assert asks["after"].value is None


def test_a_slip_that_reverses_in_a_blow_of_several() -> None:
    """Flat on both lower corners, which rebound differently: the spin turns the slip."""
    text = f"""
until = "start"
{FLOOR}
{plate("crate", "1 m", "1 m", "3 kg", at={"A": [0, 0]})}
{touching("a", "crate.A", friction=0.05, restitution=1)}
{touching("b", "crate.B", friction=0.05)}
[start]
crate.velocity = ["0.01 m/s", "-2 m/s"]
crate.omega = 0
[ask]
omega = "crate.omega"
slip = "crate.A.velocity.x"
"""
    other_way = text.replace('"0.01 m/s"', '"-0.01 m/s"')
    forward, backward = run(text), run(other_way)
    for values in (forward, backward):  # friction opposes the slip that is left, whatever it was before
        assert values["slip"] < 0
        assert values["omega"] == pytest.approx(-2, rel=1e-12)
    assert run(text + '[solve]\nimpacts = "sequential"\n')["omega"] != 0


def test_blows_without_end_are_told() -> None:
    text = f"""
until = "t = 1 s"
{FLOOR}
ground.lines.ceiling = {{ through = [0, "0.2 m"], angle = "180 deg" }}
{body("ball", sphere="0.1 m", mass="1 kg", at=[0, "0.1 m"])}
{touching("below", "ball.rim", restitution=1)}
{touching("above", "ball.rim", "ceiling", restitution=1)}
[start]
ball.velocity = ["1 m/s", "-1 m/s"]
[ask]
x = "ball.x"
[solve]
impacts = "sequential"
"""
    with pytest.raises(planemotion.SimulationError, match="the blows at this instant do not end"):
        planemotion.load_text(text).run()


# ---- several sliding contacts ----


@pytest.mark.parametrize("route", ["auto", "uniform", "rk", "ida"])
def test_a_cylinder_spins_down_in_a_corner_and_stays(route: str) -> None:
    """Floor and wall, both with mu: N_floor = m g/(1 + mu^2), N_wall = mu N_floor; it stops and stays."""
    m, r, mu, omega = 4.0, 0.15, 0.25, 30.0
    values = run(
        f"""
until = "t = 3 s"
{FLOOR}
ground.lines.wall = {{ through = [0, 0], angle = "-90 deg" }}
{body("C", cylinder=f"{r} m", mass=f"{m} kg", at=[f"{r} m", f"{r} m"])}
{touching("floor", "C.rim", friction=mu)}
{touching("wall", "C.rim", "wall", friction=mu)}
[start]
C.omega = "{omega} rad/s"
[events]
still = "floor sticks"
tenth = "t = 0.1 s"
[ask]
n_floor = {{ of = "floor.normal", at = "tenth" }}
n_wall = {{ of = "wall.normal", at = "tenth" }}
t = {{ of = "t", at = "still" }}
omega = "C.omega"
turned = "C.turned"
x = "C.x"
friction = "floor.friction"
""",
        route,
    )
    floor = m * G / (1 + mu**2)
    alpha = mu * (1 + mu) * floor * r / (0.5 * m * r * r)
    close = within(route, ida=1e-6)
    assert values["n_floor"] == pytest.approx(floor, rel=close)
    assert values["n_wall"] == pytest.approx(mu * floor, rel=close)
    assert values["t"] == pytest.approx(omega / alpha, rel=close)
    assert values["turned"] == pytest.approx(omega**2 / (2 * alpha), rel=close)
    assert values["omega"] == pytest.approx(0, abs=1e-9)
    assert values["x"] == pytest.approx(r, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("mu_static", "stays"), [(0.6, True), (0.4, False)])
def test_a_block_thrown_up_a_slope_stays_or_comes_back(route: str, mu_static: float, stays: bool) -> None:
    slope, mu, v = math.radians(25), 0.35, 2.0
    values = run(
        f"""
until = "t = 2 s"
[ground]
lines = {{ slope = {{ through = [0, 0], angle = "25 deg" }} }}
[bodies]
P = {{ mass = "2 kg", at = [0, 0] }}
[contacts]
lie = {{ touch = ["P", "ground.slope"], friction = {{ static = {mu_static}, kinetic = {mu} }} }}
[start]
P.velocity = {{ polar = ["{v} m/s", "25 deg"] }}
[ask]
s = "P.moved.x"
v = "P.speed"
f = "lie.friction"
""",
        route,
    )
    up, down = G * (math.sin(slope) + mu * math.cos(slope)), G * (math.sin(slope) - mu * math.cos(slope))
    t, s = v / up, v * v / (2 * up)
    close = within(route, ida=1e-6, others=1e-8)
    if stays:
        assert values["s"] == pytest.approx(s * math.cos(slope), rel=close)
        assert values["v"] == pytest.approx(0, abs=1e-8)
        assert values["f"] == pytest.approx(2 * G * math.sin(slope), rel=close)
    else:
        back = s - 0.5 * down * (2 - t) ** 2
        assert values["s"] == pytest.approx(back * math.cos(slope), rel=close)
        assert values["f"] == pytest.approx(2 * G * mu * math.cos(slope), rel=close)


# ---- small bodies that are fast ----

SHOT = """
plane = "horizontal"
until = "t = 1 s"
[bodies]
A = { disk = "0.02 m", mass = "1 kg", at = [0, 0] }
B = { disk = "0.02 m", mass = "1 kg", at = ["d", "0.03 m"] }
[contacts]
hit = { touch = ["A.rim", "B.rim"], restitution = 1 }
[parameters]
d = "1 m"
v = "13 m/s"
[start]
A.velocity = ["v", 0]
[forces]
[ask]
x = { of = "A.velocity.x", unit = "m/s" }
y = { of = "A.velocity.y", unit = "m/s" }
"""
PUSHED = SHOT.replace("[forces]", '[forces]\npush = { force = "A", value = ["60 N", 0] }')


@pytest.mark.parametrize("route", ["rk", "ida"])
@pytest.mark.parametrize("text", [SHOT, PUSHED], ids=["free", "pushed"])
def test_small_balls_do_not_pass_through_each_other(text: str, route: str) -> None:
    """Equal smooth balls, e = 1: along the line of centres, (-3/4, sin), they exchange what they have."""
    for d in (0.3, 0.77, 1.31, 2.9, 5.03, 9.7):
        start = {"d": f"{d} m", "v": "13 m/s" if text == SHOT else 0}
        far = 0.5 * 60 if text == PUSHED else 13.0
        met = d - math.sqrt(0.04**2 - 0.03**2) < far
        after = run(text, route, **start)
        along = math.sqrt(1 - 0.75**2)  # of the velocity, in the line of centres
        before = 13.0 if text == SHOT else math.sqrt(2 * 60 * (d - 0.04 * along))
        assert after["y"] == pytest.approx(-0.75 * along * before if met else 0, rel=1e-6), d


PINNED = """
until = "t = 0.5 s"
[ground]
lines = { floor = { through = [0, 0] } }
points = { O = [0, "h"] }
[parameters]
h = "0.8 m"
[bodies.rod]
rod = ["A", "B"]
length = "1 m"
mass = "1 kg"
at = { A = [0, "h"] }
angle = "ANGLE deg"
[joints]
pin = { pin = ["rod.A", "ground.O"] }
[contacts]
tip = { touch = ["rod.B", "ground.floor"], friction = 3, restitution = RESTITUTION, law = "LAW" }
[events]
hit = "tip strikes"
[ask]
before = { of = "rod.omega", at = "before hit" }
n = { of = "tip.impulse.y", at = "hit" }
f = { of = "tip.impulse.x", at = "hit" }
after = { of = "rod.omega", at = "hit" }
end = "rod.omega"
angle = "rod.angle"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("height", [0.55, 0.8, 0.93])
@pytest.mark.parametrize(("law", "restitution"), [("poisson", 0.5), ("newton", 0), ("stronge", 0)])
def test_the_tip_of_a_pinned_rod_jams(route: str, height: float, law: str, restitution: float) -> None:
    """Slip and approach end together; then it is held, nothing brings it back.  I w = P (cos + mu sin)."""
    rng, floor = random.Random(3), math.asin(height)
    for _ in range(6):
        text = PINNED.replace("ANGLE", f"{rng.uniform(-20, 10)}").replace("LAW", law)
        text = text.replace("RESTITUTION", f"{restitution}")
        values = answers(text, route, h=f"{height} m")
        assert values["end"] == pytest.approx(0, abs=1e-12)
        assert values["angle"] == pytest.approx(-floor, abs=1e-9)
        if restitution > 0:
            continue  # it ends a series of bounces, which are not counted
        pressed = -values["before"] / 3 / (math.cos(floor) + 3 * math.sin(floor))
        assert values["n"] == pytest.approx(pressed, rel=1e-7)
        assert values["after"] == pytest.approx(0, abs=1e-12)
