"""Kinds of flights: bounces to the last and to a time, throws against drag, tops beside a level."""

from __future__ import annotations

import math
import random

from tests.scenes import G
from tests.stress.kinds.drawn import Drawn, Value

DRAGS = (
    "-c*abs(b.velocity.y)*b.velocity.y",
    "-c*sign(b.velocity.y)*b.velocity.y^2",
    "c*(max(0 m/s, -b.velocity.y)^2 - max(0 m/s, b.velocity.y)^2)",
    "-c*b.velocity.y*max(b.velocity.y, -b.velocity.y)",
)
THROWN = """
until = "back"
parameters.c = "{c!r} kg/m"
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
forces.d = {{ force = "b", value = [0, "{law}"] }}
start.b.velocity = [0, "{speed!r} m/s"]
events.back = "b.moved.y < 0"
"""
CLOSE = 1e-12  # of a height: doubles of scene and truth do not tell levels so close to each other
BOUNCING = """
until = "{until}"
ground.lines.floor = {{ through = [0, 0] }}
bodies.b = {{ mass = "1 kg", at = [0, "{h!r} m"] }}
start.b.velocity = ["{aside!r} m/s", 0]
contacts.floor = {{ touch = ["b", "ground.floor"], restitution = {e!r} }}
"""


def series(h: float, e: float, aside: float, end: float | None) -> tuple[dict[str, float], float]:
    """Integrals of a ball that is let go at h, to its rest or a later time, and when it rests.

    Flight k begins at v e^k and takes 2 v e^k / g.
    """
    v = math.sqrt(2 * G * h)
    rest = v / G * (1 + e) / (1 - e)
    t = rest if end is None else end
    q = e**3 / (1 - e**3)
    below = v**3 / G**2 * (1 / 3 + 2 / 3 * q)
    rises = v / G * e / (1 - e)
    return {
        "way": h * (1 + 2 * e**2 / (1 - e**2)),
        "below": below,
        "aside": 0.5 * aside * t**2,
        "squares": v**3 / G * (1 / 3 + 2 / 3 * q),
        "pressed": G * (t - rest),
        "mean": below / t,
        "up": v**3 / G**2 / 3 * q / rises,
    }, rest


SERIES = """[ask]
way = { integral = "abs(b.velocity.y)" }
below = { integral = "b.y" }
aside = { integral = "b.x" }
squares = { integral = "b.velocity.y^2" }
pressed = { integral = "floor.normal" }
mean = { mean = "b.y" }
up = { mean = "b.y", during = "b.velocity.y > 0" }
"""


def bounces_for_ever(draw: random.Random) -> Drawn:
    h, e = 10 ** draw.uniform(-2, 2), draw.uniform(0.03, draw.choice([0.2, 0.95]))
    aside = draw.uniform(-3, 3) * draw.randrange(2)
    _, rest = series(h, e, aside, None)
    end = None if aside == 0 else rest * draw.uniform(1.001, 1.5)
    text = BOUNCING.format(until="b rests" if end is None else f"t = {end!r} s", h=h, e=e, aside=aside)
    sizes = {"aside": (abs(aside) + 1) * rest**2, "pressed": G * rest}
    return Drawn(text + SERIES, series(h, e, aside, end)[0], sizes)


def bounces_for_a_while(draw: random.Random) -> Drawn:
    """To a time within flight n; a level that lies below the top of flight k by a part of it."""
    h, e, n = 10 ** draw.uniform(-2, 2), draw.uniform(0.3, 1), draw.randint(1, 12)
    v = math.sqrt(2 * G * h)
    speeds = [v * e**k for k in range(n + 1)]  # with which flight k begins; flight 0 begins at its top
    begins = [0.0]
    for k in range(n):
        begins.append(begins[-1] + (v / G if k == 0 else 2 * speeds[k] / G))
    late = draw.uniform(0.02, 0.98) * 2 * speeds[n] / G
    k = draw.randint(1, n)
    below = 10 ** draw.uniform(-8, -0.05)
    level = h * e ** (2 * k) * (1 - below)
    passed = [2 for j in range(1, n) if h * e ** (2 * j) > level]
    if h * e ** (2 * n) > level:
        dip = math.sqrt(speeds[n] ** 2 - 2 * G * level)
        passed.append(sum(late > (speeds[n] + sign * dip) / G for sign in (-1, 1)))
    end = begins[n] + late
    text = (
        BOUNCING.format(until=f"t = {end!r} s", h=h, e=e, aside=0.0)
        + f"""
events.level = "b.y = {level!r} m"
events.blow = "floor strikes"
[ask]
y = "b.y"
v = "b.velocity.y"
levels = "level.count"
blows = "blow.count"
times = {{ of = "t", at = "each blow" }}
"""
    )
    truth: dict[str, Value] = {
        "y": speeds[n] * late - 0.5 * G * late**2,
        "v": speeds[n] - G * late,
        "levels": 1 + sum(passed),
        "blows": n,
        "times": begins[1:],
    }
    edge = min(below * h * e ** (2 * k), level) < CLOSE * h
    return Drawn(text, truth, {"y": h * 5 * (n + 1), "v": v * 5 * (n + 1)}, edge)


def thrown_against_drag(draw: random.Random) -> Drawn:
    """It falls back with v/sqrt(1 + v^2/u^2), u = sqrt(m g/c)."""
    c, ratio = 10 ** draw.uniform(-2, 1), 10 ** draw.uniform(-1, 1.6)
    u = math.sqrt(G / c)
    speed, law = ratio * u, draw.choice(DRAGS)
    back = u / G * (math.atan(ratio) + math.asinh(ratio))
    text = (
        THROWN.format(c=c, law=law, speed=speed)
        + """[ask]
v = "b.velocity.y"
t = "t"
y = { max = "b.y" }
top = { of = "t", at = { max = "b.y" } }
"""
    )
    truth = {
        "v": -speed / math.sqrt(1 + ratio**2),
        "t": back,
        "y": math.log1p(ratio**2) / (2 * c),
        "top": u / G * math.atan(ratio),
    }
    return Drawn(text, truth)


def top_beside_a_level(draw: random.Random) -> Drawn:
    """Above or below the level by a part of its height; with linear drag the height is known as well."""
    v, over = 10 ** draw.uniform(-1, 2), draw.choice([-1, 1]) * 10 ** draw.uniform(-9, -1)
    c = 10 ** draw.uniform(-2, 1) * G / v * draw.randrange(2)
    height = v**2 / (2 * G) if c == 0 else v / c - G / c**2 * math.log1p(c * v / G)
    text = f"""
until = "t = {1.5 * v / G!r} s"
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
start.b.velocity = ["1 m/s", "{v!r} m/s"]
{f'forces.d = {{ force = "b", value = [0, "-({c!r} N*s/m)*b.velocity.y"] }}' if c else ""}
events.through = "b.y = {height * (1 - over)!r} m"
events.above = "b.y > {height * (1 - over)!r} m"
[ask]
n = "through.count"
m = "above.count"
top = {{ max = "b.y" }}
"""
    return Drawn(text, {"n": 2 if over > 0 else 0, "m": 1 if over > 0 else 0, "top": height})


def past_a_point(draw: random.Random) -> Drawn:
    """Something flies straight past a point, which it is close to for a moment alone."""
    v, far, r = 10 ** draw.uniform(0.8, 2.5), 10 ** draw.uniform(0, 3.3), 10 ** draw.uniform(-2, 0)
    b, end = (
        r * draw.choice([draw.uniform(0.05, 0.95), draw.uniform(1.05, 3)]),
        draw.uniform(1.1, 3) * far / v,
    )
    distance = draw.choice(["p.position.norm", "norm(p.x, p.y)", "(f.stretch + (1 cm))"])
    text = f"""
until = "t = {end!r} s"
plane = "horizontal"
ground.points.O = [0, 0]
bodies.p = {{ mass = "1 kg", at = ["{-far!r} m", "{b!r} m"] }}
start.p.velocity = ["{v!r} m/s", 0]
forces.f = {{ spring = ["p", "ground.O"], stiffness = "0 N/m", free_length = "1 cm" }}
events.near = "{distance} < {r!r} m"
[ask]
n = "near.count"
least = {{ min = "{distance}" }}
"""
    return Drawn(text, {"n": int(b < r), "least": b}, {"least": far})
