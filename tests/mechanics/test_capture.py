"""Contacts that capture, from the words of a scene to its answers."""

from __future__ import annotations

import math

import pytest

import planemotion
from planemotion.pen import page
from planemotion.pictures import scene as sketch
from planemotion.report.explain import explain
from tests.scenes import ROUTES, answers, within
from tests.scenes.parts import plate, rod_on_pin

# A lump of clay flies into the foot of a rod; without weight all speeds stay.
CLAY = f"""
until = "rod.turned = 0.5 rad"
plane = "horizontal"
parameters = {{ g = "9.81 m/s^2", M = "4 kg", m = "0.3 kg", L = "1.2 m", v = "9 m/s", duration = "2 ms" }}
{rod_on_pin("rod", length="L", mass="M", angle="-90 deg")}
bodies.clay = {{ mass = "m", at = ["-0.6 m", "-L"] }}
contacts.hit = {{ touch = [PARTNERS], capture = "pin" }}
start.clay.velocity.x = "v"
events.blow = "hit strikes"
[ask]
time = {{ of = "t", at = "blow" }}
omega = "rod.omega"
mean = {{ of = "A.impulse.x/duration", at = "blow" }}
lost = {{ of = "energy.lost", at = "blow" }}
on_clay = {{ of = "hit.impulse.x on clay", at = "blow" }}
on_rod = {{ of = "hit.impulse.x on rod", at = "blow" }}
first = {{ of = "hit.impulse.x", at = "blow" }}
holds = "hit.force.norm"
gap = {{ of = "hit.gap", at = "before blow" }}
closed = "hit.closed"
"""


@pytest.mark.parametrize("partners", ['"clay", "rod.B"', '"rod.B", "clay"'])
@pytest.mark.parametrize("route", ROUTES)
def test_clay_in_a_rod(route: str, partners: str) -> None:
    got = answers(CLAY.replace("PARTNERS", partners), route)
    inertia = 4 * 1.2**2 / 3 + 0.3 * 1.2**2
    omega = 0.3 * 9 * 1.2 / inertia
    impulse = 0.3 * (9 - 1.2 * omega)
    close = within(route, ida=1e-6, others=1e-10)
    assert got["time"] == pytest.approx(0.6 / 9, rel=close)
    assert got["omega"] == pytest.approx(omega, rel=close)
    assert got["mean"] == pytest.approx((4 * 0.6 * omega - impulse) / 2e-3, rel=close)
    assert got["lost"] == pytest.approx(0.5 * (0.3 * 81 - inertia * omega**2), rel=close)
    assert got["on_rod"] == pytest.approx(impulse, rel=close)
    assert got["on_clay"] == pytest.approx(-impulse, rel=close)
    assert got["first"] == got["on_clay" if partners.startswith('"clay') else "on_rod"]
    assert got["holds"] == pytest.approx(0.3 * 1.2 * omega**2, rel=1e3 * close)
    assert got["gap"] == pytest.approx(0, abs=1e-6)
    assert got["closed"] == 1


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("partners", ['"beam.A", "post.B"', '"post.B", "beam.A"'])
def test_the_couple_that_holds_a_captured_body(partners: str, route: str) -> None:
    """A beam falls onto a turning post: its weight and its acceleration, about where it is held."""
    values = answers(
        f"""
until = "t = 0.6 s"
{rod_on_pin("post", length="1 m", mass="4 kg", angle="90 deg")}
bodies.beam = {{ rod = ["A", "B"], length = "0.5 m", mass = "2 kg", at = {{ A = [0, "1.2 m"] }} }}
contacts.hit = {{ touch = [{partners}], capture = "body" }}
[ask]
couple = "hit.couple on beam"
first = "hit.couple"
opposite = "hit.couple on post"
alpha = "beam.alpha"
ax = "beam.acceleration.x"
ay = "beam.acceleration.y"
x = "beam.B.x - beam.A.x"
y = "beam.B.y - beam.A.y"
""",
        route,
    )
    arm = values["x"] / 2, values["y"] / 2  # from where it is held to its mass centre
    about = 2 * (arm[0] * (values["ay"] + 9.81) - arm[1] * values["ax"]) + 2 * 0.25 / 12 * values["alpha"]
    assert abs(about) > 0.1
    assert values["couple"] == pytest.approx(about, rel=within(route))
    assert values["opposite"] == pytest.approx(-values["couple"])
    assert values["first"] == values["couple" if partners.startswith('"beam') else "opposite"]


@pytest.mark.parametrize("capture", ["pin", "body"])
def test_a_disk_on_a_disk(capture: str) -> None:
    """As a pin both turn about the place of contact, as a body they have one spin."""
    got = answers(f"""
plane = "horizontal"
until = "t = 0.7 s"
bodies.a = {{ disk = "0.3 m", mass = "2 kg", at = [0, 0] }}
bodies.b = {{ disk = "0.2 m", mass = "1 kg", at = ["1 m", "0.3 m"] }}
contacts.c = {{ touch = ["b.rim", "a.rim"], capture = "{capture}" }}
start.b.velocity.x = "-3 m/s"
start.a.omega = "4 rad/s"
events.blow = "c strikes"
[ask]
x = {{ of = "b.x - a.x", at = "blow" }}
y = {{ of = "b.y - a.y", at = "blow" }}
apart = "sqrt((b.x - a.x)^2 + (b.y - a.y)^2)"
spin_a = "a.omega"
spin_b = "b.omega"
spin = {{ of = "a.omega", at = "blow" }}
spin_2 = {{ of = "b.omega", at = "blow" }}
momentum = "momentum.x"
moment = "angular_momentum"
""")
    assert math.hypot(got["x"], got["y"]) == pytest.approx(0.5, rel=1e-9)
    assert got["y"] == pytest.approx(0.3, rel=1e-9)
    assert got["momentum"] == pytest.approx(-3, rel=1e-9)
    assert got["moment"] == pytest.approx(0.3 * 3 + 4 * 0.5 * 2 * 0.3**2, rel=1e-9)
    if capture == "body":
        assert got["spin_a"] == pytest.approx(got["spin_b"], rel=1e-9)
        assert got["spin_a"] == pytest.approx(got["spin"], rel=1e-9)
        assert got["apart"] == pytest.approx(0.5, rel=1e-9)
    else:
        assert abs(got["spin"] - got["spin_2"]) > 0.1
        assert abs(got["apart"] - 0.5) > 1e-3  # they turn about the place of contact


def test_a_corner_of_a_set_is_caught() -> None:
    """Whichever corner comes: the others stay free, and the box falls about the caught one as a pendulum."""
    got = answers(f"""
until = "box.turned = -0.3 rad"
parameters.b = "0.4 m"
ground.points.P = ["0.1 m", "-0.2 m"]
{plate("box", "b", "b", "3 kg", at={"A": ["0.1 m", 0]})}
contacts.post = {{ touch = ["box.corners", "ground.P"], capture = "pin" }}
[ask]
first = "post[0].closed"
all = "post.closed"
omega = "box.omega"
fall = {{ of = "box.speed", at = "before blow" }}
[events]
blow = "post strikes"
""")
    v, inertia = math.sqrt(2 * 9.81 * 0.2), 2 * 0.4**2 / 3
    after, r = -v * 0.2 / inertia, 0.2 * math.sqrt(2)
    rise = r * (math.sin(math.pi / 4 - 0.3) - math.sin(math.pi / 4))
    assert got["fall"] == pytest.approx(v, rel=1e-9)
    assert (got["first"], got["all"]) == (1, 1)
    assert got["omega"] == pytest.approx(-math.sqrt(after**2 - 2 * 9.81 * rise / inertia), rel=1e-9)


def test_it_is_explained_and_drawn() -> None:
    """Also where the points are at one place when it starts."""
    text = CLAY.replace("PARTNERS", '"clay", "rod.B"').replace("-0.6 m", "0 m")
    assert "hit  clay - rod.B  captures as a pin" in explain(planemotion.load_text(text)).text
    text = text.replace('"pin"', '"body"')
    assert "captures as a body" in explain(planemotion.load_text(text)).text
    with page.style():
        figure = sketch.figure(sketch.start_of(planemotion.load_text(text)))
    assert "hit" in [one.get_text() for one in figure.axes[0].texts]


@pytest.mark.parametrize("route", ROUTES)
def test_what_is_captured_is_let_go(route: str) -> None:
    """Released it flies on along the tangent; added again, it is caught where it is met again."""
    text = CLAY.replace("PARTNERS", '"clay", "rod.B"').replace('"rod.turned = 0.5 rad"', '"t = 1 s"')
    text = text.replace(
        "[ask]",
        'events.go = { when = "rod.turned = 0.5 rad", do = [{ remove = "hit" }] }\n'
        'events.opened = "hit opens"\n[ask]\n'
        'opened = "opened.count"\ngone = { of = "t", at = "go" }\n'
        'x = "clay.x"\ny = "clay.y"\nturned = "rod.turned"\n'
        'held = { of = "hit.closed", at = "before go" }\nloss = { of = "energy.kinetic", at = "go" }\n',
    )
    got = answers(text, route)
    omega = 0.3 * 9 * 1.2 / (4 * 1.2**2 / 3 + 0.3 * 1.2**2)
    gone, close = 0.6 / 9 + 0.5 / omega, within(route, ida=1e-6)
    flown = 1.2 * omega * (1 - gone)
    assert got["gone"] == pytest.approx(gone, rel=close)
    assert (got["held"], got["closed"], got["opened"]) == (1, 0, 1)
    assert got["x"] == pytest.approx(1.2 * math.sin(0.5) + flown * math.cos(0.5), rel=10 * close)
    assert got["y"] == pytest.approx(-1.2 * math.cos(0.5) + flown * math.sin(0.5), rel=10 * close)
    assert got["turned"] == pytest.approx(omega * (1 - 0.6 / 9), rel=10 * close)
    assert got["omega"] == pytest.approx(omega, rel=close)
    assert got["loss"] == pytest.approx(0.5 * 0.3 * 9 * 1.2 * omega, rel=10 * close)


def test_let_go_and_caught_again() -> None:
    """A rod drops its lump and takes it back at the same instant: nothing has happened."""
    text = CLAY.replace("PARTNERS", '"clay", "rod.B"').replace("turned = 0.5 rad", "turned = 1 rad")
    again = 'do = [{ remove = "hit" }, { add = "hit" }]'
    text = text.replace("[ask]", f'events.go = {{ when = "rod.turned = 0.5 rad", {again} }}\n[ask]')
    got = answers(text)
    omega = 0.3 * 9 * 1.2 / (4 * 1.2**2 / 3 + 0.3 * 1.2**2)
    assert got["closed"] == 1
    assert got["omega"] == pytest.approx(omega, rel=1e-9)
    assert got["holds"] == pytest.approx(0.3 * 1.2 * omega**2, rel=1e-8)


@pytest.mark.parametrize("friction", [0, 0.3])
@pytest.mark.parametrize("turn", [0.03 + 0.37 * k for k in range(17)])
def test_a_contact_of_an_end_that_is_held_does_nothing(turn: float, friction: float) -> None:
    """A hook jerks one end of a rod off the floor it touches; rounding is no motion."""
    up = [-math.sin(turn), math.cos(turn)]
    got = answers(
        f"""
until = "start"
plane = "horizontal"
ground.lines.floor = {{ through = [0, 0], angle = "{turn} rad" }}
bodies.rod = {{ rod = ["A", "B"], length = "0.83 m", mass = "2.7 kg", at.A = [0, 0], angle = "{turn} rad" }}
bodies.hook = {{ at = "rod.A", driven.velocity = ["{1.9 * up[0]} m/s", "{1.9 * up[1]} m/s"] }}
contacts.catch = {{ touch = ["rod.A", "hook"], capture = "pin" }}
contacts.held = {{ touch = ["rod.A", "ground.floor"], friction = {friction} }}
contacts.foot = {{ touch = ["rod.B", "ground.floor"] }}
[start]
rod = {{ velocity = [0, 0], omega = 0 }}
[ask]
x = "foot.impulse.x on rod"
y = "foot.impulse.y on rod"
held = "held.impulse.norm"
"""
    )
    # J_A + J_B = m v/2 and J_A - J_B = m v/6, as B stays on the floor.
    assert [got["x"], got["y"]] == pytest.approx([2.7 * 1.9 / 6 * u for u in up], rel=1e-9, abs=1e-12)
    assert got["held"] == pytest.approx(0, abs=1e-12)
