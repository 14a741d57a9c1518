"""Motions that are known in closed form: a body flies, swings on a pin or goes to and fro on a spring."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy.special import ellipj

from tests.scenes.parts import rod_on_pin
from tests.stress.contacts.laws import Array

GRAVITY = 9.81  # m/s^2
OMEGA = 6.0  # 1/s, of the spring on 1 kg
LENGTH = 1.5  # m, of the rod: its small swings have the frequency sqrt(g)
END = {"flies": 1.0, "swings": 3.0, "springs": 1.0}  # s

# What comes before the first table of a scene; parameters: v, u (a velocity) or q (an angle from below).
SCENES = {
    "flies": 'bodies.k = { mass = "1 kg", at = [0, 0] }\nstart.k.velocity = ["v", "u"]\n',
    "swings": rod_on_pin(length=f"{LENGTH} m", mass="1 kg", angle="q - (90 deg)"),
    "springs": 'plane = "horizontal"\nground.points.O = [0, 0]\nbodies.k = { mass = "1 kg", at = [0, 0] }\n'
    f'forces.hold = {{ spring = ["k", "ground.O"], stiffness = "{OMEGA**2} N/m" }}\n'
    'start.k.velocity = ["v", "u"]\n',
}
# Coordinates as numbers, in SI units.
COORDINATES: dict[str, dict[str, str]] = {
    "flies": {"x": "(k.x/(1 m))", "y": "(k.y/(1 m))", "speed": "(k.speed/(1 m/s))", "t": "(t/(1 s))"},
    "swings": {
        "x": "(AB.B.x/(1 m))",
        "y": "(AB.B.y/(1 m))",
        "angle": "AB.angle",
        "omega": "(AB.omega/(1 rad/s))",
        "force": "(A.force.y on AB/(1 N))",
        "t": "(t/(1 s))",
    },
    "springs": {
        "x": "(k.x/(1 m))",
        "y": "(k.y/(1 m))",
        "speed": "(k.velocity.x/(1 m/s))",
        "t": "(t/(1 s))",
    },
}


def _flies(p: Mapping[str, float], t: Array) -> dict[str, Array]:
    down = p["u"] - GRAVITY * t
    return {"x": p["v"] * t, "y": p["u"] * t - 0.5 * GRAVITY * t * t, "speed": np.hypot(p["v"], down), "t": t}


def _springs(p: Mapping[str, float], t: Array) -> dict[str, Array]:
    sine = np.sin(OMEGA * t) / OMEGA
    return {"x": p["v"] * sine, "y": p["u"] * sine, "speed": p["v"] * np.cos(OMEGA * t), "t": t}


def _swings(p: Mapping[str, float], t: Array) -> dict[str, Array]:
    """Let go at rest at the angle q: sin(angle/2) = k cd(sqrt(g) t, k), k = sin(q/2)."""
    k, w = math.sin(p["q"] / 2), math.sqrt(GRAVITY)
    sn, cn, dn, _ = ellipj(w * t, k * k)
    angle, rate = 2 * np.arcsin(k * cn / dn), -2 * w * k * math.sqrt(1 - k * k) * sn / dn
    sine, cosine = np.sin(angle), np.cos(angle)
    lift = 0.5 * LENGTH * (cosine * rate**2 - GRAVITY * sine**2)  # of the mass centre
    return {
        "x": LENGTH * sine,
        "y": -LENGTH * cosine,
        "angle": angle - math.pi / 2,
        "omega": rate,
        "force": GRAVITY + lift,
        "t": t,
    }


def place(motion: str, p: Mapping[str, float], t: Array) -> dict[str, Array]:
    """The coordinates of a motion at the times t."""
    return {"flies": _flies, "swings": _swings, "springs": _springs}[motion](p, t)
