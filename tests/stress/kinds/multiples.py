"""Kinds of events `X every STEP`, beside another event: times, places, an oscillator."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from functools import partial
from itertools import pairwise

from tests.stress.kinds.drawn import Drawn

OTHERS = (
    "b.x > {a} m",
    "b.x every {a} m",
    "t = {a} s",
    "t every {a} s",
    "b.y every {a} m",
    "b.velocity.y < 0",
    "b.y = -0.01 m",
)


def swing(size: float, rate: float, phase: float, t: float) -> float:
    return size * math.cos(rate * t + phase)


def flying(y: float, v: float, g: float, t: float) -> float:
    return y + v * t - g * t * t / 2


def passages(p: Callable[[float], float], ends: list[float]) -> list[float]:
    """Where p, which only rises or falls from one of the ends to the next, reaches integers."""
    found = []
    for a, b in pairwise(ends):
        way = 1 if p(b) > p(a) else -1
        m = way * (math.floor(way * p(a) + 1e-9) + 1)
        while way * m <= way * p(b):
            low, high = a, b
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if way * p(middle) >= way * m else (middle, high)
            found.append(high)
            m += way
    return found


def oscillator(end: float, x: float, v: float, stiffness: float, step: float, other: str) -> str:
    return f"""
until = "t = {end!r} s"
plane = "horizontal"
bodies.b = {{ mass = "1 kg", at = ["{x!r} m", 0] }}
start.b.velocity = ["{v!r} m/s", 0]
forces.s = {{ force = "b", value = ["-({stiffness!r} N/m) * b.x", 0] }}
events.e = "b.x every {step!r} m"
{f'events.f = "{other}"' if other else ""}
"""


ASKS = 'ask.n = "e.count"\nask.times = { of = "t", at = "each e" }\n'


def beside_others(draw: random.Random) -> Drawn:
    end = math.exp(draw.uniform(-2, 2))
    step, beside = end * math.exp(draw.uniform(-5, -0.7)), end * math.exp(draw.uniform(-3, -0.2))
    what, unit = draw.choice([("t", "s"), ("b.x", "m")])
    times = [k * step for k in range(1, math.floor(end / step) + 1)]
    text = f"""
until = "t = {end!r} s"
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
start.b.velocity = ["1 m/s", "{4.2 * end!r} m/s"]
events.e = "{what} every {step!r} {unit}"
events.f = "{draw.choice(OTHERS).format(a=repr(beside))}"
"""
    return Drawn(text + ASKS, {"n": len(times), "times": times})


def of_an_oscillator(draw: random.Random) -> Drawn:
    stiffness, size, phase = draw.uniform(5, 50), draw.uniform(0.2, 1), draw.uniform(0, 6)
    rate, step = math.sqrt(stiffness), size * math.exp(draw.uniform(-4, 0.2))
    x, v = size * math.cos(phase), -size * rate * math.sin(phase)
    end = draw.uniform(0.5, 4) * 2 * math.pi / rate
    turns = [(k * math.pi - phase) / rate for k in range(-3, 20)]
    other = draw.choice(["", "b.x > 0.1 m", "b.velocity.x < 0", "t every 0.071 s"])
    ends = [0, *(t for t in turns if 0 < t < end), end]
    times = passages(partial(swing, size / step, rate, phase), ends)
    text = oscillator(end, x, v, stiffness, step, other)
    return Drawn(text + ASKS, {"n": len(times), "times": times}, {"times": end})
