"""Friction of bearings, sliders and slots: it slides, stops, holds, and lets go again when overcome."""

from __future__ import annotations

import math

import pytest

from tests.scenes import ROUTES, G, answers, within
from tests.scenes.parts import body, drum_and_block, rod

EXACT = 1e-9


TORSION = """
until = "wheel rests"
parameters = { M = "0.8 N*m", k = "10 N*m", I = "0.5 kg*m^2" }
bodies.wheel = { inertia = "I", at = [0, 0], angle = "1 rad" }
joints.axle = { pin = ["ground", "wheel.center"], friction_couple = "M" }
forces.spring = { torsion = ["wheel", "ground"], stiffness = "k", free_angle = "0 rad" }
[ask]
angle = "wheel.angle"
t = "t"
couple = "axle.couple on wheel"
opposite = "axle.couple"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_torsion_pendulum_loses_the_same_with_each_swing(route: str) -> None:
    """It swings about +-M/k: each half swing is 2 M/k shorter, until the spring is too weak for it."""
    close = within(route)
    values = answers(TORSION, route)
    assert values["t"] == pytest.approx(6 * math.pi * math.sqrt(0.5 / 10), rel=close)
    assert values["angle"] == pytest.approx(1 - 6 * 0.16, rel=20 * close)
    assert values["couple"] == pytest.approx(10 * (1 - 6 * 0.16), rel=20 * close)
    assert values["opposite"] == pytest.approx(-values["couple"])


GROWING = """
until = "t = 2 s"
parameters = { M = "0.8 N*m", I = "0.5 kg*m^2", rate = "1 N*m/s" }
bodies.wheel = { inertia = "I", at = [0, 0] }
joints.axle = { pin = ["ground", "wheel.center"], friction_couple = "M" }
forces.drive = { couple = "wheel", value = "rate*t" }
[ask]
omega = "wheel.omega"
turned = "wheel.turned"
"""


@pytest.mark.parametrize("route", ["rk", "ida"])
@pytest.mark.parametrize("rate", [0.5, 1, 3, 70])
def test_a_couple_that_grows_out_of_rest_overcomes_a_bearing(rate: float, route: str) -> None:
    """It turns from t = M/rate on, with I alpha = rate (t - M/rate)."""
    values = answers(GROWING, route, rate=f"{rate} N*m/s")
    since = 2 - 0.8 / rate
    assert values["omega"] == pytest.approx(rate * since**2, rel=1e-8)
    assert values["turned"] == pytest.approx(rate * since**3 / 3, rel=1e-8)


SLED = """
until = "t = 2.5 s"
parameters = { mu = 0.3, v0 = "0 m/s", rate = "4 N/s", tilt = "0 deg" }
ground.lines.rail = { through = [0, 0], angle = "tilt" }
bodies.sled = { mass = "2 kg", at = [0, 0] }
joints.rail = { slider = ["sled", "ground.rail"], friction = "mu" }
forces.pull = { force = "sled", value = ["rate*t", 0] }
start.sled.velocity = { polar = ["v0", "tilt"] }
[ask]
v = "sled.velocity.x"
x = "sled.x"
friction = "rail.friction"
normal = "rail.normal"
force = "rail.force.x on sled"
early = { of = "rail.friction", at = { each = "t", values = ["0.5 s"] } }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_sled_starts_when_the_pull_overcomes_its_friction(route: str) -> None:
    values = answers(SLED, route)
    begins = 0.3 * 2 * G / 4
    assert values["v"] == pytest.approx((2.5 - begins) ** 2, rel=EXACT)
    assert values["x"] == pytest.approx((2.5 - begins) ** 3 / 3, rel=EXACT)
    assert values["friction"] == pytest.approx(-0.3 * 2 * G, rel=EXACT)
    assert values["force"] == pytest.approx(-0.3 * 2 * G, rel=EXACT)
    assert values["normal"] == pytest.approx(2 * G, rel=EXACT)
    assert values["early"] == pytest.approx([-2.0], rel=EXACT)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_sled_stops_and_stays(sense: int) -> None:
    values = answers(SLED, v0=f"{3 * sense} m/s", rate="0 N/s")
    assert values["x"] == pytest.approx(sense * 9 / (2 * 0.3 * G), rel=EXACT)
    assert values["v"] == pytest.approx(0, abs=1e-12)
    assert values["friction"] == pytest.approx(0, abs=1e-9)


def test_a_sled_on_an_incline_slides_where_it_is_steep() -> None:
    down = answers(SLED, tilt="30 deg", rate="0 N/s")
    acceleration = G * (math.sin(math.pi / 6) - 0.3 * math.cos(math.pi / 6))
    assert down["x"] == pytest.approx(-0.5 * acceleration * 2.5**2 * math.cos(math.pi / 6), rel=EXACT)
    assert answers(SLED, tilt="15 deg", rate="0 N/s")["x"] == pytest.approx(0, abs=1e-12)


DRUM = f"""
until = "t = 1 s"
parameters = {{ mu = 0.25, r = "0.04 m" }}
{drum_and_block(friction={"mu": "mu", "radius": "r"})}
[ask]
v = "block.velocity.y"
couple = "axle.couple on drum"
load = "axle.force.norm"
tension = "cord.tension"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_bearing_rubs_by_its_load(route: str) -> None:
    """I a/R = T R - mu r (W + T), T = m (g - a)."""
    values = answers(DRUM, route)
    c, inertia = 0.25 * 0.04, 0.5 * 4 * 0.04
    a = (3 * G * (0.2 - c) - c * 4 * G) / (inertia / 0.2 + 3 * (0.2 - c))
    assert values["v"] == pytest.approx(-a, rel=EXACT)
    assert values["tension"] == pytest.approx(3 * (G - a), rel=EXACT)
    assert values["load"] == pytest.approx(4 * G + 3 * (G - a), rel=EXACT)
    assert values["couple"] == pytest.approx(c * values["load"], rel=EXACT)


def test_a_tight_bearing_holds() -> None:
    values = answers(DRUM, mu=2.5)
    assert values["v"] == pytest.approx(0, abs=1e-12)
    assert values["couple"] == pytest.approx(3 * G * 0.2, rel=EXACT)


BEAD = """
plane = "horizontal"
until = "bead.x = 0 m"
parameters = { mu = 0.2, R = "0.5 m", v0 = "4 m/s" }
ground.circles.ring = { radius = "R" }
bodies.bead = { mass = "0.3 kg", at = ["R", 0] }
joints.ring = { slot = ["bead", "ground.ring"], friction = "mu" }
start.bead.velocity.y = "v0"
[ask]
v = "-bead.velocity.x"
force = "ring.force.norm on bead"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_in_a_ring_slows_down_by_the_angle(route: str) -> None:
    """dv/ds = -mu v/R: v = v0 exp(-mu angle)."""
    values = answers(BEAD, route)
    speed = 4 * math.exp(-0.2 * math.pi / 2)
    assert values["v"] == pytest.approx(speed, rel=EXACT)
    assert values["force"] == pytest.approx(0.3 * speed**2 / 0.5 * math.hypot(1, 0.2), rel=EXACT)


STRUCK = f"""
until = "stop 2"
events.stop = "bar rests"
plane = "horizontal"
parameters.M = "0.5 N*m"
{rod("bar", mass="3 kg")}
{body("ball", mass="1 kg", at=["1 m", "1 m"])}
joints.axle = {{ pin = ["bar.A", "ground"], friction_couple = "M" }}
contacts.hit = {{ touch = ["ball", "bar.top"], restitution = 1 }}
start.ball.velocity.y = "-2 m/s"
[ask]
turned = "bar.turned"
"""


def test_a_friction_of_given_size_has_no_impulse() -> None:
    """I w = m l (u - v), e = 1; then I w^2 / 2 = M turned.  Before the blow the bar is held."""
    values = answers(STRUCK)
    omega = 2 * 1 * 2 / (1 + 1)
    assert values["turned"] == pytest.approx(-0.5 * omega**2 / 0.5, rel=EXACT)


CHANGES = """
slips = { of = "t", at = "let_go" }
sticks = { of = "t", at = "holds" }
n_slips = "let_go.count"
n_sticks = "holds.count"
[events]
let_go = "rail slips"
holds = "rail sticks"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_joint_slips_and_sticks_as_events(route: str) -> None:
    """Thrown back, the sled stops, holds until the pull has grown to mu m g, and slides again."""
    close = EXACT
    values = answers(SLED + CHANGES, route, v0="-2 m/s")
    mu, m, rate = 0.3, 2.0, 4.0
    # v = -2 + mu g t + rate t^2/(2 m): where it is 0
    stop = m / rate * (-mu * G + math.sqrt((mu * G) ** 2 + 2 * rate / m * 2))
    assert values["sticks"] == pytest.approx(stop, rel=close)
    assert values["slips"] == pytest.approx(mu * m * G / rate, rel=close)
    assert (values["n_slips"], values["n_sticks"]) == (1, 1)
    assert values["v"] == pytest.approx(
        (rate * (2.5**2 - values["slips"] ** 2) / 2 - mu * m * G * (2.5 - values["slips"])) / m,
        rel=10 * close,
    )


def test_where_it_turns_back_it_does_not_stick() -> None:
    events = 'events.holds = "axle sticks"\nevents.lets_go = "axle slips"\n'
    values = answers(
        events + TORSION + 'sticks = "holds.count"\nslips = "lets_go.count"\nat = "holds.time"\n'
    )
    assert (values["sticks"], values["slips"]) == (1, 0)
    assert values["at"] == pytest.approx(values["t"])


def test_what_slips_at_once_has_not_begun_to() -> None:
    text = SLED.replace("2.5 s", "0.1 s") + CHANGES.replace("slips =", "# ", 1).replace("sticks =", "# ", 1)
    values = answers(text, tilt="-30 deg")
    assert (values["n_slips"], values["n_sticks"]) == (0, 0)


CRANK = """
until = "t = 2 s"
parameters = { mu = 0.2, r = "8 mm" }
ground.lines.guide = { through = [0, "20 mm"] }
bodies.crank = { rod = ["O", "A"], length = "0.1 m", mass = "0.4 kg", at = { O = [0, 0] }, angle = "70 deg" }
bodies.rod = { rod = ["B", "C"], length = "0.35 m", mass = "0.3 kg", at.B = "crank.A", angle = "~-12 deg" }
bodies.block = { mass = "0.5 kg", at = "rod.C" }
joints.main = { pin = ["crank.O", "ground"], friction = { mu = "mu", radius = "r" } }
joints.big = { pin = ["crank.A", "rod.B"], friction = { mu = "mu", radius = "r" } }
joints.small = { pin = ["rod.C", "block"] }
joints.guide = { slider = ["block", "ground.guide"], friction = "mu" }
forces.drive = { couple = "crank", value = "(0.5 N*m) + (0.6 N*m)*sin(t * (3 rad/s))" }
start.crank.omega = "3 rad/s"
[ask]
turned = "crank.turned"
omega = "crank.omega"
load = "main.force.norm"
couple = "main.couple on crank"
rub = "guide.friction"
"""


def test_three_frictions_by_their_loads_agree_on_all_routes() -> None:
    found = [answers(CRANK, route) for route in ROUTES]
    assert abs(found[0]["turned"]) > 3
    assert abs(found[0]["couple"]) == pytest.approx(0.2 * 0.008 * found[0]["load"], rel=EXACT)
    for values, route in zip(found, ROUTES, strict=True):
        assert values == pytest.approx(found[0], rel=within(route)), route
