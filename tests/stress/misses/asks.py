"""Asks of narrow features along a motion that goes on: extremes, counts and integrals, at random.

Some bells, tents, boxes and others of a place x, with a trend, stand behind max, min, abs, a gate, a square
or exp.  As x only grows, extremes and counts are those of a function of x, and the integral over time is one
over x, divided by the speed, which is known in closed form.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

import planemotion
from planemotion.engine.call import run_cases
from tests.stress.contacts.laws import Array
from tests.stress.misses import peaks, tops
from tests.stress.misses.motions import GRAVITY, OMEGA
from tests.stress.misses.verdict import Verdict, judge

# Functions of {X}, with a place a and a width w; each feature of an ask has its own.
FEATURES = {
    "bell": f"exp(-{tops.U}^2)",
    "lorentzian": f"1/(1 + {tops.U}^2)",
    "tent": peaks.TENT,
    "arch": peaks.EXPRESSIONS["arch"][0],
    "sech": f"2/(exp({tops.U}) + exp(-{tops.U}))",
    "there and back": f"{tops.U}*exp(-{tops.U}^2)",
    "box": "(abs({X} - a) < w)",
    "cusp": peaks.EXPRESSIONS["ridge"][0],
    "packet": f"cos(5*{tops.U})*exp(-{tops.U}^2)",
}
TRENDS = {
    "none": "0",
    "slope": "0.3*{X}",
    "down": "-0.2*{X}^2",
    "hump": "-({X} - m)^4",
    "wave": "0.3*cos(2*{X})",
    "cubic": "-abs({X} - m)^3",
}
# What an expression makes of its features {f}, and what is zero where it switches.
BEHIND = {
    "alone": ("{f}", "1"),
    "max": ("max({f}, h - 0.01*{X})", "{f} - h + 0.01*{X}"),
    "min": ("min({f}, h + 0.01*{X})", "{f} - h - 0.01*{X}"),
    "less max": ("-max({f}, h - 0.01*{X})", "{f} - h + 0.01*{X}"),
    "abs": ("abs({f} - h)", "{f} - h"),
    "gate": ("({X} > h/2)*{f}", "{X} - h/2"),
    "square": ("{f}^2", "1"),
    "exp": ("exp(-abs({f}))", "{f}"),
}
MOST = 4  # features of an ask
ROUTES = {**tops.ROUTES, "turns": ("path", "rk")}
UPS = 0  # of the answers
# Places about a feature, in widths: dense in it, and ever denser towards its corners.
TAIL, CORNER = 10 ** np.linspace(0, 4, 400), 10 ** np.linspace(-12, 0, 121)
ABOUT = np.concatenate(
    [
        np.linspace(-6, 6, 2401),
        np.linspace(-40, 40, 1601),
        *(sign * TAIL for sign in (-1, 1)),
        *(corner + sign * CORNER for corner in (-1, 0, 1) for sign in (-1, 1)),
    ]
)
CORNERS = np.array([-1.0, 0.0, 1.0])  # of a feature, in widths: no feature has others
BESIDE = 4e-15  # m or rad: so far from a jump doubles tell its two sides
GRID = 3001  # places of the whole run
HALVINGS = 80  # of the way between two places: down to neighbours
CLOSE = 1e-2  # so near to the best of the places a top may be the best one
APART = 1e-6  # of a width: a smooth top is flat to rounding over less
NEAR = 1e-3  # more than a top is above its best place: a count that changes with the level by so much is open
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class Ask:
    move: str
    route: str
    features: tuple[str, ...]
    trend: str
    behind: str

    def written(self, x: str, form: int = 0) -> str:
        """Its expression of x, or (form 1) what is zero where that switches."""
        own = [re.sub(r"\b([aw])\b", rf"\g<1>{j}", FEATURES[one]) for j, one in enumerate(self.features)]
        terms = [TRENDS[self.trend], *(f"q{j}*({one})" for j, one in enumerate(own))]
        features = f"({' + '.join(terms)})".format(X=x)
        return BEHIND[self.behind][form].format(f=features, X=x)

    @property
    def text(self) -> str:
        scene, x, unit = tops.MOVES[self.move]
        e = self.written(x)
        own = "\n".join(f"a{j} = 0.1\nw{j} = 0.1\nq{j} = 0.1" for j in range(len(self.features)))
        return f"""
until = "t = {tops.END[self.move]} s"
{scene}
[parameters]
v = "1 {unit}"
h = 0.1
m = 0.1
c = 0.1
{own}
[events]
up = "{e} > c"
[ask]
ups = "up.count"
high = {{ max = "{e}" }}
low = {{ min = "{e}" }}
{"" if self.route == "path" else f'area = {{ integral = "{e}" }}'}
[solve]
max_events = 100000
{f'route = "{self.route}"' if self.route else ""}
"""

    def value(self, p: Mapping[str, float], x: Array, form: int = 0) -> Array:
        formula = self.written("X", form).replace("^", "**")
        with np.errstate(over="ignore"):  # 1/exp(800) is 0
            return np.asarray(eval(formula, {}, {**peaks.FUNCTIONS, **p, "X": x})) + 0.0 * x


# ---- the truth ----
def _speed(move: str, v: float, x: Array) -> Array:
    """That at which x grows, where it is x."""
    square = {"falls": 2 * GRAVITY * x, "springs": -((OMEGA * x) ** 2)}.get(move, 0.0 * x)
    return np.sqrt(v * v + square)


def _switches(ask: Ask, p: Mapping[str, float], x: Array) -> Array:
    """Where the expression switches between two of the places x."""
    rising = np.sign(ask.value(p, x, 1))
    passed = np.flatnonzero(rising[:-1] * rising[1:] < 0)
    low, high, before = x[passed], x[passed + 1], rising[passed]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        left = np.sign(ask.value(p, middle, 1)) == before
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return low


def _places(ask: Ask, p: Mapping[str, float]) -> Array:
    """Places between which the expression is smooth, dense about each feature; both sides of each corner."""
    end = tops.place(ask.move, p["v"], tops.END[ask.move])
    own = range(len(ask.features))
    dense = [p[f"a{j}"] + p[f"w{j}"] * ABOUT for j in own]
    x = np.unique(np.clip(np.concatenate([np.linspace(0, end, GRID), *dense]), 0, end))
    corners = [p[f"a{j}"] + p[f"w{j}"] * CORNERS for j in own]
    sharp = np.concatenate([[p["m"]], *corners, _switches(ask, p, x)])
    beside = [sharp + side * BESIDE * max(1.0, end) for side in (-1, 0, 1)]
    return np.unique(np.clip(np.concatenate([x, *beside]), 0, end))


def _greatest(ask: Ask, p: Mapping[str, float], x: Array, g: Array, sign: int) -> float:
    """The greatest value of sign*g, by places ever denser about each top that may be it."""
    up = np.diff(sign * g)
    top = np.append(True, up > 0) & np.append(up <= 0, True)
    k = np.flatnonzero(top & (sign * g >= (sign * g).max() - CLOSE))
    best = float((sign * g).max())
    # Places by a corner are so near that rounding makes tops of its own among them: wider ways, too.
    reach = np.array([0.0, x[-1], *(p[f"w{i}"] for i in range(len(ask.features)))])[:, None] * APART
    before = np.searchsorted(x, x[k] - reach) - 1
    after = np.searchsorted(x, x[k] + reach, side="right")
    low, high = x[np.maximum(before, 0)].ravel(), x[np.minimum(after, len(x) - 1)].ravel()
    for _ in range(8):
        s = np.linspace(low, high, 21)
        h = sign * ask.value(p, s)
        best = max(best, float(h.max()))
        j, column = h.argmax(axis=0), np.arange(len(low))
        low, high = s[np.maximum(j - 1, 0), column], s[np.minimum(j + 1, 20), column]
    return sign * best


def _rises(g: Array, level: float) -> float:
    return float(((g[:-1] <= level) & (g[1:] > level)).sum())


def _integral(ask: Ask, p: Mapping[str, float], x: Array) -> float:
    half, middle = 0.5 * np.diff(x), 0.5 * (x[1:] + x[:-1])
    s = middle[:, None] + half[:, None] * NODES
    rate = ask.value(p, s) / _speed(ask.move, p["v"], s)
    return float((rate @ WEIGHTS) @ half)


def truth_of(ask: Ask, p: Mapping[str, float]) -> tuple[list[float], bool]:
    """Rises above the level, greatest and least value, integral; whether the count is open.

    It is open if it is another one for a level a little higher or lower.
    """
    x = _places(ask, p)
    g = ask.value(p, x)
    ups, *others = (_rises(g, p["c"] + off) for off in (0.0, -NEAR, NEAR))
    high, low = (_greatest(ask, p, x, g, sign) for sign in (1, -1))
    return [ups, high, low, _integral(ask, p, x)], any(other != ups for other in others)


# ---- a table ----
def draw(rng: np.random.Generator) -> Ask:
    move = str(rng.choice(list(tops.MOVES)))
    routes = [route for route in ("", *ROUTES[move]) if route != "ida" or rng.random() < 0.4]
    return Ask(
        move=move,
        route=str(rng.choice(routes)),
        features=tuple(str(one) for one in rng.choice(list(FEATURES), rng.integers(1, MOST + 1))),
        trend=str(rng.choice(list(TRENDS))),
        behind=str(rng.choice(list(BEHIND))),
    )


def numbers(ask: Ask, rng: np.random.Generator) -> dict[str, float]:
    """Of one case: its features are on the way, half of them beside a part of the run by halves."""
    v, many = rng.uniform(0.5, 5), len(ask.features)
    at = rng.uniform(0.02, 0.98, many)
    at = np.round(64 * at) / 64 if rng.random() < 0.5 else at
    width = np.where(rng.random(many) < 0.4, 10 ** rng.uniform(-4, -0.5), 10 ** rng.uniform(-4, -0.5, many))
    off = rng.integers(0, 2, many) * rng.uniform(-1, 1, many) * width
    sign, small = np.where(rng.random(many) < 0.8, 1, -1), rng.random(many) < 0.3
    factor = sign * rng.uniform(0.3, 1, many) * np.where(small, 10 ** rng.uniform(-3, 0, many), 1)
    end = tops.END[ask.move]
    p = {
        "v": v,
        "h": rng.uniform(-0.2, 0.8),
        "m": tops.place(ask.move, v, end * rng.uniform()),
        "c": rng.uniform(-0.3, 1),
    }
    for j in range(many):
        p |= {f"a{j}": tops.place(ask.move, v, end * at[j]) + off[j], f"w{j}": width[j], f"q{j}": factor[j]}
    return {name: float(one) for name, one in p.items()}


def cases_of(seed: int, n: int) -> tuple[Ask, list[dict[str, float]]]:
    rng = np.random.default_rng([78, seed])
    ask = draw(rng)
    return ask, [numbers(ask, rng) for _ in range(n)]


def table(seed: int, n: int) -> tuple[Ask, Verdict, Array]:
    """An ask, what became of n cases of it, and their numbers: v, h, m, c, and a, w, q of each feature."""
    ask, cases = cases_of(seed, n)
    (flat,) = planemotion.load_text(ask.text).tables()
    given = np.array([[{**p, "g": GRAVITY}[name] for name in flat.parameters] for p in cases])
    found = run_cases(flat, given)
    truths = [truth_of(ask, p) for p in cases]
    truth = np.array([one for one, _ in truths])[:, : found.out.shape[1]]  # path takes no integral
    is_open = np.array([unsure for _, unsure in truths])
    truth[is_open, UPS] = found.out[is_open, UPS]
    width = np.array([min(p[f"w{j}"] for j in range(len(ask.features))) for p in cases])[:, None]
    told = judge(found, truth, np.maximum(np.abs(truth), 1), peaks.ROUNDING + 1e-12 / width)
    return ask, told, np.array([list(p.values()) for p in cases])
