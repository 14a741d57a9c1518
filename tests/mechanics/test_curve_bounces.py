"""Points and circles that strike curves: blow by blow beside flights and roots of their own, on every route."""

# ruff: noqa: E501

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from tests.mechanics.curve_scenes import PARABOLA
from tests.scenes import ROUTES, G, asked, close, on_route


def foot_on_parabola(x: float, y: float) -> float:
    roots = np.roots([-0.125, 0, 0.5 * y - 1, x])
    s = min(
        (root.real for root in roots if abs(root.imag) < 1e-9), key=lambda s: math.hypot(x - s, y - s * s / 4)
    )
    for _ in range(3):
        s -= ((x - s) + (y - s * s / 4) * s / 2) / (-1 + (y - s * s / 4) / 2 - s * s / 4)
    return float(s)


def bounced(until: float, radius: float, e: float, mu: float) -> tuple[float, float, float, int]:
    """A disk that falls from (1, 1.5) into y = x^2/4, by parabolas and blows: x, y, omega and how many blows there were."""

    def gap(x: float, y: float) -> float:
        s = foot_on_parabola(x, y)
        return math.copysign(math.hypot(x - s, y - s * s / 4), y - x * x / 4) - radius

    t, blows = 0.0, 0
    x, y, vx, vy, w = 1.0, 1.5, 0.0, 0.0, 0.0
    while True:

        def at(h: float, x: float = x, y: float = y, vx: float = vx, vy: float = vy) -> float:
            return gap(x + vx * h, y + vy * h - G * h * h / 2)

        times = np.linspace(1e-6, until - t, 4000)
        hit = next(((a, b) for a, b in itertools.pairwise(times) if at(a) > 0 >= at(b)), None)
        h = until - t if hit is None else brentq(at, *hit, xtol=1e-15)
        x, y, vy, t = x + vx * h, y + vy * h - G * h * h / 2, vy - G * h, t + h
        if hit is None:
            return x, y, w, blows
        blows += 1
        slope = foot_on_parabola(x, y) / 2
        tx, ty = 1 / math.hypot(1, slope), slope / math.hypot(1, slope)
        normal = -(1 + e) * (-vx * ty + vy * tx)
        along = -(vx * tx + vy * ty + radius * w) / 3
        along = max(-mu * normal, min(mu * normal, along))
        vx, vy, w = vx - normal * ty + along * tx, vy + normal * tx + along * ty, w + 2 * along / radius


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("radius", "e", "mu"), [(0.2, 0.7, 0.3), (0.5, 1, 0), (0.1, 0.9, 0.05)])
def test_a_disk_bounces_in_a_bowl_as_blow_by_blow(route: str, radius: float, e: float, mu: float) -> None:
    result = on_route(
        f"""
        until = "t = 1.5 s"
        ground.curves.bowl = {PARABOLA}
        bodies.p = {{ disk = "{radius} m", mass = "2 kg", at = ["1 m", "1.5 m"] }}
        contacts.c = {{ touch = ["p.rim", "ground.bowl"], restitution = {e}, friction = {mu} }}
        events.hit = "c strikes"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.y = {{ of = "p.y", unit = "m" }}
        ask.w = {{ of = "p.omega", unit = "rad/s" }}
        ask.n = "hit.count"
        """,
        route,
    )
    x, y, w, n = bounced(1.5, radius, e, mu)
    assert asked(result, "n") == n > 1
    assert asked(result, "x") == pytest.approx(x, abs=close(route))
    assert asked(result, "y") == pytest.approx(y, abs=close(route))
    assert asked(result, "w") == pytest.approx(w, abs=1e-8)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("begin", [0.02, 0.11, 0.3])
def test_a_fast_ball_hits_the_first_of_many_waves(route: str, begin: float) -> None:
    """Over y = 0.1 cos 20 x, flat and fast, so that a step goes over several waves."""
    result = on_route(
        f"""
        until = "c strikes"
        ground.curves.waves = {{ x = "(1 m)*s", y = "(0.1 m)*cos(20*s)", from = -1, to = 10 }}
        bodies.p = {{ mass = "1 kg", at = ["{begin} m", "1 m"] }}
        contacts.c = {{ touch = ["p", "ground.waves"] }}
        start.p.velocity.x = "20 m/s"
        ask.x = {{ of = "p.x", at = "end", unit = "m" }}
        """,
        route,
    )

    def gap(t: float) -> float:
        return 1 - G * t * t / 2 - 0.1 * math.cos(20 * (begin + 20 * t))

    times = np.linspace(0, 0.55, 20001)
    a, b = next((a, b) for a, b in itertools.pairwise(times) if gap(a) > 0 >= gap(b))
    assert asked(result, "x") == pytest.approx(begin + 20 * brentq(gap, a, b, xtol=1e-15), rel=close(route))


def test_gaps_are_those_to_the_nearest_place() -> None:
    """Random places beside a wavy ring, against all of it looked at closely."""
    rng = np.random.default_rng(5)
    s = np.linspace(0, 2 * math.pi, 20001)

    def radius(s: float | np.ndarray) -> float | np.ndarray:
        return 1 + 0.2 * np.cos(5 * s) + 0.1 * np.sin(2 * s)

    for x, y in rng.uniform(-2.5, 2.5, (40, 2)):

        def apart(s: float, x: float = x, y: float = y) -> float:
            return float(math.hypot(x - radius(s) * math.cos(s), y - radius(s) * math.sin(s)))

        near = s[np.argmin(np.hypot(x - radius(s) * np.cos(s), y - radius(s) * np.sin(s)))]
        least = minimize_scalar(apart, bounds=(near - 1e-3, near + 1e-3), options={"xatol": 1e-13}).fun
        inside = math.hypot(x, y) < radius(math.atan2(y, x))
        gap = asked(
            on_route(
                f"""
                until = "t = 1 us"
                ground.curves.ring = {{ x = "(1 m)*(1 + 0.2*cos(5*s) + 0.1*sin(2*s))*cos(s)", y = "(1 m)*(1 + 0.2*cos(5*s) + 0.1*sin(2*s))*sin(s)", from = 0, to = "2*pi", closed = true, side = "{"left" if inside else "right"}" }}
                bodies.p = {{ mass = "1 kg", at = ["{x} m", "{y} m"] }}
                contacts.c = {{ touch = ["p", "ground.ring"] }}
                events.begin = "start"
                ask.gap = {{ of = "c.gap", at = "begin", unit = "m" }}
                """
            ),
            "gap",
        )
        assert gap == pytest.approx(least, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_a_wheel_that_slides_into_a_narrow_hollow_strikes_its_other_side(route: str) -> None:
    """Its first foot has next to ended there: it must not be taken for the second.  The least gap tells of any overlap."""
    result = on_route(
        """
        until = "t = 1.5 s"
        ground.curves.ring = { x = "(1 m)*(1 + 0.101*cos(5*s + 5.80) + 0.083*cos(5*s + 4.54))*cos(s)", y = "(1 m)*(1 + 0.101*cos(5*s + 5.80) + 0.083*cos(5*s + 4.54))*sin(s)", from = 0, to = "2*pi", closed = true }
        bodies.p = { disk = "0.3 m", mass = "1 kg", at = [0, 0] }
        contacts.c = { touch = ["p.rim", "ground.ring"] }
        start.p.velocity = ["-0.594 m/s", "2.325 m/s"]
        ask.x = { of = "p.x", unit = "m" }
        ask.y = { of = "p.y", unit = "m" }
        ask.gap = { min = "c.gap", unit = "m" }
        """,
        route,
    )
    assert asked(result, "gap") > -1e-7
    s = np.linspace(0, 2 * math.pi, 200001)
    r = 1 + 0.101 * np.cos(5 * s + 5.80) + 0.083 * np.cos(5 * s + 4.54)
    apart = np.hypot(asked(result, "x") - r * np.cos(s), asked(result, "y") - r * np.sin(s))
    assert apart.min() > 0.3 - 1e-7


@pytest.mark.parametrize("route", ROUTES)
def test_the_far_side_of_a_cam_is_not_touched(route: str) -> None:
    """A roller stays on a turning ellipse, whose far side has feet as well: their way on the follower's line is the height."""
    result = on_route(
        """
        until = "t = 4 s"
        bodies.cam = { inertia = "1 kg*m^2", mass = "1 kg", at = [0, 0], driven.angle = "(2 rad/s)*t", curves.profile = { ellipse = ["0.5 m", "0.3 m"], at = ["0.1 m", 0], side = "right" } }
        bodies.roller = { disk = "0.1 m", mass = "0.1 kg", at = [0, "0.42 m"] }
        ground.lines.guide = { through = [0, 0], angle = "90 deg" }
        joints.axle = { pin = ["cam", "ground"] }
        joints.guide = { slider = ["roller", "ground.guide"], turning = false }
        contacts.c = { touch = ["roller.rim", "cam.profile"] }
        ask.y = { of = "roller.y", unit = "m" }
        ask.most = { max = "roller.y", unit = "m" }
        ask.closed = "c.closed"
        """,
        route,
    )

    def height(angle: float) -> float:
        """Of the centre over the axle: on the curve parallel to the ellipse, turned, at x = 0; the upper place."""

        def place(s: float) -> tuple[float, float]:
            size = math.hypot(0.3 * math.cos(s), 0.5 * math.sin(s))
            x = 0.1 + 0.5 * math.cos(s) + 0.1 * 0.3 * math.cos(s) / size
            y = 0.3 * math.sin(s) + 0.1 * 0.5 * math.sin(s) / size
            return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)

        places = np.linspace(0, 2 * math.pi, 400)
        roots = [
            brentq(lambda s: place(s)[0], a, b, xtol=1e-15)
            for a, b in itertools.pairwise(places)
            if place(a)[0] * place(b)[0] <= 0
        ]
        return max(place(root)[1] for root in roots)

    assert asked(result, "closed") == 1
    assert asked(result, "y") == pytest.approx(height(8), rel=close(route))
    assert asked(result, "most") == pytest.approx(0.7, rel=1e-9)
