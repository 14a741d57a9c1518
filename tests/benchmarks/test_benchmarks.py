"""The benchmark runs, its references agree with the engine, and a missing peer is a row that says so."""

from __future__ import annotations

import csv
import importlib
import json
import math
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from tests import ROOT

PEERS = "scipy,heyoka,sksundae,mujoco,exudyn"


def bench(out: Path, *options: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "studies.benchmarks", "--quick", "--out", str(out), *options]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)


def rows(out: Path) -> list[dict[str, str]]:
    with (out / "scenes.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A quick run of two scenes in which no peer is installed."""
    out = tmp_path_factory.mktemp("bench")
    ended = bench(out, "--only", "double_pendulum,rolling_collar,summary", "--without", PEERS)
    assert ended.returncode == 0, ended.stderr
    return out


def test_a_missing_peer_is_a_row_that_says_so(quick: Path) -> None:
    missing = {row["method"] for row in rows(quick) if row["status"] == "not installed"}
    assert missing >= {"heyoka", "SciPy DOP853", "scikit-SUNDAE IDA", "MuJoCo", "Exudyn"}
    assert "| heyoka | - | - | - | - | - | not installed |" in (quick / "README.md").read_text(
        encoding="utf-8"
    )


def test_every_route_has_a_row_and_those_that_run_are_exact(quick: Path) -> None:
    found = [row for row in rows(quick) if row["scene"] == "rolling_collar"]
    methods = {row["method"] for row in found}
    assert methods >= {f"planemotion {route}" for route in ("default", "path", "uniform", "rk", "ida")}
    for method in ("planemotion default", "planemotion rk", "planemotion rk, no estimates"):
        row = next(row for row in found if row["method"] == method)
        assert row["status"] == "ok"
        assert float(row["error"]) < 1e-9
        assert 0 < float(row["cpu_s"]) < 1


def test_a_route_that_does_not_apply_is_a_row_that_says_why(quick: Path) -> None:
    uniform = next(row for row in rows(quick) if row["method"] == "planemotion uniform")
    assert uniform["status"] != "ok"
    assert math.isnan(float(uniform["cpu_s"] or "nan"))


def test_files_of_the_page(quick: Path) -> None:
    page = (quick / "README.md").read_text(encoding="utf-8")
    for name in ("double_pendulum", "rolling_collar"):
        assert f"({name}.png)" in page
        assert (quick / f"{name}.png").stat().st_size > 10_000
        assert (quick / f"{name}.csv").exists()
    assert str(ROOT) not in page


def test_an_unknown_scene_is_refused(tmp_path: Path) -> None:
    ended = bench(tmp_path, "--only", "double_pendulums")
    assert ended.returncode != 0
    assert "double_pendulums" in ended.stderr


def test_models_of_the_peers_agree_with_the_references(monkeypatch: pytest.MonkeyPatch) -> None:
    """SciPy on the hand-derived equations against the stored answers: equations, events and blows."""
    from studies.benchmarks.peers import scipy
    from studies.benchmarks.problems import PROBLEMS

    for problem in PROBLEMS:
        case = problem.cases[0]
        answers = np.array([scipy.run(problem.model, case, 1e-10)])
        # The ball is not followed beyond blows of 1e-6 m/s: it then lacks some 2e-6 s of the limit.
        assert problem.error(answers) < 1e-5, problem.name
        assert problem.wrong(answers) in (None, 0)


def test_a_wrong_reference_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Errors are measured against the stored answers: a changed digit is an error of its size."""
    from studies.benchmarks import problems

    stored = json.loads(problems.REFERENCES.read_text(encoding="utf-8"))
    exact = float(stored["slider_crank"]["answers"][0][0])
    stored["slider_crank"]["answers"][0][0] = repr(exact + 1e-3)
    monkeypatch.setattr(problems, "references", lambda: stored)
    problem = next(p for p in problems.PROBLEMS if p.name == "slider_crank")
    assert problem.error(np.array([[exact]])) == pytest.approx(1e-3)


# ---- the agreement of the routes ----


@pytest.fixture
def agreement(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    return importlib.import_module("studies.benchmarks.agreement")


def test_the_routes_agree_on_a_study(agreement: ModuleType) -> None:
    table = agreement.table([found for found in agreement.scenes() if found[0] == "bouncing_ball"])
    rows = [dict(zip(table.header, row, strict=True)) for row in table.rows]
    assert [row["route"] for row in rows] == ["default: uniform", "rk", "ida"]
    assert {row["cases"] for row in rows} == {agreement.CASES}
    for row in rows[1:]:
        assert row["agrees"] == "yes"
        assert row["accuracy"] == 1e-10
        assert 0 < row["greatest difference"] < 1e-6
        assert row["what limits it"] == ""


def test_every_study_and_scene_is_compared(agreement: ModuleType) -> None:
    names = {name.split(",")[0] for name, _ in agreement.scenes()}
    studies = {path.stem for path in (ROOT / "studies").glob("*.toml")}
    scenes = {path.stem for path in (ROOT / "studies" / "benchmarks" / "scenes").glob("*.toml")}
    assert names == studies | scenes | {"four_bars_2", "four_bars_40"}


def test_a_route_that_answers_wrongly_does_not_agree(agreement: ModuleType) -> None:
    def answers(*out: float, error: float = 1e-12) -> Any:
        values = np.array([out])
        return agreement.Answers(values, np.full_like(values, error), [0], ["rk"], 1.0, "")

    right = answers(2.0, 0.0, np.nan)
    same, agrees = agreement.compared(["a", "b", "c"], right, answers(2.0, 0.0, np.nan))
    assert agrees
    assert same[1] == 0
    off, agrees = agreement.compared(["a", "b", "c"], right, answers(2.001, 1e-8, np.nan))
    assert not agrees
    assert off[1:3] == [pytest.approx(5e-4), "a"]
    assert off[4:] == ["no", "not known to the estimates"]
    said, _ = agreement.compared(["a", "b", "c"], right, answers(2.001, 0.0, np.nan, error=0.1))
    assert said[5] == "its own truncation, as it says"
    zero, agrees = agreement.compared(["a", "b", "c"], right, answers(2.0, 1e-5, np.nan))
    assert not agrees
    assert zero[1:3] == [1e-5, "b ~"]
    missing, agrees = agreement.compared(["a", "b", "c"], right, answers(2.0, 0.0, 1.0))
    assert not agrees
    assert missing[1:3] == [math.inf, "c"]


def test_a_run_that_takes_too_long_is_a_row_that_says_so(
    agreement: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(agreement, "PATIENCE", 1)
    chain = agreement.generate.four_bars(160)
    assert agreement.limited(chain, "ida", 1e-10) == "not finished in 1 s"


# ---- ida beside the library's own parts ----


def test_ida_is_measured_in_a_process_of_its_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    stock = importlib.import_module("studies.benchmarks.stock")
    problem = next(p for p in stock.PROBLEMS if p.name == "linkage_c5")
    cpu, error, why = stock.measured(problem, 1e-6, None)
    assert not why
    assert cpu > 0
    assert 0 < error < 1e-6
    (tmp_path / "planemotion").mkdir()
    (tmp_path / "planemotion" / "__init__.py").write_text("raise ImportError('another package')\n")
    assert stock.measured(problem, 1e-6, tmp_path)[2] == "ImportError: another package"


def test_forces_by_the_motion_answer_as_constants_do(tmp_path: Path) -> None:
    ended = bench(tmp_path, "--only", "motion_forces")
    assert ended.returncode == 0, ended.stderr
    with (tmp_path / "motion_forces.csv").open(encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    assert [row["what depends"] for row in found] == ["stiffness", "rate", "force", "couple", "all"]
    assert all(float(row["answers differ by"]) < 1e-11 for row in found)
