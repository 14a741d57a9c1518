"""Peaks with corners and steps along a motion: expressions with abs, min, max and comparisons.

An expression is cut where one of its operations may switch - a coordinate goes through a level there, or
turns - and is smooth between: its extremes, and how often it rises above a level, follow from these pieces.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

import planemotion
from planemotion.engine.call import run_cases
from tests.stress.contacts.laws import Array
from tests.stress.misses.motions import COORDINATES, END, GRAVITY, SCENES, place
from tests.stress.misses.verdict import Verdict, judge

GRID = 4001  # places of the whole run: a coordinate turns at most once between three of them
PIECE = np.sin(np.pi / 2 * np.linspace(-1, 1, 41)) / 2 + 0.5  # places of a piece
INSIDE = 1e-7  # of a piece: what jumps at its ends is read so far from them
LEAST = 1e-13  # s: no piece is shorter
NEAR = 1e-7  # so near to its level a piece may pass it or not: not judged
ROUNDING = 1e-10  # of an answer
Levels = Callable[[Mapping[str, float]], list[tuple[str, float]]]


def _at(*pairs: tuple[str, str]) -> Levels:
    """Levels by expressions of the numbers of a case.

    a, b: levels on the way; c: a time; w: a width; n, p: of a wave.
    """
    return lambda p: [(name, float(eval(level, {}, dict(p)))) for name, level in pairs]


def _of_steps(first: str, step: str, many: int) -> Levels:
    """X at first + k step, |k| <= many."""
    return _at(*[("X", f"{first} + {k}*({step})") for k in range(-many, many + 1)])


def _both(*levels: Levels) -> Levels:
    return lambda p: [one for some in levels for one in some(p)]


TENT, ON_TENT = "max(0, 1 - abs({X} - a)/w)", _of_steps("a", "w", 1)
OTHER, ON_OTHER = "max(0, 1 - abs({Y} - b)/w)", _at(("Y", "b"), ("Y", "b - w"), ("Y", "b + w"))
WAVE, ON_WAVE = "abs(cos(n*{X} + p))", _of_steps("(pi/2 - p)/n", "pi/n", 500)
# So many that no coordinate leaves them: each keeps within 50 (test_misses.py).
ON_STEPS = _of_steps("a", "w + 0.05", 1000)
# Where the pieces of what has no switch are taken: about its middle.
ABOUT = _of_steps("a", "w/2", 12)
# An expression of the coordinates X and Y and the numbers of a case, and where it may switch.
EXPRESSIONS: dict[str, tuple[str, Levels]] = {
    "tent": (TENT, ON_TENT),
    "tent on a slope": (f"{TENT} + 0.3*{{Y}}", ON_TENT),
    "capped": ("min(max(1 - abs({X} - a)/w, 0), 0.4)", _both(ON_TENT, _of_steps("a", "0.6*w", 1))),
    "hole": ("0.2*{Y} - max(0, 1 - abs({X} - a)/w)", ON_TENT),
    "gate": ("({X} > a)*({X} < a + w)*(2 + {Y})", ON_TENT),
    "band": ("(abs({X} - a) < w)*(1 + {Y}^2)", ON_TENT),
    "out of it": ("sign(abs({X} - a) - w)*{Y}", ON_TENT),
    "both": (f"{TENT} + 0.7*{OTHER}", _both(ON_TENT, ON_OTHER)),
    "either": (f"max({TENT}, 0.7*{OTHER})", _both(ON_TENT, ON_OTHER)),
    "arch": ("sqrt(max(0, 1 - (({X} - a)/w)^2))", ON_TENT),
    "bell": ("max(exp(-(({X} - a)/w)^2) - 0.5, 0.01*{Y})", ABOUT),
    "ridge": ("1/(1 + abs({X} - a)/w)", ABOUT),
    "soft step": ("min(tanh(({X} - a)/w), tanh((a + 4*w - {X})/w))", ABOUT),
    "stairs": ("floor(({X} - a)/(w + 0.05))*(1 + 0.1*{Y})", ON_STEPS),
    "teeth": ("({X} - a)/(w + 0.05) - floor(({X} - a)/(w + 0.05))", ON_STEPS),
    "waves": (f"{WAVE} - 0.2*{{Y}}", ON_WAVE),
    "waves and tent": (f"max(0.9*{WAVE}, 2*{TENT})", _both(ON_WAVE, ON_TENT)),
    "square": ("max(abs({X} - a), abs({Y} - b))", _at(("X", "a"), ("Y", "b"))),
    "notch": ("-max(abs({X} - a), abs({Y} - b))", _at(("X", "a"), ("Y", "b"))),
    "near": ("max(0, 1 - norm({X} - a, {Y} - b)/w)", _both(ON_TENT, ON_OTHER)),
    "comb": (
        " + ".join(f"max(0, 1 - abs({{X}} - a - {3 * k}*w)/w)*{1 + 0.1 * k}" for k in range(7)),
        _of_steps("a", "w", 20),
    ),
    "time": ("max(0, 1 - abs({t} - c)/w)*(1 + {X}^2)", _at(("t", "c"), ("t", "c - w"), ("t", "c + w"))),
}
JUMPS = frozenset(("gate", "band", "out of it", "stairs", "teeth"))  # all others are continuous
FUNCTIONS = {
    "max": np.maximum,
    "min": np.minimum,
    "abs": np.abs,
    "cos": np.cos,
    "exp": np.exp,
    "sqrt": np.sqrt,
    "tanh": np.tanh,
    "sign": np.sign,
    "floor": np.floor,
    "norm": np.hypot,
}


@dataclass(frozen=True)
class Peak:
    motion: str
    name: str
    route: str
    x: str  # the coordinate X of its expression
    y: str

    @property
    def text(self) -> str:
        c = COORDINATES[self.motion]
        e = EXPRESSIONS[self.name][0].format(X=c[self.x], Y=c[self.y], t=c["t"])
        start = 'v = "1 m/s"\nu = "1 m/s"' if self.motion != "swings" else 'q = "1 rad"'
        return f"""
until = "t = {END[self.motion]} s"
{SCENES[self.motion]}
[parameters]
a = 0.1
b = 0.1
c = 0.1
w = 0.1
n = 1
p = 0
level = 0
{start}
[events]
rise = "{e} > level"
[ask]
rises = "rise.count"
high = {{ max = "{e}" }}
low = {{ min = "{e}" }}
[solve]
{f'route = "{self.route}"' if self.route else ""}
"""

    def value(self, p: Mapping[str, float], t: Array) -> Array:
        at = place(self.motion, p, t)
        formula = EXPRESSIONS[self.name][0].format(X="X", Y="Y", t="t").replace("^", "**")
        names = {**FUNCTIONS, **p, "X": at[self.x], "Y": at[self.y], "t": t}
        return np.asarray(eval(formula, {}, names)) + 0.0 * t


# ---- the truth ----
def _root(f: Callable[[float], float], low: float, high: float) -> float:
    return float(brentq(f, low, high, xtol=1e-16, rtol=1e-15))


def _turns(peak: Peak, p: Mapping[str, float], name: str) -> list[float]:
    """Times at which a coordinate turns, with those of begin and end."""
    end, h = END[peak.motion], 1e-6
    grid = np.linspace(0, end, GRID)
    rises = np.sign(np.diff(place(peak.motion, p, grid)[name]))

    def rate(t: float) -> float:
        before, after = place(peak.motion, p, np.array([t - h, t + h]))[name]
        return float(after - before)

    found = [0.0]
    for i in np.flatnonzero(rises[:-1] * rises[1:] < 0):
        low, high = float(grid[i]), float(grid[i + 2])
        found.append(_root(rate, low, high) if rate(low) * rate(high) < 0 else 0.5 * (low + high))
    return [*found, end]


def _cuts(peak: Peak, p: Mapping[str, float]) -> list[float]:
    """Times at which the expression may switch, or a coordinate turns."""
    monotonic = {name: _turns(peak, p, name) for name in (peak.x, peak.y, "t")}
    found = {t for times in monotonic.values() for t in times}
    at = {name: place(peak.motion, p, np.array(times))[name] for name, times in monotonic.items()}
    for name, level in EXPRESSIONS[peak.name][1](p):
        coordinate = {"X": peak.x, "Y": peak.y}.get(name, name)
        times, off = monotonic[coordinate], at[coordinate] - level

        def of(t: float, coordinate: str = coordinate, level: float = level) -> float:
            return float(place(peak.motion, p, np.array(t))[coordinate] - level)

        passed = np.flatnonzero(off[:-1] * off[1:] < 0)
        found |= {_root(of, times[i], times[i + 1]) for i in passed}
    return sorted(found)


def _piece(peak: Peak, p: Mapping[str, float], a: float, b: float) -> tuple[Array, Array]:
    """Places of a piece and the values there; limits at ends where it may jump."""
    t = a + (b - a) * PIECE
    if peak.name not in JUMPS:
        t[0], t[-1] = a, b
        return t, peak.value(p, t)
    t[:3], t[-3:] = a + INSIDE * (b - a) * np.arange(3), b - INSIDE * (b - a) * np.arange(2, -1, -1)
    g = peak.value(p, t)
    g[0], g[-1] = 2 * g[1] - g[2], 2 * g[-2] - g[-3]
    return t, g


def _tops(peak: Peak, p: Mapping[str, float], t: Array, g: Array, sign: int) -> list[tuple[float, float]]:
    """Where sign*g is greater than beside it, and g there."""
    rises = np.diff(sign * g)
    top = np.append(True, rises > 0) & np.append(rises <= 0, True)
    return [_top(peak, p, t, g, sign, int(k)) for k in np.flatnonzero(top)]


def _top(peak: Peak, p: Mapping[str, float], t: Array, g: Array, sign: int, k: int) -> tuple[float, float]:
    """By samples ever denser about sample k."""
    place_of_best, best = float(t[k]), float(g[k])
    edge = 1 if peak.name in JUMPS else 0  # its ends are limits
    low, high = t[max(k - 1, edge)], t[min(k + 1, len(t) - 1 - edge)]
    for _ in range(8):
        s = np.linspace(low, high, 41)
        h = peak.value(p, s)
        j = int(np.argmax(sign * h))
        if sign * h[j] > sign * best:
            place_of_best, best = float(s[j]), float(h[j])
        low, high = s[max(j - 1, 0)], s[min(j + 1, 40)]
    return place_of_best, best


def truth_of(peak: Peak, p: Mapping[str, float]) -> tuple[list[float], bool]:
    """Rises above the level, greatest and least value; whether it comes too near to the level for that."""
    high, low, edge = -math.inf, math.inf, False
    above: list[bool] = []
    for a, b in pairwise(_cuts(peak, p)):
        if b - a < LEAST:
            continue
        t, g = _piece(peak, p, a, b)
        tops = _tops(peak, p, t, g, 1) + _tops(peak, p, t, g, -1)
        values = [value for _, value in tops]
        high, low = max(high, *values), min(low, *values)
        edge |= min(abs(one - p["level"]) for one in (*values, g[0], g[-1])) < NEAR
        course = sorted([*zip(t.tolist(), g.tolist(), strict=True), *tops])
        above += [value > p["level"] for _, value in course]
    return [float(sum(not one and other for one, other in pairwise(above))), high, low], edge


# ---- a table ----
def draw(rng: np.random.Generator) -> Peak:
    motion = str(rng.choice(list(SCENES)))
    routes, chance = ["", "rk", "ida"], [0.5, 0.4, 0.1]
    x, y = rng.choice([name for name in COORDINATES[motion] if name != "t"], 2, replace=False)
    return Peak(motion, str(rng.choice(list(EXPRESSIONS))), str(rng.choice(routes, p=chance)), str(x), str(y))


def numbers(peak: Peak, rng: np.random.Generator) -> dict[str, float]:
    """Of one case: its peak is on the way; the width is 1e-5 to 1."""
    end = END[peak.motion]
    p = {
        "v": rng.uniform(0.5, 5),
        "u": rng.uniform(0.5, 5),
        "q": rng.uniform(0.2, 2.8),
        "n": 10 ** rng.uniform(0, 1.5),
        "p": rng.uniform(-3, 3),
        "w": 10 ** rng.uniform(-5, 0),
        "c": rng.uniform(0, 1) * end,
        "level": rng.uniform(-0.2, 1),
    }
    at = place(peak.motion, p, np.array(rng.uniform(0, 1) * end))
    p["a"], p["b"] = float(at[peak.x]), float(at[peak.y]) + rng.choice([0, 1]) * rng.uniform(-1, 1) * p["w"]
    return {**{name: float(one) for name, one in p.items()}, "pi": math.pi}


def cases_of(seed: int, n: int) -> tuple[Peak, list[dict[str, float]]]:
    rng = np.random.default_rng([28, seed])
    peak = draw(rng)
    return peak, [numbers(peak, rng) for _ in range(n)]


def table(seed: int, n: int) -> tuple[Peak, Verdict, Array]:
    """A peak, what became of n cases of it, and their numbers: v, u, q, n, p, w, c, level, a, b, pi."""
    peak, cases = cases_of(seed, n)
    (flat,) = planemotion.load_text(peak.text).tables()
    truths = [truth_of(peak, p) for p in cases]
    truth = np.array([one for one, _ in truths])
    given = np.array([[{**p, "g": GRAVITY}[name] for name in flat.parameters] for p in cases])
    found = run_cases(flat, given)
    width = np.array([p["w"] for p in cases])[:, None]
    edge = np.array([on for _, on in truths])
    judged = judge(found, truth, np.maximum(np.abs(truth), 1), ROUNDING + 1e-12 / width, edge)
    return peak, judged, np.array([list(p.values()) for p in cases])
