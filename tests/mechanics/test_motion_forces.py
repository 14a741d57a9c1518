"""Forces that depend on the motion, and switch by it: beside closed forms and quadratures, on each route."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from planemotion import load_text
from tests.scenes import ROUTES, G, answers, number, within

BALL = """
parameters = {{ m = "1 kg", c = "{c}" }}
bodies.ball = {{ mass = "m", at = [0, 0] }}
start.ball.velocity.x = "5 m/s"
start.ball.velocity.y = "12 m/s"
until = "t = 3 s"
[forces]
drag = {{ force = "ball", value = [{x}, {y}] }}
[ask]
x = "ball.x"
y = "ball.y"
vx = "ball.velocity.x"
vy = "ball.velocity.y"
work = "drag.work"
"""
LINE = """
plane = "horizontal"
ground.points.O = [0, 0]
ground.lines.track = {{ through = [0, 0], angle = 0 }}
parameters = {{ k = "2 N/m", k3 = "3 N/m^3", a = "1 m" }}
bodies.m = {{ mass = "1 kg", at = ["1.5 m", 0] }}
until = "t = 10 s"
[forces]
{force}
[ask]
x = "m.x"
v = "m.velocity.x"
"""
# One law in four ways of writing it.
CUBIC = (
    'S = { force = "m", value = ["-k*m.x - k3*m.x^3", 0] }',
    'S = { force = ["ground.O", "m"], value = "k*S.stretch + k3*S.stretch^3" }',
    'S = { spring = ["m", "ground.O"], stiffness = "k + k3*S.stretch^2", free_length = 0 }',
    'S = { force = "m", value = { polar = ["k*m.x + k3*m.x^3", "180 deg"] } }',
)


def close(found: object, true: float, route: str, scale: float = 1.0) -> None:
    assert found == pytest.approx(true, rel=within(route, ida=1e-8), abs=within(route, ida=1e-8) * scale)


@pytest.mark.parametrize("route", ROUTES)
def test_linear_drag(route: str) -> None:
    text = BALL.format(c="0.4 N*s/m", x='"-c*ball.velocity.x"', y='"-c*ball.velocity.y"')
    found = answers(text, route)
    decay, t, c = math.exp(-0.4 * 3), 3.0, 0.4
    vx, vy = 5 * decay, (12 + G / c) * decay - G / c
    x, y = 5 * (1 - decay) / c, (12 + G / c) * (1 - decay) / c - G * t / c
    for key, true in (("vx", vx), ("vy", vy), ("x", x), ("y", y)):
        close(found[key], true, route)
    close(found["work"], 0.5 * (vx**2 + vy**2) - 0.5 * 169 + G * y, route, 100)


@pytest.mark.parametrize("route", ROUTES)
def test_quadratic_drag_up_and_down(route: str) -> None:
    """Lamb, Dynamics, art. 42: tan on the way up, tanh on the way down; abs switches at the top."""
    text = BALL.replace('start.ball.velocity.x = "5 m/s"\n', "")
    text = text.format(c="0.05 kg/m", x="0", y='"-c*ball.velocity.y*abs(ball.velocity.y)"')
    c, rate = 0.05, math.sqrt(G * 0.05)
    end = math.sqrt(G / c)
    top = math.atan(12 / end) / rate
    found = answers(text, route)
    close(found["vy"], -end * math.tanh(rate * (3 - top)), route)
    height = math.log(1 + 144 / end**2) / (2 * c)
    close(found["y"], height - math.log(math.cosh(rate * (3 - top))) / c, route, 5)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("force", CUBIC[:3])
def test_cubic_spring(route: str, force: str) -> None:
    """Duffing's free oscillation: x = a cn(w t), w^2 = k + k3 a^2, modulus^2 = k3 a^2 / (2 w^2)."""
    found = answers(LINE.format(force=force), route)
    w = math.sqrt(2 + 3 * 1.5**2)
    m = 3 * 1.5**2 / (2 * w**2)
    sn, cn, dn, _ = ellipj(10 * w, m)
    if "S.stretch" in force:  # its stretch has no sign: the spring pushes after the centre is passed
        assert ellipk(m) < 10 * w
    close(found["x"], 1.5 * cn, route)
    close(found["v"], -1.5 * w * sn * dn, route, w)


@pytest.mark.parametrize("route", ROUTES)
def test_all_ways_to_write_a_law_agree(route: str) -> None:
    here, *others = (answers(LINE.format(force=force), route) for force in CUBIC)
    for other in others:
        assert other == pytest.approx(here, rel=within(route, ida=1e-8))


PD = """
parameters = {{ kp = "60 N*m", kd = "{kd} N*m*s", target = "90 deg" }}
bodies.AB = {{ rod = ["A", "B"], length = "1 m", mass = "2 kg", at = {{ A = [0, 0] }}, angle = "-80 deg" }}
joints.A = {{ pin = ["AB.A", "ground"] }}
until = "t = 2 s"
[forces]
{forces}
[ask]
angle = "AB.angle"
omega = "AB.omega"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("kd", [0, 8])
def test_controlled_pendulum(route: str, kd: int) -> None:
    """By place alone (kd = 0) and with a rate, beside scipy; as a couple, and as spring and damper."""

    def law(t: float, y: np.ndarray) -> list[float]:
        moment = -60 * (y[0] - math.pi / 2) - kd * y[1] - 2 * G * 0.5 * math.cos(y[0])
        return [y[1], moment / (2 / 3)]

    true = solve_ivp(law, (0, 2), [math.radians(-80), 0], method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    couple = 'motor = { couple = "AB", value = "-kp*(AB.angle - target) - kd*AB.omega" }'
    parts = 's = { torsion = ["AB", "ground"], stiffness = "kp*(1 + 0*AB.omega/(1 rad/s))", '
    parts += f'free_angle = "target" }}\nd = {{ couple = "AB", value = "-{kd}*(1 N*m*s)*d.stretch_rate" }}'
    for forces in (couple, parts):
        found = answers(PD.format(kd=kd, forces=forces), route)
        close(found["angle"], true[0], route)
        close(found["omega"], true[1], route, 10)


STEPS = """
plane = "horizontal"
parameters = {{ F = "3 N", w = "{width}" }}
bodies.m = {{ mass = "1 kg", at = ["-1 m", 0] }}
start.m.velocity.x = "2 m/s"
until = "t = 4 s"
forces.W = {{ force = "m", value = ["{force}", 0] }}
[ask]
x = "m.x"
v = "m.velocity.x"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    "force",
    [
        "-F*(m.x > 0)",
        "-F + F*(m.x < 0)",
        "-F*min((m.x > (0 m)), 1)",
        "-F/2*abs(1 + (m.x > 0) - (m.x < 0))",
    ],
)
def test_a_force_that_jumps_where_a_place_is_passed(route: str, force: str) -> None:
    """To the place, up against the force, back, and out with the speed it came with."""
    found = answers(STEPS.format(force=force, width="1 m"), route)
    back = 0.5 + 2 * 2 / 3
    close(found["x"], -2 * (4 - back), route)
    close(found["v"], -2, route)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("width", [1e-1, 1e-3, 1e-6])
def test_a_window_of_any_width_is_met(route: str, width: float) -> None:
    found = answers(STEPS.format(force="F/w*(0.1 m)*(m.x > 0)*(m.x < w)", width=f"{width} m"), route)
    close(found["v"], math.sqrt(4 + 2 * 0.3), route)


@pytest.mark.parametrize("seed", range(12))
def test_random_laws_with_corners_and_jumps(seed: int) -> None:
    """A bead on a line under a law of pieces: energy tells the speed at a place, and both routes agree."""
    rng = np.random.default_rng(seed)
    knots = np.sort(rng.uniform(-0.8, 3, 4))
    jumps = rng.uniform(-0.5, 0.9, 4)
    bends = rng.uniform(-0.3, 0.5, 4)
    force = " + ".join(
        f"({jump:.17g} N)*(m.x > ({knot:.17g} m)) + ({bend:.17g} N/m)*max(m.x - ({knot:.17g} m), 0)"
        for knot, jump, bend in zip(knots, jumps, bends, strict=True)
    )
    text = STEPS.format(force=force, width="1 m").replace("t = 4 s", 'm.x = 3.5 m", "t = 60 s')
    text = text.replace('until = "m.x = 3.5 m", "t = 60 s"', 'until = ["m.x = 3.5 m", "m.x = -1.5 m"]')
    found = {route: answers(text, route) for route in ROUTES}
    end = number(found["auto"]["x"])
    work = sum(
        jump * max(end - knot, 0) + bend / 2 * max(end - knot, 0) ** 2
        for knot, jump, bend in zip(knots, jumps, bends, strict=True)
    )
    for route in ROUTES:
        close(abs(number(found[route]["v"])), math.sqrt(4 + 2 * work), route)
        close(found[route]["x"], end, route)


# A force that is a peak over the place, and its integral from -inf to u widths.
PEAKS = {
    "bell": ("exp(-((m.x - x0)/w)^2)", lambda u: 0.5 * math.sqrt(math.pi) * (1 + math.erf(u))),
    "lorentz": ("1/(1 + ((m.x - x0)/w)^2)", lambda u: math.atan(u) + 0.5 * math.pi),
    "sech": ("4/(exp((m.x - x0)/w) + exp(-(m.x - x0)/w))^2", lambda u: 1 + math.tanh(u)),
}


@pytest.mark.parametrize("shape", PEAKS)
@pytest.mark.parametrize("seed", range(8))
def test_a_peak_in_space_is_not_passed_over(shape: str, seed: int) -> None:
    """Steps are as long as the motion allows: a free flight but for a force over some um to cm of 10 m."""
    rng = np.random.default_rng(seed)
    width, middle, speed = 10 ** rng.uniform(-5, -1), rng.uniform(1, 9), rng.uniform(0.5, 3)
    law, integral = PEAKS[shape]
    size = rng.uniform(-0.1, 0.3) * speed**2 / width
    text = f"""
    plane = "horizontal"
    parameters = {{ F = "{size!r} N", w = "{width!r} m", x0 = "{middle!r} m" }}
    bodies.m = {{ mass = "1 kg", at = [0, 0] }}
    start.m.velocity.x = "{speed!r} m/s"
    until = "m.x = 10 m"
    forces.W = {{ force = "m", value = ["F*{law}", 0] }}
    ask.v = "m.velocity.x"
    """
    work = size * width * (integral((10 - middle) / width) - integral(-middle / width))
    for route in ("auto", "ida"):
        close(answers(text, route)["v"], math.sqrt(speed**2 + 2 * work), route)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("width", [3.0, 0.3, 0.03])
def test_friction_as_tanh(width: float, route: str) -> None:
    """m v' = -F tanh(v/w): sinh(v/w) = sinh(v0/w) exp(-F t/(m w))."""
    text = f"""
    plane = "horizontal"
    parameters = {{ F = "2 N", w = "{width} m/s" }}
    bodies.m = {{ mass = "1 kg", at = [0, 0] }}
    start.m.velocity.x = "4 m/s"
    until = "t = 2.1 s"
    forces.W = {{ force = "m", value = ["-F*tanh(m.velocity.x/w)", 0] }}
    ask.v = "m.velocity.x"
    """
    # log sinh(u) = u + log((1 - exp(-2 u))/2): sinh(4/0.03) is beyond all numbers
    left = 4 / width + math.log1p(-math.exp(-8 / width)) - 2 * 2.1 / width
    close(answers(text, route)["v"], width * math.asinh(0.5 * math.exp(left)), route)


@pytest.mark.parametrize("route", ROUTES)
def test_a_force_by_the_sign_of_a_place(route: str) -> None:
    """Between two parabolas: a period lasts 4 sqrt(2 a m/F)."""
    text = """
    plane = "horizontal"
    bodies.m = { mass = "2 kg", at = ["0.7 m", 0] }
    until = "t = 5 s"
    forces.W = { force = "m", value = ["(-5 N)*sign(m.x)", 0] }
    ask.x = "m.x"
    """
    found = answers(text, route)
    quarter = math.sqrt(2 * 0.7 * 2 / 5)
    turns, rest = divmod(5.0, quarter)
    side = (1, -1, -1, 1)[int(turns) % 4]
    since = rest if int(turns) % 2 == 0 else quarter - rest
    close(found["x"], side * (0.7 - 0.5 * 2.5 * since**2), route)


def test_a_switch_that_holds_the_motion_is_told() -> None:
    text = STEPS.format(force="-F*((m.velocity.x > (1 m/s)) - (m.velocity.x < (1 m/s)))", width="1 m")
    result = load_text(text).run()
    assert result.status == "alternates"
    assert "forces.W.value switches and pushes the motion back from both sides" in result.error
    assert result.stopped_at == pytest.approx(1 / 3)


@pytest.mark.parametrize("route", ROUTES)
def test_a_force_that_counts_blows(route: str) -> None:
    """A ball that bounces between floor and weaker and weaker gravity: g, g/2, g/3 after each blow."""
    text = """
    plane = "horizontal"
    ground.lines.floor = { through = [0, 0], angle = 0 }
    bodies.b = { sphere = "1 mm", mass = "1 kg", at = [0, "1 m"] }
    contacts.c = { touch = ["b.rim", "ground.floor"], restitution = 0.5 }
    events.hit = "c strikes"
    until = "hit 3"
    forces.pull = { force = "b", value = [0, "(-2 N)/(1 + hit.count)"] }
    [ask]
    t = "t"
    v = { of = "b.velocity.y", at = "before hit 3" }
    """
    height, force, time, speed = 0.999, 2.0, 0.0, 0.0
    time, speed = math.sqrt(2 * height / force), math.sqrt(2 * height * force)
    for count in (1, 2):
        speed /= 2
        time += 2 * speed * (1 + count) / force
    found = answers(text, route)
    close(found["t"], time, route)
    close(found["v"], -speed, route)


def test_what_a_force_of_the_motion_has_and_has_not() -> None:
    scene = load_text(
        LINE.format(force=CUBIC[2]).replace("[ask]", '[ask]\ns = "S.stretch"\nr = "S.stretch_rate"')
    )
    result = scene.run()
    assert result["s"] == pytest.approx(abs(number(result["x"])), rel=1e-9)
    assert abs(number(result["r"])) == pytest.approx(abs(number(result["v"])), rel=1e-9)
    with pytest.raises(Exception, match=r'"S.energy": it has no potential; ask for its work'):
        load_text(LINE.format(force=CUBIC[2]).replace("[ask]", '[ask]\ne = "S.energy"')).run()


DISC = """
plane = "horizontal"
parameters = {{ R = "0.1 m", k = "100 kN/m" }}
bodies.p = {{ mass = "1 kg", at = ["-10 m", "{y} m"] }}
start.p.velocity.x = "1 m/s"
until = "t = 15 s"
[forces]
push.force = "p"
push.value = ["k*{depth}*p.x/norm(p.x, p.y)", "k*{depth}*p.y/norm(p.x, p.y)"]
[ask]
x = "p.x"
vx = "p.velocity.x"
vy = "p.velocity.y"
"""
# How deep it is in the disc, written in four ways.
DEPTHS = (
    "max(0 m, R - norm(p.x, p.y))",
    "max(R - norm(p.x, p.y), 0 m)",
    "(-min(norm(p.x, p.y) - R, 0 m))",
    "(R - min(R, norm(p.x, p.y)))",
)


@pytest.mark.parametrize("depth", DEPTHS)
def test_free_flight_past_a_soft_disc(depth: str) -> None:
    """The greater of two is one of them, without rounding: no force is none, however stiff the disc is."""
    for y in (0.3, -0.15):
        result = load_text(DISC.format(y=y, depth=depth)).run()
        assert result.ok
        assert result.counts["steps"] < 40
        assert number(result.x) == pytest.approx(5, abs=1e-13)
        assert (number(result.vx), number(result.vy)) == (1, 0)


@pytest.mark.parametrize("depth", DEPTHS)
def test_flight_against_a_soft_disc(depth: str) -> None:
    result = load_text(DISC.format(y=0.05, depth=depth)).run()
    assert result.ok
    assert result.counts["steps"] < 100
    assert math.hypot(number(result.vx), number(result.vy)) == pytest.approx(1, abs=1e-9)
