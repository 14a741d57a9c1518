"""Grids finer than a picture: what is drawn of them is in them, and nothing that sticks out is lost."""

from __future__ import annotations

import numpy as np
import pytest

from planemotion.pictures.condensed import condensed, middles, outline


@pytest.mark.parametrize("shape", [(12, 15), (13, 16), (3, 4)])
def test_a_dot_is_the_median_of_its_cases(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(3)
    values = rng.normal(size=shape)
    values[rng.uniform(size=shape) < 0.3] = np.nan
    made = condensed(values, (3, 4))
    for i in range(made.shape[0]):
        for j in range(made.shape[1]):
            block = values[3 * i : 3 * i + 3, 4 * j : 4 * j + 4]
            known = np.sort(block[np.isfinite(block)])
            expected = known[(len(known) - 1) // 2] if len(known) else np.nan
            np.testing.assert_equal(made[i, j], expected)


def test_a_column_of_every_third_case_makes_no_pattern() -> None:
    stripes = np.tile([1.0, 1.0, 0.0], (30, 30))
    assert condensed(stripes, (3, 3)).min() == 1


def test_a_dot_is_bad_where_one_of_its_cases_is() -> None:
    bad = np.zeros((9, 9), bool)
    bad[4, 7] = True
    assert np.argwhere(condensed(bad, (3, 3)) > 0).tolist() == [[1, 2]]


def test_middles_of_a_last_block_that_is_smaller() -> None:
    np.testing.assert_allclose(middles(np.arange(5.0), 2), [0.5, 2.5, 4])


def test_an_outline_keeps_peaks_gaps_and_places() -> None:
    x = np.linspace(0, 1, 100_000)
    y = np.sin(40 * x)
    y[31_415], y[50_000:52_000] = 7.0, np.nan
    drawn_x, drawn_y = outline(x, y, 500)
    assert len(drawn_x) <= 1500
    assert np.nanmax(drawn_y) == 7
    assert np.isnan(drawn_y).any()
    index = np.searchsorted(x, drawn_x)
    np.testing.assert_equal(drawn_y, y[index])


def test_a_short_curve_is_drawn_whole() -> None:
    x = np.arange(9.0)
    assert outline(x, x**2, 5)[1].tolist() == (x**2).tolist()
