"""Expressions of the motion may have many waves, narrow peaks, corners and jumps in one step: none is missed.

Each is an expression of one coordinate x; what it does is seen from its closed form, at places that lie close
where it changes.
"""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Callable
from dataclasses import dataclass

import pytest

import planemotion
from tests.scenes import number

WATCHED = """
[events]
up = "{f} > {level}"
[ask]
n = "up.count"
high = {{ max = "{f}" }}
low = {{ min = "{f}" }}
"""

PARTICLE = (
    """
until = "t = 1 s"
plane = "horizontal"
[bodies]
p = {{ mass = "1 kg", at = [0, 0] }}
[start]
p.velocity = ["{speed} m/s", 0]
[forces]
f = {{ force = "p", value = ["{push} N", 0] }}
"""
    + WATCHED
)

ROD = (
    """
until = "t = 1 s"
plane = "horizontal"
[bodies]
p = {{ rod = ["A", "B"], length = "1 m", mass = "3 kg", at = {{ A = [0, 0] }}, angle = "0 rad" }}
[joints]
A = {{ pin = ["p.A", "ground"] }}
[start]
p.omega = "{speed} rad/s"
[forces]
f = {{ couple = "p", value = "{push} N*m" }}
"""
    + WATCHED
)


@dataclass
class Part:
    """A term: as it is written, as a function, and where it changes."""

    text: str
    value: Callable[[float], float]
    places: list[float]


def term(draw: random.Random) -> Part:
    kind = draw.choice(["wave", "bell", "peak", "tent", "step"])
    width, at, size = 10 ** draw.uniform(-6, 0), draw.uniform(-0.1, 1.3), draw.uniform(-2, 2)
    if kind == "wave":
        often, phase = 10 ** draw.uniform(-1, 2.7), draw.uniform(0, 6)
        close = [0.02 * i / often for i in range(-int(20 * often), int(80 * often))]
        return Part(
            f"({size!r})*sin({often!r}*X + {phase!r})", lambda x: size * math.sin(often * x + phase), close
        )
    close = [at + sign * width * 10 ** (0.02 * i) for sign in (-1, 1) for i in range(-200, 100)] + [at]
    off = f"((X - ({at!r}))/{width!r})"
    if kind == "bell":
        return Part(f"({size!r})*exp(-{off}^2)", lambda x: size * math.exp(-(((x - at) / width) ** 2)), close)
    if kind == "peak":
        return Part(f"({size!r})/(1 + {off}^2)", lambda x: size / (1 + ((x - at) / width) ** 2), close)
    if kind == "tent":
        tent = f"({size!r})*max(0, 1 - abs({off}))"
        return Part(
            tent, lambda x: size * max(0, 1 - abs((x - at) / width)), [*close, at - width, at + width]
        )
    beside = [at + sign * width * (1 + little) for sign in (-1, 1) for little in (-1e-9, 1e-9)]
    return Part(f"({size!r})*(abs({off}) < 1)", lambda x: size * (abs((x - at) / width) < 1), close + beside)


def course(places: list[float], speed: float, push: float) -> list[float]:
    """The places that x = speed t + push t^2 / 2 passes in 1 s, one after the other."""
    turn = -speed / push if push < 0 else math.inf
    ends = [0.0] + ([turn] if turn < 1 else []) + [1.0]
    passed: list[float] = []
    for a, b in itertools.pairwise(ends):
        begin, end = (speed * t + push * t * t / 2 for t in (a, b))
        between = sorted({x for x in places if min(begin, end) < x < max(begin, end)})
        passed += [begin, *(between if begin < end else reversed(between)), end]
    return passed


@pytest.mark.parametrize(
    ("scene", "route", "x"),
    [
        (PARTICLE, "uniform", "p.x/(1 m)"),
        (PARTICLE, "rk", "p.x/(1 m)"),
        (PARTICLE, "ida", "p.x/(1 m)"),
        (ROD, "path", "p.angle/(1 rad)"),
        (ROD, "rk", "p.angle/(1 rad)"),
    ],
)
@pytest.mark.parametrize("seed", range(12))
def test_waves_peaks_corners_and_jumps_are_met(scene: str, route: str, x: str, seed: int) -> None:
    draw = random.Random(seed)
    parts = [term(draw) for _ in range(draw.randint(1, 3))]
    speed, push, level = (
        draw.uniform(0.5, 1.2),
        draw.choice([0, draw.uniform(-1.5, 1.5)]),
        draw.uniform(-1.5, 1.5),
    )
    places = [0.0005 * i for i in range(-1000, 4000)] + [place for part in parts for place in part.places]
    values = [sum(part.value(place) for part in parts) for place in course(places, speed, push)]
    f = " + ".join(part.text for part in parts).replace("X", x)
    text = scene.format(speed=speed, push=push, level=level, f=f)
    result = planemotion.load_text(text).run(**{"solve.route": route})
    size = max(abs(value) for value in values)
    assert result.status in ("ok", "undecided")
    for name, expected in (("high", max(values)), ("low", min(values))):
        ask = result.asks[name]
        assert number(ask.value) == pytest.approx(expected, abs=1e-3 * size + 1e-9)
    if result.status == "ok":
        assert result.asks["n"].value == sum(a <= level < b for a, b in itertools.pairwise(values))


@pytest.mark.parametrize("route", ["uniform", "rk", "ida"])
@pytest.mark.parametrize("waves", [3, 4.3, 10, 30.3, 1000.2])
def test_all_waves_of_a_step_are_counted(route: str, waves: float) -> None:
    text = PARTICLE.format(speed=1, push=0, f=f"-cos(2*pi*{waves}*p.x/(1 m))", level=0)
    result = planemotion.load_text(text).run(**{"solve.route": route})
    assert result.status == "ok"
    assert result.asks["n"].value == math.floor(waves + 0.75)
    assert result.asks["high"].value == pytest.approx(1, abs=1e-9)
    assert result.asks["low"].value == pytest.approx(-1, abs=1e-9)


def test_a_dip_that_comes_back_the_way_that_counts_is_met() -> None:
    """Falling through the level does not count, coming back does; both lie between two samples."""
    text = PARTICLE.format(speed=1, push=0, f="(p.x/(1 m) - 0.53)^2", level=1e-6)
    for route in ("uniform", "rk", "ida"):
        result = planemotion.load_text(text).run(**{"solve.route": route})
        assert (result.status, result.asks["n"].value) == ("ok", 1)


def test_waves_that_are_too_many_are_told() -> None:
    text = PARTICLE.format(speed=1, push=0, f="sin(1e7*p.x/(1 m))", level=0)
    result = planemotion.load_text(text).run(**{"solve.route": "uniform", "solve.max_steps": 2000})
    assert result.status == "limit_steps"
    assert result.asks["n"].value is None
