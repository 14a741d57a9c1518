"""Estimated errors hold on scenes that nobody has tuned for: the quick part of `make calibrate`."""

from __future__ import annotations

import random
from collections.abc import Callable

import mpmath as mp
import pytest

from studies.benchmarks.calibration import Tally, tally
from studies.benchmarks.drawn import KINDS
from studies.benchmarks.known import Known

SCENES = {"crank": 2, "two_rods": 1}  # truths that take seconds; of the others more


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_true_errors_lie_below_their_estimates(kind: Callable[[random.Random], Known]) -> None:
    """Nearly all do, and hardly any is ten times as great where the run ends as ok."""
    draw, totals = random.Random(5), Tally()
    with mp.workdps(40):
        scenes = [kind(draw) for _ in range(SCENES.get(kind.__name__, 12))]
    for known in scenes:
        for route, powers in known.accuracies.items():
            totals.add(tally(known, route, 10.0 ** -powers[0]))
    assert totals.beyond <= 2
    assert totals.share() >= 0.9
    assert totals.unanswered == 0
