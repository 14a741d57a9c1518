"""Results as tables of pandas: rows of cases, and statistics with their sampling errors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import planemotion
from planemotion import load_text
from planemotion.cli.main import main
from tests.scenes.parts import FALLING

FALL = (
    FALLING
    + """\
ask.E = { of = "energy.kinetic", unit = "J" }
ask.far_at = { of = "t", at = "far", unit = "s" }
ask.times = { of = "t", at = { each = "ball.y", values = ["0.5 m", "0.2 m"] } }
ask.word = { events = ["far", "landing"] }
"""
)


def test_one_row_for_each_case() -> None:
    dataset = load_text(FALL).sweep(h=["1 m", "2 m", "3 m"], v=[1, 4])
    table = planemotion.cases(dataset)
    assert len(table) == 6
    assert table["h"].tolist() == [1, 1, 2, 2, 3, 3]
    assert table["v"].tolist() == [1, 4] * 3
    np.testing.assert_array_equal(table["E"], dataset["E"].values.ravel())
    np.testing.assert_array_equal(table["times[2]"], dataset["times"].values[..., 1].ravel())
    assert table["word"].tolist() == ["landing", "far landing"] * 3
    assert table["far_at_reason"].tolist() == ["not_reached", ""] * 3
    assert "E_reason" not in table
    assert set(table["status"]) == {"ok"}


def test_zipped_and_drawn_parameters() -> None:
    zipped = load_text(FALL).sweep(grids={"h": ["1 m", "2 m"], "v": [1, 4], "zip": [["h", "v"]]})
    assert planemotion.cases(zipped)[["h", "v"]].values.tolist() == [[1, 1], [2, 4]]
    drawn = load_text(FALL).sweep(
        grids={"h": {"uniform": ["1 m", "2 m"]}, "design": {"latin": 5}, "v": [1, 2]}
    )
    assert planemotion.cases(drawn)["v"].tolist() == [1, 2] * 5


def test_statistics_have_the_spread_of_repeated_draws() -> None:
    """Over 300 studies of 200 random cases: the standard errors are the deviations of what they belong to."""
    rng = np.random.default_rng(5)
    scene = load_text(FALL)
    h = rng.uniform(1, 3, 300 * 200)
    dataset = scene.sweep(grids={"h": {"uniform": ["1 m", "3 m"]}, "design": {"random": 200}})
    told = planemotion.statistics(dataset).loc["E"]
    many = 9.81 * h.reshape(300, 200)
    exact = {
        "mean": (many.mean(axis=1), 9.81 * 2),
        "q05": (np.quantile(many, 0.05, axis=1), 9.81 * 1.1),
        "q50": (np.quantile(many, 0.5, axis=1), 9.81 * 2),
        "q95": (np.quantile(many, 0.95, axis=1), 9.81 * 2.9),
    }
    assert told["cases"] == 200
    assert told["unit"] == "J"
    assert told["deviation"] == pytest.approx(9.81 * 2 / np.sqrt(12), rel=0.1)
    for name, (repeated, wanted) in exact.items():
        assert abs(told[name] - wanted) < 4 * told[f"{name}_error"]
        assert told[f"{name}_error"] == pytest.approx(repeated.std(), rel=0.5)


def test_few_cases_have_no_error_of_their_outer_quantiles() -> None:
    dataset = load_text(FALL).sweep(grids={"h": {"uniform": ["1 m", "3 m"]}, "design": {"latin": 10}})
    told = planemotion.statistics(dataset).loc["E"]
    assert np.isnan(told["q05_error"])
    assert told["q50_error"] > 0


def test_a_grid_has_no_statistics() -> None:
    with pytest.raises(ValueError, match="a design has drawn"):
        planemotion.statistics(load_text(FALL).sweep(h=["1 m"]))


def test_the_command_tells_statistics(tmp_path: Path) -> None:
    study = tmp_path / "fall.toml"
    study.write_text(FALL + 'sweep = { design = { latin = 64 }, h = { uniform = ["1 m", "3 m"] } }\n')
    result = CliRunner().invoke(main, ["sweep", str(study), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    assert "50% below" in result.output
    line = next(line for line in result.output.splitlines() if line.startswith("E ") and "±" in line)
    assert "19.6" in line
