"""Boundaries that are known in closed form, followed on a lattice."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from planemotion.base.arrays import Floats, Ints
from planemotion.base.errors import SceneError
from planemotion.maps.lattice import Places, Side, halvings_for
from planemotion.maps.looks import Looks
from planemotion.maps.outlines import Curve, curves_of, pieces_of
from planemotion.maps.refine import Refined, refine
from planemotion.sweep.plan import Axis

# Outcomes [n] of points (x, y) of the unit square.
Seen = npt.NDArray[Any]
Function = Callable[[Floats, Floats], Seen]
TOLERANCE = 1e-3


class Mapped:
    """A function over the unit square, refined from a grid of n x n cells."""

    def __init__(self, function: Function, n: int = 8, tolerance: float = TOLERANCE) -> None:
        axis = Axis("x", "", np.linspace(0, 1, n + 1))
        steps = 1 << halvings_for(axis, tolerance, False)
        self.side = Side(axis, steps, False)
        self.asked: list[Places] = []

        def compute(places: Places) -> Ints:
            self.asked.append(places)
            x, y = self.side.part(places).T
            return np.asarray(function(x, y)).astype(np.int32)

        self.look = Looks(compute)
        self.found: Refined = refine(self.look, (self.side, self.side), tolerance)
        self.curves: list[Curve] = curves_of(self.found)

    def points(self, curve: Curve) -> Floats:
        return self.side.part(np.array(curve.points))

    def distance(self, x: Floats, y: Floats) -> Floats:
        """How far points [n] are from the nearest boundary."""
        ends = [(p[:-1], p[1:]) for p in map(self.points, self.curves)]
        a, b = (np.concatenate(part) for part in zip(*ends, strict=True))
        at = np.stack([x, y], axis=1)[:, None]
        along = np.clip(((at - a) * (b - a)).sum(-1) / np.maximum(((b - a) ** 2).sum(-1), 1e-300), 0, 1)
        return np.hypot(*np.moveaxis(at - a - along[..., None] * (b - a), -1, 0)).min(axis=1)

    def areas(self) -> dict[int, float]:
        areas: dict[int, float] = {}
        for piece in pieces_of(self.found):
            x, y = self.side.part(np.array(piece.points)).T
            area = 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))
            areas[piece.outcome] = areas.get(piece.outcome, 0.0) + area
        return areas


def on_circle(cx: float, cy: float, r: float, n: int = 400) -> tuple[Floats, Floats]:
    angle = np.linspace(0, 2 * np.pi, n)
    return cx + r * np.cos(angle), cy + r * np.sin(angle)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_a_circle(tolerance: float) -> None:
    """Both ways: the curve lies on the circle, and all of the circle on the curve."""
    mapped = Mapped(lambda x, y: np.hypot(x - 0.43, y - 0.57) < 0.3, tolerance=tolerance)
    (curve,) = mapped.curves
    assert curve.points[0] == curve.points[-1]
    x, y = mapped.points(curve).T
    assert np.abs(np.hypot(x - 0.43, y - 0.57) - 0.3).max() < tolerance / 2
    assert mapped.distance(*on_circle(0.43, 0.57, 0.3)).max() < tolerance
    areas = mapped.areas()
    assert sum(areas.values()) == pytest.approx(1, abs=1e-12)
    assert areas[1] == pytest.approx(np.pi * 0.09, abs=2 * np.pi * 0.3 * tolerance)
    assert not mapped.found.open


def test_runs_grow_with_the_root_of_the_digits() -> None:
    """A smooth boundary takes four times the lines for a 16th of the tolerance, and not 16 times."""
    few, many = (
        len(Mapped(lambda x, y: np.hypot(x - 0.43, y - 0.57) < 0.3, tolerance=t).look) for t in (16e-4, 1e-4)
    )
    assert many < 6 * few
    assert many < 1e-4 * (1 + 1 / 1e-4) ** 2


def test_no_place_is_computed_twice() -> None:
    mapped = Mapped(lambda x, y: x * y > 0.2)
    asked = np.concatenate(mapped.asked)
    assert len(np.unique(asked, axis=0)) == len(asked) == len(mapped.look)
    np.testing.assert_array_equal(mapped.look.places(), asked)


@pytest.mark.parametrize("seed", range(8))
def test_regions_that_meet_in_points(seed: int) -> None:
    """Nearest of nine points: straight boundaries, three of which meet here and there."""
    site = np.random.default_rng(seed).uniform(0, 1, (9, 2))

    def nearest(x: Floats, y: Floats) -> Seen:
        return np.hypot(x[:, None] - site[:, 0], y[:, None] - site[:, 1]).argmin(axis=1)

    mapped = Mapped(nearest, n=16)
    for curve in mapped.curves:
        x, y = mapped.points(curve).T
        a, b = (site[k] for k in curve.outcomes)
        away = np.hypot(x - a[0], y - a[1]) - np.hypot(x - b[0], y - b[1])
        slope = np.hypot(*(a - b)) / np.hypot(x - a[0], y - a[1])  # across the boundary
        assert (np.abs(away) < TOLERANCE * slope + 1e-9).all()
    grid = (np.arange(400) + 0.5) / 400
    x, y = (one.ravel() for one in np.meshgrid(grid, grid))
    wanted = np.bincount(nearest(x, y), minlength=9) / len(x)
    areas = mapped.areas()
    assert all(areas.get(k, 0.0) == pytest.approx(wanted[k], abs=3e-3) for k in range(9))
    assert len(mapped.look) < 0.02 * 1001**2


def test_a_band_thinner_than_the_start_grid() -> None:
    """Where it shows at one place of the grid it is followed to both ends; both sides are curves."""
    mapped = Mapped(lambda x, y: np.abs(y - 0.5 - 0.1 * (x - 0.5)) < 0.004, n=8)
    x = np.linspace(0, 1, 200)
    for side in (-0.004, 0.004):
        assert mapped.distance(x, 0.5 + 0.1 * (x - 0.5) + side).max() < TOLERANCE
    assert mapped.areas()[1] == pytest.approx(0.008, abs=1e-3)


def test_an_island_that_the_start_grid_misses_is_not_seen() -> None:
    """As the docs say: the grid is the user's."""

    def island(x: Floats, y: Floats) -> Seen:
        return np.hypot(x - 0.1875, y - 0.1875) < 0.05

    assert Mapped(island, n=8).curves == []
    assert len(Mapped(island, n=16).curves) == 1


def test_a_side_that_smaller_cells_contradict() -> None:
    """A tongue comes into a cell through a side whose ends agree: it is found from beside it."""

    def tongue(x: Floats, y: Floats) -> Seen:
        return (y < 0.26) | ((np.abs(x - 0.3) < 0.02) & (y < 0.7))

    mapped = Mapped(tongue, n=4)
    y = np.linspace(0.27, 0.7, 100)
    for x in (0.28, 0.32):
        assert mapped.distance(np.full(100, x), y).max() < TOLERANCE
    assert mapped.distance(np.linspace(0.28, 0.32, 50), np.full(50, 0.7)).max() < TOLERANCE


def test_noise_ends_at_the_tolerance() -> None:
    mapped = Mapped(lambda x, y: np.sin(831 * x + 5007 * y) * 43758.5 % 1 > 0.5, n=2, tolerance=0.05)
    assert mapped.found.open
    assert sum(mapped.areas().values()) == pytest.approx(1, abs=1e-12)


def test_places_have_the_values_of_the_grid() -> None:
    values = np.array([0.1, 0.2, 0.7])
    side = Side(Axis("x", "m", values), 16, False)
    assert side.value(np.array([0, 16, 32])).tolist() == values.tolist()
    assert side.value(np.array([8])).tolist() == [pytest.approx(0.15)]
    log = Side(Axis("x", "m", np.array([1.0, 100.0, 1000.0])), 16, True)
    assert log.value(np.array([0, 8, 16, 32])).tolist() == [1, pytest.approx(10), 100, 1000]
    assert log.part(np.array([8])).tolist() == [pytest.approx(1 / 3)]


@pytest.mark.parametrize("values", [[1.0], [1.0, 2.0, 1.5], [1.0, 1.0]])
def test_grids_that_are_no_range(values: list[float]) -> None:
    with pytest.raises(SceneError, match="a map needs"):
        halvings_for(Axis("x", "", np.array(values)), 1e-3, False)


def test_a_tolerance_that_is_too_fine() -> None:
    with pytest.raises(SceneError, match="it must be at least"):
        halvings_for(Axis("x", "", np.linspace(0, 1, 5)), 1e-12, False)
