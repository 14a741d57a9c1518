"""Friction of joints by their load in a blow: beside small steps of the impulse, and all modes by hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
import pytest

import planemotion
from tests.scenes import answers

LAWS = ["newton", "poisson", "stronge"]
ROUTES = ["auto", "rk", "ida"]

SLED = """
plane = "horizontal"
until = "t = 1 us"
parameters = { mu = 0.3, e = 0.5, v0 = "1 m/s", f = 0.0, ux = "-3 m/s", uy = "-2 m/s", at = "60 deg" }
ground.lines.rail = { through = [0, 0] }
bodies.sled = { mass = "2 kg", at = [0, 0] }
bodies.ball = { sphere = "0.1 m", mass = "1 kg", at = ["(0.1 m)*cos(at)", "(0.1 m)*sin(at)"] }
joints.rail = { slider = ["sled", "ground.rail"], friction = "mu" }
events.blow = "hit strikes"
contacts.hit = { touch = ["sled", "ball.rim"], restitution = "e", friction = "f", law = "LAW" }
start.sled.velocity.x = "v0"
start.ball.velocity = ["ux", "uy"]
[ask]
v = "sled.velocity.x"
x = "ball.velocity.x"
y = "ball.velocity.y"
omega = "ball.omega"
lost = { of = "energy.lost", at = "blow" }
rubbed = { of = "rail.impulse.x on sled", at = "blow" }
pressed = { of = "rail.impulse.y on sled", at = "blow" }
"""
ROLL = 0.4 * 0.1**2  # kg m^2, of a ball of 1 kg


def follow(
    rates: Callable[[np.ndarray], np.ndarray],
    start: Sequence[float] | np.ndarray,
    law: str,
    e: float,
    steps: int,
) -> np.ndarray:
    """Small steps of the normal impulse of one contact.

    u[0] is its normal velocity; rates(u): what a unit of the impulse does.
    """
    approach, p, work, u = start[0], 0.0, 0.0, np.array(start, dtype=float)
    compresses, end, most = True, 0.0, 0.0
    dp = -approach / steps * 4
    for _ in range(100 * steps):
        rate = rates(u)
        p += dp
        work += dp * (u[0] + 0.5 * dp * rate[0])
        u = u + dp * rate
        if compresses and u[0] >= 0:
            compresses = False
            end, work, most = (1 + e) * p, 0.0, work
        elif not compresses:
            done = {"newton": u[0] >= -e * approach, "poisson": p >= end, "stronge": work >= -(e**2) * most}
            if done[law]:
                return u
        if not compresses and e == 0:
            return u
    raise AssertionError("the blow did not end")


def sign(slip: float, size: float) -> float:
    """Of a slip, with what is none in small steps smoothed."""
    return max(-1.0, min(1.0, slip / size))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("angle", "mu", "f", "v0", "e"),
    [(60, 0.3, 0, 1, 0.5), (60, 0.1, 0, 1, 0.5), (130, 0.3, 0.2, -1, 0.7), (40, 0.6, 0.4, 0.3, 0.2)],
)
def test_a_sled_is_struck_on_its_rail(
    law: str, angle: float, mu: float, f: float, v0: float, e: float
) -> None:
    """The slip of the rail and that of the ball end, hold and reverse while the impulse grows."""
    n = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    t = np.array([-n[1], n[0]])
    start = np.array([v0, -3.0, -2.0, 0.0])  # sled, ball, spin

    def rates(u: np.ndarray) -> np.ndarray:
        v = u[1:]
        slip = (v[1:3] - [v[0], 0]) @ t - 0.1 * v[3]
        push = n - f * sign(slip, 1e-3) * t  # on the ball
        load = push[1]  # the rail bears what presses the sled down
        along = -push[0]
        rub = -mu * abs(load) * sign(v[0], 1e-3)
        dv = np.array([(along + rub) / 2, push[0], push[1], f * sign(slip, 1e-3) * 0.1 / ROLL])
        return np.append((dv[1:3] - [dv[0], 0]) @ n, dv)

    u = follow(rates, np.append((start[1:3] - [v0, 0]) @ n, start), law, e, 20_000)
    if u[0] < 0 or (start[1:3] - [v0, 0]) @ n >= 0:
        raise AssertionError("the ball does not approach")
    values = answers(SLED.replace("LAW", law), mu=mu, f=f, v0=f"{v0} m/s", e=e, at=f"{angle} deg")
    assert [values[k] for k in ("v", "x", "y", "omega")] == pytest.approx(u[1:], abs=4e-3)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("route", ROUTES)
def test_what_a_blow_on_a_rail_gives(law: str, route: str) -> None:
    """Momentum goes into the rail and nowhere else; energy is lost as much as the velocities say."""
    values = answers(SLED.replace("LAW", law), route, f=0.2, v0="1 m/s")
    v, x, y, spin = (values[k] for k in ("v", "x", "y", "omega"))
    rubbed, pressed, lost = (values[k] for k in ("rubbed", "pressed", "lost"))
    assert rubbed == pytest.approx(2 * v + x - (2 - 3), abs=1e-9)
    assert pressed == pytest.approx(y + 2, abs=1e-9)
    assert lost == pytest.approx((2 + 9 + 4) / 2 - (2 * v**2 + x**2 + y**2 + ROLL * spin**2) / 2, abs=1e-8)
    assert lost > 0
    assert abs(rubbed) <= 0.3 * abs(pressed)


@pytest.mark.parametrize("law", LAWS)
def test_a_steep_blow_does_not_move_a_sled(law: str) -> None:
    """Within the friction cone of the rail it holds: the ball comes back as from a wall."""
    values = answers(SLED.replace("LAW", law), mu=0.7, v0="0 m/s", ux="-1 m/s", uy="-2 m/s")
    n = np.array([0.5, math.sqrt(0.75)])
    after = np.array([-1, -2]) - 1.5 * (np.array([-1, -2]) @ n) * n
    assert values["v"] == pytest.approx(0, abs=1e-12)
    assert [values["x"], values["y"]] == pytest.approx(after, abs=1e-9)


@pytest.mark.parametrize("law", LAWS)
def test_a_slot_rubs_like_a_slider(law: str) -> None:
    """At the top of a ring a bead moves as on a rail, at the instant of the blow."""
    text = SLED.replace("LAW", law)
    ring = text.replace(
        "ground.lines.rail = { through = [0, 0] }",
        'ground.circles.rail = { center = [0, "-5 m"], radius = "5 m" }',
    )
    found = answers(ring.replace("slider =", "slot ="))
    expected = answers(text)
    assert found == pytest.approx(expected, abs=1e-5)


TWO = """
plane = "horizontal"
until = "t = 1 us"
[parameters]
mu = 0.3
e1 = 0.5
e2 = 0.2
v0 = "1 m/s"
x1 = "-3 m/s"
y1 = "-2 m/s"
x2 = "2 m/s"
y2 = "3 m/s"
a1 = "60 deg"
a2 = "-130 deg"
[ground]
lines.rail = { through = [0, 0] }
[bodies]
sled = { mass = "2 kg", at = [0, 0] }
one = { sphere = "0.1 m", mass = "1 kg", at = ["(0.1 m)*cos(a1)", "(0.1 m)*sin(a1)"] }
two = { sphere = "0.1 m", mass = "0.5 kg", at = ["(0.1 m)*cos(a2)", "(0.1 m)*sin(a2)"] }
[joints]
rail = { slider = ["sled", "ground.rail"], friction = "mu" }
[events]
blow = "a strikes"
[contacts]
a = { touch = ["sled", "one.rim"], restitution = "e1" }
b = { touch = ["sled", "two.rim"], restitution = "e2" }
[start]
sled.velocity.x = "v0"
one.velocity = ["x1", "y1"]
two.velocity = ["x2", "y2"]
[ask]
v = "sled.velocity.x"
rubbed = { of = "rail.impulse.x on sled", at = "blow" }
"""


def by_hand(
    mu: float,
    v0: float,
    e: np.ndarray,
    angle: Sequence[float],
    u: Sequence[np.ndarray],
    masses: Sequence[float],
) -> list[np.ndarray]:
    """All modes of two smooth balls and a rail: who pushes, how it slips, which side is pressed."""
    n = [np.array([math.cos(a), math.sin(a)]) for a in np.radians(angle)]
    found: list[np.ndarray] = []
    for pushes, slips, side in product(product([0, 1], repeat=2), [-1, 0, 1], [-1, 1]):
        # unknown: p_a, p_b, F, v; equations linear in them
        a, b = np.zeros((4, 4)), np.zeros(4)
        for i in range(2):  # normal velocity after the blow, of ball i relative to the sled
            before = (u[i] - [v0, 0]) @ n[i]
            if pushes[i]:
                a[i, i], a[i, 3] = 1 / masses[i], -n[i][0]
                b[i] = -(u[i] @ n[i]) - e[i] * min(before, 0)
            else:
                a[i, i] = 1
        a[2, 2] = 1
        if slips == 0:
            a[2] = [0, 0, 0, 1]
        else:  # the rail bears sum p n_y, positive: presses it down
            a[2, :2] = [slips * mu * side * n[i][1] for i in range(2)]
        a[3] = [n[0][0], n[1][0], -1, 2]
        b[3] = 2 * v0
        try:
            p = np.linalg.solve(a, b)
        except np.linalg.LinAlgError:
            continue
        load = side * sum(p[i] * n[i][1] for i in range(2))
        left = [
            (u[i] + p[i] / masses[i] * n[i] - [p[3], 0]) @ n[i] + e[i] * min((u[i] - [v0, 0]) @ n[i], 0)
            for i in range(2)
        ]
        if min(p[0], p[1], load, *left) < -1e-9 or slips * p[3] < -1e-9:
            continue
        if slips == 0 and abs(p[2]) > mu * load + 1e-9:
            continue
        if not any(abs(p[3] - q[3]) < 1e-8 for q in found):
            found.append(p)
    return found


def test_two_balls_strike_a_sled_at_once() -> None:
    """Newton: the slip after the blow decides, at the rail as well; of those with one motion."""
    random = np.random.default_rng(3)
    scene, counted, held = planemotion.load_text(TWO), 0, 0
    for _ in range(60):
        mu, v0 = random.uniform(0, 0.8), random.choice([-1, 0, 1])
        e, angle = random.uniform(0, 0.8, 2), [random.uniform(20, 160), random.uniform(-160, -20)]
        n = [np.array([math.cos(a), math.sin(a)]) for a in np.radians(angle)]
        u = [-random.uniform(1.5, 3) * m + random.uniform(-1, 1, 2) * 0.3 for m in n]
        if any((u[i] - [v0, 0]) @ n[i] > -0.1 for i in range(2)):
            continue
        found = by_hand(mu, v0, e, angle, u, [1, 0.5])
        if len(found) != 1 or min(found[0][:2]) <= 1e-6:
            continue
        v = found[0][3]
        after = [u[i] + found[0][i] / m * n[i] for i, m in enumerate([1, 0.5])]
        gain = 2 * (v**2 - v0**2) + sum(
            m * (after[i] @ after[i] - u[i] @ u[i]) for i, m in enumerate([1, 0.5])
        )
        if gain > -1e-9:
            continue
        values = scene.run(
            mu=mu,
            v0=f"{v0} m/s",
            e1=e[0],
            e2=e[1],
            a1=f"{angle[0]} deg",
            a2=f"{angle[1]} deg",
            x1=f"{u[0][0]} m/s",
            y1=f"{u[0][1]} m/s",
            x2=f"{u[1][0]} m/s",
            y2=f"{u[1][1]} m/s",
        ).asks
        assert values["v"].value == pytest.approx(v, abs=1e-9)
        assert values["rubbed"].value == pytest.approx(
            2 * (v - v0) + sum(found[0][i] * n[i][0] for i in range(2)), abs=1e-8
        )
        counted += 1
        held += abs(v) < 1e-12
    assert counted > 30
    assert held > 3


PIN = """
plane = "horizontal"
until = "t = 1 us"
parameters = { mu = 0.5, r = "0.1 m", e = 0.5, w0 = "0 rad/s", ux = "-1 m/s", uy = "-3 m/s", f = 0.0 }
bodies.bar.rod = ["A", "B"]
bodies.bar.length = "1 m"
bodies.bar.mass = "3 kg"
bodies.bar.at = { A = [0, 0] }
bodies.bar.points = { hit = ["0.3 m", 0] }
bodies.ball = { sphere = "0.1 m", mass = "1 kg", at = ["0.8 m", "0.1 m"] }
joints.axle = { pin = ["bar.A", "ground"], friction = { mu = "mu", radius = "r" } }
events.blow = "hit strikes"
contacts.hit = { touch = ["bar.hit", "ball.rim"], restitution = "e", friction = "f", law = "LAW" }
start.bar.omega = "w0"
start.ball.velocity = ["ux", "uy"]
[ask]
omega = "bar.omega"
x = "ball.velocity.x"
y = "ball.velocity.y"
force = { of = "axle.impulse.norm", at = "blow" }
"""


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("mu", "f", "w0", "e"), [(0.5, 0, 0, 0.5), (0.5, 0.3, 2, 0.4), (1.5, 0.3, 2, 0.4), (3, 0.3, 1, 0.4)]
)
def test_a_bearing_rubs_in_a_blow(law: str, mu: float, f: float, w0: float, e: float) -> None:
    """The couple is mu r |R|; R has two components, whose direction the friction of the contact changes."""
    inertia, arm, half = 3 / 3, 0.8, 0.5

    def rates(u: np.ndarray) -> np.ndarray:
        omega, x = u[1], u[2]
        slip = sign(x + 0.1 * u[4], 1e-3)  # the bar's point moves across only
        push = np.array([-f * slip, 1.0])  # on the ball

        def spin(couple: float) -> float:
            return (-arm * push[1] + couple) / inertia

        couple = 0.0
        for _ in range(30):
            a = spin(couple)
            load = math.hypot(push[0], 3 * a * half + push[1])  # R = m a_c + push
            couple = -mu * 0.1 * load * sign(omega, 1e-3)
        return np.array([push[1] - arm * a, a, push[0], push[1], 0.1 * push[0] / ROLL])

    u = follow(rates, [-3 - arm * w0, w0, -1, -3, 0], law, e, 16_000)
    values = answers(PIN.replace("LAW", law), mu=mu, f=f, w0=f"{w0} rad/s", e=e)
    assert [values[k] for k in ("omega", "x", "y")] == pytest.approx(u[1:4], abs=8e-3)


BOUNCING = """
until = "t = 2 s"
parameters = { mu = 0.1, e = 0.6 }
ground.lines.rail = { through = [0, 0] }
bodies.sled = { mass = "2 kg", inertia = "1 kg*m^2", at = [0, 0], lines = { deck = { through = [0, 0] } } }
bodies.ball = { sphere = "0.1 m", mass = "1 kg", at = [0, "0.6 m"] }
joints.rail = { slider = ["sled", "ground.rail"], friction = "mu", turning = false }
contacts.hit = { touch = ["sled.deck", "ball.rim"], restitution = "e", friction = 0, law = "LAW" }
start.sled.velocity.x = "5 m/s"
[ask]
v = "sled.velocity.x"
y = "ball.y"
"""


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("route", ROUTES)
def test_a_sled_is_slowed_by_all_blows_of_a_bouncing_ball(law: str, route: str) -> None:
    """What it is pressed with in 2 s is its weight, in blows or at rest: v = v0 - mu (M + m) g t / M."""
    values = answers(BOUNCING.replace("LAW", law), route)
    assert values["v"] == pytest.approx(5 - 0.1 * 3 / 2 * 9.81 * 2, abs=2e-6)
    assert values["y"] == pytest.approx(0.1, abs=1e-7)


TWICE = """
until = "t = 1 us"
ground.points = { left = [0, 0], right = ["1 m", 0] }
bodies.bar = { rod = ["A", "B"], length = "1 m", mass = "3 kg", at = { A = [0, 0] } }
bodies.ball = { sphere = "0.1 m", mass = "1 kg", at = ["0.7 m", "0.1 m"] }
joints.a = { pin = ["bar.A", "ground.left"] }
joints.b = { pin = ["bar.B", "ground.right"], friction = { mu = 0.3, radius = "10 mm" } }
contacts.hit = { touch = ["bar.top", "ball.rim"], restitution = 0.5 }
start.ball.velocity.y = "-1 m/s"
ask.v = "ball.velocity.y"
"""


def test_a_joint_that_cannot_slip_has_no_friction_in_a_blow() -> None:
    """A bar that is pinned at both ends does not turn: the ball comes back."""
    assert answers(TWICE)["v"] == pytest.approx(0.5, abs=1e-4)


def test_a_friction_whose_load_is_shared_is_refused() -> None:
    text = SLED.replace("LAW", "newton").replace(
        "[ask]", 'joints.also = { slider = ["sled", "ground.rail"] }\n[ask]', 1
    )
    result = planemotion.load_text(text).run()
    assert result.status == "not_unique"
    assert "joints.rail.friction: redundant constraints share" in str(result.error)


def test_rough_contacts_of_a_blow_that_is_followed_are_refused() -> None:
    text = SLED.replace("LAW", "stronge").replace('friction = "f"', 'friction = "rough"')
    with pytest.raises(planemotion.SimulationError, match=r"joints\.rail\.friction: a blow loads this joint"):
        planemotion.load_text(text).run()
