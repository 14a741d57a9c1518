"""Estimated errors against true ones: `make calibrate`.

    .venv/bin/python -m studies.benchmarks.calibration          tables; exit status 1 if a target is missed
    .venv/bin/python -m studies.benchmarks.calibration renew    compute the stored truths again (minutes)

Scenes whose answers are known - closed forms, quadratures and integrations in 30 digits that share nothing
with the engine, the chapter's reference figures - are run at many accuracies, on the default route and on
both time routes.  Two things are wanted of the estimates: the true error, counted as at least 1e-14, lies
below the estimate in at least 95 % of the asks, and the estimate is within 100 times of it in the median.
The values of a list weigh as one ask.  A scene that needs very many steps on a route is run at its first
accuracy alone; the table tells how many runs were left out so.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import sys
import time
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np

import planemotion
from planemotion._layout import (
    PM_COUNT_PASSES,
    PM_COUNT_RUNS,
    PM_COUNT_SOLVES,
    PM_OK,
    PM_TRUST_EXCESS,
    PM_UNDECIDED,
)
from planemotion.compile.flatten import flatten
from planemotion.engine import call, messages
from studies.benchmarks.truths import G_SI, INCH, collar_reference, gragg_extrapolation, sphere_reference

STUDIES = Path(__file__).parent.parent
CHAPTER = STUDIES / "chapter17"
CHAPTER_TRUTH = STUDIES.parent / "tests" / "chapter17" / "reference.toml"
STORED = Path(__file__).with_name("calibration_truth.toml")

LEAST_TRUE_ERROR = 1e-14  # relative: closer than that the truths themselves are not known
COVERED = 0.95
WITHIN = 100.0
COSTLY = 2e6  # solves of one run, all its passes: some seconds; tighter accuracies take as long or longer
ACCURACIES = {
    "auto": np.arange(4, 12.1, 0.5),
    "rk": np.arange(4, 12.1, 0.5),
    "ida": np.arange(4, 10.1, 0.5),
}
CHAPTER_ACCURACIES = {"auto": (5, 7, 9, 10, 11), "rk": (5, 7, 9, 10, 11), "ida": (5, 7, 9)}

Truth = dict[str, "float | list[float]"]


@dataclass(frozen=True)
class Known:
    """A scene, its parameters, and what its asks are."""

    name: str
    scene: planemotion.Scene
    truth: Truth
    accuracies: Mapping[str, Any] = field(default_factory=lambda: ACCURACIES)


# ---- truths ---------------------------------------------------------------------------------------------


def pendulum() -> Iterator[Known]:
    scene = planemotion.load(STUDIES / "pendulum.toml")
    for length in (0.3, 0.7, 1.2, 2.9):
        with mp.workdps(30):
            g, size = mp.mpf(str(G_SI)), mp.mpf(str(length))
            angles = [mp.radians(a) for a in range(10, 91, 10)]
            truth: Truth = {
                "omega": -float(mp.sqrt(3 * g / size)),
                "time": float(mp.ellipk(mp.mpf(1) / 2) * mp.sqrt(2 * size / (3 * g))),
                "A_over_weight": 2.5,
                "speed_at_angles": [float(mp.sqrt(3 * g * size * mp.sin(a))) for a in angles],
            }
        yield Known("pendulum", scene.with_values({"L": f"{length} m"}), truth)


def collar_extremes(d: float, ratio: float, r: float = 0.3, omega: float = 15.0) -> tuple[float, float]:
    """Least normal force over the weight and greatest friction over normal force in one turn, m = 1."""
    d, ratio, omega, r, g = (mp.mpf(str(x)) for x in (d, ratio, omega, r, G_SI))

    def motion(x: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
        """omega^2 and alpha after the angle x, from the energy and its slope."""
        inertia = 2 * r**2 + ratio * (r**2 + d**2 - 2 * r * d * mp.cos(x))
        slope = 2 * ratio * r * d * mp.sin(x)
        energy = (2 * r**2 + ratio * (r - d) ** 2) * omega**2 - 2 * ratio * g * d * (1 - mp.cos(x))
        square = energy / inertia
        return square, (-2 * ratio * g * d * mp.sin(x) - slope * square) / inertia / 2

    def normal(x: mp.mpf) -> mp.mpf:
        square, alpha = motion(x)
        return (1 + ratio) * g + ratio * d * (mp.sin(x) * alpha + mp.cos(x) * square)

    def needed(x: mp.mpf) -> mp.mpf:
        square, alpha = motion(x)
        friction = r * alpha + ratio * (r * alpha - d * (mp.cos(x) * alpha - mp.sin(x) * square))
        return -abs(friction) / normal(x)

    return float(least(normal) / ((1 + ratio) * g)), -float(least(needed))


def least(f: Callable[[mp.mpf], mp.mpf], cells: int = 720) -> mp.mpf:
    """The least value over a turn: the best of many places, then ternary search around it."""
    step = 2 * mp.pi / cells
    best = min((step * i for i in range(cells + 1)), key=f)
    low, high = best - step, best + step
    for _ in range(160):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if f(a) < f(b) else (a, high)
    return f((low + high) / 2)


def collar() -> Iterator[Known]:
    scene = planemotion.load(STUDIES / "rolling_collar.toml")
    for d, ratio in ((0.05, 1), (0.1, 0.5), (0.15, 2), (0.2, 1), (0.25, 0.5)):
        with mp.workdps(30):
            above, turn = collar_reference(d, ratio)
            normal, friction = collar_extremes(d, ratio)
        truth: Truth = {
            "omega_above": above,
            "time_of_turn": turn,
            "min_normal_over_weight": normal,
            "friction_needed": friction,
        }
        yield Known("rolling collar", scene.with_values({"d": f"{d} m", "mass_ratio": ratio}), truth)


def bouncing_ball() -> Iterator[Known]:
    scene = planemotion.load(STUDIES / "bouncing_ball.toml")
    for e in (0.5, 0.8, 0.9):
        with mp.workdps(30):
            g, q, h = mp.mpf(str(G_SI)), mp.mpf(str(e)), mp.mpf(1)
            fall, speed = mp.sqrt(2 * h / g), mp.sqrt(2 * g * h)
            blows = [fall * (1 + 2 * sum((q**k for k in range(1, n + 1)), mp.mpf(0))) for n in range(10)]
            truth: Truth = {
                "time": float(blows[-1]),
                "blow_times": [float(t) for t in blows],
                "height_1": float(q**2 * h),
                "speed_before_1": float(speed),
                "speed_after_1": float(q * speed),
                "lost_in_last_blow": float(mp.mpf("0.1") / 2 * (speed * q**9) ** 2 * (1 - q**2)),
            }
        yield Known("bouncing ball", scene.with_values({"e": e}), truth)


def sphere() -> Iterator[Known]:
    raw = planemotion.load(STUDIES / "sphere_over_bars.toml").raw
    ask = {
        "omegas": {"of": "-sphere.omega", "at": "each over", "unit": "rad/s"},
        "bars_passed": "over.count",
    }
    scene = planemotion.Scene.from_raw({**raw, "ask": ask})
    for d, r, omega in (
        (1.8, 10, 1.5),
        (2.2, 10, 1.7),
        (3, 10, 1.5),
        (4, 10, 2.1),
        (6, 10, 2.6),
        (3, 7, 2.0),
    ):
        squares = sphere_squares(d * INCH, r * INCH, omega)
        truth: Truth = {
            "omegas": [float(mp.sqrt(x)) for x in squares[:64]],
            "bars_passed": float(len(squares)),
        }
        assert len(squares) == sphere_reference(d * INCH, r * INCH, omega)[1]
        values = {"d": f"{d} in", "r": f"{r} in", "omega0": f"{omega} rad/s"}
        yield Known("sphere over bars", scene.with_values(values), truth)


def sphere_squares(d: float, r: float, omega0: float) -> list[mp.mpf]:
    """omega^2 above each bar that is passed."""
    with mp.workdps(40):
        d, r, omega0, g = (mp.mpf(x) for x in (d, r, omega0, 32.2 * 0.3048))
        beta = mp.asin(d / (2 * r))
        c, k = 10 * g / (7 * r) * (1 - mp.cos(beta)), (2 + 5 * mp.cos(2 * beta)) / 7
        square, passed = omega0**2, []
        while (square := k**2 * (square + c) - c) > 0:
            passed.append(square)
        return passed


def stored() -> Iterator[Known]:
    """Motions that have no closed form."""
    truths = tomllib.loads(STORED.read_text(encoding="utf-8"))
    for name in ("double_pendulum", "slider_crank"):
        scene = planemotion.load(STUDIES / f"{name}.toml")
        for entry in truths[name]:
            cut = planemotion.Scene.from_raw({**scene.raw, "until": f"t = {entry['t']} s"})
            yield Known(name.replace("_", " "), cut, {k: v for k, v in entry.items() if k != "t"})


def chapter() -> Iterator[Known]:
    truths = tomllib.loads(CHAPTER_TRUTH.read_text(encoding="utf-8"))
    for path in sorted(CHAPTER.glob("*.toml")):
        scene = planemotion.load(path)
        asks = truths[scene.id]
        truth = {key: ask["value"] for key, ask in asks.items() if key != "instances" and "value" in ask}
        if truth:
            yield Known("the chapter", scene, truth, CHAPTER_ACCURACIES)


# ---- the motions without closed form --------------------------------------------------------------------


def renew() -> None:
    """Writes calibration_truth.toml: hand-derived equations of motion, extrapolation, 30 digits."""
    lines = [
        "# Motions without closed form: hand-derived equations, extrapolated midpoint rule of order 24,",
        "# 30 digits.  Written by `calibration.py renew`; two numbers of intervals agree to 1e-17.",
    ]
    with mp.workdps(30):
        for t, intervals in ((1, 100), (2, 200), (5, 600)):
            a, b = agreed(
                partial(gragg_extrapolation, double_pendulum, [mp.mpf(0)] * 4, mp.mpf(t)), intervals
            )[:2]
            values = {
                "tip_x": mp.cos(a) + mp.cos(b),
                "tip_y": mp.sin(a) + mp.sin(b),
                "upper_angle": a,
                "lower_angle": b,
            }
            lines += entry("double_pendulum", t, values)
        for t, intervals in ((1, 300), (3, 900), (10, 3000)):
            start = [mp.pi / 4, mp.mpf(10)]
            th = agreed(partial(gragg_extrapolation, slider_crank, start, mp.mpf(t)), intervals)[0]
            a, length = mp.mpf("0.1"), mp.mpf("0.3")
            piston = a * mp.cos(th) + mp.sqrt(length**2 - (a * mp.sin(th)) ** 2)
            lines += entry("slider_crank", t, {"crank_angle": th, "piston_x": 1000 * piston})
    STORED.write_text("\n".join(lines) + "\n", encoding="utf-8")


def agreed(solve: Callable[[int], list[mp.mpf]], intervals: int) -> list[mp.mpf]:
    fine, coarse = solve(intervals), solve(intervals * 4 // 5)
    apart = max(abs(x - y) for x, y in zip(fine, coarse, strict=True))
    assert apart < mp.mpf(10) ** -17, apart
    return fine


def entry(name: str, t: int, values: dict[str, mp.mpf]) -> list[str]:
    return ["", f"[[{name}]]", f"t = {t}", *(f"{key} = {mp.nstr(x, 20)}" for key, x in values.items())]


def double_pendulum(_t: mp.mpf, y: list[mp.mpf]) -> list[mp.mpf]:
    """Two rods of 1 m and 1 kg: angles and their rates."""
    a, b, wa, wb = y
    g, inertia = mp.mpf("9.81"), mp.mpf(1) / 12
    c, s = mp.cos(a - b), mp.sin(a - b)
    m11, m22, m12 = inertia + mp.mpf(5) / 4, inertia + mp.mpf(1) / 4, c / 2
    f1 = -mp.mpf(3) / 2 * g * mp.cos(a) - s / 2 * wb * wb
    f2 = -g / 2 * mp.cos(b) + s / 2 * wa * wa
    det = m11 * m22 - m12 * m12
    return [wa, wb, (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det]


def slider_crank(_t: mp.mpf, y: list[mp.mpf]) -> list[mp.mpf]:
    """Crank 0.1 m, rod 0.3 m, masses 0.2, 0.2, 0.4 kg: I(th) th'' + I'(th) th'^2 / 2 = M(th)."""
    a, length, m1, m2, m3, g = (mp.mpf(x) for x in ("0.1", "0.3", "0.2", "0.2", "0.4", "9.81"))
    s, c = mp.sin(y[0]), mp.cos(y[0])
    root = mp.sqrt(length**2 - (a * s) ** 2)
    rate = a * c / root  # of the rod per unit rate of the crank
    slope = (-a * s * root + a * c * a**2 * s * c / root) / root**2
    x2, y2, x3 = -a * s - a * s * rate / 2, a * c / 2, -a * s - a * s * rate
    dx2, dy2 = -a * c - (a * c * rate + a * s * slope) / 2, -a * s / 2
    dx3 = -a * c - a * c * rate - a * s * slope
    inertia = m1 * a**2 / 3 + m2 * (x2**2 + y2**2 + length**2 / 12 * rate**2) + m3 * x3**2
    change = 2 * (m2 * (x2 * dx2 + y2 * dy2 + length**2 / 12 * rate * slope) + m3 * x3 * dx3)
    return [y[1], -(change * y[1] ** 2 / 2 + g * a / 2 * (m1 + m2) * c) / inertia]


# ---- the comparison -------------------------------------------------------------------------------------


@dataclass
class Tally:
    """Weights and ratios of the asks of one row of the table."""

    covered: list[float] = field(default_factory=list)
    ratio: list[float] = field(default_factory=list)
    weight: list[float] = field(default_factory=list)
    kept: list[bool] = field(default_factory=list)
    runs: int = 0
    passes: int = 0
    undecided: int = 0
    unanswered: int = 0
    wrong_counts: int = 0
    left_out: int = 0
    solves: float = 0
    seconds: float = 0
    said: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)

    def share(self) -> float:
        return float(np.average(self.covered, weights=self.weight))

    def median(self) -> float:
        order = np.argsort(self.ratio)
        total = np.cumsum(np.asarray(self.weight)[order])
        return float(np.asarray(self.ratio)[order][np.searchsorted(total, total[-1] / 2)])


def tally(known: Known, route: str, accuracy: float) -> Tally:
    """One run, compared."""
    scene = known.scene.with_values(
        {"solve.route": route, "solve.accuracy": accuracy, "solve.max_steps": 10**8}
    )
    flat = flatten(scene)
    results = call.run_cases(flat, np.atleast_2d(flat.defaults))
    status = int(results.status[0])
    counts = [int(number) for number in results.count[0]]
    row = Tally(runs=1, passes=counts[PM_COUNT_PASSES], undecided=int(status == PM_UNDECIDED))
    row.solves = counts[PM_COUNT_PASSES] * max(counts[PM_COUNT_RUNS], 1) * counts[PM_COUNT_SOLVES]
    if status not in (PM_OK, PM_UNDECIDED):
        row.unanswered = 1  # declined by the route, or not trusted: the run says so
        message = messages.message(flat, results, 0).removeprefix(f"{flat.file}: ")
        row.said.append(f"{scene.id}, {route}, {accuracy:g}: {message}")
        return row
    row.kept.append(bool(results.trust[0, PM_TRUST_EXCESS] <= 1))
    for column in flat.asks:
        if column.key not in known.truth:
            continue
        truth = np.atleast_1d(known.truth[column.key])
        columns = slice(column.first, column.first + truth.size)
        found, error = results.out[0, columns] / column.factor, results.error[0, columns] / column.factor
        if np.isfinite(results.margin[0, flat.asks.index(column)]):
            row.wrong_counts += int(status == PM_OK and found[0] != truth[0])
            continue
        for value, estimate, wanted in zip(found, error, truth, strict=True):
            least_error = LEAST_TRUE_ERROR * (abs(wanted) or 1.0)
            true = max(abs(value - wanted), least_error)
            row.covered.append(true <= estimate)
            row.ratio.append(estimate / true if math.isfinite(estimate) else math.inf)
            row.weight.append(1 / truth.size)
    return row


def tallies(known: Known, route: str) -> Tally:
    """The runs of a scene on a route at its accuracies, from the loosest on."""
    begun, total = time.process_time(), Tally()
    powers = list(known.accuracies[route])
    for done, power in enumerate(powers, 1):
        row = tally(known, route, 10.0 ** -float(power))
        total.add(row)
        if row.solves > COSTLY and done < len(powers):
            total.left_out += len(powers) - done
            total.said.append(f"{known.scene.id}, {route}: {row.solves:.1e} solves: at 1e-{power:g} only")
            break
    total.seconds = time.process_time() - begun
    return total


def compare() -> dict[tuple[str, str], Tally]:
    """A row for each scene and route, computed on all cores."""
    sources = (pendulum, collar, bouncing_ball, sphere, stored, chapter)
    jobs = [(known, route) for source in sources for known in source() for route in known.accuracies]
    JOBS.extend(jobs)
    rows: dict[tuple[str, str], Tally] = {}
    # The children of a fork know the jobs; what they hand back is numbers.
    with multiprocessing.get_context("fork").Pool(os.cpu_count()) as pool:
        for (known, route), row in zip(jobs, pool.imap(job, range(len(jobs))), strict=True):
            print("".join(f"{line}\n" for line in row.said), end="", file=sys.stderr, flush=True)
            rows.setdefault((known.name, route), Tally()).add(row)
    return rows


JOBS: list[tuple[Known, str]] = []


def job(i: int) -> Tally:
    return tallies(*JOBS[i])


def show(rows: dict[tuple[str, str], Tally]) -> bool:
    """Prints the table; whether both targets are reached on every route."""
    header = ("scene", "route", "runs", "passes", "asks", "true <= estimate", "median estimate / true")
    more = ("accuracy kept", "undecided", "no answer", "wrong counts", "left out", "CPU s")
    print("|", " | ".join((*header, *more)), "|")
    print("|" + 13 * "---|")
    totals: dict[str, Tally] = {}
    for (_, route), row in rows.items():
        totals.setdefault(route, Tally()).add(row)
    for (name, route), row in [*rows.items(), *((("all", route), row) for route, row in totals.items())]:
        print(
            f"| {name} | {route} | {row.runs} | {row.passes / row.runs:.2f} | {sum(row.weight):.0f} "
            f"| {100 * row.share():.1f} % | {row.median():.1f} | {100 * np.mean(row.kept):.0f} % "
            f"| {row.undecided} | {row.unanswered} "
            f"| {row.wrong_counts} | {row.left_out} | {row.seconds:.0f} |"
        )
    return all(
        row.share() >= COVERED and row.median() <= WITHIN and row.wrong_counts == 0 for row in totals.values()
    )


# ---- what it costs --------------------------------------------------------------------------------------


def cost() -> None:
    """Time with the estimate over time without, at the same accuracy."""
    print("\n| scene | route | accuracy | without [ms] | with [ms] | ratio | passes |")
    print("|---|---|---|---|---|---|---|")
    names = (
        "pendulum",
        "rolling_collar",
        "bouncing_ball",
        "sphere_over_bars",
        "double_pendulum",
        "slider_crank",
    )
    for name in names:
        for route, accuracy in (("rk", 1e-6), ("rk", 1e-8), ("rk", 1e-10), ("ida", 1e-8)):
            if route == "ida" and name in ("sphere_over_bars", "slider_crank"):
                continue  # minutes, and no other ratio
            times, passes = [], 1
            for estimate in (False, True):
                settings = {"solve.route": route, "solve.accuracy": accuracy, "solve.estimate": estimate}
                flat = flatten(planemotion.load(STUDIES / f"{name}.toml").with_values(settings))
                param = np.atleast_2d(flat.defaults)
                times.append(min(seconds(flat, param) for _ in range(5)))
                passes = int(call.run_cases(flat, param).count[0, PM_COUNT_PASSES])
            print(
                f"| {name} | {route} | {accuracy:.0e} | {1e3 * times[0]:.2f} | {1e3 * times[1]:.2f} "
                f"| {times[1] / times[0]:.2f} | {passes} |"
            )


def seconds(flat: Any, param: np.ndarray) -> float:
    begun = time.process_time()
    call.run_cases(flat, param)
    return time.process_time() - begun


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", nargs="?", choices=("compare", "renew"), default="compare")
    if parser.parse_args().what == "renew":
        renew()
        return 0
    good = show(compare())
    cost()
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
