"""Contacts whose laws allow no motion, or several: what is said, and that earlier answers stand.

The scenes are numbered with those of test_found_contacts.py.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import planemotion
from tests.mechanics.found_scenes import told
from tests.mechanics.test_crates import rod
from tests.mechanics.test_order import balls
from tests.scenes import ROUTES, G
from tests.stress.contacts import one_body
from tests.stress.contacts.laws import motions

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
