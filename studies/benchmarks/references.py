"""Makes references.json: cases and exact answers by mpmath, from principles that the engine does not use.

    .venv/bin/python -m studies.benchmarks.references     (five minutes)

Recursion and closed forms where there are any, quadrature of the energy equation for times, and for motions
in time an extrapolated midpoint rule in 30 digits on two grids, whose agreement is stored beside the answer.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp
import numpy as np

from .models import FOOT, G_SI, G_US, SPHERE_RADIUS, Collar, Linkage
from .problems import REFERENCES

DIGITS = 30  # of the working precision
STORED = 20  # digits that are written
SPHERE_SEED, SPHERE_DRAWN, SPHERE_CASES, SPHERE_SLOW = 7, 100_000, 200, 20
COLLAR_SIDE, COLLAR_SLOW = 10, 20
BALL_HEIGHT, BALL_RESTITUTION = 1.0, 0.9

State = list[mp.mpf]


# ---- closed forms and quadratures ----


def sphere(d: float, omega0: float) -> list[mp.mpf]:
    """omega above bar B (not a number if it never gets there), bars passed, least N/W, greatest |F|/N.

    Energy about a bar, (2 + 5 cos 2 beta)/7 of omega kept at each blow; N and F from the acceleration of the
    centre, both worst at the end of the first arc, where the speed and the angle are greatest.
    """
    d, r, omega0, g = (mp.mpf(x) for x in (d, SPHERE_RADIUS, omega0, G_US))
    beta = mp.asin(d / (2 * r))
    c, k = 10 * g / (7 * r) * (1 - mp.cos(beta)), (2 + 5 * mp.cos(2 * beta)) / 7
    normal = (17 * mp.cos(beta) - 10) / 7 - r * omega0**2 / g
    friction = mp.mpf(2) / 7 * mp.sin(beta) / normal
    square, bars, first = omega0**2, 0, mp.nan
    while True:
        square = k**2 * (square + c) - c
        if square <= 0:
            return [first, mp.mpf(bars), normal, friction]
        bars += 1
        if bars == 1:
            first = mp.sqrt(square)


def collar(d: float, ratio: float) -> list[mp.mpf]:
    """omega with the collar above, time of a turn, least N/W, greatest |F|/N (not a number if N vanishes)."""
    r, m, omega0, g = (mp.mpf(x) for x in (Collar.radius, Collar.mass, Collar.omega_below, G_SI))
    d, mc = mp.mpf(d), mp.mpf(ratio) * m

    def inertia(x: mp.mpf) -> mp.mpf:
        return 2 * m * r**2 + mc * (r**2 + d**2 - 2 * r * d * mp.cos(x))

    def square(x: mp.mpf) -> mp.mpf:
        return (inertia(mp.mpf(0)) * omega0**2 - 2 * mc * g * d * (1 - mp.cos(x))) / inertia(x)

    def forces(x: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
        s, c = mp.sin(x), mp.cos(x)
        alpha = -mc * d * s * (g + r * square(x)) / inertia(x)
        normal = (m + mc) * g + mc * d * (c * square(x) + s * alpha)
        return normal, (m + mc) * r * alpha + mc * d * (s * square(x) - c * alpha)

    def normal(x: mp.mpf) -> mp.mpf:
        return forces(x)[0] / ((m + mc) * g)

    def friction(x: mp.mpf) -> mp.mpf:
        n, f = forces(x)
        return -abs(f) / n

    time = mp.quad(lambda x: 1 / mp.sqrt(square(x)), mp.linspace(0, 2 * mp.pi, 9))
    least = least_of(normal)
    return [mp.sqrt(square(mp.pi)), time, least, -least_of(friction) if least > 0 else mp.nan]


def least_of(f: Callable[[mp.mpf], mp.mpf], samples: int = 64) -> mp.mpf:
    """The least value of a smooth function over a turn: samples, then golden section in the best bracket."""
    x = [2 * mp.pi * i / samples for i in range(samples + 1)]
    values = [f(u) for u in x]
    best = min(range(samples + 1), key=lambda i: values[i])
    low, high = x[max(best - 1, 0)], x[min(best + 1, samples)]
    golden = (mp.sqrt(5) - 1) / 2
    while high - low > mp.mpf(10) ** (-DIGITS // 2):  # the value is then good to twice as many digits
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, right) if f(left) < f(right) else (left, high)
    return min(values[best], f((low + high) / 2))


def linkage() -> list[mp.mpf]:
    """omega at each mark, speed of D and time at the last: omega^2 = 3 g sin / (L (1 + 3 sin^2))."""
    g, length = mp.mpf(G_US), mp.mpf(Linkage.length)

    def omega(x: mp.mpf) -> mp.mpf:
        return mp.sqrt(3 * g * mp.sin(x) / (length * (1 + 3 * mp.sin(x) ** 2)))

    speeds = [omega(mp.radians(mark)) for mark in Linkage.marks_deg]
    end = mp.radians(Linkage.marks_deg[-1])
    # x = u^2 takes the root out of the time near the start.
    time = mp.quad(lambda u: 2 * u / omega(u * u) if u else mp.mpf(0), mp.linspace(0, mp.sqrt(end), 9))
    return [*speeds, 2 * length * mp.sin(end) * speeds[-1], time]


def ball() -> list[mp.mpf]:
    """The first blow, and the limit of all: t1 (1 + e) / (1 - e)."""
    first = mp.sqrt(2 * mp.mpf(BALL_HEIGHT) / mp.mpf(G_SI))
    e = mp.mpf(BALL_RESTITUTION)
    return [first, first * (1 + e) / (1 - e)]


def simple_pendulum() -> list[mp.mpf]:
    """x and y after 10 s, from the level on the left: sin(angle/2) = k cd(t sqrt(g/L), k), k^2 = 1/2."""
    u = mp.sqrt(mp.mpf(G_SI)) * 10
    half = mp.ellipfun("cd", u, m=mp.mpf(1) / 2) / mp.sqrt(2)
    angle = 2 * mp.asin(half)
    return [-mp.sin(angle), -mp.cos(angle)]


# ---- motions in time ----


def double_pendulum_rhs(y: State) -> State:
    g, inertia = mp.mpf(G_SI), mp.mpf(1) / 12
    a, b, wa, wb = y
    c, s = mp.cos(a - b), mp.sin(a - b)
    m11, m22, m12 = inertia + mp.mpf(5) / 4, inertia + mp.mpf(1) / 4, c / 2
    f1 = -mp.mpf(3) / 2 * g * mp.cos(a) - s / 2 * wb * wb
    f2 = -g / 2 * mp.cos(b) + s / 2 * wa * wa
    det = m11 * m22 - m12 * m12
    return [wa, wb, (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det]


def slider_crank_rhs(y: State) -> State:
    a, length, m1, m2, m3, g = (mp.mpf(x) for x in (0.1, 0.3, 0.2, 0.2, 0.4, G_SI))
    s, c = mp.sin(y[0]), mp.cos(y[0])
    root = mp.sqrt(length**2 - (a * s) ** 2)
    phi = a * c / root
    dphi = (-a * s * root + a * c * a**2 * s * c / root) / root**2
    x2, y2 = -a * s - a * s * phi / 2, a * c / 2
    dx2, dy2 = -a * c - (a * c * phi + a * s * dphi) / 2, -a * s / 2
    x3, dx3 = -a * s - a * s * phi, -a * c - a * c * phi - a * s * dphi
    moment = m1 * a**2 / 3 + m2 * (x2**2 + y2**2) + m2 * length**2 / 12 * phi**2 + m3 * x3**2
    slope = 2 * (m2 * (x2 * dx2 + y2 * dy2) + m2 * length**2 / 12 * phi * dphi + m3 * x3 * dx3)
    return [y[1], -(slope * y[1] ** 2 / 2 + g * a / 2 * (m1 + m2) * c) / moment]


def four_bars_rhs(n: int) -> Callable[[State], State]:
    """n + 1 cranks turn as one, n couplers only translate."""
    inertia, moment = mp.mpf(n + 1) / 3 + n, mp.mpf(n + 1) / 2 + n
    return lambda y: [y[1], -mp.mpf(G_SI) * moment / inertia * mp.cos(y[0])]


def midpoint_extrapolated(
    rhs: Callable[[State], State], start: Sequence[mp.mpf], end: float, intervals: int, order: int = 12
) -> State:
    """Gragg's midpoint rule with 2, 4 .. 2 order substeps of each of the equal intervals, extrapolated."""
    y, h = [mp.mpf(u) for u in start], mp.mpf(end) / intervals
    for _ in range(intervals):
        table: list[list[State]] = []
        for j in range(order):
            n = 2 * (j + 1)
            step = h / n
            z0, z1 = y, [u + step * f for u, f in zip(y, rhs(y), strict=True)]
            for _ in range(1, n):
                z0, z1 = z1, [u + 2 * step * f for u, f in zip(z0, rhs(z1), strict=True)]
            row = [[(u + v + step * f) / 2 for u, v, f in zip(z0, z1, rhs(z1), strict=True)]]
            for m in range(1, j + 1):
                ratio = (mp.mpf(j + 1) / (j + 1 - m)) ** 2 - 1
                row.append(
                    [u + (u - v) / ratio for u, v in zip(row[m - 1], table[j - 1][m - 1], strict=True)]
                )
            table.append(row)
        y = table[-1][-1]
    return y


def motion(
    rhs: Callable[[State], State],
    start: Sequence[mp.mpf],
    end: float,
    intervals: int,
    answers: Callable[[State], list[mp.mpf]],
) -> tuple[list[mp.mpf], float]:
    """The answers on the finer of two grids, and the greatest difference between the grids."""
    coarse, fine = (
        answers(midpoint_extrapolated(rhs, start, end, n)) for n in (intervals, intervals * 3 // 2)
    )
    return fine, float(max(abs(a - b) for a, b in zip(coarse, fine, strict=True)))


# ---- the file ----


def entry(
    origin: str,
    columns: Sequence[str],
    answers: Sequence[Sequence[mp.mpf]],
    names: Sequence[str] = (),
    cases: Sequence[Sequence[float]] = ((),),
    slow: int = 1,
    agreement: float | None = None,
) -> dict[str, Any]:
    """One problem; answers beyond the columns of the peers are under their own names in `more`."""
    texts = [[mp.nstr(x, STORED) for x in row] for row in answers]
    found = {"origin": origin, "columns": list(columns), "names": list(names), "slow": slow}
    if agreement is not None:
        found["agreement"] = f"{agreement:.1e}"
    return {**found, "cases": [list(case) for case in cases], "answers": texts}


def sphere_entry() -> dict[str, Any]:
    """Random cases; those that stand for all come first: every tenth in the order of the bars they pass."""
    rng = np.random.default_rng(SPHERE_SEED)
    d = rng.uniform(1 / 12, 6 / 12, SPHERE_DRAWN)[:SPHERE_CASES] * FOOT
    omega0 = rng.uniform(1.0, 3.0, SPHERE_DRAWN)[:SPHERE_CASES]
    cases = [(float(a), float(b)) for a, b in zip(d, omega0, strict=True)]
    answers = [sphere(*case) for case in cases]
    every = SPHERE_CASES // SPHERE_SLOW
    order = sorted(range(SPHERE_CASES), key=lambda i: (answers[i][1], i))
    first = order[every // 2 :: every]
    order = first + [i for i in range(SPHERE_CASES) if i not in first]
    found = entry(
        "energy about each bar and angular momentum about the struck one, as a recursion",
        ("omega_B", "bars_passed"),
        [answers[i][:2] for i in order],
        ("d", "omega0"),
        [cases[i] for i in order],
        SPHERE_SLOW,
    )
    more = {"min_normal_over_weight": 2, "friction_needed": 3}
    return {
        **found,
        "more": {key: [mp.nstr(answers[i][c], STORED) for i in order] for key, c in more.items()},
    }


def collar_entry() -> dict[str, Any]:
    side = range(COLLAR_SIDE)
    grid = [(0.3 * i / (COLLAR_SIDE - 1), 0.5 + 1.5 * j / (COLLAR_SIDE - 1)) for i in side for j in side]
    every = len(grid) // COLLAR_SLOW
    cases = grid[every // 2 :: every] + [case for i, case in enumerate(grid) if i % every != every // 2]
    answers = [collar(*case) for case in cases]
    found = entry(
        "conservation of energy; quadrature of 1/omega over the turn",
        ("omega_above", "time_of_turn"),
        [row[:2] for row in answers],
        ("d", "mass_ratio"),
        cases,
        COLLAR_SLOW,
    )
    more = {"min_normal_over_weight": 2, "friction_needed": 3}
    return {**found, "more": {key: [mp.nstr(row[c], STORED) for row in answers] for key, c in more.items()}}


def all_entries() -> dict[str, Any]:
    grids = f"midpoint rule extrapolated to order 24 in {DIGITS} digits, two grids"
    pendulum, pendulum_agreement = motion(
        double_pendulum_rhs,
        [0, 0, 0, 0],
        5,
        200,
        lambda y: [mp.cos(y[0]) + mp.cos(y[1]), mp.sin(y[0]) + mp.sin(y[1])],
    )
    crank, crank_agreement = motion(slider_crank_rhs, [mp.pi / 4, 10], 10, 1200, lambda y: y[:1])
    found = {
        "sphere_over_bars": sphere_entry(),
        "rolling_collar": collar_entry(),
        "linkage_c5": entry(
            "conservation of energy; quadrature of 1/omega for the time",
            (*(f"omega at {mark} deg" for mark in Linkage.marks_deg), "v_D", "time"),
            [linkage()],
        ),
        "double_pendulum": entry(grids, ("tip_x", "tip_y"), [pendulum], agreement=pendulum_agreement),
        "slider_crank": entry(grids, ("crank_angle",), [crank], agreement=crank_agreement),
        "zeno_ball": entry("sum of the geometric series", ("first", "rest"), [ball()]),
        "pendulum_a01": entry("Jacobi's elliptic function cd", ("x", "y"), [simple_pendulum()]),
    }
    for n in (2, 40):
        angle, agreement = motion(four_bars_rhs(n), [mp.pi / 2, -1], 10, 300, lambda y: y[:1])
        found[f"four_bars_{n}"] = entry(
            f"{grids}, one coordinate", ("angle", "energy"), [[*angle, mp.mpf(0)]], agreement=agreement
        )
    return found


def main() -> None:
    with mp.workdps(DIGITS):
        found = all_entries()
    REFERENCES.write_text(as_text(found), encoding="utf-8")


def as_text(found: dict[str, Any]) -> str:
    """JSON with a line for each case, so that the file can be read and its changes are small."""
    problems = []
    for name, one in found.items():
        lines = []
        for key, value in one.items():
            text = json.dumps(value)
            if key in ("cases", "answers"):
                text = "[\n" + ",\n".join(f"   {json.dumps(row)}" for row in value) + "\n  ]"
            lines.append(f"  {json.dumps(key)}: {text}")
        problems.append(f" {json.dumps(name)}: {{\n" + ",\n".join(lines) + "\n }")
    return "{\n" + ",\n".join(problems) + "\n}\n"


if __name__ == "__main__":
    main()
