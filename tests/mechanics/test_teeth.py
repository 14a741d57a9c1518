"""Gears as they are built: pressure angle, racks, and friction of teeth."""

from __future__ import annotations

import itertools
import math

import pytest
from scipy import integrate

import planemotion
from tests.mechanics.tooth_scenes import I_A, I_B, PAIR, PHI, RACK
from tests.scenes import ROUTES, G, answers, within
from tests.scenes.parts import body, on_axle


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
def test_teeth_press_their_wheels_apart(sense: int, route: str) -> None:
    """F_r = F_t tan(phi), whichever flank is loaded; the motion is that of circles that roll."""
    values, close = answers(PAIR, route, T=f"{3 * sense} N*m"), within(route)
    alpha = 3 * sense / (I_A + I_B / 4)
    along = I_B * alpha / 2 / 0.2
    assert values["omega"] == pytest.approx(-0.5 * alpha / 2, rel=close)
    assert values["along"] == pytest.approx(along, rel=close)
    assert values["apart"] == pytest.approx(abs(along) * math.tan(PHI), rel=close)
    assert values["size"] == pytest.approx(abs(along) / math.cos(PHI), rel=close)
    assert values["axle_A"] == pytest.approx(abs(along) * math.tan(PHI), rel=close)
    assert values["axle_B"] == pytest.approx(-abs(along) * math.tan(PHI), rel=close)
    assert values["axle_B_y"] == pytest.approx(-along, rel=close)


SWINGING = PAIR.replace('value = "T"', 'value = "T*cos(t*(20 rad/s) + 0.3)"').replace(
    "[ask]", '[ask]\npushed = { integral = "b.force.x on B" }\nleast = { min = "mesh.force.x on B" }'
)


@pytest.mark.parametrize("route", ROUTES)
def test_the_other_flank_is_loaded_where_the_couple_reverses(route: str) -> None:
    """The integral of F_r is that of |F_t| tan(phi)."""
    values, close = answers(SWINGING, route), within(route)
    share = I_B / 2 / 0.2 / (I_A + I_B / 4)  # F_t by T
    cut = [(k * math.pi - math.pi / 2 - 0.3) / 20 for k in range(1, 5)]
    edges = [0.0, *(t for t in cut if 0 < t < 0.5), 0.5]

    def way(t: float) -> float:
        return math.sin(20 * t + 0.3) / 20

    total = sum(abs(way(b) - way(a)) for a, b in itertools.pairwise(edges))
    assert values["pushed"] == pytest.approx(-3 * share * math.tan(PHI) * total, rel=close)
    assert values["least"] == pytest.approx(0, abs=1e-6)
    assert values["along"] == pytest.approx(3 * share * math.cos(10.3), rel=close)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("first", ["pinion", "ring"])
def test_a_ring_presses_its_pinion_inwards(first: str, sense: int, route: str) -> None:
    names = ["ring.teeth", "pinion.teeth"] if first == "ring" else ["pinion.teeth", "ring.teeth"]
    values = answers(
        f"""
until = "t = 0.5 s"
plane = "horizontal"
{on_axle("ring", "r", inertia="0.5 kg*m^2", mass="1 kg", circles={"teeth": "0.4 m"})}
{on_axle("pinion", "p", inertia="0.01 kg*m^2", mass="1 kg", circles={"teeth": "0.1 m"}, x="0.3 m")}
couplings.mesh = {{ gears = {names!r}, pressure_angle = "25 deg" }}
forces.motor = {{ couple = "pinion", value = "{3 * sense} N*m" }}
[ask]
ring = "ring.omega"
x = "mesh.force.x on pinion"
y = "mesh.force.y on pinion"
axle = "p.force.x on pinion"
""",
        route,
    )
    alpha = 3 * sense / (0.01 + 0.5 / 16)
    along, close = 0.5 * alpha / 4 / 0.4, within(route)
    assert values["ring"] == pytest.approx(alpha / 8, rel=close)
    assert values["y"] == pytest.approx(-along, rel=close)
    assert values["x"] == pytest.approx(-abs(along) * math.tan(math.radians(25)), rel=close)
    assert values["axle"] == pytest.approx(-values["x"], rel=close)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
def test_a_pinion_drives_a_rack(sense: int, route: str) -> None:
    """(I/R^2 + m) a = T/R; the guide carries the weight, F_t tan(phi), and their couple."""
    values, close = answers(RACK, route, T=f"{3 * sense} N*m"), within(route)
    a = sense * 3 / 0.1 / (0.5 * 2 + 5)
    along, x = 5 * a, 0.5 * a * 0.4**2
    assert values["v"] == pytest.approx(a * 0.4, rel=close)
    assert values["x"] == pytest.approx(x, rel=close)
    assert values["omega"] == pytest.approx(a * 0.4 / 0.1, rel=close)
    assert values["along"] == pytest.approx(along, rel=close)
    apart = abs(along) * math.tan(PHI)
    assert values["apart"] == pytest.approx(-apart, rel=close)
    assert values["normal"] == pytest.approx(5 * G + apart, rel=close)
    assert values["axle"] == pytest.approx(2 * G - apart, rel=close)
    assert values["couple"] == pytest.approx(-x * apart, rel=close)  # the force acts at x = 0


def test_a_rack_needs_no_pressure_angle() -> None:
    values = answers(RACK.replace(', pressure_angle = "phi"', ""))
    assert values["v"] == pytest.approx(0.4 * 3 / 0.1 / 6, rel=1e-12)
    assert values["apart"] == pytest.approx(0, abs=1e-12)


# ---- friction of teeth ----
RUBBING = PAIR.replace('pressure_angle = "phi"', 'pressure_angle = "phi", efficiency = "eta"')


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("sense", [1, -1])
def test_teeth_lose_what_their_efficiency_says(sense: int, route: str) -> None:
    """What goes into B is eta times what goes out of A."""
    values = answers(RUBBING + 'rub = "mesh.couple on A"\n', route, T=f"{3 * sense} N*m", eta=0.93)
    alpha = sense * 3 / (I_A + I_B / 4 / 0.93)
    assert values["omega"] == pytest.approx(-alpha / 4, rel=within(route))
    power_in, power_out = 3 * sense - I_A * alpha, I_B * alpha / 4
    assert power_out == pytest.approx(0.93 * power_in)
    along = values["along"]
    c = 0.07 / (0.93 / 0.1 + 1 / 0.2)
    assert values["rub"] == pytest.approx(-sense * c * abs(along), rel=within(route))


@pytest.mark.parametrize("route", ROUTES)
def test_teeth_are_less_efficient_backwards_where_the_greater_wheel_drives(route: str) -> None:
    """(1 - c/R_A) / (1 + c/R_B), with the same friction of the teeth: it is little less."""
    c = 0.07 / (0.93 / 0.1 + 1 / 0.2)
    backwards = (1 - c / 0.1) / (1 + c / 0.2)
    text = RUBBING.replace('couple = "A"', 'couple = "B"').replace('omega = "B.omega"', 'omega = "A.omega"')
    values = answers(text, route, eta=0.93)
    alpha = 3 / (I_B + I_A * 4 / backwards)
    assert values["omega"] == pytest.approx(-alpha * 2 * 0.5, rel=within(route))


@pytest.mark.parametrize("given", ["efficiency = 0.9", 'friction = { mu = 0.1, radius = "4 mm" }'])
@pytest.mark.parametrize("names", [["pinion", "ring"], ["ring", "pinion"]])
def test_internal_teeth_slide_less(names: list[str], given: str) -> None:
    text = f"""
until = "t = 0.5 s"
plane = "horizontal"
{on_axle("ring", "r", inertia="0.5 kg*m^2", mass="1 kg", circles={"teeth": "0.4 m"})}
{on_axle("pinion", "p", inertia="0.01 kg*m^2", mass="1 kg", circles={"teeth": "0.1 m"}, x="0.3 m")}
couplings.mesh = {{ gears = {[f"{name}.teeth" for name in names]!r}, {given} }}
forces.motor = {{ couple = "{names[0]}", value = "3 N*m" }}
[ask]
first = "{names[0]}.omega"
"""
    radius, inertia = {"ring": 0.4, "pinion": 0.1}, {"ring": 0.5, "pinion": 0.01}
    a, b = names
    eta = 0.9
    if "mu" in given:  # the couple on each is 0.1 * 4 mm of the force at the pitch circles
        sign = 1 if a == "pinion" else -1  # the pinion turns faster
        c = 0.1 * 0.004
        eta = (1 + sign * c / radius[b]) / (1 + sign * c / radius[a])
    ratio = radius[a] / radius[b]
    alpha = 3 / (inertia[a] + inertia[b] * ratio**2 / eta)
    assert answers(text)["first"] == pytest.approx(0.5 * alpha, rel=1e-9)


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_losses_where_the_flanks_change(route: str) -> None:
    """Turning forward throughout; the couple reverses: then B drives A."""
    c = 0.07 / (0.93 / 0.1 + 1 / 0.2)
    text = RUBBING.replace('value = "T"', 'value = "T*cos(t*(20 rad/s) + 0.3)"')
    text = text.replace("[ask]", '[start]\nA.omega = "40 rad/s"\n[ask]\nturned = "A.turned"')
    values = answers(text, route, eta=0.93)

    def rate(t: float, y: list[float], sign: float) -> list[float]:
        share = (0.1 + sign * c) / (0.2 - sign * c)
        return [y[1], 3 * math.cos(20 * t + 0.3) / (I_A + I_B / 2 * share)]

    edges = [0.0, *[(k * math.pi - math.pi / 2 - 0.3) / 20 for k in range(1, 5)], 0.5]
    edges = [t for t in edges if 0 <= t <= 0.5]
    y = [0.0, 40.0]
    for k, (a, b) in enumerate(itertools.pairwise(edges)):
        y = integrate.solve_ivp(rate, (a, b), y, args=(1 - 2 * (k % 2),), rtol=1e-12, atol=1e-13).y[:, -1]
    assert values["turned"] == pytest.approx(y[0], rel=within(route, ida=1e-6))
    assert values["omega"] == pytest.approx(-y[1] / 2, rel=within(route, ida=1e-6))


def test_a_worm_that_cannot_be_driven_back_holds() -> None:
    """Friction so great that the wheel does not drive: (1 - c/R_A) < 0."""
    text = RUBBING.replace('efficiency = "eta"', 'friction = { mu = 1, radius = "0.11 m" }')
    back = text.replace('couple = "A"', 'couple = "B"')
    assert answers(back)["omega"] == pytest.approx(0, abs=1e-12)


def test_a_rack_with_losses() -> None:
    values = answers(RACK.replace('pressure_angle = "phi"', 'pressure_angle = "phi", efficiency = 0.8'))
    assert values["v"] == pytest.approx(0.4 * 3 / 0.1 / (1 + 5 / 0.8), rel=1e-9)


# ---- blows ----
@pytest.mark.parametrize("sense", [1, -1])
def test_a_blow_loads_the_flank_that_pushes(sense: int) -> None:
    values = answers(
        PAIR.replace(
            "[ask]",
            '[events]\nblow = { when = "t = 0.2 s", do = [{ impulse = "A", value = "'
            + f'{4 * sense} N*m*s" }}] }}\n[ask]',
        )
        + """
teeth_x = { of = "mesh.impulse.x on B", at = "blow" }
teeth_y = { of = "mesh.impulse.y on B", at = "blow" }
axle_x = { of = "b.impulse.x on B", at = "blow" }
"""
    )
    change = 4 * sense / (I_A + I_B / 4)
    along = I_B * change / 2 / 0.2
    assert values["teeth_y"] == pytest.approx(along, rel=1e-9)
    assert values["teeth_x"] == pytest.approx(abs(along) * math.tan(PHI), rel=1e-9)
    assert values["axle_x"] == pytest.approx(-abs(along) * math.tan(PHI), rel=1e-9)
    assert values["along"] > 0  # of the motor again


STRUCK = f"""
until = "t = 0.1 s"
plane = "horizontal"
parameters = {{ side = 1 }}
{on_axle("A", "a", disk="0.1 m", mass="2 kg")}
{on_axle("B", "b", disk="0.2 m", mass="6 kg", x="0.3 m", points={"E": ["0.15 m", 0]})}
{body("ball", sphere="1 cm", mass="0.5 kg", at=["0.45 m", "-(0.03 m)*side"])}
couplings.mesh = {{ gears = ["A.rim", "B.rim"], pressure_angle = "20 deg" }}
contacts.hit = {{ touch = ["ball.rim", "B.E"], restitution = 1 }}
start.ball.velocity.y = "(2 m/s)*side"
events.strike = "hit strikes"
[ask]
omega = "B.omega"
x = {{ of = "mesh.impulse.x on B", at = "strike" }}
y = {{ of = "mesh.impulse.y on B", at = "strike" }}
axle_x = {{ of = "a.impulse.x on A", at = "strike" }}
"""


@pytest.mark.parametrize("side", [1, -1])
def test_a_ball_strikes_a_wheel(side: int) -> None:
    """It meets a point of B from below or from above, e = 1: the axles feel what drives the wheels apart."""
    values = answers(STRUCK, side=side)
    omega = 2 * 0.5 * 0.15 * 2 * side / (I_B + 4 * I_A + 0.5 * 0.15**2)
    assert values["omega"] == pytest.approx(omega, rel=1e-9)
    along = I_A * 2 * omega / 0.1  # A is turned back by it: B has the opposite, at its left
    assert values["y"] == pytest.approx(along, rel=1e-9)
    assert values["x"] == pytest.approx(abs(along) * math.tan(PHI), rel=1e-9)
    assert values["axle_x"] == pytest.approx(abs(along) * math.tan(PHI), rel=1e-9)


# ---- what does not fit ----
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"phi"', '"80 deg"', r"couplings\.mesh\.pressure_angle.* must lie between 0 and 1\.0"),
        ('pressure_angle = "phi"', "efficiency = 1.2", r"couplings\.mesh\.efficiency.*above 0 and at most 1"),
        ('pressure_angle = "phi"', "efficiency = 0", r"couplings\.mesh\.efficiency.*above 0 and at most 1"),
        (
            'pressure_angle = "phi"',
            'efficiency = 0.9, friction = { mu = 0.1, radius = "1 mm" }',
            "give friction or efficiency, not both",
        ),
        ('pressure_angle = "phi"', "friction = 0.1", "or give their efficiency"),
        ('pressure_angle = "phi"', "restitution = 0.1", "teeth without backlash do not strike"),
        ('pressure_angle = "phi"', 'backlash = "-1 mm"', r"couplings\.mesh\.backlash"),
        ('pressure_angle = "phi"', 'backlash = "0*phi*(1 mm)"', r"backlash.*must be positive"),
        ('pressure_angle = "phi"', 'backlash = "1 mm", efficiency = 1.1', "above 0 and at most 1"),
        ('["A.rim", "B.rim"]', '["A.rim", "B.center"]', "B.center is a point"),
    ],
)
def test_messages(old: str, new: str, said: str) -> None:
    with pytest.raises(planemotion.SceneError, match=said):
        planemotion.load_text(PAIR.replace(old, new)).run()


def test_a_rack_that_does_not_touch_is_told() -> None:
    text = RACK.replace('"-0.1 m"', '"-0.11 m"')
    with pytest.raises(planemotion.SimulationError, match=r"0\.01 m from touching"):
        planemotion.load_text(text).run()
