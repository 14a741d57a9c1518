"""Motion that is prescribed by position, beside closed forms and independent integrations."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from scipy.integrate import solve_ivp

import planemotion
from tests.scenes import ROUTES

SHAKEN = """
until = "t = 5 s"
parameters = { a = "0.2 m", w = "3 rad/s" }
bodies.cart = { mass = "2 kg", driven.at = ["a*sin(w*t)", "0.1*a*cos(2*w*t)"] }
bodies.bob = { mass = "1 kg", at = ["(0.7 m)*sin(40 deg)", "-(0.7 m)*cos(40 deg) + 0.1*a"] }
joints.rod = { link = ["cart", "bob"], length = "0.7 m" }
start.bob.velocity.x = "0.5 m/s"
ask.x = { of = "bob.x", unit = "m" }
ask.work = { integral = "cart.driven.power", unit = "J" }
"""
CRANK = """
until = "t = 2 s"
parameters = { A = "2.5 rad", w = "4 rad/s" }
bodies.crank = { rod = ["O", "P"], length = "0.1 m", mass = "1 kg", at = { O = [0, 0] } }
bodies.rod = { rod = ["P", "Q"], length = "0.3 m", mass = "2 kg", at = { P = "crank.P" }, angle = "~-10 deg" }
bodies.piston = { mass = "3 kg", at = { G = "rod.Q" } }
ground.lines.guide = { through = [0, 0], angle = 0 }
joints.O = { pin = ["crank.O", "ground"], angle = "(60 deg) + A*sin(w*t)" }
joints.P = { pin = ["rod.P", "crank.P"] }
joints.Q = { pin = ["piston", "rod.Q"] }
joints.S = { slider = ["piston", "ground.guide"] }
ask.x = { of = "piston.x", unit = "m" }
ask.v = { of = "piston.velocity.x", unit = "m/s" }
ask.work = { integral = "O.power", unit = "J" }
events.begin = "start"
ask.before = { of = "energy.total", at = "begin", unit = "J" }
ask.after = { of = "energy.total", unit = "J" }
ask.gained = { of = "after - before", unit = "J" }
"""
ROPE = """
until = "t = 4 s"
plane = "horizontal"
bodies.bob = { mass = "1.5 kg", at = ["0.8 m", 0] }
ground.points.O = [0, 0]
joints.rope = { link = ["bob", "ground.O"], length = "(0.8 m) + (0.3 m)*sin((2 rad/s)*t)" }
start.bob.velocity.y = "2 m/s"
ask.H = { of = "bob.x*bob.velocity.y - bob.y*bob.velocity.x", unit = "m^2/s" }
ask.r = { of = "norm(bob.x, bob.y)", unit = "m" }
"""
CORNER = """
until = "t = 2 s"
plane = "horizontal"
bodies.w = { disk = "0.2 m", mass = "2 kg", at = [0, 0] }
joints.O = { pin = ["w", "ground"], angle = "PROGRAM" }
events.half = "t = 0.5 s"
ask.angle = { of = "w.angle", unit = "rad" }
ask.omega = { of = "w.omega", unit = "rad/s" }
ask.half = { of = "w.angle", at = "half", unit = "rad" }
"""


def run(text: str, route: str) -> planemotion.RunResult:
    return planemotion.load_text(f'{text}\n[solve]\nroute = "{route}"\n').run()


def shaken() -> tuple[float, float]:
    """x of the bob and the work of the drive, by the angle of the rod alone."""
    length, a, w, g, start = 0.7, 0.2, 3.0, 9.81, math.radians(40)

    def rates(t: float, y: npt.NDArray[np.float64]) -> list[float]:
        angle, omega, _ = y
        ax, ay = -a * w * w * math.sin(w * t), -0.4 * a * w * w * math.cos(2 * w * t)
        vx, vy = a * w * math.cos(w * t), -0.2 * a * w * math.sin(2 * w * t)
        alpha = -((g + ay) * math.sin(angle) + ax * math.cos(angle)) / length
        bx = ax + length * (alpha * math.cos(angle) - omega**2 * math.sin(angle))
        by = ay + length * (alpha * math.sin(angle) + omega**2 * math.cos(angle))
        return [omega, alpha, (bx + 2 * ax) * vx + (by + g + 2 * (ay + g)) * vy]

    up = (0.5 - a * w) * math.tan(start)
    omega = ((0.5 - a * w) * math.cos(start) + up * math.sin(start)) / length
    found = solve_ivp(rates, (0, 5), [start, omega, 0], "DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return a * math.sin(5 * w) + length * math.sin(found[0]), found[2]


@pytest.mark.parametrize("route", ROUTES)
def test_a_pendulum_on_a_shaken_support(route: str) -> None:
    result = run(SHAKEN, route)
    x, work = shaken()
    assert result["x"] == pytest.approx(x, abs=1e-10)
    assert result["work"] == pytest.approx(work, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_a_slider_crank_is_kinematics_and_the_drive_does_the_work(route: str) -> None:
    result = run(CRANK, route)
    angle, omega = math.pi / 3 + 2.5 * math.sin(8), 10 * math.cos(8)
    reach = math.sqrt(0.09 - 0.01 * math.sin(angle) ** 2)
    assert result["x"] == pytest.approx(0.1 * math.cos(angle) + reach, abs=1e-13)
    slope = -0.1 * math.sin(angle) - 0.01 * math.sin(angle) * math.cos(angle) / reach
    assert result["v"] == pytest.approx(slope * omega, abs=1e-12)
    assert result["gained"] == pytest.approx(result["work"], abs=1e-10)


@pytest.mark.parametrize("route", ROUTES)
def test_a_rope_of_given_length_keeps_the_moment_of_momentum(route: str) -> None:
    result = run(ROPE, route)
    assert result["H"] == pytest.approx(1.6, abs=1e-10)
    assert result["r"] == pytest.approx(0.8 + 0.3 * math.sin(8), abs=1e-14)


@pytest.mark.parametrize("route", ROUTES)
def test_a_corner_is_a_blow(route: str) -> None:
    result = run(CORNER.replace("PROGRAM", "(2 rad/s)*abs(t - (1 s))"), route)
    assert result.counts["jumps"] == 1
    assert result["angle"] == pytest.approx(2, abs=1e-14)
    assert result["omega"] == pytest.approx(2, abs=1e-12)


def lesser_or_greater(seed: int) -> tuple[str, float, float]:
    """Two straight laws that cross before 1.8 s, the lesser or the greater of them; value and rate at 2 s."""
    rng = np.random.default_rng(seed)
    corner = float(rng.choice([rng.uniform(0.2, 1.8), rng.integers(1, 8) / 4]))
    slope = [0.0 if rng.random() < 0.3 else float(rng.uniform(-2, 2)), float(rng.uniform(-2, 2))]
    level = 0.0 if rng.random() < 0.3 else float(rng.uniform(-1, 1))
    laws = [f"({level!r} rad) + ({a!r} rad/s)*(t - ({corner!r} s))" for a in slope]
    name, best = [("min", min), ("max", max)][seed % 2]
    rate = best(slope)
    order = [laws[k] for k in rng.permutation(2)]
    if rng.random() < 0.3:
        order.append(f"{-9 if name == 'max' else 9} rad")
    return f"{name}({', '.join(order)})", level + rate * (2 - corner), rate


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(12))
def test_the_corner_of_a_lesser_or_greater_is_a_blow(seed: int, route: str) -> None:
    law, angle, omega = lesser_or_greater(seed)
    at = f"at = [0, 0], angle = '{law.replace('t - ', '(0 s) - ')}'"
    result = run(CORNER.replace("PROGRAM", law).replace("at = [0, 0]", at, 1), route)
    assert result.counts["jumps"] == 1
    assert result["angle"] == pytest.approx(angle, abs=1e-13)
    assert result["omega"] == pytest.approx(omega, abs=1e-12)


@pytest.mark.parametrize("route", ROUTES)
def test_a_jump_is_refused_and_what_was_answered_before_stands(route: str) -> None:
    result = run(CORNER.replace("PROGRAM", "t*(1 rad/s) + (0.1 rad)*(t > (1 s))"), route)
    assert result.status == "drive_jumps"
    assert result["half"] == pytest.approx(0.5, abs=1e-12)
    assert "joints.O: what is prescribed jumps by 0.1 rad" in str(result.error)


def test_a_start_that_does_not_fit_is_told() -> None:
    text = CORNER.replace("PROGRAM", "(60 deg) + t*(1 rad/s)").replace(
        "at = [0, 0] }", 'at = [0, 0], angle = "5 deg" }'
    )
    with pytest.raises(planemotion.PlanemotionError, match=r"what is prescribed at joints\.O"):
        planemotion.load_text(text).run()


YOKE = """
until = "t = 1.7 s"
plane = "horizontal"
parameters = { turn = "0 deg", r = "0.2 m" }
ground.lines.guide = { through = [0, 0], angle = "turn" }
bodies.crank = { disk = "0.3 m", mass = "2 kg", points = { P = ["r", 0] }, at = [0, 0] }
[bodies.yoke]
plate = ["0.1 m", "0.8 m"]
mass = "1.5 kg"
lines = { slot = { through = [0, 0], angle = "90 deg" } }
at = { polar = ["r", "turn"] }
angle = "turn"
[joints]
O = { pin = ["crank.center", "ground"] }
guide = { slider = ["yoke.center", "ground.guide"], turning = false }
slot = { slider = ["crank.P", "yoke.slot"] }
[couplings]
drive = { motor = ["crank", "ground"], angle = "turn + (5 rad/s)*t" }
[ask]
along = { of = "yoke.x*cos(turn) + yoke.y*sin(turn)", unit = "m" }
across = { of = "yoke.y*cos(turn) - yoke.x*sin(turn)", unit = "m" }
couple = { of = "drive.couple", unit = "N*m" }
power = { of = "drive.power", unit = "W" }
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("turn", ["0 deg", "37 deg", "-100 deg"])
def test_a_scotch_yoke_moves_by_a_cosine_wherever_it_lies(route: str, turn: str) -> None:
    """The couple is m r^2 w^2 sin cos: what the yoke's acceleration needs, by its lever."""
    result = run(YOKE.replace("0 deg", turn, 1), route)
    angle = 5 * 1.7
    assert result["along"] == pytest.approx(0.2 * math.cos(angle), abs=1e-13)
    assert result["across"] == pytest.approx(0, abs=1e-13)
    couple = 1.5 * 0.2**2 * 25 * math.sin(angle) * math.cos(angle)
    assert result["couple"] == pytest.approx(couple, abs=1e-11)
    assert result["power"] == pytest.approx(5 * couple, abs=1e-10)


ARM = """
until = "t = 3 s"
plane = "horizontal"
bodies.arm = { rod = ["O", "E"], length = "1 m", mass = "3 kg", at = { O = [0, 0] }, angle = 0 }
bodies.bead = { mass = "1 kg", at = ["0.3 m", 0] }
joints.O = { pin = ["arm.O", "ground"] }
joints.drive = { slider = ["bead", "arm.axis"], position = "PLACE", friction = 0.2 }
start.arm.omega = "2 rad/s"
ask.omega = { of = "arm.omega", unit = "rad/s" }
ask.r = { of = "norm(bead.x, bead.y)", unit = "m" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_that_is_driven_along_a_free_arm_keeps_the_angular_momentum(route: str) -> None:
    """Friction in the guide is between the two: it takes energy, and no angular momentum."""
    result = run(ARM.replace("PLACE", "(-0.2 m) + (0.2 m)*sin((1 rad/s)*t)"), route)
    r = 0.3 + 0.2 * math.sin(3)
    assert result["r"] == pytest.approx(r, abs=1e-13)
    assert result["omega"] == pytest.approx(2 * (1 + 0.3**2) / (1 + r**2), abs=1e-10)


TABLE = """
until = "t = 0.6 s"
bodies.table = { plate = ["1 m", "0.1 m"], mass = "5 kg", driven.at = [0, "SPEED*max(t - (0.5 s), 0)"] }
bodies.ball = { sphere = "0.05 m", mass = "1 kg", at = [0, "0.1 m"] }
contacts.c = { touch = ["ball.rim", "table.top"], restitution = 0.5 }
ask.y = { of = "ball.y", unit = "m" }
ask.v = { of = "ball.velocity.y", unit = "m/s" }
ask.closed = "c.closed"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_what_rests_on_a_table_is_thrown_or_left_by_its_jerk(route: str) -> None:
    left = run(TABLE.replace("SPEED", "-(1 m/s)"), route)
    assert left["closed"] == 0
    assert left["y"] == pytest.approx(0.1 - 0.5 * 9.81 * 0.1**2, abs=1e-11)
    thrown = run(TABLE.replace("SPEED", "(1 m/s)"), route)
    assert (thrown["closed"], thrown.counts["jumps"]) == (1, 1)
    assert thrown["y"] == pytest.approx(0.2, abs=1e-12)
    assert thrown["v"] == pytest.approx(1, abs=1e-12)
