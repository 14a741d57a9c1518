"""Narrow tops of an expression along a motion that goes on, most of them where windows of a step end.

Where x of a body goes on, f((x - a)/w) has its one top, which is known in closed form, whatever a and w are:
what is found beside it, for tops alone and behind abs, min and max.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import mpmath as mp
import numpy as np

import planemotion
from planemotion import _layout as layout
from planemotion.engine.call import run_cases
from tests.scenes.parts import rod_on_pin
from tests.stress.contacts.laws import Array
from tests.stress.misses.motions import GRAVITY, OMEGA, SCENES

DIGITS = 30
END = {"glides": 1.0, "turns": 1.0, "falls": 1.0, "springs": 0.25}  # s: it does not come back
U = "(({X} - a)/w)"
# f(u), with a slope s, and its top.
SHAPES: dict[str, tuple[str, Callable[[mp.mpf, mp.mpf], mp.mpf]]] = {
    "bell": (f"exp(-{U}^2)*(1 + s*{U})", lambda s, e: _bell((mp.sqrt(1 + 2 * s * s) - 1) / (2 * s), s)),
    "ridge": (f"(1 + s*{U})/(1 + {U}^2)", lambda s, e: _ridge((mp.sqrt(1 + s * s) - 1) / s, s)),
    "edge": (f"1 - sqrt(e^2 + {U}^2) + s*{U}", lambda s, e: 1 - e * mp.sqrt(1 - s * s)),
    "waves": (f"cos(3*{U})*exp(-abs({U})/3) + 0*s", lambda s, e: mp.mpf(1)),
    "well": (f"1 - 0.1*log(e^2 + {U}^2) + 0*s", lambda s, e: 1 - mp.log(e) / 5),
}
# How far a top may be off that is a corner beside others: no more than the accuracy of the run.
EXACT = {"waves": 1e-9}
# What an expression makes of a top, of at most 3, and its answer there; h: a little less than the top.
BEHIND: dict[str, tuple[str, Callable[[mp.mpf], mp.mpf]]] = {
    "alone": ("{f}", lambda top: top),
    "max": ("max({f} - 0.5, -1)", lambda top: top - 0.5),
    "floor": ("max({f}, h - 0.01*{X})", lambda top: top),
    "level": ("max(h, {f})", lambda top: top),
    "product": ("({f})*max(0.5, {f})", lambda top: top * max(mp.mpf(0.5), top)),
    "abs": ("-abs({f} - 5)", lambda top: top - 5),
    "min": ("min({f}, 4 - {X}^2/100)", lambda top: top),
}
MOVES = {
    "glides": (
        'plane = "horizontal"\nbodies.k = { mass = "1 kg", at = [0, 0] }\n'
        'start.k.velocity = ["v", "0 m/s"]\n',
        "(k.x/(1 m))",
        "m/s",
    ),
    "turns": (
        'plane = "horizontal"\n'
        + rod_on_pin(length="1 m", mass="1 kg", angle="0 deg")
        + 'start.AB.omega = "v"\n',
        "AB.angle",
        "rad/s",
    ),
    "falls": (
        'bodies.k = { mass = "1 kg", at = [0, 0] }\nstart.k.velocity = ["0 m/s", "-v"]\n',
        "(-k.y/(1 m))",
        "m/s",
    ),
    "springs": (SCENES["springs"].replace('"u"', '"0 m/s"'), "(k.x/(1 m))", "m/s"),
}
ROUTES = {
    "glides": ("uniform", "rk", "ida"),
    "turns": ("path",),
    "falls": ("uniform", "rk", "ida"),
    "springs": ("rk", "ida"),
}


def place(move: str, v: float, t: float) -> float:
    """x of a body at the time t, as long as it goes on."""
    if move == "falls":
        return v * t + 0.5 * GRAVITY * t * t
    return v * math.sin(OMEGA * t) / OMEGA if move == "springs" else v * t


def _bell(u: mp.mpf, s: mp.mpf) -> mp.mpf:
    return mp.exp(-u * u) * (1 + s * u)


def _ridge(u: mp.mpf, s: mp.mpf) -> mp.mpf:
    return (1 + s * u) / (1 + u * u)


@dataclass(frozen=True)
class Top:
    move: str
    route: str
    shape: str
    behind: str

    @property
    def text(self) -> str:
        scene, x, unit = MOVES[self.move]
        e = BEHIND[self.behind][0].replace("{f}", SHAPES[self.shape][0]).replace("{X}", x)
        return f"""
until = "t = {END[self.move]} s"
{scene}
[parameters]
a = 0.1
w = 0.1
s = 0.1
e = 0.1
h = 0
v = "1 {unit}"
[ask]
high = {{ max = "{e}" }}
low = {{ min = "-({e})" }}
[solve]
estimate = false
route = "{self.route}"
"""

    def truth(self, p: dict[str, float]) -> float:
        with mp.workdps(DIGITS):
            return float(BEHIND[self.behind][1](SHAPES[self.shape][1](mp.mpf(p["s"]), mp.mpf(p["e"]))))


def numbers(top: Top, rng: np.random.Generator) -> dict[str, float]:
    """Of one case: the place of its top is between 0.1 and 0.9, mostly beside a part of the run by halves."""
    v, halvings = rng.uniform(0.5, 5), int(rng.integers(1, 7))
    whole = rng.integers(1, 2**halvings) / 2**halvings
    at = np.clip(whole if rng.random() < 0.8 else rng.uniform(), 0.1, 0.9)
    w = 10 ** rng.uniform(-4, -1.5)
    off = rng.choice([0, 1]) * rng.uniform(-1, 1) * 10 ** rng.uniform(-6, 0)
    p = {
        "v": float(v),
        "w": float(w),
        "a": place(top.move, float(v), float(END[top.move] * at)) + float(off * w),
        "s": float(rng.choice([1e-9, 0.5]) * rng.uniform(0.1, 1)),
        "e": float(10 ** rng.uniform(-4, 0)),
    }
    with mp.workdps(DIGITS):
        p["h"] = float(SHAPES[top.shape][1](mp.mpf(p["s"]), mp.mpf(p["e"]))) - 10 ** rng.uniform(-3, -1)
    return p


def table(top: Top, seed: int, n: int) -> tuple[Array, list[dict[str, float]]]:
    """How far the greatest and the least value are off in n cases (NaN: no answer), and their numbers."""
    rng = np.random.default_rng([29, seed])
    cases = [numbers(top, rng) for _ in range(n)]
    (flat,) = planemotion.load_text(top.text).tables()
    given = np.array([[{**p, "g": GRAVITY}[name] for name in flat.parameters] for p in cases])
    found = run_cases(flat, given)
    truth = np.array([top.truth(p) for p in cases])
    off = np.abs(found.out - np.stack([truth, -truth], axis=1)).max(axis=1)
    return np.where(found.status == layout.PM_OK, off, np.nan), cases
