"""What rests while something else moves has velocities of rounding: they are no motion."""

from __future__ import annotations

import numpy as np
import pytest

import planemotion
from planemotion import _layout as layout
from planemotion.compile.flatten import flatten
from planemotion.engine import call
from tests import CHAPTER


@pytest.mark.parametrize("seed", [11, 12, 13])
@pytest.mark.parametrize("route", ["auto", "rk"])
def test_a_velocity_of_rounding_ends_no_run(route: str, seed: int) -> None:
    """A gymnast stands on a plank until the other one lands: by free fall at sqrt(2 g h)."""
    scene = planemotion.load(CHAPTER / "17-126.toml").with_values({"solve.route": route})
    flat = flatten(scene, history=False)
    factor = np.exp(np.random.default_rng(seed).normal(0, 0.15, (200, len(flat.parameters))))
    values = np.asarray(flat.defaults) * factor
    g, h = (values[:, list(flat.parameters).index(name)] for name in "gh")
    results = call.run_cases(flat, values)
    landing = next(column.first for column in flat.asks if column.key == "check_v_before")
    assert np.all(results.status == layout.PM_OK)
    assert results.out[:, landing] == pytest.approx(np.sqrt(2 * g * h), rel=1e-9)
