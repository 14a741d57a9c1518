"""A quick part of `python -m tests.stress.misses`, and that its truth is one."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import planemotion
from planemotion.engine.call import run_cases
from tests.stress.misses import asks, peaks, pulses, tops, waves
from tests.stress.misses.motions import END, GRAVITY, SCENES, place
from tests.stress.misses.verdict import BEYOND, MISSED, RIGHT

CASES = 60


def words_of(kind: Any, seeds: int, n: int) -> Counter[str]:
    """What became of n cases of each of the first seeds."""
    return Counter(word for seed in range(seeds) for word in kind.table(seed, n)[1].words)


@pytest.mark.parametrize("kind", [pulses, waves])
def test_nothing_short_is_missed(kind: object) -> None:
    found = words_of(kind, 8, CASES)
    assert found[MISSED] == found[BEYOND] == 0
    assert found[RIGHT] > 0.85 * 8 * CASES


def test_no_peak_with_corners_is_missed() -> None:
    """Extremes and counts of expressions with abs, min, max, floor and comparisons, beside their pieces."""
    found = words_of(peaks, 60, 2)
    assert found[MISSED] == found[BEYOND] == 0
    assert found[RIGHT] > 0.95 * 120


def test_asks_of_narrow_features_are_right() -> None:
    """Counts, extremes and integrals of features behind max, min, abs, a gate, a square or exp."""
    found = words_of(asks, 20, 3)
    assert found[MISSED] == found[BEYOND] == 0
    assert found[RIGHT] > 0.95 * 60


def test_the_truth_of_asks_is_that_of_many_times() -> None:
    for seed in range(12):
        ask, (p,) = asks.cases_of(seed, 1)
        (ups, high, low, area), is_open = asks.truth_of(ask, p)
        t = np.linspace(0, tops.END[ask.move], 400_001)
        g = ask.value(p, np.array([tops.place(ask.move, p["v"], float(one)) for one in t]))
        assert g.max() <= high + 1e-8
        assert g.min() >= low - 1e-8
        np.testing.assert_allclose(np.trapezoid(g, t), area, atol=2e-5)
        assert is_open or ups == ((g[:-1] <= p["c"]) & (g[1:] > p["c"])).sum()


@pytest.mark.parametrize(
    ("move", "route"), [(move, route) for move, routes in tops.ROUTES.items() for route in routes]
)
def test_narrow_tops_are_exact(move: str, route: str) -> None:
    """Beside ends of windows, where half of a top looks like a straight line, and in one node by chance."""
    for i, shape in enumerate(tops.SHAPES):
        for behind in tops.BEHIND:
            off, cases = tops.table(tops.Top(move, route, shape, behind), i, 12)
            wrong = np.flatnonzero(off > tops.EXACT.get(shape, 1e-11))
            assert len(wrong) == 0, (shape, behind, off[wrong], cases[wrong[0]])
            assert np.isnan(off).sum() == 0


@pytest.mark.parametrize("motion", SCENES)
def test_the_motions_keep_their_energy(motion: str) -> None:
    t = np.linspace(0, END[motion], 50)
    p = {"v": 0.8, "u": 2.0, "q": 1.7}
    at = place(motion, p, t)
    energy = {
        "flies": lambda: 0.5 * at["speed"] ** 2 + 9.81 * at["y"],
        "swings": lambda: 0.5 * (1.5**2 / 3) * at["omega"] ** 2 + 9.81 * 0.5 * at["y"],
        "springs": lambda: at["speed"] ** 2 + 36 * at["x"] ** 2,
    }[motion]()
    np.testing.assert_allclose(energy, energy[0], rtol=1e-12)


def test_the_truth_of_peaks_is_that_of_many_places() -> None:
    for seed in range(30):
        peak, (p,) = peaks.cases_of(seed, 1)
        (_, high, low), _ = peaks.truth_of(peak, p)
        g = peak.value(p, np.linspace(0, END[peak.motion], 20_001)[1:-1])
        assert g.max() <= high + 1e-8
        assert g.min() >= low - 1e-8


def test_a_jump_counts_once() -> None:
    """Teeth of a force that scatters about a jump: rises on the way up, jumps on the way down, enumerated."""
    peak, cases = peaks.cases_of(311, 5)
    p = cases[4]
    (flat,) = planemotion.load_text(peak.text).tables()
    found = run_cases(flat, np.array([[{**p, "g": GRAVITY}[name] for name in flat.parameters]]))
    turns = np.array(peaks._turns(peak, p, peak.x))
    teeth = (place(peak.motion, p, turns)[peak.x] - p["a"]) / (p["w"] + 0.05)
    up = sum(max(b - a, 0) for a, b in pairwise(np.floor(teeth - p["level"])))
    assert found.out[0, 0] == up + sum(max(a - b, 0) for a, b in pairwise(np.floor(teeth)))


def test_no_coordinate_leaves_the_steps_of_the_truth() -> None:
    for seed in range(400):
        peak, (p,) = peaks.cases_of(seed, 1)
        if peak.name in ("stairs", "teeth"):
            x = place(peak.motion, p, np.linspace(0, END[peak.motion], 1000))[peak.x]
            levels = [level for _, level in peaks.EXPRESSIONS[peak.name][1](p)]
            assert min(levels) < x.min()
            assert x.max() < max(levels)


def test_the_truth_beside_a_corner_is_within_bounds() -> None:
    """What stands between 0 and 1, or 0 and 0.4, whose pieces end right beside a corner."""
    for seed, case, greatest in ((354, 0, 0.4), (271, 5, 1.0)):
        peak, cases = peaks.cases_of(seed, case + 1)
        (_, high, low), _ = peaks.truth_of(peak, cases[case])
        assert 0 <= low < high <= greatest + 1e-12


def test_a_sample_in_a_pulse_does_not_tell_it() -> None:
    """A bell of 4 us with one of nine samples in it by chance; half sines, zero at both ends of a step."""
    for seed, cases in ((4, 200), (3, 40)):
        _, verdict, _ = pulses.table(seed, cases)
        assert Counter(verdict.words)[MISSED] == 0


@pytest.mark.parametrize(
    ("shape", "route"),
    [("rectangle", ""), ("rectangle", "rk"), ("bell", ""), ("bell", "rk"), ("half sine", "rk")],
)
def test_what_rounding_times_does_to_narrow_pulses_is_told(shape: str, route: str) -> None:
    """A time is a double: what a pulse of a few microseconds gives is known to no more than 1e-10 of it."""
    rng = np.random.default_rng(7)
    (flat,) = planemotion.load_text(pulses.Train((shape,), spring=False, route=route).text()).tables()
    n = 300
    impulse, middle, width = rng.uniform(0.1, 1, n), rng.uniform(0.1, 0.9, n), 10 ** rng.uniform(-6, -5, n)
    columns = {"g": np.full(n, 9.81), "J0": impulse, "c0": middle, "w0": width}
    found = run_cases(flat, np.stack([columns[name] for name in flat.parameters], axis=1))
    whole = {"rectangle": 1.0, "bell": np.sqrt(np.pi), "half sine": 2 / np.pi}[shape] * impulse
    off = np.abs(found.out - np.stack([whole, whole * (1 - middle)], axis=1))
    assert (found.status == 0).all()
    assert (off > 10 * found.error).mean() <= 5e-3
    assert (off > found.error).mean() <= 0.1


@pytest.mark.parametrize("motion", waves.MOTIONS)
def test_the_truth_of_waves_is_that_of_many_places(motion: str) -> None:
    rng = np.random.default_rng(5)
    n, p, c, v = (
        10 ** rng.uniform(-1, 1, 40),
        rng.uniform(-3, 3, 40),
        rng.uniform(-0.9, 0.9, 40),
        rng.uniform(0.5, 5, 40),
    )
    truth, edge = waves.truth_of(motion, n, p, c, v)
    t = np.linspace(0, 1, 200_001)[:, None]
    x = {"goes on": v * t, "comes back": v * t - 3 * t**2, "swings": v / 6 * np.sin(6 * t)}[motion]
    wave = np.cos(2 * np.pi * n * x + p)
    dips = ((wave[:-1] >= c) & (wave[1:] < c)).sum(axis=0)
    many = np.stack([dips, wave.max(axis=0), wave.min(axis=0)], axis=1)
    np.testing.assert_allclose(many[edge == 0], truth[edge == 0], atol=1e-6)
    assert edge.sum() < 3


@pytest.mark.parametrize("shape", pulses.SHAPES)
def test_the_truth_of_pulses_is_their_integral(shape: str) -> None:
    impulse, middle, width = np.array([0.7, -0.3]), np.array([0.4, 0.98]), np.array([0.05, 0.3])
    t = np.linspace(0, 1, 2_000_001)
    for i in range(2):
        u = (t - middle[i]) / width[i]
        force = {
            "rectangle": np.abs(u) < 0.5,
            "bell": np.exp(-(u**2)),
            "half sine": np.cos(np.pi * u) * (np.abs(u) < 0.5),
        }[shape] * (impulse[i] / width[i])
        speed, place = pulses._integral(shape, impulse[[i]], middle[[i]], width[[i]], spring=False)
        np.testing.assert_allclose(speed[0], np.trapezoid(force, t), atol=1e-5)
        np.testing.assert_allclose(place[0], np.trapezoid(force * (1 - t), t), atol=1e-5)
