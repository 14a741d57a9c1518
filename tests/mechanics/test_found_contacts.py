"""Several contacts with friction: scenes that were once refused, or wrong with status `ok`.

They run on all routes, with their contacts in the order given and in reverse, and as mirror images.  What is
expected are closed forms, or all that the laws allow, enumerated (tests/stress/contacts/laws.py).
"""

from __future__ import annotations

import itertools
import math
import random
import re
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import planemotion
from tests.mechanics.test_crates import rod, slider
from tests.mechanics.test_order import balls
from tests.mechanics.test_walker import by_least_coordinates, walker
from tests.scenes import ROUTES, G, number
from tests.scenes.parts import beam_on_feet
from tests.stress.contacts import one_body
from tests.stress.contacts.laws import motions
from tests.stress.contacts.verdict import LIMITED, RIGHT, is_fault

WAYS = list(itertools.product(ROUTES, (1, -1), (1, -1)))  # route, mirror image, order in the file
LAWS = ("newton", "poisson", "stronge")


def ran(text: str, route: str = "auto") -> planemotion.RunResult:
    """The same scene on another route; status ok."""
    result = planemotion.load_text(text).with_values({"solve.route": route}).run()
    assert result.status == "ok", (text, result.error)
    return result


def told(text: str, route: str = "auto") -> planemotion.RunResult:
    return planemotion.load_text(text).with_values({"solve.route": route}).run()


def struck(text: str, route: str = "auto") -> planemotion.RunResult:
    """What the blow at the start leaves; a route that goes on in time answers for the instant of it."""
    if route == "auto":
        return ran(text)
    head, asks = text.split("[ask]\n")
    at_start = re.sub(r'^(\w+) = (".*")$', r'\1 = { of = \2, at = "blow" }', asks, flags=re.MULTILINE)
    events = '[events]\nblow = { when = "A strikes", nth = 1 }\n[ask]\n'
    return ran(head.replace('until = "start"', 'until = "t = 1 ms"') + events + at_start, route)


def plate(
    width: float,
    height: float,
    friction: float | str,
    restitution: float,
    velocity: tuple[float, float],
    *,
    law: str = "newton",
    mirror: int = 1,
    order: int = 1,
    above: float = 0,
    tilt: float = 0,
    slope: float = 0,
    until: str = "start",
    more: str = "",
) -> str:
    """A plate of 1 kg, in degrees; its left corner (mirrored: its right one) is `above` the floor."""
    rest = f'friction = {friction}, restitution = {restitution}, law = "{law}"'
    feet = [f'{name} = {{ touch = ["k.{name}", "ground.floor"], {rest} }}' for name in "ABCD"[::order]]
    return f"""
until = "{until}"
{more}
[ground]
lines = {{ floor = {{ through = [0, 0], angle = "{mirror * slope} deg" }} }}
[bodies.k]
plate = ["{width} m", "{height} m"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ {"A" if mirror > 0 else "B"} = [0, "{above} m"] }}
angle = "{mirror * (slope + tilt)} deg"
[contacts]
{chr(10).join(feet)}
[start]
k.velocity = ["{mirror * velocity[0]!r} m/s", "{velocity[1]!r} m/s"]
k.omega = 0
[ask]
x = "k.x"
y = "k.y"
vx = "k.velocity.x"
vy = "k.velocity.y"
omega = "k.omega"
a = "k.acceleration.norm"
alpha = "k.alpha"
lost = "energy.lost"
"""


# ---- 1: a plate that falls flat, wrong with `ok` ----
@pytest.mark.parametrize(("route", "mirror", "order"), WAYS)
@pytest.mark.parametrize(
    ("friction", "restitution", "vx", "vy"),
    [(0.1, 0.3, -0.461, 0.09), (0.05, 0, -0.485, 0), (0.1, 0, -0.47, 0)],
)
def test_1_a_plate_falls_flat(
    friction: float, restitution: float, vx: float, vy: float, route: str, mirror: int, order: int
) -> None:
    text = plate(0.2, 0.3, friction, restitution, (-0.5, -0.3), mirror=mirror, order=order)
    result = struck(text, route)
    assert (result.vx, result.vy, result.omega) == pytest.approx((mirror * vx, vy, 0), abs=1e-12)


@pytest.mark.parametrize(("route", "mirror", "order"), WAYS)
def test_1_both_of_its_corners_push(route: str, mirror: int, order: int) -> None:
    """p_A + p_B = m (1 + e) v, and the moments of both and of their friction about the mass centre cancel."""
    text = plate(0.2, 0.3, 0.1, 0.3, (-0.5, -0.3), mirror=mirror, order=order)
    result = struck(text + 'A = "A.impulse.y on k"\nB = "B.impulse.y on k"\n', route)
    front, rear = (result.A, result.B)[::mirror]
    assert (front, rear) == pytest.approx((0.22425, 0.16575), abs=1e-12)


# ---- 2: refused though unique ----
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mirror", [1, -1])
def test_2_a_box_dropped_flat_slides_until_friction_has_stopped_it(mirror: int, route: str) -> None:
    """From 1 cm; it loses mu v of its speed when it lands, then slides on for u^2 / (2 mu g)."""
    fall = math.sqrt(2 * G * 0.01)
    for speed, mu in itertools.product((0.5, 1, 1.5, 2, 2.5, 3), (0.05, 0.1, 0.15, 0.2, 0.25, 0.3)):
        text = plate(0.3, 0.2, mu, 0, (speed, 0), mirror=mirror, above=0.01, until="rest")
        result = ran(text, route)
        left = max(0.0, speed - mu * fall)
        way = 0.15 + speed * fall / G + left**2 / (2 * mu * G)
        assert result.x == pytest.approx(mirror * way, rel=1e-7), (speed, mu)
        assert result.y == pytest.approx(0.1, abs=1e-9)
        assert result.lost == pytest.approx(0.5 * (speed**2 - left**2) + G * 0.01, rel=1e-7)


def test_2_a_compact_box_without_friction() -> None:
    """J below 2e-4 kg m^2; flat, and tilted, where one corner alone is struck."""
    for size, tilt, e in itertools.product((0.002, 0.01, 0.03), (0, 10, 30), (0, 0.5, 1)):
        result = ran(plate(size, size, 0, e, (0.3, -0.5), tilt=tilt))
        arm = (
            size / math.sqrt(2) * math.sin(math.radians(45 - tilt)) if tilt else 0.0
        )  # in front of the corner
        j = size**2 / 6
        impulse = 0.5 * (1 + e) / (1 + arm**2 / j)
        assert result.vx == pytest.approx(0.3, abs=1e-12)
        assert result.vy == pytest.approx(impulse - 0.5, abs=1e-12)
        assert result.omega == pytest.approx(-arm * impulse / j, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mirror", [1, -1])
def test_2_a_crate_is_tilted_by_ten_degrees_and_let_go(mirror: int, route: str) -> None:
    """Housner's rocking block: each blow leaves 1 - 3/2 sin^2(alpha) of omega, tan(alpha) = width / height.

    It rocks without end in a finite time, and each foot is struck by every second blow.
    """
    text = plate(0.2, 0.3, 0.9, 0, (0, 0), mirror=mirror, tilt=10, until="rest")
    foot = "B" if mirror > 0 else "A"
    events = f'[events]\nany = "{foot} strikes"\nfirst = {{ when = "{foot} strikes", nth = 1 }}\n[ask]\n'
    asks = """
once = "first.count"
times = "any.count"
before = { of = "k.omega", at = "before first" }
after = { of = "k.omega", at = "first" }
t = "t"
"""
    result = ran(text.replace("[ask]\n", events) + asks, route)
    arm, alpha, tilt = 0.5 * math.hypot(0.2, 0.3), math.atan2(0.2, 0.3), math.radians(10)
    fall = arm * (math.cos(alpha - tilt) - math.cos(alpha))
    omega, left = math.sqrt(2 * G * fall / (4 / 3 * arm**2)), 1 - 1.5 * math.sin(alpha) ** 2
    assert result.before == pytest.approx(-mirror * omega, rel=1e-7)
    assert result.after == pytest.approx(-mirror * omega * left, rel=1e-7)
    assert result.once == 1
    assert result.asks["times"].reason == "infinite"
    assert result.y == pytest.approx(0.15, abs=1e-7)
    true = end_of_rocking(arm, alpha, tilt, omega, left)
    known = 1e-8 if route == "ida" else 2 * number(result.asks["t"].error)
    assert result.t == pytest.approx(true, abs=known)


def end_of_rocking(arm: float, alpha: float, tilt: float, omega: float, left: float) -> float:
    """The tilt x has x'' = -p^2 sin(alpha - x), p^2 = 3 g / (4 R); each swing leaves `left` of its omega."""
    p2 = 0.75 * G / arm

    def rise(top: float) -> float:
        """The time from a tilt of none up to this one; x = top (1 - u^2) takes out the root at the top."""

        def slowness(u: float) -> float:
            below = 0.5 * top * u * u  # half of what is missing to the top
            fallen = 2 * math.sin(alpha - top + below) * math.sin(below)
            return 2 * top * u / math.sqrt(2 * p2 * fallen)

        return float(quad(slowness, 0, 1, epsabs=1e-13)[0])

    t, speed = rise(tilt), omega
    while speed > 1e-4:
        speed *= left
        t += 2 * rise(alpha - math.acos(math.cos(alpha) + speed**2 / (2 * p2)))
    return t + 2 * speed / (p2 * math.sin(alpha)) * left / (1 - left)  # the rest of them hardly tilt


def only_right(drawn: one_body.Drawn, law: str, *, blow: bool) -> None:
    """Each case has one motion, and the engine gives it; so it does mirrored, and in another order."""
    words = one_body.judged(drawn, law, blow=blow)
    assert set(words) <= {RIGHT, LIMITED}, words


@pytest.mark.parametrize("law", LAWS)
def test_2_disks_with_backspin_into_a_wall(law: str) -> None:
    """133 of them, rolling or sliding on a floor; the friction of the wall presses them on it."""
    rng, n = np.random.default_rng(2), 133
    only_right(
        one_body.Drawn(
            mass=np.tile([1, 1, 0.005], (n, 1)),
            place=np.tile([[0, -0.1], [0.1, 0]], (n, 1, 1)),
            angle=np.tile([0, np.pi / 2], (n, 1)),
            friction=np.tile(rng.uniform(0.02, 1, (n, 1)), 2),
            restitution=rng.choice([0, 0.5, 0.8], (n, 1)) * np.array([0, 1]),
            before=np.stack([rng.uniform(0.2, 3, n), np.zeros(n), rng.uniform(0, 40, n)], axis=1),
        ),
        law,
        blow=True,
    )


@pytest.mark.parametrize("law", LAWS)
def test_2_boxes_fall_flat_by_each_law(law: str) -> None:
    """60 of them."""
    rng, n = np.random.default_rng(58), 60
    half = rng.uniform(0.05, 0.3, (n, 2))
    only_right(
        one_body.Drawn(
            mass=np.stack([np.ones(n), np.ones(n), (half**2).sum(axis=1) / 3], axis=1),
            place=np.stack([half * [-1, -1], half * [1, -1]], axis=1),
            angle=np.zeros((n, 2)),
            friction=np.tile(rng.uniform(0, 0.6, (n, 1)), 2),
            restitution=np.tile(rng.choice([0, 0.3, 0.8], (n, 1)), 2),
            before=np.stack([rng.uniform(-3, 3, n), -rng.uniform(0.2, 3, n), np.zeros(n)], axis=1),
        ),
        law,
        blow=True,
    )


@pytest.mark.parametrize("law", LAWS)
def test_2_laws_agree_for_a_wide_box_that_slides_on(law: str) -> None:
    """v' = -e v and u' = u - mu (1 + e) v while mu h <= w, which lets both corners push."""
    for mirror, order, mu, e in itertools.product((1, -1), (1, -1), (0, 0.1, 0.3), (0, 0.4, 0.9)):
        result = ran(plate(0.4, 0.1, mu, e, (2, -1), law=law, mirror=mirror, order=order))
        after = mirror * (2 - mu * (1 + e))
        assert (result.vx, result.vy, result.omega) == pytest.approx((after, e, 0), abs=1e-9)


# ---- 3: at rest or sticking ----
@pytest.mark.parametrize(("route", "mirror", "order"), WAYS)
def test_3_a_tall_plate_slides_down_a_slope(route: str, mirror: int, order: int) -> None:
    text = plate(0.2, 0.4, 0.2, 0, (0, 0), slope=35, mirror=mirror, order=order, until="t = 0.1 s")
    result = ran(text, route)
    slope = math.radians(35)
    assert result.a == pytest.approx(G * (math.sin(slope) - 0.2 * math.cos(slope)), rel=1e-9)
    assert result.a == pytest.approx(4.02, abs=5e-3)
    assert result.omega == pytest.approx(0, abs=1e-9)


def test_3_boxes_let_go_on_slopes() -> None:
    """345 of them: they stay, slide, tip or do both."""
    rng, n = np.random.default_rng(3), 345
    half = rng.uniform(0.05, 0.5, (n, 2))
    slope = rng.uniform(-1.2, 1.2, n)
    feet = np.stack([half * [-1, -1], half * [1, -1]], axis=1)
    s, c = np.sin(slope)[:, None], np.cos(slope)[:, None]
    only_right(
        one_body.Drawn(
            mass=np.stack([np.ones(n), np.ones(n), (half**2).sum(axis=1) / 3], axis=1),
            place=np.stack(
                [c * feet[..., 0] - s * feet[..., 1], s * feet[..., 0] + c * feet[..., 1]], axis=2
            ),
            angle=np.tile(slope[:, None], 2),
            friction=np.tile(rng.uniform(0, 1.2, (n, 1)), 2),
            restitution=np.zeros((n, 2)),
            before=np.tile([0, -G, 0.0], (n, 1)),
        ),
        "newton",
        blow=False,
    )


def test_3_ladders_pushed_at_the_foot() -> None:
    """258 of them, with friction at both ends; forces by mass, of the weight and the push."""
    rng, n = np.random.default_rng(258), 258
    half, angle, push = rng.uniform(0.2, 2, n), rng.uniform(0.3, 1.4, n), rng.uniform(-30, 30, n)
    foot = half[:, None] * np.stack([np.cos(angle), -np.sin(angle)], axis=1)
    words = one_body.judged(
        one_body.Drawn(
            mass=np.stack([np.ones(n), np.ones(n), half**2 / 3], axis=1),
            place=np.stack([foot, -foot], axis=1),
            angle=np.tile([0, -np.pi / 2], (n, 1)),
            friction=rng.uniform(0, 0.6, (n, 2)),
            restitution=np.zeros((n, 2)),
            before=np.stack([push, np.full(n, -G), -foot[:, 1] * push / (half**2 / 3)], axis=1),
        ),
        "newton",
        blow=False,
    )
    assert words[RIGHT] > 240
    assert not any(is_fault(word) for word in words), words


@pytest.mark.parametrize("mirror", [1, -1])
def test_3_one_foot_slides_where_sticking_and_parting_are_inconsistent(mirror: int) -> None:
    """It slides forward, T = -mu N: (a_A)_n = 0 at the foot."""
    angle, omega, mu = math.radians(37.5), -4.5425, 0.1
    result = ran(rod(37.5 if mirror > 0 else 142.5, "0.1", 0, mirror * omega))
    x, y = -0.5 * math.cos(angle), -0.5 * math.sin(angle)
    load = (G + omega**2 * y) / (1 + 12 * x * (x + mu * y))
    assert load > 0
    assert result.alpha == pytest.approx(mirror * 12 * (x + mu * y) * load, rel=1e-9)


# ---- 4: friction of nothing as a parameter ----
def test_4_friction_of_nothing_may_be_a_parameter() -> None:
    """100 smooth boxes, thrown from a height that keeps them above the floor."""
    rng = random.Random(4)
    for _ in range(100):
        size, start = (
            (rng.uniform(0.05, 0.5), rng.uniform(0.05, 0.5)),
            (rng.uniform(-2, 2), -rng.uniform(0.1, 2)),
        )
        tilt, slope = rng.choice([0, rng.uniform(-80, 80)]), rng.choice([0, rng.uniform(-40, 40)])
        more: dict[str, Any] = {"tilt": tilt, "slope": slope}
        e = rng.choice([0, rng.uniform(0, 1)])
        written = ran(plate(*size, 0, e, start, above=0.8, until="t = 0.5 s", **more))
        swept = ran(
            plate(
                *size, '"mu"', e, start, above=0.8, until="t = 0.5 s", more="[parameters]\nmu = 0\n", **more
            )
        )
        for key in ("x", "y", "vx", "vy", "omega"):
            assert swept[key] == pytest.approx(written[key], abs=1e-10)


# ---- 5: a slider-crank with friction in its guide ----
CRANK = """
until = "rest"
[parameters]
mu = 0.1
[ground]
lines = {{ guide = {{ through = [0, 0] }} }}
points = {{ O = [0, 0] }}
[bodies.crank]
rod = ["A", "B"]
length = "0.1 m"
mass = "0.1 kg"
at = {{ A = [0, 0] }}
angle = "{angle} deg"
[bodies.link]
rod = ["P", "Q"]
length = "0.3 m"
mass = "0.1 kg"
at = {{ P = ["{across} m", "0.0866025403784438647 m"] }}
angle = "~{link} deg"
[bodies.block]
mass = "5 kg"
at = ["{place!r} m", 0]
[joints]
a = {{ pin = ["ground.O", "crank.A"] }}
b = {{ pin = ["crank.B", "link.P"] }}
c = {{ pin = ["link.Q", "block"] }}
{guide}
[start]
crank.omega = "{omega} rad/s"
{start}
[events]
dead = "crank.turned = {turned} deg"
[ask]
time = {{ of = "t", at = "dead", unit = "s" }}
omega = {{ of = "crank.omega", at = "dead", unit = "rad/s" }}
end = {{ of = "crank.turned", unit = "deg" }}
"""
GUIDES = {
    "slider": 'd = { slider = ["block", "ground.guide"], friction = "mu" }',
    "contact": '[contacts]\nd = { touch = ["block", "ground.guide"], friction = "mu" }',
}


def crank(guide: str, mirror: int) -> str:
    lean = math.asin(math.sin(math.radians(60)) / 3)
    return CRANK.format(
        angle=60 if mirror > 0 else 120,
        across=mirror * 0.05,
        link=-math.degrees(lean) if mirror > 0 else 180 + math.degrees(lean),
        place=mirror * (0.05 + 0.3 * math.cos(lean)),
        guide=GUIDES[guide],
        start="block.velocity.y = 0" if guide == "contact" else "",
        omega=5 * mirror,
        turned=120.0001 * mirror,  # just behind it: at it the slip is zero, and which comes first is rounding
    )


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("guide", list(GUIDES))
@pytest.mark.parametrize("mirror", [1, -1])
def test_5_a_slider_crank_passes_its_dead_centre(mirror: int, guide: str, route: str) -> None:
    result = ran(crank(guide, mirror), route)
    assert result.time == pytest.approx(0.481153, abs=1e-6)
    assert result.omega == pytest.approx(mirror * 14.41, abs=5e-3)
    assert 60 + mirror * number(result.end) == pytest.approx(234.17, abs=5e-3)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("guide", list(GUIDES))
def test_5_so_it_does_where_friction_is_none_as_a_parameter(guide: str, route: str) -> None:
    """Without friction its energy stays, and at 180 degrees the block stands still."""
    text = crank(guide, 1).replace('until = "rest"', 'until = "dead"')
    result = planemotion.load_text(text).with_values({"solve.route": route}).run(mu=0)
    assert result.status == "ok", result.error
    assert result.omega == pytest.approx(speed_at_the_dead_centre(), rel=1e-6)


def speed_at_the_dead_centre() -> float:
    """T = J w^2 / 2 with the share of each body in the coordinate that is the crank's angle."""

    def inertia(angle: float) -> float:
        s, c = math.sin(angle), math.cos(angle)
        lean = math.asin(s / 3)  # of the link, downwards
        turn = -c / (3 * math.cos(lean))  # of the link by the crank
        block = -0.1 * s + 0.3 * math.sin(lean) * turn
        x, y = -0.1 * s + 0.15 * math.sin(lean) * turn, 0.1 * c + 0.15 * math.cos(lean) * turn
        return 0.1 * 0.1**2 / 3 + 5 * block**2 + 0.1 * (x * x + y * y + 0.3**2 / 12 * turn * turn)

    height = 0.1 * math.sin(math.radians(60))
    fall = 0.1 * G * (0.5 * height + 0.5 * height)  # of the mass centres of crank and link
    return math.sqrt((25 * inertia(math.radians(60)) + 2 * fall) / inertia(math.pi))


# ---- 6: reactions that are not unique ----
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("order", ["ABC", "BCA", "CAB", "CBA"])
@pytest.mark.parametrize("mirror", [1, -1])
def test_6_a_beam_on_three_smooth_feet(mirror: int, order: str, route: str) -> None:
    contacts = "\n".join(f'{x} = {{ touch = ["beam.{x}", "ground.floor"] }}' for x in order)
    text = beam_on_feet(contacts, (-2 * mirror, mirror, 2 * mirror))
    result = ran(text, route)
    for name in "ABC":
        assert result.asks[name].value is None
        assert "not unique" in result.asks[name].reason
    assert result["all"] == pytest.approx(98.1, rel=1e-12)
    assert result.moment == pytest.approx(0, abs=1e-9)
    least = ran(text + '[solve]\nshared = "least"\n', route)
    for name, share in zip("ABC", (11, 8, 7), strict=True):  # sums of 1, x and x^2: 3, 1, 9
        assert least[name] == pytest.approx(98.1 * share / 26, rel=1e-10)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("mirror", "order"), [(1, "AB"), (1, "BA"), (-1, "AB"), (-1, "BA")])
def test_6_a_ladder_that_rubs_at_both_ends(mirror: int, order: str, route: str) -> None:
    """At rest its loads are not unique but for their sum."""
    lines = {
        "A": 'A = { touch = ["ladder.A", "ground.wall"], friction = 0.4 }',
        "B": 'B = { touch = ["ladder.B", "ground.floor"], friction = 0.5 }',
    }
    text = f"""
until = "t = 0.1 s"
[ground.lines]
floor = {{ through = [0, 0] }}
wall = {{ through = [0, 0], angle = "{-90 * mirror} deg" }}
[bodies.ladder]
rod = ["A", "B"]
length = "4 m"
mass = "10 kg"
angle = "{-60 if mirror > 0 else -120} deg"
at = {{ A = [0, "{4 * math.sin(math.pi / 3)!r} m"] }}
[contacts]
{lines[order[0]]}
{lines[order[1]]}
[ask]
A = "A.normal"
B = "B.normal"
up = "A.force.y on ladder + B.force.y on ladder"
across = "A.force.x on ladder + B.force.x on ladder"
"""
    result = ran(text, route)
    assert result.asks["A"].value is None
    assert result.asks["B"].value is None
    assert result.up == pytest.approx(98.1, rel=1e-11)
    assert result.across == pytest.approx(0, abs=1e-9)


PINNED = """
until = "t = 0.1 s"
[ground]
points = { A = ["-2 m", 0], B = ["2 m", 0] }
[bodies.rod]
rod = ["A", "B"]
length = "4 m"
mass = "10 kg"
at = [0, 0]
[joints]
LINES
[ask]
Ax = "A.force.x on rod"
Ay = "A.force.y on rod"
By = "B.force.y on rod"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("order", ["AB", "BA"])
def test_6_a_rod_pinned_at_both_ends(order: str, route: str) -> None:
    lines = "\n".join(f'{x} = {{ pin = ["rod.{x}", "ground.{x}"] }}' for x in order)
    result = ran(PINNED.replace("LINES", lines), route)
    assert result.asks["Ax"].value is None
    assert result.Ay == pytest.approx(49.05, rel=1e-12)
    assert result.By == pytest.approx(49.05, rel=1e-12)


# a truss with an extra bar: tests/mechanics/test_shared_loads.py, test_a_truss_with_a_bar_too_many


# ---- 7: Painleve ----
@pytest.mark.parametrize("mirror", [1, -1])
def test_7_two_motions_are_told(mirror: int) -> None:
    """At 50 degrees with mu = 1.6 and 6 rad/s it may slide on, or lift off."""
    result = told(rod(50 if mirror > 0 else 130, "1.6", -mirror, 6 * mirror))
    assert result.status == "not_unique"
    assert "contacts.foot: with friction 1.6" in result.error


@pytest.mark.parametrize("mirror", [1, -1])
def test_7_no_motion_is_told(mirror: int) -> None:
    result = told(rod(50 if mirror > 0 else 130, "1.6", -mirror, 0))
    assert result.status == "painleve"
    assert "contacts.foot: with friction 1.6 no motion" in result.error


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mirror", [1, -1])
def test_7_what_is_reached_from_outside_is_told(mirror: int, route: str) -> None:
    """1 + 3 cos (cos - mu sin) vanishes on the way, and the load grows without bound."""
    for degrees in (34, 35, 36, 38):
        result = told(
            rod(degrees if mirror > 0 else 180 - degrees, "1.6", -4 * mirror, 2 * mirror, until="t = 0.1 s"),
            route,
        )
        assert result.status in ("ok", "painleve", "undecided"), (degrees, result.error)


# ---- 8: a livelock ----
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mirror", [1, -1])
def test_8_a_rough_foot_that_cannot_push(mirror: int, route: str) -> None:
    """N = m (g - L/2 (alpha cos + omega^2 sin)) vanishes while F does not: no event repeats at one time."""
    result = told(rod(90, '"rough"', 0, -2 * mirror, until="t = 5 s"), route)
    assert result.status == "rough_impossible"
    assert result.stopped_at == pytest.approx(time_of_no_load(), rel=1e-5)
    assert result.counts["events"] < 50


def time_of_no_load() -> float:
    """alpha = 3 g / 2 cos, omega^2 = 4 + 3 g (1 - sin), N / m = g - (alpha cos + omega^2 sin) / 2; SI."""

    def speed2(s: float) -> float:
        return 4 + 3 * G * (1 - s)

    load = lambda s: G - 0.5 * (1.5 * G * (1 - s * s) + speed2(s) * s)  # noqa: E731
    s = brentq(load, 0.3, 0.8)
    return float(
        quad(lambda a: 1 / math.sqrt(speed2(math.sin(a))), math.asin(s), math.pi / 2, epsabs=1e-13)[0]
    )


# ---- 9: walkers and clattering sliders ----
@pytest.mark.parametrize("inertia", [1e-9, 1e-30])
@pytest.mark.parametrize("mirror", [1, -1])
@pytest.mark.parametrize("friction", ['"rough"', "1000"])
def test_9_the_second_foot_of_a_walker_strikes(friction: str, mirror: int, inertia: float) -> None:
    x = {"l": 1, "b": 0.5, "m": 5, "M": 10, "I": inertia, "a": 0.3, "w1": -1.5, "w2": -0.5}
    text = walker(x, friction)
    names = ("vx", "vy", "w1", "w2", "qx", "qy")
    if mirror < 0:
        x |= {"a": -0.3, "w1": 1.5, "w2": 0.5}
        text = walker(x, friction)
    known = by_least_coordinates(x)
    assert known is not None
    result = ran(text)
    found = [result[name] for name in names]
    assert found == pytest.approx(known[:4] + known[6:], abs=1e-8 * max(map(abs, known)))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("law", LAWS)
def test_9_two_corners_clatter_to_rest(law: str, route: str) -> None:
    """Until both are on a wall; under each law, on each route, mirrored."""
    found = []
    for mirror in (1, -1):
        text = slider(route, 0.5, 0.1, 0.5, (0.3 * mirror, -0.2, 0.5 * mirror, 0)).replace(
            "restitution = ", f'law = "{law}", restitution = '
        )
        result = ran(text, route)
        assert result.fast == pytest.approx(0, abs=1e-7)
        assert result.spin == pytest.approx(0, abs=1e-6)
        found.append(mirror * (number(result.x) - 0.05))
    assert found[0] == pytest.approx(found[1], abs=1e-6)


# ---- 10: what was answered before a failure stands ----
def arriving(x: one_body.Drawn, case: int, mirror: int, route: str) -> str:
    """A body that comes to two walls at once, 10 ms after the start."""
    one = x if mirror > 0 else x.mirrored()
    u, v, w = (float(speed) for speed in one.before[case])
    places = [[f"{float(c)!r} m" for c in place] for place in one.place[case]]
    walls = "\n".join(
        f'w{i} = {{ through = {place!r}, angle = "{float(angle)!r} rad" }}'
        for i, (place, angle) in enumerate(zip(places, one.angle[case], strict=True))
    )
    contacts = "\n".join(
        f'c{i} = {{ touch = ["b.p{i}", "ground.w{i}"], friction = {float(one.friction[case, i])!r}, '
        f"restitution = {float(one.restitution[case, i])!r} }}"
        for i in range(len(places))
    )
    return f"""
until = "t = 20 ms"
plane = "horizontal"
[ground.lines]
{walls}
[bodies.b]
mass = "{float(one.mass[case, 0])!r} kg"
inertia = "{float(one.mass[case, 2])!r} kg*m^2"
at = ["{-0.01 * u!r} m", "{-0.01 * v!r} m"]
angle = "{-0.01 * w!r} rad"
points = {{ {", ".join(f"p{i} = {place!r}" for i, place in enumerate(places))} }}
[contacts]
{contacts}
[start]
b = {{ velocity = ["{u!r} m/s", "{v!r} m/s"], omega = "{w!r} rad/s" }}
[events]
hit = ["c0 strikes", "c1 strikes"]
[ask]
x = {{ of = "b.x", at = "before hit" }}
omega = {{ of = "b.omega", at = "before hit" }}
after = {{ of = "b.omega", at = "hit" }}
[solve]
route = "{route}"
"""


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mirror", [1, -1])
def test_10_answers_before_a_failed_blow_stand(mirror: int, route: str) -> None:
    """Two contacts are struck at once, and their law has no motion (case 24), or three of them (case 42)."""
    drawn = one_body.draw(np.random.default_rng(8), 3000, 2, blow=True)
    for case, count in ((24, 0), (42, 3)):
        assert len(motions(drawn.problem(case))) == count
        scene = planemotion.load_text(arriving(drawn, case, mirror, route))
        if count:
            result = scene.run()
            assert result.status == "not_unique"
        else:
            with pytest.raises(planemotion.SimulationError, match="no motion obeys its law") as failed:
                scene.run()
            assert isinstance(failed.value.result, planemotion.RunResult)
            result = failed.value.result
        assert result.asks["x"].value == pytest.approx(0, abs=1e-9)
        assert result.asks["omega"].value == pytest.approx(mirror * drawn.before[case, 2], rel=1e-9)
        assert result.asks["after"].value is None


# ---- 11: the cradle ----
@pytest.mark.parametrize("order", ["pq", "qp"])
@pytest.mark.parametrize("names", ["ABC", "CBA"])
def test_11_a_cradle_is_told_that_its_order_matters(names: str, order: str) -> None:
    scene = planemotion.load_text(balls(names, order))
    result = scene.run()
    assert result.v == pytest.approx(2 / 3, abs=1e-12)
    assert len(result.notes) == 1
    assert "one by one it leaves another motion" in result.notes[0]
    for chosen, v in (("simultaneous", 2 / 3), ("sequential", 1)):
        other = scene.solve(impacts=chosen).run()
        assert other.v == pytest.approx(v, abs=1e-12)
        assert other.notes == ()
