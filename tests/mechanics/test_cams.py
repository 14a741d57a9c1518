"""Flat-faced followers, which rise and swing, beside support functions; and where a spring no longer holds one down."""

# ruff: noqa: E501

from __future__ import annotations

import math
from dataclasses import dataclass

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq

import planemotion
from tests import STUDIES
from tests.scenes import ROUTES, G, asked, close, number, on_route

# ---- a follower that swings ----

FREE = -0.6  # rad, of the spring


@dataclass(frozen=True)
class Swinging:
    """An arm on a pivot, whose flat face lies on an ellipse that turns about a point beside its centre; in SI units."""

    half: tuple[float, float]
    beside: float
    pivot: tuple[float, float]
    below: float  # how far the face is below the pivot in the axes of the arm
    mass: float
    far: float  # of the mass centre from the pivot
    inertia: float  # about the mass centre
    stiffness: float
    rate: float

    def beyond(self, turned: float, angle: float) -> float:
        """How far the face is from the axle less how far the cam reaches that way: its support function."""
        up = (-mpmath.sin(angle), mpmath.cos(angle))
        long = up[0] * mpmath.cos(turned) + up[1] * mpmath.sin(turned)
        short = -up[0] * mpmath.sin(turned) + up[1] * mpmath.cos(turned)
        reach = self.beside * long + mpmath.hypot(self.half[0] * long, self.half[1] * short)
        return self.pivot[0] * up[0] + self.pivot[1] * up[1] - self.below - reach  # type: ignore[no-any-return]

    def angle(self, turned: float) -> float:
        return mpmath.findroot(lambda x: self.beyond(turned, x), 0.1)  # type: ignore[no-any-return]

    def arm(self, turned: float, angle: float) -> float:
        """Of the normal force about the pivot: where the support function is met, along the face."""
        # a turn of the face about the pivot lifts it from the axle by its arm, less what the support function gains
        return mpmath.diff(lambda x: self.beyond(turned, x), angle)  # type: ignore[no-any-return]

    def normal(self, turned: float) -> float:
        angle = self.angle(turned)
        bend = mpmath.diff(self.angle, turned, 2) * self.rate**2
        about_pivot = self.inertia + self.mass * self.far**2
        load = self.mass * G * self.far * mpmath.cos(angle) + self.stiffness * (angle - FREE)
        return float((about_pivot * bend + load) / self.arm(turned, angle))

    def written(self, end: float) -> str:
        a, b = self.half
        begin, omega = float(self.angle(0)), float(mpmath.diff(self.angle, 0) * self.rate)
        return f"""
        until = "t = {end!r} s"
        bodies.cam = {{ inertia = "0.02 kg*m^2", mass = "2 kg", at = [0, 0], driven.angle = "({self.rate!r} rad/s)*t", curves.profile = {{ ellipse = ["{a!r} m", "{b!r} m"], at = ["{self.beside!r} m", 0], side = "right" }} }}
        [bodies.arm]
        mass = "{self.mass!r} kg"
        inertia = "{self.inertia!r} kg*m^2"
        mass_center = ["{self.far!r} m", 0]
        at = ["{self.pivot[0]!r} m", "{self.pivot[1]!r} m"]
        angle = "{begin!r} rad"
        lines.face = {{ from = ["2 m", "{-self.below!r} m"], to = [0, "{-self.below!r} m"] }}
        [joints]
        axle = {{ pin = ["cam.center", "ground"] }}
        pivot = {{ pin = ["arm.center", "ground"] }}
        [forces]
        spring = {{ torsion = ["arm", "ground"], stiffness = "{self.stiffness!r} N*m", free_angle = "{FREE} rad" }}
        [contacts]
        c = {{ touch = ["arm.face", "cam.profile"], friction = 0 }}
        [start]
        arm.omega = "{omega!r} rad/s"
        [events]
        off = "c opens"
        [ask]
        angle = {{ of = "arm.angle", unit = "rad" }}
        N = {{ of = "c.normal", unit = "N" }}
        hops = "off.count"
        """


def swinging(seed: int) -> Swinging:
    rng = np.random.default_rng(seed)
    one = rng.uniform
    return Swinging(
        half=(one(0.12, 0.18), one(0.08, 0.12)),
        beside=one(0, 0.05),
        pivot=(-one(0.45, 0.6), one(0.1, 0.15)),
        below=one(0, 0.03),
        mass=one(0.5, 2),
        far=one(0.2, 0.5),
        inertia=one(0.02, 0.2),
        stiffness=one(20, 60),
        rate=one(1, 3) * (1 if seed % 2 else -1),
    )


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(4))
def test_a_flat_arm_swings_as_the_support_function_of_its_cam_says(seed: int, route: str) -> None:
    case, end = swinging(seed), 1.7
    turned = case.rate * end
    result = on_route(case.written(end), route)
    exact = float(case.angle(turned)), case.normal(turned)
    assert result.status == "ok"
    assert asked(result, "hops") == 0
    assert asked(result, "angle") == pytest.approx(exact[0], abs=close(route))
    assert asked(result, "N") == pytest.approx(exact[1], rel=close(route))


# ---- a follower that rises, pressed down by a spring ----

E, M, K, PRESSED = 0.008, 0.4, 2e3, 0.01  # of studies/flat_follower.toml, in SI units
FOLLOWER = planemotion.load(STUDIES / "flat_follower.toml")


@pytest.mark.parametrize(("route", "k"), [("auto", 500.0), ("auto", 8000.0), ("rk", 2000.0)])
def test_a_follower_hops_from_the_speed_on_at_which_its_load_is_zero(k: float, route: str) -> None:
    """N = m (g - e n^2 sin) + k (e sin + pressed), least at the top."""
    asks = FOLLOWER.run(**{"solve.route": route, "k": f"{k} N/m"}).asks
    exact = math.sqrt((M * G + k * (E + PRESSED)) / (M * E)) * 30 / math.pi
    hops = asks["hops_from"]
    assert number(hops.value) == pytest.approx(exact, rel=1e-9)
    assert abs(number(hops.value) - exact) <= number(hops.error)
    assert number(asks["highest"].value) == pytest.approx(1e3 * E, rel=close(route))
    assert number(asks["least_load"].value) == pytest.approx(0, abs=1e-7)
    assert number(asks["most_load"].value) == pytest.approx(2 * (M * G + k * PRESSED), rel=1e-8)  # below


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("faster", [1.05, 1.3, 1.6])
def test_a_follower_that_hops_flies_on_its_spring_and_lands(faster: float, route: str) -> None:
    """It leaves where the load is zero, then y = y0 + A sin + B cos about where weight and spring balance."""
    rate = faster * math.sqrt((M * G + K * (E + PRESSED)) / (M * E))
    text = (STUDIES / "flat_follower.toml").read_text(encoding="utf-8").split("[find]")[0]
    result = on_route(
        text.replace('"500 rpm"', f'"{rate!r} rad/s"')
        + """
        hopped = { of = "t", at = "hop", unit = "s" }
        height = { of = "follower.y - r", at = "hop", unit = "m" }
        speed = { of = "follower.velocity.y", at = "before land", unit = "m/s" }
        landed = { of = "t", at = "land", unit = "s" }
        """,
        route,
    )
    hop = math.asin((M * G + K * PRESSED) / (E * (M * rate**2 - K))) / rate
    swings, middle = math.sqrt(K / M), -PRESSED - M * G / K
    a, b = E * rate * math.cos(rate * hop) / swings, E * math.sin(rate * hop) - middle

    def height(t: float) -> float:
        x = swings * (t - hop)
        return middle + a * math.sin(x) + b * math.cos(x)

    times = np.linspace(hop, hop + 2 * math.pi / rate, 2001)[20:]
    down = next(i for i, t in enumerate(times) if height(t) < E * math.sin(rate * t))
    land = brentq(lambda t: height(t) - E * math.sin(rate * t), *times[down - 1 : down + 1], xtol=1e-16)
    x = swings * (land - hop)
    assert asked(result, "hopped") == pytest.approx(hop, rel=close(route))
    assert asked(result, "height") == pytest.approx(E * math.sin(rate * hop), rel=close(route))
    assert asked(result, "landed") == pytest.approx(land, rel=close(route))
    speed = swings * (a * math.cos(x) - b * math.sin(x))
    assert asked(result, "speed") == pytest.approx(speed, rel=10 * close(route))
