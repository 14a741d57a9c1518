"""The benchmark runs, its references agree with the engine, and a missing peer is a row that says so."""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parent.parent
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
    monkeypatch.syspath_prepend(str(ROOT))
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
    monkeypatch.syspath_prepend(str(ROOT))
    from studies.benchmarks import problems

    stored = json.loads(problems.REFERENCES.read_text(encoding="utf-8"))
    exact = float(stored["slider_crank"]["answers"][0][0])
    stored["slider_crank"]["answers"][0][0] = repr(exact + 1e-3)
    monkeypatch.setattr(problems, "references", lambda: stored)
    problem = next(p for p in problems.PROBLEMS if p.name == "slider_crank")
    assert problem.error(np.array([[exact]])) == pytest.approx(1e-3)
