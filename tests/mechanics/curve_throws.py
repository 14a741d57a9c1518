"""Bodies of ellipses and edges, thrown at hills and bowls y = k x^2: the scene, and its flights and blows beside it."""

# ruff: noqa: E501

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from tests.scenes import G

DOME = '{ x = "(1 m)*s", y = "(-0.25 m)*s^2", from = -4, to = 4 }'
BOWL = '{ x = "(1 m)*s", y = "(0.25 m)*s^2", from = -4, to = 4 }'


Place = Callable[[float], np.ndarray]


@dataclass
class Body:
    """A body with mass 1 kg whose outline in its axes is `place`, for u from `ends[0]` to `ends[1]`."""

    place: Place
    ends: tuple[float, float]
    inertia: float
    closed: bool

    def outline(self, q: np.ndarray, u: np.ndarray) -> np.ndarray:
        p = self.place(u)  # type: ignore[arg-type]
        c, s = math.cos(q[2]), math.sin(q[2])
        return np.array([q[0] + c * p[0] - s * p[1], q[1] + s * p[0] + c * p[1]])

    def deepest(self, q: np.ndarray, k: float) -> tuple[float, np.ndarray]:
        """The least y - k x^2 on its outline, and where."""
        u = np.linspace(*self.ends, 241)
        x, y = self.outline(q, u)
        i = int(np.argmin(y - k * x * x))
        low, high = u[i] - (u[1] - u[0]), u[i] + (u[1] - u[0])
        if not self.closed:
            low, high = max(low, self.ends[0]), min(high, self.ends[1])

        def slope(u: float) -> float:
            """By a complex step."""
            x, y = self.outline(q, np.array(u + 1e-30j))
            return float((y - k * x * x).imag / 1e-30)

        at = low if slope(low) > 0 else high if slope(high) < 0 else brentq(slope, low, high, xtol=1e-15)
        x, y = self.outline(q, np.array(at))
        return float(y - k * x * x), np.array([x, y], dtype=float)


def edge(half: float, below: float, inertia: float) -> Body:
    return Body(lambda u: np.array([u, 0 * u - below]), (-half, half), inertia, False)


def ellipse(a: float, b: float, inertia: float) -> Body:
    return Body(lambda u: np.array([a * np.cos(u), b * np.sin(u)]), (0, 2 * math.pi), inertia, True)


def struck(body: Body, q: np.ndarray, v: np.ndarray, k: float, e: float, rough: bool) -> np.ndarray:
    """The velocities after a blow where it is deepest: what comes back by e along the normal, and slips no more if rough.

    Raises ValueError where it would have to pull."""
    _, at = body.deepest(q, k)
    n = np.array([-2 * k * at[0], 1]) / math.hypot(1, 2 * k * at[0])
    r = at - q[:2]
    rows = [[n[0], n[1], r[0] * n[1] - r[1] * n[0]]]
    if rough:
        rows.append([n[1], -n[0], -r[0] * n[0] - r[1] * n[1]])
    j = np.array(rows)
    after = np.zeros(len(rows))
    after[0] = -e * (j[0] @ v)
    inverse = np.diag([1, 1, 1 / body.inertia])
    impulse = np.linalg.solve(j @ inverse @ j.T, after - j @ v)
    if impulse[0] <= 0:
        raise ValueError
    return v + inverse @ j.T @ impulse


def flown(
    body: Body, q: np.ndarray, v: np.ndarray, k: float, e: float, rough: bool, end: float
) -> tuple[np.ndarray, int]:
    """Where it is at the end, by parabolas and blows, and how many blows there were."""
    t, blows = 0.0, 0
    while True:

        def at(h: float, q: np.ndarray = q, v: np.ndarray = v) -> np.ndarray:
            return q + v * h + np.array([0, -G * h * h / 2, 0])

        def gap(h: float) -> float:
            return body.deepest(at(h), k)[0]

        hit, before = None, 1e-5
        for h in np.arange(2e-3, end - t, 2e-3):
            if gap(h) <= 0:
                hit = before, h
                break
            before = h
        if hit is None:
            return at(end - t), blows
        h = brentq(gap, *hit, xtol=1e-15)
        q, v, t = at(h), v + np.array([0, -G * h, 0]), t + h
        v, blows = struck(body, q, v, k, e, rough), blows + 1


THROWN = """
until = "t = {end} s"
ground.curves.hill = {curve}
[bodies.p]
{body}
mass = "1 kg"
inertia = "{inertia} kg*m^2"
at = ["{x} m", "{y} m"]
angle = "{angle} rad"
[contacts.c]
touch = ["{mark}", "ground.hill"]
restitution = {e}
friction = {friction}
[start]
p.velocity = ["{vx} m/s", "{vy} m/s"]
p.omega = "{w} rad/s"
[events]
hit = "c strikes"
[ask]
x = {{ of = "p.x", unit = "m" }}
y = {{ of = "p.y", unit = "m" }}
angle = {{ of = "p.angle", unit = "rad" }}
n = "hit.count"
least = {{ min = "c.gap", unit = "m" }}
"""


def thrown(
    rng: np.random.Generator, body: Body, shape: str, mark: str, dome: bool, rough: bool, most: float
) -> tuple[str, np.ndarray, int]:
    """A scene in which a body falls, turned by at most so much, on a hill or into a bowl; where it is then, and after how
    many blows."""
    e, end = 0.7, 0.75
    while True:
        q = np.array([rng.uniform(-0.5, 0.5), 0.9 if dome else 1.1, rng.uniform(-most, most)])
        v = np.array([rng.uniform(-0.5, 0.5), 0.0, rng.uniform(-1, 1)])
        try:
            where, blows = flown(body, q, v, -0.25 if dome else 0.25, e, rough, end)
            break
        except ValueError:
            continue
    x, y, angle, vx, vy, w = (repr(float(one)) for one in (*q, *v))
    scene = THROWN.format(
        end=end,
        curve=DOME if dome else BOWL,
        body=shape,
        inertia=body.inertia,
        x=x,
        y=y,
        angle=angle,
        vx=vx,
        vy=vy,
        w=w,
        mark=mark,
        e=e,
        friction='"rough"' if rough else 0,
    )
    return scene, where, blows
