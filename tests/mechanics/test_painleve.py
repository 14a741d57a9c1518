"""Where no motion obeys the laws of contact: an impact without collision, if the contact asks for it."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests.mechanics.test_crates import rod
from tests.scenes import ROUTES

MORE = """
vx = "rod.velocity.x"
vy = "rod.velocity.y"
omega = "rod.omega"
lost = "energy.lost"
p = "foot.impulse.y"
x = "rod.x"
"""
STEPS = 40000


def drawn(
    degrees: float, mu: float, slip: float, law: str = "newton", e: float = 0, until: str = "start"
) -> str:
    keys = f'{mu}, painleve = "impact", law = "{law}", restitution = {e}'
    return rod(degrees, keys, slip, 0, until=until) + MORE


def values(text: str, closes: float = 1e-12) -> dict[str, float]:
    result = planemotion.load_text(text).run()
    assert result.status == "ok", result.error
    assert result.audit["energy"] is not None
    assert result.audit["energy"] < closes
    return {key: float(ask.value) for key, ask in result.asks.items() if isinstance(ask.value, float)}


def stepped(degrees: float, mu: float, slip: float, law: str, e: float) -> tuple[float, float, float]:
    """vx, vy, omega of the rod after the blow, in small normal impulses at its foot."""
    angle, inertia = math.radians(degrees), 1 / 12
    rx, ry = -0.5 * math.cos(angle), -0.5 * math.sin(angle)
    vx, vy, omega, dp, p, work = slip, 0.0, 0.0, 1.5 / STEPS, 0.0, 0.0
    p_end = work_end = math.inf
    sense, compresses = math.copysign(1, slip), True
    for _ in range(10 * STEPS):
        ux, before = vx - omega * ry, vy + omega * rx
        hold = -(ux - rx * ry / inertia * dp) / (
            1 + ry * ry / inertia
        )  # friction that ends the slip in this step
        f = max(-mu * dp, min(mu * dp, hold))
        vx, vy, omega, p = vx + f, vy + dp, omega + (rx * dp - ry * f) / inertia, p + dp
        after = vy + omega * rx
        work += 0.5 * (before + after) * dp
        if compresses and after >= 0:
            compresses, p_end, work_end = False, (1 + e) * p, (1 - e * e) * work
        ended = {
            "newton": not compresses,
            "poisson": p >= p_end,
            "stronge": not compresses and work >= work_end,
        }
        if ended[law]:
            break
    assert sense * (vx - omega * ry) < 1e-3
    return vx, vy, omega


@pytest.mark.parametrize("law", ["newton", "poisson", "stronge"])
@pytest.mark.parametrize(("degrees", "mu", "slip"), [(50, 1.6, -1), (60, 2, -3), (65, 1.6, -1), (120, 2, 2)])
def test_the_sliding_rod_against_small_steps(law: str, degrees: float, mu: float, slip: float) -> None:
    e = 0.6
    seen = values(drawn(degrees, mu, slip, law, e))
    vx, vy, omega = stepped(degrees, mu, slip, law, e)
    assert (seen["vx"], seen["vy"], seen["omega"]) == pytest.approx((vx, vy, omega), abs=2e-3)
    assert seen["lost"] > 0
    assert seen["p"] > 0


def test_without_restitution_the_foot_is_held() -> None:
    """The momentum about the foot stays: omega = 3 sin 50 deg / 2 * 1 m/s."""
    seen = values(drawn(50, 1.6, -1))
    assert seen["omega"] == pytest.approx(1.5 * math.sin(math.radians(50)), rel=1e-13)


def test_mirror_images_and_energy() -> None:
    choose, struck = random.Random(11), 0
    for _ in range(60):
        degrees, mu, e = choose.uniform(30, 85), choose.uniform(1.4, 3), choose.uniform(0, 1)
        law, slip = choose.choice(["newton", "poisson", "stronge"]), choose.uniform(-3, -0.2)
        one, other = values(drawn(degrees, mu, slip, law, e)), values(drawn(180 - degrees, mu, -slip, law, e))
        angle = math.radians(degrees)
        draws = 1 + 3 * math.cos(angle) * (math.cos(angle) - mu * math.sin(angle)) < 0
        assert (one["p"] > 0) == draws
        struck += draws
        assert one["lost"] >= 0
        assert one["lost"] <= 0.5 * slip**2
        for key, sign in (("vx", -1), ("vy", 1), ("omega", -1)):
            assert other[key] == pytest.approx(sign * one[key], abs=1e-12)
    assert 20 < struck < 55


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("law", "e"), [("newton", 0), ("stronge", 0.5)])
def test_all_routes_go_on(route: str, law: str, e: float) -> None:
    text = drawn(50, 1.6, -1, law, e, until="t = 0.2 s")
    one, other = values(text), values(f'{text}[solve]\nroute = "{route}"\n', closes=1e-8)
    for key in ("x", "vx", "omega"):
        assert other[key] == pytest.approx(one[key], rel=1e-6)


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_a_foot_that_comes_there_ends_in_no_failure(route: str) -> None:
    """1 + 3 cos (cos - 1.6 sin) vanishes, and what would part the foot: rounding tells whether it parts."""
    seen = set()
    for degrees in (34, 35, 36, 38):
        text = rod(degrees, "1.6", -4, 2, until="t = 0.1 s") + f'[solve]\nroute = "{route}"\n'
        result = planemotion.load_text(text).run()
        seen.add(result.status)
        struck = planemotion.load_text(
            text.replace("friction = 1.6", 'friction = 1.6, painleve = "impact"')
        ).run()
        assert struck.status in ("ok", "undecided")
        assert struck.counts["jumps"] <= 1
    assert seen <= {"ok", "undecided", "painleve"}
    if route == "rk":
        assert "painleve" in seen


def test_what_others_would_join_stays_an_outcome() -> None:
    """A second foot 10 mm behind the first, which the blow at the first alone would press into the floor."""
    angle = math.radians(50)
    behind = [f"{-0.5 - 0.01 * math.cos(angle)} m", f"{0.01 * math.sin(angle)} m"]
    touch = 'touch = ["rod.C", "ground.floor"], friction = 1.6'
    other = f"points = {{ C = {behind} }}\n[contacts]\nother = {{ {touch} }}"
    result = planemotion.load_text(drawn(50, 1.6, -1).replace("[contacts]", other)).run()
    assert result.status == "painleve"
    assert "(2 contacts take part" in result.error
