"""Kinds of bodies that slide, stop, slide back, are pushed loose, or skid until they roll."""

from __future__ import annotations

import math
import random

from tests.scenes import G
from tests.stress.kinds.drawn import Drawn


def up_an_incline(draw: random.Random) -> Drawn:
    slope, v = math.radians(draw.uniform(2, 60)), 10 ** draw.uniform(-2, 1.5)
    ratio = draw.uniform(0.1, 0.98) if draw.randrange(2) else draw.uniform(1.02, 3)
    mu = math.tan(slope) * ratio
    slower, back = (G * (math.sin(slope) + sign * mu * math.cos(slope)) for sign in (1, -1))
    up = v / slower
    end = up * draw.uniform(0.3, 4)
    late = max(0.0, end - up)
    along = v * min(end, up) - 0.5 * slower * min(end, up) ** 2
    speed = v - slower * min(end, up)
    slides = ratio < 1 and late > 0
    if slides:
        along, speed = along - 0.5 * back * late**2, -back * late
    text = f"""
until = "t = {end!r} s"
ground.lines.floor = {{ through = [0, 0], angle = "{slope!r} rad" }}
bodies.b = {{ mass = "2 kg", at = [0, 0] }}
start.b.velocity = ["{v!r}*cos({slope!r})*(1 m/s)", "{v!r}*sin({slope!r})*(1 m/s)"]
contacts.floor = {{ touch = ["b", "ground.floor"], friction = {mu!r} }}
events.back = "b.velocity.x < 0"
[ask]
x = "b.x"
v = "b.velocity.x"
n = "back.count"
far = {{ max = "b.x" }}
pressed = {{ integral = "floor.normal" }}
"""
    truth = {
        "x": along * math.cos(slope),
        "v": speed * math.cos(slope),
        "n": int(slides),
        "far": (v * min(end, up) - 0.5 * slower * min(end, up) ** 2) * math.cos(slope),
        "pressed": 2 * G * math.cos(slope) * end,
    }
    return Drawn(text, truth, {"x": v * end, "v": v + G * late})


def pushed_loose(draw: random.Random) -> Drawn:
    """A force that grows with the time, to the right or to the left, moves a block once friction is less."""
    mu, mass, way = draw.uniform(0.05, 1), 10 ** draw.uniform(-1, 2), draw.choice([-1, 1])
    rate = 10 ** draw.uniform(-1, 1) * mu * mass * G
    loose = mu * mass * G / rate
    late = loose * draw.uniform(0.1, 3)
    text = f"""
until = "t = {loose + late!r} s"
ground.lines.floor = {{ through = [0, 0] }}
bodies.b = {{ mass = "{mass!r} kg", at = [0, 0] }}
forces.f = {{ force = "b", value = ["{way * rate!r}*t*(1 N/s)", 0] }}
contacts.floor = {{ touch = ["b", "ground.floor"], friction = {mu!r} }}
events.right = "b.velocity.x > 0"
events.left = "b.velocity.x < 0"
[ask]
x = "b.x"
v = "b.velocity.x"
right = "right.count"
left = "left.count"
"""
    truth = {
        "x": way * rate / mass * late**3 / 6,
        "v": way * rate / mass * late**2 / 2,
        "right": int(way > 0),
        "left": int(way < 0),
    }
    return Drawn(
        text, truth, {"x": rate / mass * (loose + late) ** 3, "v": rate / mass * (loose + late) ** 2}
    )


def skids_until_it_rolls(draw: random.Random) -> Drawn:
    """A disk with any velocity and spin; what slips at the floor slows by 3 mu g."""
    r, mu = 10 ** draw.uniform(-2, 0), draw.uniform(0.05, 1)
    v, spin = draw.uniform(-5, 5), draw.uniform(-5, 5) / r
    slip = v + spin * r
    rolls = abs(slip) / (3 * mu * G)
    end = rolls * draw.uniform(0.2, 3)
    pull, time = -math.copysign(mu * G, slip), min(end, rolls)
    after, late = v + pull * time, end - time
    turns = after * v < 0
    text = f"""
until = "t = {end!r} s"
ground.lines.floor = {{ through = [0, 0] }}
bodies.d = {{ disk = "{r!r} m", mass = "3 kg", at = [0, "{r!r} m"] }}
start.d = {{ velocity = ["{v!r} m/s", 0], omega = "{spin!r} rad/s" }}
contacts.floor = {{ touch = ["d.rim", "ground.floor"], friction = {mu!r} }}
events.turn = "d.velocity.x = 0"
[ask]
x = "d.x"
v = "d.velocity.x"
omega = "d.omega"
turns = "turn.count"
"""
    truth = {
        "x": v * time + 0.5 * pull * time**2 + after * late,
        "v": after,
        "omega": spin + 2 * pull / r * time,
        "turns": int(turns),
    }
    size = abs(v) + abs(spin * r)
    return Drawn(text, truth, {"x": size * end, "v": size, "omega": size / r})
