"""Several contacts with friction: scenes that were once refused, or wrong with status `ok`.

They run on all routes, with their contacts in the order given and in reverse, and as mirror images.  What is
expected are closed forms, or all that the laws allow, enumerated (tests/stress/contacts/laws.py).
"""

from __future__ import annotations

import itertools
import math
from collections import Counter

import numpy as np
import pytest
from scipy.integrate import quad

from tests.mechanics.found_scenes import LAWS, WAYS, plate, ran, struck
from tests.mechanics.test_crates import rod, slider
from tests.mechanics.test_walker import by_least_coordinates, walker
from tests.scenes import ROUTES, G, number
from tests.stress.contacts import one_body
from tests.stress.contacts.verdict import LIMITED, RIGHT, is_fault


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
    judged = one_body.judged(
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
    words = Counter(judged)
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
