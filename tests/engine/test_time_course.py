"""What forces and drives do in time is not stepped over: pulses, steps and waves, beside their integrals."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests.scenes import number

ROUTES = ("rk", "ida")

PUSHED = """
until = "t = {T} s"
plane = "horizontal"
[bodies]
k = {{ mass = "1 kg", at = [0, 0] }}
[forces]
f = {{ force = "k", value = ["{f}", 0] }}
[ask]
v = "k.velocity.x"
"""

ROCKING = """
until = "t = 25 s"
[bodies]
base = {{ plate = ["4 m", "0.1 m"], mass = "10 kg", at = [0, "0.05 m"], \
driven = {{ velocity = ["{rate}", 0] }}, lines = {{ top = {{ through = [0, "0.05 m"] }} }} }}
block = {{ plate = ["0.1 m", "0.4 m"], corners = ["a", "b", "c", "d"], mass = "1 kg", at = [0, "0.3 m"] }}
[contacts]
c = {{ touch = ["block.corners", "base.top"], friction = 0.6, restitution = 0.1 }}
[ask]
angle = "block.angle"
x = "base.x"
"""


def speed(f: str, time: float, route: str) -> float:
    """What a force of time makes of 1 kg at rest."""
    result = planemotion.load_text(PUSHED.format(T=time, f=f)).run(**{"solve.route": route})
    assert result.status == "ok"
    return number(result.asks["v"].value)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    ("force", "time", "expected"),
    [
        ("(2 N)*(t > (3 s))*(t < (3.1 s))", 10, 0.2),
        ("(2 N)*(t > (0.3 s))*(t < (0.31 s))", 1, 0.02),
        ("(2 N)*(t >= (0 s))*(t < (1 us))", 1, 2e-6),
        ("(100 N)*exp(-((t - (50 s))/(10 ms))^2)", 100, math.sqrt(math.pi)),
        ("(1 N)*floor(t/(1 s))/100", 100, 49.5),
        ("min(5 N, (1 N)*(t/(1 s))^3)", 10, 50 - 0.75 * 5 ** (4 / 3)),
    ],
)
def test_pulses_and_steps_are_met(route: str, force: str, time: float, expected: float) -> None:
    assert speed(force, time, route) == pytest.approx(expected, rel=1e-8)


def pulse(draw: random.Random, time: float) -> tuple[str, float]:
    """A random pulse or wave in a run of that length, and its integral."""
    width, at, size = time * 10 ** draw.uniform(-6, 0), draw.uniform(0, time), draw.uniform(-3, 3)
    kind = draw.choice(["step", "bell", "peak", "tent", "wave"])
    off = f"(t - ({at!r} s))/({width!r} s)"
    if kind == "step":
        return f"({size!r} N)*(abs({off}) < 1)", size * (min(time, at + width) - max(0, at - width))
    if kind == "bell":
        both = math.erf((time - at) / width) + math.erf(at / width)
        return f"({size!r} N)*exp(-({off})^2)", size * width * math.sqrt(math.pi) / 2 * both
    if kind == "peak":
        both = math.atan((time - at) / width) + math.atan(at / width)
        return f"({size!r} N)/(1 + ({off})^2)", size * width * both
    if kind == "tent":
        half = [min(1, (time - at) / width), min(1, at / width)]
        return f"({size!r} N)*max(0, 1 - abs({off}))", size * width * sum(x - x * x / 2 for x in half)
    omega = 2 * math.pi * 10 ** draw.uniform(-1, 2) / time
    return f"({size!r} N)*sin(({omega!r} rad/s)*t)", size * (1 - math.cos(omega * time)) / omega


@pytest.mark.parametrize("case", range(40))
def test_random_pulses_on_waves_are_met(case: int) -> None:
    draw = random.Random(case)
    time = 10 ** draw.uniform(-1, 3)
    parts = [pulse(draw, time) for _ in range(draw.randint(1, 3))]
    found = speed(" + ".join(text for text, _ in parts), time, "rk")
    assert found == pytest.approx(sum(whole for _, whole in parts), rel=1e-8, abs=1e-9 * time)


@pytest.mark.parametrize("route", ROUTES)
def test_a_base_that_moves_for_its_first_half_wave_tips_a_block(route: str) -> None:
    """Half a wave of 0.16 s in 25 s; the block's way out is that of the run that ends with it."""
    rate = "(0.5 m/s)*sin((20 rad/s)*t)*(t < (pi/10)*(1 s))"
    result = planemotion.load_text(ROCKING.format(rate=rate)).run(**{"solve.route": route})
    assert result.status == "ok"
    assert result.asks["x"].value == pytest.approx(0, abs=1e-9)
    assert abs(number(result.asks["angle"].value)) == pytest.approx(math.pi / 2, rel=1e-9)


def test_a_switch_ends_a_phase() -> None:
    result = planemotion.load_text(PUSHED.format(T=10, f="(2 N)*(t > (3 s))")).run()
    assert result.counts["phases"] == 2
