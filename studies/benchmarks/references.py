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

from .models import FOOT, G_SI, G_US, SPHERE_RADIUS, Linkage
from .problems import REFERENCES
from .truths import RollingCollar, State, double_pendulum, midpoint_extrapolated, slider_crank, sphere_squares

DIGITS = 30  # of the working precision
STORED = 20  # digits that are written
SPHERE_SEED, SPHERE_DRAWN, SPHERE_CASES, SPHERE_SLOW = 7, 100_000, 200, 20
COLLAR_SIDE, COLLAR_SLOW = 10, 20
BALL_HEIGHT, BALL_RESTITUTION = 1.0, 0.9


# ---- closed forms and quadratures ----


def sphere(d: float, omega0: float) -> list[mp.mpf]:
    """omega above bar B (not a number if it never gets there), bars passed, least N/W, greatest |F|/N.

    N and F from the acceleration of the centre, both worst at the end of the first arc, where the speed and
    the angle are greatest.
    """
    squares = sphere_squares(d, SPHERE_RADIUS, omega0)
    d, r, omega0, g = (mp.mpf(x) for x in (d, SPHERE_RADIUS, omega0, G_US))
    beta = mp.asin(d / (2 * r))
    normal = (17 * mp.cos(beta) - 10) / 7 - r * omega0**2 / g
    friction = mp.mpf(2) / 7 * mp.sin(beta) / normal
    return [mp.sqrt(squares[0]) if squares else mp.nan, mp.mpf(len(squares)), normal, friction]


def collar(d: float, ratio: float) -> list[mp.mpf]:
    """omega with the collar above, time of a turn, least N/W, greatest |F|/N (not a number if N vanishes)."""
    motion = RollingCollar(d, ratio)
    least = motion.least_normal_over_weight()
    needed = motion.friction_needed() if least > 0 else mp.nan
    return [motion.omega_above(), motion.time_of_turn(), least, needed]


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


def four_bars_rhs(n: int) -> Callable[[State], State]:
    """n + 1 cranks turn as one, n couplers only translate."""
    inertia, moment = mp.mpf(n + 1) / 3 + n, mp.mpf(n + 1) / 2 + n
    return lambda y: [y[1], -mp.mpf(G_SI) * moment / inertia * mp.cos(y[0])]


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
        double_pendulum,
        [0, 0, 0, 0],
        5,
        200,
        lambda y: [mp.cos(y[0]) + mp.cos(y[1]), mp.sin(y[0]) + mp.sin(y[1])],
    )
    crank, crank_agreement = motion(slider_crank, [mp.pi / 4, 10], 10, 1200, lambda y: y[:1])
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
