"""Waves along the motion: cos(2 pi n x + p) of a coordinate that goes on, comes back or swings.

How often it falls below a level and its extremes follow from the way of x, which is known.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

import planemotion
from planemotion.engine.call import run_cases
from tests.stress.contacts.laws import Array
from tests.stress.misses.verdict import Verdict, judge

MOTIONS = ("goes on", "comes back", "swings")
NEAR = 1e-6  # rad: crossings so near to an end or to a place where it comes back are not judged


@dataclass(frozen=True)
class Wave:
    motion: str
    route: str

    def text(self) -> str:
        """x from 0: v t; v t - 3 t^2; v sin(6 t)/6."""
        wave = "cos(2*pi*n*k.x/(1 m) + p)"
        force = {
            "goes on": "",
            "comes back": '[forces]\nback = { force = "k", value = ["-6 N", 0] }',
            "swings": '[forces]\nhold = { spring = ["k", "ground.O"], stiffness = "36 N/m" }',
        }[self.motion]
        return f"""
until = "t = 1 s"
plane = "horizontal"
[parameters]
n = 1
p = 0
c = 0
v = "1 m/s"
[ground.points]
O = [0, 0]
[bodies.k]
mass = "1 kg"
at = [0, 0]
{force}
[start]
k.velocity.x = "v"
[events]
dip = "{wave} < c"
[ask]
dips = "dip.count"
high = {{ max = "{wave}" }}
low = {{ min = "{wave}" }}
[solve]
max_events = 1000000
{f'route = "{self.route}"' if self.route else ""}
"""


def ways(motion: str, v: Array) -> list[Array]:
    """x at the begin, where it turns, and at the end, [n] each."""
    zero = np.zeros_like(v)
    if motion == "goes on":
        return [zero, v]
    if motion == "comes back":
        turn = np.where(v < 6, v * v / 12, zero)
        return [zero, turn, v - 3]
    quarter = [v / 6 * np.sin(np.pi / 2 * k) for k in range(4)]  # 6 rad: three turning points
    return [quarter[0], quarter[1], quarter[3], v / 6 * np.sin(6.0)]


def _falls(low: Array, high: Array, level: Array) -> Array:
    """How often cos falls through `level` from angle low to high, whichever is greater."""
    edge = np.arccos(level)
    up = np.floor((high - edge) / (2 * np.pi)) - np.floor((low - edge) / (2 * np.pi))
    down = np.ceil((low + edge) / (2 * np.pi)) - np.ceil((high + edge) / (2 * np.pi))
    return np.where(high > low, up, down)


def _near_edge(angle: Array, level: Array) -> Array:
    off = np.stack([(angle + way * np.arccos(level)) / (2 * np.pi) for way in (-1, 1)])
    near: Array = (2 * np.pi * np.abs(off - np.round(off)) < NEAR).any(axis=0)
    return near


def truth_of(motion: str, n: Array, p: Array, c: Array, v: Array) -> tuple[Array, Array]:
    """Dips, greatest and least value [cases, 3]; which cases lie on an edge."""
    angle = [2 * np.pi * n * x + p for x in ways(motion, v)]
    dips = sum((_falls(a, b, c) for a, b in itertools.pairwise(angle)), np.zeros_like(n))
    low, high = np.min(angle, axis=0), np.max(angle, axis=0)
    ends = np.cos(angle)
    top = np.floor(high / (2 * np.pi)) >= np.ceil(low / (2 * np.pi))
    bottom = np.floor((high - np.pi) / (2 * np.pi)) >= np.ceil((low - np.pi) / (2 * np.pi))
    greatest, least = np.where(top, 1, ends.max(axis=0)), np.where(bottom, -1, ends.min(axis=0))
    edge = np.any([_near_edge(one, c) for one in angle], axis=0)
    return np.stack([dips, greatest, least], axis=1), edge


def draw(rng: np.random.Generator) -> Wave:
    return Wave(
        motion=str(rng.choice(MOTIONS)), route=str(rng.choice(["", "rk", "ida"], p=[0.5, 0.45, 0.05]))
    )


def table(seed: int, cases: int) -> tuple[Wave, Verdict, Array]:
    """A motion, what became of its cases, and their parameters [cases, 4]: n, p, c, v."""
    rng = np.random.default_rng([81, seed])
    wave = draw(rng)
    (flat,) = planemotion.load_text(wave.text()).tables()
    most = 1.5 if wave.route == "ida" else 2.5
    columns = {
        "n": 10 ** rng.uniform(-1, most, cases),
        "p": rng.uniform(-3, 3, cases),
        "c": rng.uniform(-0.99, 0.99, cases),
        "v": rng.uniform(0.5, 5, cases),
    }
    truth, edge = truth_of(wave.motion, *columns.values())
    columns["g"] = np.full(cases, 9.81)
    found = run_cases(flat, np.stack([columns[name] for name in flat.parameters], axis=1))
    size = np.maximum(np.abs(truth), 1)
    judged = judge(found, truth, size, edge=edge)
    return wave, judged, np.stack([columns[name] for name in "npcv"], axis=1)
