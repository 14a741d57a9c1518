"""Ends of open curves that touch edges and other curves, whichever is written first."""

# ruff: noqa: E501

from __future__ import annotations

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests import STUDIES
from tests.mechanics.curve_throws import Body, thrown
from tests.scenes import ROUTES, G, answers, close

ORDERS = (False, True)


def swapped(scene: str, swap: bool) -> str:
    """The scene with the two partners of `touch` the other way round."""
    if not swap:
        return scene
    before, rest = scene.split("touch = [", 1)
    pair, after = rest.split("]", 1)
    first, second = pair.split(", ")
    return f"{before}touch = [{second}, {first}]{after}"


# ---- blades that fly, and strike a hill or a bowl ----


def blade(half: float, bend: float, below: float, inertia: float) -> Body:
    """y = bend x^2 - below, free below."""
    return Body(lambda u: np.array([u, bend * u * u - below]), (-half, half), inertia, False)


@pytest.mark.parametrize("swap", ORDERS)
@pytest.mark.parametrize("seed", range(10))
def test_thrown_blades_strike_with_their_ends_too(seed: int, swap: bool) -> None:
    rng = np.random.default_rng(100 + seed)
    dome, rough = seed % 2 == 0, seed % 4 >= 2
    bend, inertia = float(rng.uniform(0.3, 0.6)), round(rng.uniform(0.03, 0.08), 4)
    body = blade(0.4, bend, 0.05, inertia)
    curve = f'{{ x = "(1 m)*s", y = "({bend!r} m)*s^2 - (0.05 m)", from = -0.4, to = 0.4, side = "right" }}'
    scene, where, blows = thrown(rng, body, f"curves.edge = {curve}", "p.edge", dome, rough, 1.0)
    got = answers(swapped(scene, swap))
    assert got["n"] == blows >= 1
    assert [got["x"], got["y"], got["angle"]] == pytest.approx(where.tolist(), abs=1e-8)
    assert got["least"] > -1e-9


# ---- a chair that rocks over the ends of its runners ----


def rocked(radius: float, low: float, half: float, inertia: float, spin: float, end: float) -> np.ndarray:
    """Angle and rate of a chair of 1 kg, whose mass centre is `low` below the centre of its runner: it rolls on the level, and
    beyond the angle `half` turns about the end of the runner."""

    def rolls(_: float, y: np.ndarray) -> list[float]:
        a, w = y
        m = inertia + radius**2 + low**2 - 2 * radius * low * math.cos(a)
        return [w, -(radius * w * w + G) * low * math.sin(a) / m]

    def tips(_: float, y: np.ndarray) -> list[float]:
        a, w = y
        side, up = math.copysign(radius * math.sin(half), a), radius * math.cos(half) - low
        m = inertia + radius**2 + low**2 - 2 * radius * low * math.cos(half)
        return [w, -G * (side * math.cos(a) - up * math.sin(a)) / m]

    def corner(_: float, y: np.ndarray) -> float:
        return half - abs(y[0])

    corner.terminal = True  # type: ignore[attr-defined]
    t, state, on = 0.0, np.array([0, spin]), rolls
    while t < end:
        corner.direction = -1 if on is rolls else 1  # type: ignore[attr-defined]
        found = solve_ivp(on, (t, end), state, method="DOP853", rtol=1e-13, atol=1e-14, events=corner)
        t, state = found.t[-1], found.y[:, -1]
        on = tips if on is rolls else rolls
    return np.asarray(state)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("floor", ['{ from = ["-5 m", 0], to = ["5 m", 0] }', '{ through = ["40 m", 0] }'])
@pytest.mark.parametrize("seed", [0, 2])
def test_a_chair_rocks_over_the_ends_of_its_runners(seed: int, floor: str, route: str) -> None:
    rng = np.random.default_rng(seed)
    radius, low, half = rng.uniform(0.8, 1.2), rng.uniform(0.3, 0.5), rng.uniform(0.3, 0.5)
    inertia, end = rng.uniform(0.1, 0.3), 2.0
    m = inertia + (radius - low) ** 2
    # as high as half way from where the runner ends to where it would tip over
    most = (half + math.atan2(radius * math.sin(half), radius * math.cos(half) - low)) / 2
    high = radius * math.sin(half) * math.sin(most) + (radius * math.cos(half) - low) * math.cos(most)
    spin = math.sqrt(2 * G * (high - (radius - low)) / m)
    scene = f"""
    until = "t = {end} s"
    ground.lines.floor = {floor}
    [bodies.chair]
    mass = "1 kg"
    inertia = "{inertia!r} kg*m^2"
    at = [0, "{radius - low!r} m"]
    curves.runner = {{ arc = "{radius!r} m", from = {-math.pi / 2 - half!r}, to = {-math.pi / 2 + half!r}, at = [0, "{low!r} m"], side = "right" }}
    [contacts]
    c = {{ touch = ["chair.runner", "ground.floor"], friction = "rough" }}
    [start]
    chair.omega = "{spin!r} rad/s"
    chair.velocity.x = "{-spin * (radius - low)!r} m/s"
    [ask]
    angle = {{ of = "chair.angle", unit = "rad" }}
    rate = {{ of = "chair.omega", unit = "rad/s" }}
    most = {{ max = "chair.angle", unit = "rad" }}
    up = {{ min = "c.force.y on chair" }}
    down = {{ max = "c.force.y on ground" }}
    normal = {{ min = "c.normal" }}
    """
    got = answers(swapped(scene, seed == 0), route)
    angle, rate = rocked(radius, low, half, inertia, spin, end)
    near = 10 * close(route)
    assert got["angle"] == pytest.approx(angle, abs=near)
    assert got["rate"] == pytest.approx(rate, abs=5 * near)
    assert got["most"] == pytest.approx(most, abs=near)
    assert got["up"] == pytest.approx(-got["down"], abs=1e-9)
    assert got["up"] > 0
    assert got["normal"] > 0


@pytest.mark.parametrize("swap", ORDERS)
@pytest.mark.parametrize("last", [60, 95, 170])
def test_an_end_high_above_a_crate_is_not_in_it(last: int, swap: bool) -> None:
    """A crate slides in a loop as it does in its lower part alone, though the loop ends above it."""

    def slides(to: int, swap: bool = False) -> Any:
        scene = f"""
        until = "t = 1 s"
        ground.curves.loop = {{ arc = "2 m", from = "-100 deg", to = "{to} deg", at = [0, "2 m"] }}
        bodies.p = {{ plate = ["0.6 m", "0.2 m"], mass = "1 kg", at = [0, "0.3 m"] }}
        contacts.c = {{ touch = ["p.bottom", "ground.loop"], friction = 0.2, restitution = 0.2 }}
        start.p.velocity.x = "1 m/s"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.angle = {{ of = "p.angle", unit = "rad" }}
        """
        return answers(swapped(scene, swap))

    assert slides(last, swap) == pytest.approx(slides(0), abs=1e-9)


@pytest.mark.parametrize("swap", ORDERS)
def test_a_runner_without_a_bend_lands_flat(swap: bool) -> None:
    scene = """
    until = "t = 1 s"
    ground.lines.floor = { from = ["-5 m", 0], to = ["5 m", 0] }
    bodies.p = { mass = "1 kg", inertia = "0.1 kg*m^2", at = [0, "1 m"], curves.runner = { x = "s", y = "0*s", from = "-0.3 m", to = "0.3 m", side = "right" } }
    contacts.c = { touch = ["p.runner", "ground.floor"] }
    events.hit = "c strikes"
    ask.t = { of = "t", at = "hit", unit = "s" }
    ask.y = { of = "p.y", unit = "m" }
    """
    got = answers(swapped(scene, swap))
    assert got["t"] == pytest.approx(math.sqrt(2 / G), rel=1e-9)
    assert got["y"] == pytest.approx(0, abs=1e-9)


# ---- whichever is first ----

LOOSE = """
until = "t = 0.8 s"
parameters.g = "0 m/s^2"
[bodies.p]
mass = "1 kg"
inertia = "0.05 kg*m^2"
at = ["-0.5 m", "{y} m"]
angle = "{a} rad"
curves.tooth = {{ x = "(1 m)*s", y = "(-0.6 m)*s^2", from = -0.3, to = 0.3 }}
[bodies.q]
mass = "2 kg"
inertia = "0.1 kg*m^2"
at = ["0.5 m", 0]
angle = "{b} rad"
curves.tooth = {{ x = "(1 m)*s", y = "(-0.5 m)*s^2", from = -0.35, to = 0.25 }}
[contacts]
c = {{ touch = ["p.tooth", "q.tooth"], restitution = {e}, friction = 0.3 }}
[start]
p.velocity = ["2 m/s", 0]
p.omega = "{w} rad/s"
q.omega = "{v} rad/s"
[events]
hit = "c strikes"
[ask]
n = "hit.count"
px = {{ of = "p.velocity.x", unit = "m/s" }}
py = {{ of = "p.velocity.y", unit = "m/s" }}
pw = {{ of = "p.omega", unit = "rad/s" }}
qx = {{ of = "q.velocity.x", unit = "m/s" }}
qy = {{ of = "q.velocity.y", unit = "m/s" }}
qw = {{ of = "q.omega", unit = "rad/s" }}
jx = {{ of = "c.impulse.x on p", at = "hit", unit = "N*s" }}
jy = {{ of = "c.impulse.y on p", at = "hit", unit = "N*s" }}
"""


@pytest.mark.parametrize("seed", range(12))
def test_teeth_that_fly_into_each_other_do_so_in_either_order(seed: int) -> None:
    """Their tips strike, and what p gets it gets from q."""
    rng = np.random.default_rng(seed)
    while True:
        y, w, v = rng.uniform(-0.25, 0.25), *rng.uniform(-2, 2, 2)
        a, b = -math.pi / 2 + rng.uniform(-0.5, 0.5), math.pi / 2 + rng.uniform(-0.5, 0.5)
        e = float(rng.choice([0, 0.5]))
        scene = LOOSE.format(y=y, w=w, v=v, a=a, b=b, e=e)
        one = answers(scene)
        if one["n"]:
            break
    other = answers(swapped(scene, True))
    assert other == pytest.approx(one, abs=1e-8)
    if one["n"] == 1 and e:
        assert one["jx"] == pytest.approx(one["px"] - 2, abs=1e-8)
        assert one["jy"] == pytest.approx(one["py"], abs=1e-8)


def ratio_at_tip(pinion: float) -> float:
    """By how much the pinion of studies/involute_teeth.toml is faster, at its angle, as the tip 0.7 of it slides on the wheel."""

    def wheel(angle: float) -> float:
        """The angle of the wheel: the direction of the tip from its axle less that on the involute at this distance."""
        tip = 0.03 * (1 + 0.7j) * mpmath.exp(1j * (angle - 0.7)) - 0.1
        unwound = mpmath.sqrt((abs(tip) / 0.06) ** 2 - 1)
        return mpmath.arg(-tip) + unwound - mpmath.atan(unwound)  # type: ignore[no-any-return]

    return float(-1 / mpmath.diff(wheel, pinion))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("swap", ORDERS)
def test_the_tip_of_a_tooth_slides_on_along_the_other(swap: bool, route: str) -> None:
    """The pinion drives on past the end of its flank, which is at 0.7: there is no blow, and the ratio grows."""
    text = (STUDIES / "involute_teeth.toml").read_text(encoding="utf-8").split("[sweep]")[0]
    text = text.replace('"t = 20 ms", "parted"', '"t = 16.2 ms"').replace("from = -1.3", "from = -0.7", 1)
    text += 'angle = { of = "flanks.pinion.angle", unit = "rad" }\ngap = { min = "teeth.gap", unit = "m" }\n'
    got = answers(swapped(text, swap), route)
    assert got["ratio"] == pytest.approx(ratio_at_tip(got["angle"]), rel=10 * close(route))
    assert got["ratio"] > 2.1
    assert got["gap"] > -1e-9
    assert got["push"] > 1
