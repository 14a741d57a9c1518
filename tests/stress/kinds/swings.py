"""Kinds of oscillators: with a damper, with a force of the time, with dry friction."""

from __future__ import annotations

import math
import random

from tests.scenes import G
from tests.stress.kinds.drawn import Drawn


def damped(draw: random.Random) -> Drawn:
    """Let go at a distance; from almost no damping to far beyond the aperiodic limit."""
    k, m, a, ratio = (
        10 ** draw.uniform(0, 4),
        10 ** draw.uniform(-1, 1),
        10 ** draw.uniform(-2, 1),
        10 ** draw.uniform(-3, 1),
    )
    w = math.sqrt(k / m)
    if 0.97 < ratio < 1.03:
        ratio = 0.5
    long = 20 if a > 0.9 else 1  # it must not come to the other end of the spring
    c, end = 2 * ratio * m * w, draw.uniform(0.2, 6) * 2 * math.pi / w
    if ratio < 1:
        d, rate = ratio * w, w * math.sqrt(1 - ratio**2)
        fade = a * math.exp(-d * end)
        x = fade * (math.cos(rate * end) + d / rate * math.sin(rate * end))
        v = -fade * w**2 / rate * math.sin(rate * end)
        turns = math.floor(rate * end / math.pi)
        quarter = math.atan2(rate, -d)  # where it first comes through the middle
        passed = math.floor((rate * end - quarter) / math.pi) + 1 if rate * end > quarter else 0
        part = [(rate * end / math.pi) % 1, ((rate * end - quarter) / math.pi) % 1]
        least = -a * math.exp(-d * math.pi / rate) if turns else x
    else:
        fast = w * (ratio + math.sqrt(ratio**2 - 1))
        slow = w**2 / fast
        x = a * (fast * math.exp(-slow * end) - slow * math.exp(-fast * end)) / (fast - slow)
        v = a * slow * fast * (math.exp(-fast * end) - math.exp(-slow * end)) / (fast - slow)
        passed, part, least = 0, [0.5], x
    text = f"""
until = "t = {end!r} s"
plane = "horizontal"
ground.points.O = [0, 0]
bodies.b = {{ mass = "{m!r} kg", at = ["{long + a!r} m", 0] }}
forces.s = {{ spring = ["b", "ground.O"], stiffness = "{k!r} N/m", free_length = "{long} m" }}
forces.d = {{ damper = ["b", "ground.O"], rate = "{c!r} N*s/m" }}
events.middle = "b.x = {long} m"
[ask]
x = "b.x - ({long} m)"
v = "b.velocity.x"
least = {{ min = "b.x - ({long} m)" }}
n = "middle.count"
"""
    size = long + a
    edge = min(min(one, 1 - one) for one in part) < 1e-6 or (ratio < 1 and math.exp(-d * end) < 1e-6)
    return Drawn(
        text, {"x": x, "v": v, "least": least, "n": passed}, {"x": size, "v": size * w, "least": size}, edge
    )


def driven(draw: random.Random) -> Drawn:
    """From rest, by a cosine of the time: near its own frequency or far from it."""
    m, w = 10 ** draw.uniform(-1, 1), 10 ** draw.uniform(0, 1.5)
    rate, f = w * 10 ** draw.uniform(-1, 1), 10 ** draw.uniform(-1, 1)
    if abs(rate / w - 1) < 1e-3:
        rate = 2 * w
    end = draw.uniform(0.5, 8) * 2 * math.pi / w
    part = f / (w**2 - rate**2)
    x = part * -2 * math.sin((rate + w) * end / 2) * math.sin((rate - w) * end / 2)
    v = part * (w * math.sin(w * end) - rate * math.sin(rate * end))
    text = f"""
until = "t = {end!r} s"
plane = "horizontal"
bodies.b = {{ mass = "{m!r} kg", at = [0, 0] }}
forces.s = {{ force = "b", value = ["-({m * w**2!r} N/m)*b.x", 0] }}
forces.f = {{ force = "b", value = ["({m * f!r} N)*cos({rate!r}*t/(1 s))", 0] }}
[ask]
x = "b.x"
v = "b.velocity.x"
"""
    size = f / w * min(end, 1 / abs(w - rate)) * (1 + (w + rate) * end)
    return Drawn(text, {"x": x, "v": v}, {"x": size, "v": size * max(w, rate)})


def dry(draw: random.Random) -> Drawn:
    """On a floor: each half swing loses 2 d, d = mu m g / k, and it stays where the spring is too weak."""
    mu, m, half = draw.uniform(0.05, 1), 10 ** draw.uniform(-1, 1), draw.uniform(0.1, 6)
    k = 10 ** draw.uniform(1, 4)
    d, w = mu * m * G / k, math.sqrt(k / m)
    a = (2 * half + draw.uniform(0.05, 0.95)) * d
    places, way = [a], 1.0
    while abs(places[-1]) > d:
        places.append(way * 2 * d - places[-1])
        way = -way
    n, t = len(places) - 1, math.pi / w
    end = draw.uniform(0.3, n + 1.5) * t
    i = min(int(end / t), n)
    if i == n:
        x = places[n]
        v = 0.0
    else:
        middle, late = (d if i % 2 == 0 else -d), w * (end - i * t)
        x, v = middle + (places[i] - middle) * math.cos(late), -w * (places[i] - middle) * math.sin(late)
    text = f"""
until = "t = {end!r} s"
ground.lines.floor = {{ through = [0, 0] }}
bodies.b = {{ mass = "{m!r} kg", at = ["{a!r} m", 0] }}
forces.s = {{ force = "b", value = ["-({k!r} N/m)*b.x", 0] }}
contacts.floor = {{ touch = ["b", "ground.floor"], friction = {mu!r} }}
events.right = "b.velocity.x > 0"
[ask]
x = "b.x"
v = "b.velocity.x"
right = "right.count"
"""
    swings = min(i + 1, n)
    truth = {"x": x, "v": v, "right": swings // 2}
    edge = any(abs(abs(place) / d - 1) < 1e-9 for place in places) or abs(end / t - round(end / t)) < 1e-9
    return Drawn(text, truth, {"x": a * (n + 1), "v": a * w * (n + 1)}, edge)
