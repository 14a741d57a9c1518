"""Errors that are told cover the true ones: ends of edges, places where motions turn back, beads on curves."""

# ruff: noqa: E501

from __future__ import annotations

import math
import random
from collections.abc import Mapping

import mpmath
import pytest

from planemotion import RunResult, load_text
from tests.scenes import number

ROUNDING = 4.5e-16  # of an answer: what it is printed to, and no error that is told may be less


def ran(scene: str, route: str, accuracy: float = 1e-10) -> RunResult:
    """The result, which must stand."""
    result = load_text(f'{scene}\n[solve]\nroute = "{route}"\naccuracy = {accuracy}\n').run()
    assert result.status == "ok"
    return result


def beyond(result: RunResult, truth: Mapping[str, mpmath.mpf]) -> float:
    """The greatest true error over the one that is told."""
    worst = 0.0
    for ask, value in truth.items():
        off = abs(float(number(result[ask]) - value))
        told = number(result.asks[ask].error)
        worst = max(worst, off / max(told, ROUNDING * abs(float(value))))
    return worst


def corner(draw: random.Random) -> tuple[str, dict[str, mpmath.mpf]]:
    """Down a ramp and on along a floor, which takes the speed across it; the ramp may be far longer than the way."""
    slope, way, on = draw.uniform(0.05, 1.2), 10 ** draw.uniform(-1, 0.7), 10 ** draw.uniform(-1, 0.7)
    length = way * 10 ** draw.uniform(0.01, 2)
    with mpmath.workdps(30):
        g = mpmath.mpf(9.81)
        speed = mpmath.sqrt(2 * g * mpmath.sin(slope) * way)
        struck = speed / (g * mpmath.sin(slope))
        slower = speed * mpmath.cos(slope)
        truth = {"v": slower, "th": struck, "t": struck + on / slower}
    scene = f"""
until = "b.x > {on!r} * (1 m)"
ground.lines.ramp = {{ from = ["-{length!r} * (1 m) * cos({slope!r})", "{length!r} * (1 m) * sin({slope!r})"], to = [0, 0] }}
ground.lines.floor = {{ from = [0, 0], to = ["{2 * on!r} m", 0] }}
bodies.b = {{ mass = "1 kg", at = ["-{way!r} * (1 m) * cos({slope!r})", "{way!r} * (1 m) * sin({slope!r})"] }}
contacts.a = {{ touch = ["b", "ground.ramp"] }}
contacts.c = {{ touch = ["b", "ground.floor"] }}
events.h = "c strikes"
ask = {{ t = "t", v = "b.speed", th = {{ of = "t", at = "h" }} }}
"""
    return scene, truth


def table(draw: random.Random) -> tuple[str, dict[str, mpmath.mpf]]:
    """Over the end of a table that rubs, and down."""
    way, friction, height = 10 ** draw.uniform(-1, 0.7), draw.uniform(0, 0.5), 10 ** draw.uniform(-1, 1)
    speed = math.sqrt(2 * friction * 9.81 * way) * draw.uniform(1.001, 2) + 10 ** draw.uniform(-3, 0)
    with mpmath.workdps(30):
        g = mpmath.mpf(9.81)
        left = mpmath.sqrt(mpmath.mpf(speed) ** 2 - 2 * friction * g * way)
        off, falls = 2 * way / (speed + left), mpmath.sqrt(2 * height / g)
        truth = {"x": left * falls, "t": off + falls, "to": off, "vx": left}
    scene = f"""
until = "b.y < -({height!r} m)"
ground.lines.tab = {{ from = ["-{2 * way!r} m", 0], to = [0, 0] }}
bodies.b = {{ mass = "1 kg", at = ["-{way!r} m", 0] }}
contacts.c = {{ touch = ["b", "ground.tab"], friction = {friction!r} }}
start.b.velocity = ["{speed!r} m/s", 0]
events.off = "c opens"
ask = {{ x = "b.x", t = "t", vx = "b.velocity.x", to = {{ of = "t", at = "off" }} }}
"""
    return scene, truth


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
@pytest.mark.parametrize("seed", range(4))
def test_an_edge_is_left_where_it_ends(route: str, seed: int) -> None:
    draw = random.Random(seed)
    for kind in (corner, table):
        scene, truth = kind(draw)
        assert beyond(ran(scene, route), truth) <= 1


def test_what_goes_over_an_end_does_not_come_to_it_again() -> None:
    """Where it is off, its way is as near to the table as can be: that is no decision."""
    draw = random.Random(5)
    for _ in range(60):
        assert number(ran(table(draw)[0], "auto").margin) > 1e6


def test_a_curve_is_left_where_it_ends() -> None:
    """From the middle of an arc's quarter over its end, which is level."""
    draw = random.Random(1)
    for _ in range(6):
        radius, turned = 10 ** draw.uniform(-1, 1), draw.uniform(0.2, 1.4)
        scene = f"""
until = "c opens"
ground.curves.bowl = {{ x = "{radius!r} * (1 m) * sin(s)", y = "-{radius!r} * (1 m) * cos(s)", from = -1.5, to = 0 }}
bodies.b = {{ mass = "1 kg", at = ["-{radius!r} * (1 m) * sin({turned!r})", "-{radius!r} * (1 m) * cos({turned!r})"] }}
contacts.c = {{ touch = ["b", "ground.bowl"] }}
ask = {{ v = "b.speed", x = "b.x" }}
"""
        result = ran(scene, "auto")
        assert abs(number(result["x"])) <= 1e-14 * radius
        with mpmath.workdps(30):
            speed = 2 * mpmath.sin(mpmath.mpf(turned) / 2) * mpmath.sqrt(9.81 * mpmath.mpf(radius))
        assert beyond(result, {"v": speed}) <= 1


def test_where_a_pendulum_turns_back_next_to_its_top() -> None:
    """The nearer to the top, the less its energy tells of the place."""
    draw = random.Random(3)
    for _ in range(12):
        length, short = 10 ** draw.uniform(-1, 0.7), 10 ** draw.uniform(-9, -0.5)
        with mpmath.workdps(30):
            omega = float(mpmath.sqrt(6 * mpmath.mpf(9.81) / length) * (1 - short))
            part = omega / mpmath.sqrt(6 * mpmath.mpf(9.81) / length)
            turned = 2 * mpmath.asin(part)
        result = ran(
            f"""
until = "back"
bodies.r = {{ rod = ["A", "B"], length = "{length!r} m", mass = "1 kg", at = {{ A = [0, 0] }}, angle = "-90 deg" }}
joints.A = {{ pin = ["r.A", "ground"] }}
start.r.omega = "{omega!r} rad/s"
events.back = "r.turned < 0"
ask.hi = {{ max = "r.turned" }}
""",
            "auto",
        )
        assert beyond(result, {"hi": turned}) <= 1
        # and it is no more than what the energy is known to, over the moment there
        assert number(result.asks["hi"].error) <= 1e-13 / math.sqrt(short)


def test_a_bead_on_a_parabola_keeps_its_energy() -> None:
    """On a curve far larger than the way, to the last digits of the curve."""
    draw = random.Random(4)
    for _ in range(12):
        focus, n = 10 ** draw.uniform(-1.3, 0.7), draw.randint(1, 8)
        x = focus * 10 ** draw.uniform(-2, 0.8)
        with mpmath.workdps(30):
            speed = x * mpmath.sqrt(mpmath.mpf(9.81) / (2 * mpmath.mpf(focus)))
        result = ran(
            f"""
until = "low {n}"
ground.curves.c = {{ parabola = "{focus!r} m", from = "-{7 * focus!r} m", to = "{7 * focus!r} m" }}
bodies.b = {{ mass = "1 kg", at = ["{x!r} m", "({x!r} m)^2 / (4 * ({focus!r} m))"] }}
joints.j = {{ slot = ["b", "ground.c"] }}
events.low = "b.x = 0"
ask.v = "b.speed"
""",
            "auto",
        )
        assert beyond(result, {"v": speed}) <= 1
        of_energy = abs(float(number(result["v"]) / speed - 1)) * float(speed) ** 2
        assert of_energy <= n * 5e-13 * (focus + float(speed) ** 2)
