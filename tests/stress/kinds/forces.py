"""Kinds of forces: measured ones, thin regions, powers of a depth, springs that only push."""

from __future__ import annotations

import math
import random
from itertools import accumulate

from tests.scenes import G
from tests.stress.kinds.drawn import Drawn


def measured(draw: random.Random) -> Drawn:
    """Straight lines between random knots, on a body that weighs; to a time between two knots."""
    n = draw.randint(2, 7)
    times = [0.0, *accumulate(10 ** draw.uniform(-2, 0) for _ in range(n))]
    thrust = [draw.uniform(-20, 20) for _ in times]
    end = times[-1] * draw.uniform(0.05, 1)
    v = x = 0.0
    highest = thrust[0]
    fastest = 0.0
    for i in range(n):
        h = min(times[i + 1], end) - times[i]
        if h <= 0:
            break
        slope = (thrust[i + 1] - thrust[i]) / (times[i + 1] - times[i])
        a = thrust[i] - G
        inner = -a / slope if slope else -1.0
        if 0 < inner < h:
            fastest = max(fastest, v + a * inner + slope * inner**2 / 2)
        x += v * h + a * h**2 / 2 + slope * h**3 / 6
        v += a * h + slope * h**2 / 2
        highest, fastest = max(highest, thrust[i] + slope * h), max(fastest, v)
    text = f"""
until = "t = {end!r} s"
tables.f = {{ at = {[f"{t!r} s" for t in times]}, value = {[f"{f!r} N" for f in thrust]} }}
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
forces.d = {{ force = "b", value = [0, "f(t)"] }}
[ask]
y = "b.y"
v = "b.velocity.y"
most = {{ max = "f(t)" }}
fast = {{ max = "b.velocity.y" }}
push = {{ integral = "f(t)" }}
"""
    truth = {"y": x, "v": v, "most": highest, "fast": fastest, "push": v + G * end}
    return Drawn(text, truth, {"y": 20 * end**2, "v": 30 * end, "fast": 30 * end, "push": 30 * end})


REGION = """
until = "t = {time!r} s"
plane = "horizontal"
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
start.b.velocity = ["{speed!r} m/s", 0]
forces.f = {{ force = "b", value = ["({force!r} N)*{where}", 0] }}
ask.v = "b.velocity.x"
"""


def thin_region(draw: random.Random) -> Drawn:
    """One that a body passes, or that turns it back."""
    width, speed = (1 + 10 ** draw.uniform(-6, -1)) - 1, 10 ** draw.uniform(-1, 3)
    if draw.randrange(2):
        force, where, v = -(speed**2) / 2 / width, "(b.x > (1 m))", -speed
    else:
        gain = draw.uniform(-0.7, 3)
        force, where = gain * speed**2 / 2 / width, f"(b.x > (1 m))*(b.x < ({1 + width!r} m))"
        v = speed * math.sqrt(1 + gain)
    text = REGION.format(time=2.5 / speed, speed=speed, force=force, where=where)
    return Drawn(text, {"v": v}, {"v": speed * (1 + 4e-3 / width)})


# How deep a body is below y = 0, per m.
DEPTHS = ("max(-b.y/(1 m), 0)", "(abs(b.y) - b.y)/(2 m)", "(-min(b.y, 0 m)/(1 m))")
PRESSED = """
until = "t = {end!r} s"
plane = "horizontal"
bodies.b = {{ mass = "1 kg", at = [0, "0.1 m"] }}
forces.f = {{ force = "b", value = [0, "({k!r} N)*({depth})^{power}"] }}
start.b.velocity = [0, "-{speed!r} m/s"]
"""


def pressed(power: float, k: float, speed: float) -> tuple[float, float]:
    """How deep it comes, m v^2/2 = k d^(p+1)/(p+1), and how long it is there: 2 d/v times the integral of
    1/sqrt(1 - s^(p+1)) over (0, 1)."""
    e = power + 1
    deepest = (e * speed**2 / 2 / k) ** (1 / e)
    part = math.gamma(1 + 1 / e) * math.gamma(0.5) / math.gamma(1 / e + 0.5)
    return deepest, 2 * deepest / speed * part


def power_of_a_depth(draw: random.Random) -> Drawn:
    power, k, speed = (
        draw.choice([1.25, 1.5, 2, 2.5, 3.5]),
        10 ** draw.uniform(0, 6),
        10 ** draw.uniform(-1, 1),
    )
    depth = draw.choice(DEPTHS)
    deepest, lasts = pressed(power, k, speed)
    text = PRESSED.format(end=0.3 / speed + lasts, k=k, depth=depth, power=power, speed=speed)
    text += """[events]
out = "b.y > 0"
[ask]
v = "b.velocity.y"
y = "b.y"
d = { min = "b.y" }
t = { of = "t", at = "out" }
"""
    return Drawn(text, {"v": speed, "y": 0.2, "d": -deepest, "t": 0.1 / speed + lasts})


def bumper(draw: random.Random) -> Drawn:
    """It falls, and is on the spring for a part of a harmonic period, again and again."""
    h, k, mass = draw.uniform(0.01, 3), 10 ** draw.uniform(3, 7), 0.7
    w, fall = math.sqrt(k / mass), math.sqrt(2 * h / G)
    speed, rest = G * fall, G / w**2
    amplitude = math.hypot(rest, speed / w)
    on = 2 * (math.pi - math.atan2(speed / w, rest)) / w
    end = (2 * fall + on) * draw.uniform(1, 8)
    times, late = divmod(end - fall, 2 * fall + on)
    if late > on:
        since = late - on
        y, v = speed * since - 0.5 * G * since**2, speed - G * since
    else:
        angle = w * (late - 0.5 * on) + math.pi
        y, v = amplitude * math.cos(angle) - rest, -amplitude * w * math.sin(angle)
    long = 1.2 * (amplitude + rest) + 0.1
    text = f"""
until = "t = {end!r} s"
ground.points.O = [0, "{-long!r} m"]
bodies.m = {{ mass = "{mass} kg", at = [0, "{h!r} m"] }}
[forces.s]
spring = ["m", "ground.O"]
stiffness = "{k!r} N/m"
free_length = "{long!r} m"
only = "push"
[events]
down = "m.y < 0"
[ask]
y = "m.y"
v = "m.velocity.y"
low = {{ min = "m.y" }}
downs = "down.count"
"""
    truth = {"y": y, "v": v, "low": -amplitude - rest, "downs": int(times) + 1}
    return Drawn(text, truth, {"y": speed * end, "v": speed * (1 + w * end)})
