"""Two curves that touch, and edges on curves: gaps, blows, friction, corners and rolling beside integrations of their own."""

# ruff: noqa: E501

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import planemotion
from planemotion import SceneError, SimulationError
from tests.mechanics.curve_throws import DOME, THROWN, edge, ellipse, thrown
from tests.scenes import ROUTES, G, answers, close

# ---- a flat follower on a cam ----


def lift(angle: float, order: int = 0) -> float:
    """How high an ellipse with half axes 0.3 m and 0.2 m reaches that turns about a point 0.05 m beside its centre; its
    derivatives by the angle."""
    c, s = math.cos(angle), math.sin(angle)
    far = math.hypot(0.3 * s, 0.2 * c)
    first = 0.05 * s * c / far
    if order == 0:
        return 0.05 * s + far
    if order == 1:
        return 0.05 * c + first
    return -0.05 * s + (0.05 * (c * c - s * s) - first * first) / far


CAM = """
bodies.cam = { inertia = "0.02 kg*m^2", mass = "2 kg", at = [0, 0], driven.angle = "(RATE rad/s)*t", curves.profile = { ellipse = ["0.3 m", "0.2 m"], at = ["0.05 m", 0], side = "right" } }
bodies.follower = { plate = ["1.2 m", "0.1 m"], mass = "1 kg", at = [0, "HIGH m"] }
ground.lines.guide = { through = [0, 0], angle = "90 deg" }
joints.axle = { pin = ["cam.center", "ground"] }
joints.guide = { slider = ["follower", "ground.guide"], turning = false }
contacts.c = { touch = ["follower.bottom", "cam.profile"], RULES }
ask.y = { of = "follower.y - (0.05 m)", unit = "m" }
"""


def cam(until: str, rate: float, rules: str, high: float = 0.25, more: str = "") -> str:
    scene = CAM.replace("RATE", str(rate)).replace("HIGH", repr(high)).replace("RULES", rules)
    return f'until = "{until}"\n{scene}{more}'


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("mu", [0, 0.3])
def test_a_flat_follower_goes_up_and_down_with_its_cam(route: str, mu: float) -> None:
    """N = m (g + y''), and friction mu N against the slip."""
    rate, end = 3.0, 2.0
    got = answers(
        cam(
            "t = 2 s",
            rate,
            f"friction = {mu}",
            more="""
            ask.N = { of = "c.normal", unit = "N" }
            ask.F = { of = "c.friction", unit = "N" }
            ask.up = { of = "c.force.y on follower", unit = "N" }
            ask.most = { max = "follower.y - (0.05 m)", unit = "m" }
            """,
        ),
        route,
    )
    angle = rate * end
    normal = G + rate**2 * lift(angle, 2)
    assert got["y"] == pytest.approx(lift(angle), abs=close(route))
    assert got["N"] == pytest.approx(normal, rel=close(route))
    assert abs(got["F"]) == pytest.approx(mu * normal, abs=10 * close(route))
    assert got["up"] == pytest.approx(normal, rel=close(route))
    top = brentq(lambda a: lift(a, 1), 1, 2, xtol=1e-15)
    assert got["most"] == pytest.approx(lift(top), abs=close(route))


@pytest.mark.parametrize("route", ROUTES)
def test_a_flat_follower_lifts_off_where_it_would_be_pulled(route: str) -> None:
    rate = 9.0
    got = answers(cam("c opens", rate, "friction = 0", more='ask.t = { of = "t", unit = "s" }'), route)
    angles = np.linspace(0, 2 * math.pi, 4001)
    a, b = next(x for x in itertools.pairwise(angles) if G + rate**2 * lift(x[1], 2) < 0)
    angle = brentq(lambda x: G + rate**2 * lift(x, 2), a, b, xtol=1e-15)
    assert got["t"] == pytest.approx(angle / rate, rel=close(route))
    assert got["y"] == pytest.approx(lift(angle), abs=close(route))


def hopped(rate: float, e: float, high: float, end: float) -> tuple[float, int]:
    """Where a follower is that falls on the cam and is thrown up by it: parabolas between the blows."""
    t, y, v, blows = 0.0, high - 0.05, 0.0, 0
    while True:

        def gap(h: float, t: float = t, y: float = y, v: float = v) -> float:
            return y + v * h - G * h * h / 2 - lift(rate * (t + h))

        times = np.linspace(1e-7, end - t, 20001)
        hit = next((x for x in itertools.pairwise(times) if gap(x[0]) > 0 >= gap(x[1])), None)
        h = end - t if hit is None else brentq(gap, *hit, xtol=1e-16)
        y, v, t = y + v * h - G * h * h / 2, v - G * h, t + h
        if hit is None:
            return y, blows
        rises = rate * lift(rate * t, 1)
        v, blows = rises - e * (v - rises), blows + 1


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("rate", "e"), [(9.0, 0.6), (14.0, 0.3), (5.0, 0.9)])
def test_a_flat_follower_rebounds_from_its_cam_blow_by_blow(route: str, rate: float, e: float) -> None:
    got = answers(
        cam(
            "t = 1.5 s",
            rate,
            f"restitution = {e}, friction = 0",
            high=0.4,
            more='events.hit = "c strikes"\nask.n = "hit.count"\nask.least = { min = "c.gap", unit = "m" }',
        ),
        route,
    )
    y, n = hopped(rate, e, 0.4, 1.5)
    assert got["n"] == n > 2
    assert got["y"] == pytest.approx(y, abs=10 * close(route))
    assert got["least"] > -1e-9


@pytest.mark.parametrize("seed", range(12))
def test_thrown_bodies_strike_hills_and_bowls_blow_by_blow(seed: int) -> None:
    rng = np.random.default_rng(seed)
    flat, rough = seed % 2 == 0, seed % 4 >= 2
    inertia = round(rng.uniform(0.03, 0.08), 4)
    body = edge(0.5, 0.05, inertia) if flat else ellipse(0.4, 0.25, inertia)
    shape = (
        'plate = ["1 m", "0.1 m"]'
        if flat
        else 'curves.rim = { ellipse = ["0.4 m", "0.25 m"], side = "right" }'
    )
    scene, where, blows = thrown(rng, body, shape, "p.bottom" if flat else "p.rim", flat, rough, 0.6)
    got = answers(scene)
    assert got["n"] == blows >= 1
    assert [got["x"], got["y"], got["angle"]] == pytest.approx(where.tolist(), abs=1e-8)
    assert got["least"] > -1e-9


# ---- what rocks and rolls ----


def arc(s: float) -> float:
    """Along y = -x^2/4 from its top."""
    return 0.5 * s * math.hypot(1, s / 2) + math.asinh(s / 2)


def rocks(
    half: float, thick: float, inertia: float, begin: float, offset: float, spin: float, end: float
) -> tuple[np.ndarray, int]:
    """A plate on y = -x^2/4 without slip: its pose at the end, and how often it went over a corner.

    With f the angle of its edge, x the place of contact (tan f = -x/2), and d how far that is along the edge from its middle
    its centre is at P + n h - t d, its energy (I + m (h^2 + d^2)) f'^2 / 2 + m g y.  Beyond a corner it turns about that.
    """
    begin_arc = arc(begin) - offset

    def place(f: float) -> tuple[float, np.ndarray]:
        x = -2 * math.tan(f)
        d = arc(x) - begin_arc
        t = np.array([math.cos(f), math.sin(f)])
        n = np.array([-t[1], t[0]])
        return d, np.array([x, -x * x / 4]) + thick * n - d * t

    def motion(_: float, y: np.ndarray) -> list[float]:
        f, w = y
        d, _at = place(f)
        length = -2 * math.hypot(1, math.tan(f)) / math.cos(f) ** 2  # d' by f
        # y' by f: of thick n it is -thick sin f, of -t d what its turning makes, of P - t d' nothing
        force = -G * (-thick * math.sin(f) - d * math.cos(f))
        return [w, (force - d * length * w * w) / (inertia + thick**2 + d * d)]

    def left(_: float, y: np.ndarray) -> float:
        return half - abs(place(y[0])[0])

    def turns_about(
        corner: np.ndarray, at: np.ndarray, f: float
    ) -> tuple[Callable[..., list[float]], Callable[[float], np.ndarray]]:
        r = at - corner
        far, swing = math.hypot(*r), math.atan2(r[1], r[0]) - f

        def turning(_: float, y: np.ndarray) -> list[float]:
            return [y[1], -G * far * math.cos(y[0] + swing) / (inertia + far * far)]

        return turning, lambda f: corner + far * np.array([math.cos(f + swing), math.sin(f + swing)])

    left.terminal, left.direction = True, -1  # type: ignore[attr-defined]
    t, state, corners = 0.0, np.array([math.atan(-begin / 2), spin]), 0
    while True:
        found = solve_ivp(motion, (t, end), state, method="DOP853", rtol=1e-13, atol=1e-14, events=left)
        t, state = found.t[-1], found.y[:, -1]
        d, at = place(state[0])
        if found.status == 0:
            return np.array([*at, state[0]]), corners
        f, corners = state[0], corners + 1
        along = np.array([math.cos(f), math.sin(f)])
        corner = at + d * along - thick * np.array([-along[1], along[0]])
        turning, pose = turns_about(corner, at, f)

        def back(_: float, y: np.ndarray, f: float = f) -> float:
            return float(y[0] - f)

        back.terminal, back.direction = True, -np.sign(state[1])  # type: ignore[attr-defined]
        found = solve_ivp(turning, (t, end), state, method="DOP853", rtol=1e-13, atol=1e-14, events=back)
        t, state = found.t[-1], found.y[:, -1]
        if found.status == 0:
            return np.array([*pose(state[0]), state[0]]), corners


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    ("half", "offset", "spin", "end", "times"),
    [
        (1.0, 0.2, 0, 1.5, 0),
        (1.0, -0.15, 0.3, 2.5, 0),
        (0.3, 0.2, -2.0, 0.15, 1),
        (0.3, 0.2, -2.0, 0.9, 3),
        (0.3, -0.2, 1.8, 0.5, 2),
    ],
)
def test_a_plate_rocks_on_a_hill_and_over_its_corner(
    route: str, half: float, offset: float, spin: float, end: float, times: int
) -> None:
    thick, inertia, begin = 0.05, 0.1, 0.1
    where, found = rocks(half, thick, inertia, begin, offset, spin, end)
    assert found == times
    f = math.atan(-begin / 2)
    t, n = np.array([math.cos(f), math.sin(f)]), np.array([-math.sin(f), math.cos(f)])
    r = thick * n - offset * t
    x, y = np.array([begin, -begin * begin / 4]) + r
    got = answers(
        THROWN.format(
            end=end,
            curve=DOME,
            body=f'plate = ["{2 * half} m", "{2 * thick} m"]',
            inertia=inertia,
            x=repr(float(x)),
            y=repr(float(y)),
            angle=repr(f),
            vx=repr(-spin * float(r[1])),
            vy=repr(spin * float(r[0])),
            w=spin,
            mark="p.bottom",
            e=0,
            friction='"rough"',
        ),
        route,
    )
    assert [got["x"], got["y"], got["angle"]] == pytest.approx(where.tolist(), abs=3 * close(route))
    assert got["n"] == 0


# ---- elliptic gears ----

GEARS = """
plane = "horizontal"
until = "t = 2 s"
bodies.a = { inertia = "0.01 kg*m^2", mass = "1 kg", at = [0, 0], driven.angle = "(4 rad/s)*t", curves.pitch = { ellipse = ["0.1 m", "0.08 m"], at = ["0.06 m", 0], side = "right" } }
bodies.b = { inertia = "0.01 kg*m^2", mass = "1 kg", at = ["0.2 m", 0], curves.pitch = { ellipse = ["0.1 m", "0.08 m"], at = ["0.06 m", 0], side = "right" } }
joints.shaft_a = { pin = ["a.center", "ground"] }
joints.shaft_b = { pin = ["b.center", "ground"] }
joints.mesh = { rolling = ["a.pitch", "b.pitch"] }
ask.angle = { of = "b.angle", unit = "rad" }
ask.omega = { of = "b.omega", unit = "rad/s" }
ask.slowest = { max = "b.omega", unit = "rad/s" }
ask.fastest = { min = "b.omega", unit = "rad/s" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_equal_ellipses_about_their_foci_gear_by_the_ratio_of_their_radii(route: str) -> None:
    """r = p / (1 - e cos a) from the focus, and 2 a - r of the other: the ratio goes from (1 - e)/(1 + e) to its inverse."""
    got = answers(GEARS, route)
    e, half, turned = 0.6, 0.1, 8.0

    def ratio(angle: float) -> float:
        r = half * (1 - e * e) / (1 - e * math.cos(angle))
        return -r / (2 * half - r)

    whole = quad(ratio, 0, turned, epsabs=1e-13, epsrel=1e-13, limit=200)[0]
    assert got["omega"] == pytest.approx(4 * ratio(turned), rel=close(route))
    assert got["angle"] == pytest.approx(whole, rel=close(route))
    assert got["slowest"] == pytest.approx(-4 * (1 - e) / (1 + e), rel=close(route))
    assert got["fastest"] == pytest.approx(-4 * (1 + e) / (1 - e), rel=close(route))


# ---- what is told, and drawn ----


def test_curves_that_roll_on_each_other_are_closed() -> None:
    text = GEARS.replace(
        'pitch = { ellipse = ["0.1 m", "0.08 m"],',
        'pitch = { ellipse = ["0.1 m", "0.08 m"], from = 0, to = 3,',
        1,
    )
    with pytest.raises(SceneError, match="curves that roll on each other are closed"):
        planemotion.load_text(text).run()


def test_what_overlaps_at_the_start_is_told() -> None:
    with pytest.raises(SimulationError, match="overlap"):
        planemotion.load_text(cam("t = 1 s", 3, "friction = 0", high=0.24)).run()


@pytest.mark.parametrize("scene", [GEARS, cam("t = 1 s", 3, "friction = 0", high=0.3)])
def test_pairs_of_curves_are_drawn(scene: str) -> None:
    assert planemotion.load_text(scene).draw() is not None
