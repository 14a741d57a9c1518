"""Two ellipses that fly into each other, beside support functions and the course of a blow by Routh."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.optimize import brentq, minimize_scalar

import planemotion

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Flier:
    """An ellipse about its mass centre: half axes, mass, inertia, pose and velocity at t = 0, in SI units."""

    axes: Floats
    mass: float
    inertia: float
    pose: Floats
    velocity: Floats

    def at(self, t: float) -> Floats:
        return np.asarray(self.pose + t * self.velocity)

    def reach(self, t: float, n: Floats) -> float:
        """The support function: how far it reaches along n from its mass centre."""
        return float(np.hypot(*(self.axes * self.own(t, n))))

    def place(self, t: float, n: Floats) -> Floats:
        """What lies farthest along n, from its mass centre."""
        own = self.own(t, n)
        x, y = self.axes**2 * own / np.hypot(*(self.axes * own))
        c, s = math.cos(self.at(t)[2]), math.sin(self.at(t)[2])
        return np.array([c * x - s * y, s * x + c * y])

    def own(self, t: float, n: Floats) -> Floats:
        c, s = math.cos(self.at(t)[2]), math.sin(self.at(t)[2])
        return np.array([c * n[0] + s * n[1], -s * n[0] + c * n[1]])


def direction(angle: float) -> Floats:
    return np.array([math.cos(angle), math.sin(angle)])


def apart(a: Flier, b: Flier, t: float) -> tuple[float, float]:
    """The greatest gap between lines that part them, and its direction from a to b; < 0: they overlap."""

    def gap(angle: float) -> float:
        n = direction(angle)
        return float((b.at(t) - a.at(t))[:2] @ n) - a.reach(t, n) - b.reach(t, -n)

    angles = np.linspace(0, 2 * math.pi, 46)
    best = angles[int(np.argmax([gap(one) for one in angles]))]
    found = minimize_scalar(
        lambda x: -gap(x), bounds=(best - 0.2, best + 0.2), method="bounded", options={"xatol": 1e-13}
    )
    return -float(found.fun), float(found.x)


def first_touch(a: Flier, b: Flier, until: float) -> float | None:
    times = np.linspace(0, until, 76)
    for begin, end in itertools.pairwise(times):
        if apart(a, b, end)[0] <= 0:
            return float(brentq(lambda t: apart(a, b, t)[0], begin, end, xtol=1e-15))
    return None


def course(w: Floats, u: Floats, e: float, mu: float) -> Floats:
    """The impulse (normal, tangential) from u = (normal, slip) to -e u_n, followed in its normal part."""
    u, sum_of, end = u.copy(), np.zeros(2), -e * u[0]
    slips = np.sign(u[1])
    for _ in range(6):
        sticks = -w[1, 0] / w[1, 1]
        holds = slips == 0 and abs(sticks) <= mu
        share = np.array([1, sticks if holds else mu * np.sign(sticks) if slips == 0 else -mu * slips])
        rate = w @ share
        to_end = (end - u[0]) / rate[0] if rate[0] > 0 else math.inf
        to_stop = -u[1] / rate[1] if slips and u[1] * rate[1] < 0 else math.inf
        way = min(to_end, to_stop)
        u, sum_of = u + way * rate, sum_of + way * share
        if to_end <= to_stop:
            break
        u[1], slips = 0, 0
    return sum_of


def limited(w: Floats, u: Floats, e: float, mu: float) -> Floats:
    """Newton's law gains no energy: the greatest part of its restitution that does not."""

    def gain(p: Floats) -> float:
        return float(p @ u + p @ w @ p / 2)

    whole, none = course(w, u, e, mu), course(w, u, 0, mu)
    if gain(whole) <= 1e-14:
        return whole
    part = brentq(lambda k: gain(k * whole + (1 - k) * none), 0, 1, xtol=1e-15)
    return part * whole + (1 - part) * none


def struck(a: Flier, b: Flier, t: float, e: float, mu: float) -> Floats:
    """The velocities of both after the blow."""
    n = direction(apart(a, b, t)[1])
    across = np.array([-n[1], n[0]])
    on_a, on_b = a.place(t, n), b.place(t, -n)
    rows = np.array(
        [[*-d, -(on_a[0] * d[1] - on_a[1] * d[0]), *d, on_b[0] * d[1] - on_b[1] * d[0]] for d in (n, across)]
    )
    inverse = np.array([1 / a.mass, 1 / a.mass, 1 / a.inertia, 1 / b.mass, 1 / b.mass, 1 / b.inertia])
    v = np.concatenate([a.velocity, b.velocity])
    impulse = limited(rows * inverse @ rows.T, rows @ v, e, mu)
    return np.asarray(v + inverse * (rows.T @ impulse))


def thrown(rng: np.random.Generator, x: float) -> Flier:
    """From x, about, towards the origin."""
    return Flier(
        rng.uniform(0.2, 0.6, 2),
        rng.uniform(0.5, 3),
        rng.uniform(0.05, 0.5),
        np.array([x, 0, 0]) + np.array([*rng.uniform(-0.3, 0.3, 2), rng.uniform(-3, 3)]),
        np.array([-math.copysign(rng.uniform(0.5, 1.5), x), rng.uniform(-0.5, 0.5), rng.uniform(-5, 5)]),
    )


def written(name: str, x: Flier) -> str:
    px, py, angle, vx, vy, omega = (float(one) for one in (*x.pose, *x.velocity))
    a, b = (float(one) for one in x.axes)
    return f"""
    bodies.{name} = {{ mass = "{x.mass!r} kg", inertia = "{x.inertia!r} kg*m^2", at = ["{px!r} m", "{py!r} m"], angle = "{angle!r} rad", curves.rim = {{ ellipse = ["{a!r} m", "{b!r} m"], side = "right" }} }}
    start.{name} = {{ velocity = ["{vx!r} m/s", "{vy!r} m/s"], omega = "{omega!r} rad/s" }}
    ask.{name}_x = {{ of = "{name}.velocity.x", at = "hit", unit = "m/s" }}
    ask.{name}_y = {{ of = "{name}.velocity.y", at = "hit", unit = "m/s" }}
    ask.{name}_w = {{ of = "{name}.omega", at = "hit", unit = "rad/s" }}
    """  # noqa: E501


@pytest.mark.parametrize("route", ["auto", "rk"])
@pytest.mark.parametrize("seed", range(8))
def test_ellipses_strike_as_their_support_functions_say(seed: int, route: str) -> None:
    rng = np.random.default_rng(seed)
    a, b = thrown(rng, -1), thrown(rng, 1)
    e, mu = float(rng.choice([0, 0.5, 1])), float(rng.choice([0, 0.2, 1]))
    assert apart(a, b, 0)[0] > 0
    text = f"""
    until = "t = 1.5 s"
    solve.route = "{route}"
    parameters.g = "0 m/s^2"
    contacts.c = {{ touch = ["p.rim", "q.rim"], restitution = {e}, friction = {mu} }}
    events.hit = "c strikes"
    ask.n = "hit.count"
    ask.t = {{ of = "t", at = "hit", unit = "s" }}
    {written("p", a)}{written("q", b)}"""
    got: Any = planemotion.load_text(text).run()
    t = first_touch(a, b, 1.5)
    if t is None:
        assert got["n"] == 0
        return
    assert got["n"] >= 1
    assert got["t"] == pytest.approx(t, abs=1e-9)
    found = [got[f"{body}_{part}"] for body in "pq" for part in "xyw"]
    assert found == pytest.approx(struck(a, b, t, e, mu), abs=1e-6)
