"""Maps of scenes: beside closed forms, and beside a block that is integrated independently."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner
from scipy.integrate import solve_ivp

import planemotion
from planemotion import SceneError, load_text
from planemotion.base.arrays import Floats
from planemotion.cli.main import main
from tests import ROOT
from tests.scenes import G
from tests.scenes.parts import FALLING

FALL = (
    FALLING
    + """\
events.fast = "ball.speed > (5 m/s)"
ask.outcome = { events = ["far", "fast"] }
ask.is_far = "far.count > 0"
[sweep]
h = { from = "0.2 m", to = "3 m", num = 9 }
v = { from = "0 m/s", to = "4.9 m/s", num = 9 }
refine = { tolerance = 1e-3 }
"""
)


def curves(dataset: xr.Dataset) -> Iterator[tuple[frozenset[str], Floats]]:
    """The outcomes on both sides of each boundary, and its points [n, 2]."""
    names = dataset["outcome"].values
    axes = str(dataset.attrs["parameters"]).split()
    points = np.stack([dataset[f"point_{name}"].values for name in axes], axis=1)
    parts = np.split(points, np.cumsum(dataset["curve_points"].values)[:-1])
    for pair, part in zip(dataset["curve_outcomes"].values, parts, strict=True):
        yield frozenset(str(names[k]) for k in pair), part


def time_of(event: str, h: Floats, v: Floats) -> Floats:
    """When a ball thrown level comes to x = 1 m, to 5 m/s, to the ground."""
    with np.errstate(invalid="ignore", divide="ignore"):
        match event:
            case "far":
                return 1 / v
            case "fast":
                return np.sqrt(25 - v**2) / G
            case _:
                return np.sqrt(2 * h / G)


def differ(pair: frozenset[str], h: Floats, v: Floats) -> Floats | None:
    """What is zero on the boundary between two outcomes; None where three meet."""
    match sorted(pair):
        case ["far fast", "fast far"]:
            return time_of("far", h, v) - time_of("fast", h, v)
        case ["far", "nothing"] | ["fast", "fast far"]:
            return time_of("far", h, v) - time_of("landing", h, v)
        case ["fast", "nothing"] | ["far", "far fast"]:
            return time_of("fast", h, v) - time_of("landing", h, v)
        case _:
            return None


def test_the_order_of_events_has_boundaries_in_closed_form() -> None:
    """Where two events change places, or one drops out, their times are equal: to the tolerance."""
    dataset = load_text(FALL).map().dataset
    names = {str(name) for name in dataset["outcome"].values}
    assert names == {"nothing", "far", "fast", "far fast", "fast far"}
    found = 0
    for pair, points in curves(dataset):
        h, v = points.T
        around = [
            differ(pair, h + 2.8e-3 * i, np.minimum(v + 4.9e-3 * j, 4.9999)) for i in (-1, 1) for j in (-1, 1)
        ]
        known = [one for one in around if one is not None]
        if not known:
            continue
        found += 1
        assert (np.min(known, axis=0) < 0).all(), pair
        assert (np.max(known, axis=0) > 0).all(), pair
    assert found >= 4


def test_a_map_is_the_same_for_any_workers_and_its_runs_are_runs() -> None:
    scene = load_text(FALL)
    one, two = (scene.map(workers=n).dataset for n in (1, 2))
    assert one.drop_attrs(deep=False).equals(two.drop_attrs(deep=False))
    names = one["outcome"].values
    for k in range(0, one.sizes["case"], 61):
        values = {name: f"{float(one[name][k])!r} {one[name].attrs['units']}" for name in ("h", "v")}
        word = scene.run(**values)["outcome"]
        assert (word or "nothing") == names[int(one["case_outcome"][k])]


def test_areas_and_fewer_runs() -> None:
    made = load_text(FALL).map(of="is_far", tolerance=1e-4)
    h = np.linspace(0.2, 3, 20001)
    wanted = np.mean(1 - np.minimum(np.sqrt(G / (2 * h)), 4.9) / 4.9)
    assert made.outcomes["is_far = 1"] == pytest.approx(wanted, abs=2e-4)
    assert sum(made.outcomes.values()) == pytest.approx(1, abs=1e-9)
    assert made.cases < 1e-4 * made.dataset.attrs["cases_of_full_grid"]
    assert "is_far = 1" in repr(made)


def test_grids_and_units_may_be_given_in_python() -> None:
    made = load_text(FALL).map(
        of=["is_far"], h={"from": "50 cm", "to": "80 cm", "num": 4}, v={"from": 2, "to": 4, "num": 5}
    )
    assert made.dataset["h"].attrs["units"] == "cm"
    assert float(made.dataset["h"].max()) == 80
    (pair, points), *_ = curves(made.dataset)
    assert pair == {"is_far = 0", "is_far = 1"}
    np.testing.assert_allclose(points[:, 1], np.sqrt(G / (2 * points[:, 0] / 100)), atol=2 * 1e-3)


def test_the_command_leaves_a_file_and_a_picture(tmp_path: Path) -> None:
    study = tmp_path / "fall.toml"
    study.write_text(FALL)
    arguments = ["map", str(study), "--out", str(tmp_path / "out"), "--set", "sweep.refine.tolerance=0.01"]
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, result.output
    assert "boundaries to 0.01 of the ranges" in result.output
    made = tmp_path / "out" / "fall_map.h5"
    with xr.open_dataset(made, engine="h5netcdf") as dataset:
        assert dataset.attrs["tolerance"] == 0.01
    assert CliRunner().invoke(main, ["check", str(made)]).exit_code == 0
    picture = tmp_path / "again.svg"
    assert CliRunner().invoke(main, ["plot", str(made), "--out", str(picture)]).exit_code == 0
    assert "far fast" in picture.read_text()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("v = { from", "m = { from", "m"),
        ("refine = {", 'refine = { of = ["nobody"],', "sweep.refine.of[0]"),
        ("tolerance = 1e-3", "tolerance = 2.0", "sweep.refine.tolerance"),
        ("refine = { tolerance", "refine = { tolerence", "tolerance"),
        ('ask.outcome = { events = ["far", "fast"] }', "", "what tells outcomes apart"),
        ('v = { from = "0 m/s", to = "4.9 m/s", num = 9 }', "", "a map is over two parameters"),
        ("tolerance = 1e-3 }", "tolerance = 1e-3 }\nsolve.max_cases = 100", "more than 100 cases"),
        ("refine = {", 'zip = [["h", "v"]]\nrefine = {', "a map is over two parameters"),
    ],
)
def test_faults_are_told(old: str, new: str, said: str) -> None:
    assert old in FALL
    text = FALL.replace(old, new)
    if "solve.max_cases" in text:
        text = "solve.max_cases = 100\n" + text.replace("\nsolve.max_cases = 100", "")
    with pytest.raises(SceneError) as raised:
        load_text(text).map()
    assert said in str(raised.value)


def test_an_answer_that_changes_all_along_tells_no_outcomes_apart() -> None:
    text = FALL.replace("ask.is_far", 'ask.x = "ball.x"\nask.is_far')
    with pytest.raises(SceneError, match="changes all along"):
        load_text(text).map(
            of="x", h={"from": "1 m", "to": "3 m", "num": 40}, v={"from": 1, "to": 4, "num": 40}
        )


# ---- the rocking block ----


def falls(amplitude: float, frequency: float) -> bool:
    """Whether the block of studies/rocking_block.toml falls, by Housner's equation with plastic blows."""
    half, tall = 0.15, 0.6
    alpha, radius = np.arctan2(half, tall), np.hypot(half, tall)
    p2 = 0.75 * G / radius
    ratio = 1 - 1.5 * np.sin(alpha) ** 2
    end = 1 / frequency

    def pulse(t: float) -> float:
        return amplitude * np.sin(2 * np.pi * frequency * t) if t < end else 0.0

    # seen from the ground it is pushed to -x first: it turns about its left corner
    t, angle, rate = np.arcsin(np.tan(alpha) / amplitude) / (2 * np.pi * frequency), 1e-12, 0.0
    while t < end + 20:
        side = 1.0 if angle > 0 else -1.0

        def motion(t: float, y: Floats, side: float = side) -> list[float]:
            lean = alpha - side * y[0]
            return [y[1], p2 * (pulse(t) * np.cos(lean) - side * np.sin(lean))]

        def down(t: float, y: Floats, side: float = side) -> float:
            return side * y[0]

        def over(t: float, y: Floats) -> float:
            return abs(y[0]) - np.pi / 2

        down.terminal, down.direction, over.terminal = True, -1, True  # type: ignore[attr-defined]
        for stop in (end, end + 20):
            if t >= stop:
                continue
            done = solve_ivp(motion, (t, stop), [angle, rate], events=[down, over], rtol=1e-11, atol=1e-13)
            t, (angle, rate) = done.t[-1], done.y[:, -1]
            if done.t_events[1].size:
                return True
            if done.t_events[0].size:
                angle, rate = -side * 1e-14, ratio * rate
                break
        if t > end and abs(angle) < 1e-9 and 0.5 * rate**2 / p2 < 1 - np.cos(alpha):
            return False
        if abs(rate) < 1e-9 and abs(angle) < 1e-9:
            return False
    return False


def beside(points: Floats, scale: Floats, away: float) -> Iterator[tuple[Floats, Floats]]:
    """Places on both sides of a curve, `away` parts of the ranges off the middle of some of its lines."""
    ends = points / scale
    for k in range(1, len(ends) - 2, max(1, len(ends) // 12)):
        along = ends[k + 1] - ends[k]
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        middle = 0.5 * (ends[k] + ends[k + 1])
        yield (middle + away * normal) * scale, (middle - away * normal) * scale


@pytest.mark.slow
@pytest.mark.reference
def test_the_rocking_block_beside_an_independent_integration() -> None:
    """The shipped study, whose boundaries are told to 1e-4 of the ranges: by Housner's equation, too, its
    runs fall or not, and twice the tolerance beside a boundary the block falls on one side alone."""
    scene = planemotion.load(ROOT / "studies" / "rocking_block.toml")
    dataset = scene.map().dataset
    stands = "blows_before: none"
    names = [str(name) for name in dataset["outcome"].values]
    assert set(names) == {stands, "blows_before = 0", "blows_before = 1"}
    assert dataset.attrs["tolerance"] == 1e-4
    assert dataset.attrs["cases"] < 2e-4 * dataset.attrs["cases_of_full_grid"]
    assert dataset.attrs["open_cells"] == 0
    for k in range(0, dataset.sizes["case"], dataset.sizes["case"] // 40):
        told = names[int(dataset["case_outcome"][k])] != stands
        assert falls(float(dataset["amplitude"][k]), float(dataset["frequency"][k])) == told
    compared = 0
    for pair, points in curves(dataset):
        for left, right in beside(points, np.array([2.0, 2.0]), 2e-4):
            assert (falls(*left) != falls(*right)) == (stands in pair)
            compared += 1
    assert compared > 24
