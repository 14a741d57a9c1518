"""Scenes whose answers are known, for the calibration of error estimates.

Closed forms, quadratures and integrations in 30 digits that share nothing with the engine, and the chapter's
reference figures.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np

import planemotion
from studies.benchmarks.truths import (
    G_SI,
    INCH,
    RollingCollar,
    double_pendulum,
    midpoint_extrapolated,
    slider_crank,
    sphere_squares,
)

STUDIES = Path(__file__).parent.parent
CHAPTER = STUDIES / "chapter17"
CHAPTER_TRUTH = STUDIES.parent / "tests" / "chapter17" / "reference.toml"
STORED = Path(__file__).with_name("calibration_truth.toml")

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


def collar() -> Iterator[Known]:
    scene = planemotion.load(STUDIES / "rolling_collar.toml")
    for d, ratio in ((0.05, 1), (0.1, 0.5), (0.15, 2), (0.2, 1), (0.25, 0.5)):
        with mp.workdps(30):
            motion = RollingCollar(d, ratio)
            truth: Truth = {
                "omega_above": float(motion.omega_above()),
                "time_of_turn": float(motion.time_of_turn()),
                "min_normal_over_weight": float(motion.least_normal_over_weight()),
                "friction_needed": float(motion.friction_needed()),
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
    raw = planemotion.load(STUDIES / "sphere_over_bars.toml").table
    ask = {
        "omegas": {"of": "-sphere.omega", "at": "each over", "unit": "rad/s"},
        "bars_passed": "over.count",
    }
    scene = planemotion.Scene.from_table({**raw, "ask": ask})
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
        values = {"d": f"{d} in", "r": f"{r} in", "omega0": f"{omega} rad/s"}
        yield Known("sphere over bars", scene.with_values(values), truth)


def stored() -> Iterator[Known]:
    """Motions that have no closed form."""
    truths = tomllib.loads(STORED.read_text(encoding="utf-8"))
    for name in ("double_pendulum", "slider_crank"):
        scene = planemotion.load(STUDIES / f"{name}.toml")
        for entry in truths[name]:
            cut = planemotion.Scene.from_table({**scene.table, "until": f"t = {entry['t']} s"})
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
                partial(midpoint_extrapolated, double_pendulum, [mp.mpf(0)] * 4, mp.mpf(t)), intervals
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
            th = agreed(partial(midpoint_extrapolated, slider_crank, start, mp.mpf(t)), intervals)[0]
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
