"""Two feet that strike in turn, ever faster, until both rest: a crate that rocks, a body that clatters."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import mpmath as mp
import numpy as np
import pytest

import planemotion

G = 9.81
ROUTES = ["auto", "rk", "ida"]


# ---- rocking: a crate on rough feet without restitution ----
def rocking(width: float, height: float, tilt: float, route: str) -> str:
    return f"""
until = "rest"
ground.lines.floor = {{ through = [0, 0] }}
[bodies.crate]
plate = ["{width} m", "{height} m"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ A = [0, 0] }}
angle = "{tilt} rad"
[contacts]
a = {{ touch = ["crate.A", "ground.floor"], friction = "rough", restitution = 0 }}
b = {{ touch = ["crate.B", "ground.floor"], friction = "rough", restitution = 0 }}
[start]
crate.velocity = [0, 0]
[ask]
t = {{ of = "t", unit = "s" }}
[solve]
route = "{route}"
"""


def end_of_rocking(width: float, height: float, tilt: float) -> float:
    """Housner: an inverted pendulum about one foot, then the other; a blow leaves r of the speed."""
    radius, alpha = math.hypot(width, height) / 2, math.atan2(width, height)
    inertia = (width**2 + height**2) / 12 + radius**2
    p2, r = G * radius / inertia, 1 - width**2 / 2 / inertia

    nodes, weights = np.polynomial.legendre.leggauss(60)
    s = (nodes + 1) / 2

    def fall(top: float) -> float:
        """From rest at the angle `top` down to 0; angle = top (1 - s^2)."""
        rate = np.sqrt(4 * p2 * np.sin(alpha - top + top * s * s / 2) * np.sin(top * s * s / 2))
        return float(weights @ (top * s / rate))

    def height_of(angle: float) -> float:
        return math.sin(alpha - angle / 2) * math.sin(angle / 2)

    time, top = fall(tilt), tilt
    while top > 1e-28:
        wanted = height_of(top) * r * r
        top *= r * r
        for _ in range(40):
            top -= (height_of(top) - wanted) / (0.5 * math.sin(alpha - top))
        time += 2 * fall(top)
    return time


@pytest.mark.parametrize("route", ROUTES)
def test_a_crate_that_rocks_rests_when_its_series_ends(route: str) -> None:
    rng = np.random.default_rng(11)
    for _ in range(4 if route == "ida" else 12):
        width, height = float(rng.uniform(0.1, 0.4)), float(rng.uniform(0.3, 0.6))
        case = (width, height, float(rng.uniform(0.02, 0.3)) * math.atan2(width, height))
        result = planemotion.load_text(rocking(*case, route)).run()
        told = result.asks["t"].error
        assert result.status == "ok", (case, result.error)
        assert isinstance(told, float)
        true = end_of_rocking(*case)
        assert result["t"] == pytest.approx(true, rel=1e-6 if route == "ida" else 1e-8), case
        assert result["t"] == pytest.approx(true, rel=1e-11, abs=10 * told), case


# ---- clattering: a body of small inertia on two feet ----
@dataclass
class Clatter:
    """SI; the axes go along a floor that falls by `slope` to the right, and off it."""

    inertia: float
    feet: tuple[float, float]
    below: float
    restitution: tuple[float, float]
    friction: float
    slope: float
    height: float
    velocity: tuple[float, float]
    omega: float

    def scene(self, until: str, route: str) -> str:
        c, s = math.cos(self.slope), math.sin(self.slope)
        y = self.height + self.below
        vx, vy = self.velocity
        return f"""
until = "{until}"
ground.lines.floor = {{ through = [0, 0], angle = "{-self.slope} rad" }}
[bodies.k]
mass = "1 kg"
inertia = "{self.inertia} kg*m^2"
points = {{ A = ["{-self.feet[0]} m", "{-self.below} m"], B = ["{self.feet[1]} m", "{-self.below} m"] }}
at = ["{y * s} m", "{y * c} m"]
angle = "{-self.slope} rad"
[contacts]
a = {{ touch = ["k.A", "ground.floor"], friction = {self.friction}, restitution = {self.restitution[0]} }}
b = {{ touch = ["k.B", "ground.floor"], friction = {self.friction}, restitution = {self.restitution[1]} }}
[start]
k.velocity = ["{vx * c + vy * s} m/s", "{-vx * s + vy * c} m/s"]
k.omega = "{self.omega} rad/s"
[ask]
t = {{ of = "t", unit = "s" }}
[solve]
route = "{route}"
"""


@dataclass
class End:
    time: float
    place: float
    speed: float
    order: str


class Flights:
    """The body without friction on a level floor, in exact flights from blow to blow, with 34 digits."""

    def __init__(self, case: Clatter) -> None:
        self.case = case
        self.load = mp.mpf(G)
        self.y, self.vy = mp.mpf(case.height), mp.mpf(0)
        self.angle, self.omega = mp.mpf(0), mp.mpf(case.omega)
        self.order, self.flights = "", list[mp.mpf]()

    def foot(self, i: int, t: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
        """From the mass centre to a foot, after `t`."""
        c, s = mp.cos(self.angle + self.omega * t), mp.sin(self.angle + self.omega * t)
        x, y = (-self.case.feet[0], self.case.feet[1])[i], -self.case.below
        return c * x - s * y, s * x + c * y

    def lands(self, i: int) -> mp.mpf:
        """The time until a foot is on the floor; the one that was struck leaves it first."""
        arm, lever = self.foot(i, 0)
        gap, rate = self.y + lever, self.vy + self.omega * arm
        bend = self.load + self.omega**2 * lever
        t = (rate + mp.sqrt(rate**2 + 2 * bend * max(gap, 0))) / bend
        for _ in range(60):
            arm, lever = self.foot(i, t)
            gap = self.y + self.vy * t - self.load * t * t / 2 + lever
            step = gap / (self.vy - self.load * t + self.omega * arm)
            t -= step
            if abs(step) < mp.mpf(10) ** -30 * t:
                break
        return t

    def fly(self, t: mp.mpf) -> None:
        self.y += self.vy * t - self.load * t * t / 2
        self.angle += self.omega * t
        self.vy -= self.load * t

    def strike(self, i: int) -> None:
        x = self.foot(i, 0)[0]
        push = -(1 + self.case.restitution[i]) * (self.vy + self.omega * x) / (1 + x * x / self.case.inertia)
        self.vy += push
        self.omega += x * push / self.case.inertia

    def turns(self) -> tuple[int, mp.mpf] | None:
        """How long the order of the last blows is, and the ratio of its turns."""
        for k in range(1, 10):
            last, before = self.flights[-k:], self.flights[-2 * k : -k]
            if len(before) < k or self.order[-k:] != self.order[-2 * k : -k]:
                continue
            ratio = mp.fsum(last) / mp.fsum(before)
            if ratio < 1 and all(abs(a - ratio * b) < 1e-6 * b for a, b in zip(last, before, strict=True)):
                return k, ratio
        return None

    def end(self) -> tuple[str, float] | None:
        """Order and time of its end; None where it does not so."""
        while len(set(self.order[-25:])) != 1 or len(self.order) < 25:
            times = [self.lands(i) for i in range(2)]
            i = min(range(2), key=lambda k: times[k])
            self.fly(times[i])
            self.order, self.flights = self.order + "ab"[i], [*self.flights, times[i]]
            if not times[i] > 0:
                return None
            self.strike(i)
            if max(self.flights[-6:]) < 1e-12:
                break
        turns = self.turns()
        if turns is None or len(set(self.order[-turns[0] :])) == 1:
            return None
        left = mp.fsum(self.flights[-turns[0] :]) * turns[1] / (1 - turns[1])
        return self.order[-turns[0] :], float(mp.fsum(self.flights) + left)


def body(rng: np.random.Generator, friction: float) -> Clatter:
    size, e = float(10 ** rng.uniform(-1, 0)), float(rng.uniform(0.1, 0.6))
    return Clatter(
        size**2 * float(rng.uniform(0.1, 0.2)),
        (size, size * float(rng.uniform(0.8, 1))),
        size * float(rng.uniform(0, 0.1)) if friction else 0,
        (e, e if rng.random() < 0.5 else float(rng.uniform(0.1, 0.6))),
        friction,
        friction * float(rng.uniform(0, 0.8)),
        size * float(rng.uniform(0.002, 0.02)),
        (3 if friction else 0, 0),
        float(rng.uniform(-0.3, 0.3)),
    )


@functools.cache
def cases(n: int) -> list[tuple[Clatter, tuple[str, float]]]:
    """Bodies that clatter on both feet until these rest at one time."""
    rng = np.random.default_rng(3)
    found = list[tuple[Clatter, tuple[str, float]]]()
    while len(found) < n:
        case = body(rng, 0)
        with mp.workdps(34):
            end = Flights(case).end()
        if end is not None:
            found.append((case, end))
    return found


@pytest.mark.parametrize("route", ROUTES)
def test_two_feet_that_clatter_come_to_rest_together(route: str) -> None:
    for case, (order, time) in cases(6):
        result = planemotion.load_text(case.scene("rest", route)).run()
        told = result.asks["t"].error
        assert result.status == "ok", (case, order, result.error)
        assert isinstance(told, float)
        assert result["t"] == pytest.approx(time, rel=1e-6), (case, order)
        assert result["t"] == pytest.approx(time, abs=max(10 * told, 2e-9)), (case, order)


@pytest.mark.parametrize("route", ROUTES)
def test_feet_that_clatter_on_an_incline_slide_on(route: str) -> None:
    """The blows press as much as the weight does in all: it slips as if its feet never left the floor."""
    rng = np.random.default_rng(4)
    for _ in range(4 if route == "ida" else 12):
        case = body(rng, float(rng.uniform(0.02, 0.1)))
        result = planemotion.load_text(case.scene("rest", route)).run()
        slows = G * (case.friction * math.cos(case.slope) - math.sin(case.slope))
        assert result.status == "ok", (case, result.error)
        assert result["t"] == pytest.approx(case.velocity[0] / slows, rel=1e-10), case
