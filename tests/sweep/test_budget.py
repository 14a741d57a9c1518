"""Limits of a sweep: failed cases computed once more, an end after too many, costly cases, the dry run."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from planemotion import SceneError, StudyError, load_text
from planemotion.cli.main import main
from planemotion.sweep.costs import Costs
from planemotion.sweep.estimate import estimate

SWING = """
id = "swing"
parameters = { angle = "60 deg", L = "1 m", T = "3 s" }
bodies.bob = { rod = ["A", "B"], length = "L", mass = "1 kg", at = { A = [0, 0] }, angle = "angle" }
joints.rod = { pin = ["bob.A", "ground"] }
until = "t = T"
ask.omega = "bob.omega"
solve.route = "rk"
"""
GRID = 'sweep.angle = ["1 deg", "20 deg", "60 deg", "170 deg"]\n'
LENGTHS = 'sweep.L = ["0.1 m", "0.5 m", "3 m", "20 m"]\n'
BALL = """
id = "ball"
parameters = { h = "1 m" }
bodies.ball = { disk = "10 cm", mass = "1 kg", at = [0, "h"] }
ground.lines.floor = { through = [0, 0] }
contacts.floor = { touch = ["ball.rim", "ground.floor"] }
until = "t = 0.1 s"
ask.v = "ball.velocity.y"
[sweep]
"""


def test_what_met_a_limit_is_computed_again(tmp_path: Path) -> None:
    """With the bits that a run with these settings has, for threads and for any executor."""
    plenty = load_text(SWING + LENGTHS).sweep()
    few = load_text(SWING + LENGTHS + "solve.max_steps = 80\n").sweep()
    limited = few["status"].values != 0
    assert 0 < limited.sum() < 4
    scene = load_text(SWING + LENGTHS + "solve.max_steps = 80\nsweep.retry = { max_steps = 100000 }\n")
    for executor in (None, ThreadPoolExecutor(2)):
        mended = scene.sweep(executor=executor)
        assert (mended["status"] == 0).all()
        np.testing.assert_array_equal(mended["omega"], plenty["omega"])
        told = mended["message"].values.tolist()
        assert [bool(text) for text in told] == limited.tolist()
        assert all("computed again with solve.max_steps = 100000; before: " in text for text in told if text)
        assert mended.attrs["cases_mended"] == limited.sum()
        assert (mended["solves"].values > plenty["solves"].values).tolist() == limited.tolist()
    scene.sweep(out=tmp_path)
    rows = (tmp_path / "swing.csv").read_text(encoding="utf-8").splitlines()[1:]
    assert ["computed again" in row for row in rows] == limited.tolist()


def test_what_fails_again_says_so() -> None:
    scene = load_text(SWING + GRID + "solve.max_steps = 3\nsweep.retry = { max_steps = 4 }\n")
    dataset = scene.sweep()
    assert (dataset["status"] != 0).all()
    assert all("computed again with solve.max_steps = 4: " in text for text in dataset["message"].values)
    assert dataset.attrs["cases_mended"] == 0


def test_a_failure_is_tried_again_and_an_early_stop_is_not() -> None:
    """One ball overlaps with the floor, and one lies on it for ever."""
    text = BALL.replace('"t = 0.1 s"', '"ball.y > (2 m)"') + "retry = { accuracy = 1e-12 }\n"
    dataset = load_text(text + 'h = ["5 cm", "10 cm"]').sweep()
    assert dataset["status"].values[0] < 0 < dataset["status"].values[1]
    told = ["computed again with solve.accuracy = 1e-12: " in text for text in dataset["message"].values]
    assert told == [True, False]


@pytest.mark.parametrize(
    ("retry", "told"),
    [
        ("{}", "sweep.retry: settings are wanted"),
        ("{ steps = 5 }", "unknown key"),
        ('{ route = "fast" }', "sweep.retry: as solve.route"),
        ('{ accuracy = "1 m" }', "sweep.retry: as solve.accuracy"),
    ],
)
def test_faults_of_a_retry(retry: str, told: str) -> None:
    with pytest.raises(SceneError, match=told):
        load_text(SWING + GRID + f"sweep.retry = {retry}\n").sweep()


def test_a_sweep_ends_after_so_many_failures(tmp_path: Path) -> None:
    """Here every second case overlaps with the floor; what is computed stays."""
    heights = ", ".join('"1 m", "5 cm"' for _ in range(50))
    scene = load_text(BALL + "cases = { h = [" + heights + "] }")
    everything = load_text(BALL + "cases = { h = [" + heights + "] }").sweep()
    assert (everything["status"] < 0).sum() == 50
    for executor in (None, ThreadPoolExecutor(2)):
        with pytest.raises(StudyError, match=r"cases failed, first case \d+ \(h = 0.05 m\): "):
            scene.sweep(out=tmp_path, stop_after=3, resume=True, executor=executor)
    assert scene.sweep(out=tmp_path, resume=True).drop_attrs().equals(everything.drop_attrs())
    with pytest.raises(StudyError, match="stop_after = 0: at least 1"):
        scene.sweep(stop_after=0)


def test_costly_cases_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Nineteen pendulums that swing for a moment, and one that swings for long."""
    times = ", ".join(["0.01"] * 19 + ["30"])
    study = SWING + f'sweep.cases = {{ "T [s]" = [{times}] }}\n'
    (tmp_path / "swing.toml").write_text(study, encoding="utf-8")
    with pytest.raises(SystemExit) as ended:
        main(["sweep", str(tmp_path / "swing.toml"), "--out", str(tmp_path)])
    assert not ended.value.code
    told = [line for line in capsys.readouterr().out.splitlines() if "costly: " in line]
    assert len(told) == 1
    assert "T = 30 s: " in told[0]


def test_costs_of_blocks_in_any_order() -> None:
    solves = np.array([3, 1000, 3, 4, 2, 3, 900, 3, 2, 1, 1, 3, 3, 3, 2], np.int32)
    costs = Costs()
    for first in (10, 0, 5):
        costs.add(first, solves[first : first + 5])
    found = costs.found(str)
    assert [(one.case, one.solves) for one in found] == [(1, 1000), (6, 900)]
    assert found[0].times == pytest.approx(1000 / solves.mean())


def test_a_dry_run_computes_a_sample() -> None:
    """Of a million cases, spread evenly over all."""
    scene = load_text(BALL + 'h = { from = "5 cm", to = "1 m", num = 1000000 }')
    found = estimate(scene, workers=1)
    assert found.size.cases == 1_000_000
    assert 100 < found.sample <= 4096
    assert sum(found.statuses.values()) == found.sample
    assert found.statuses["penetration"] / found.sample == pytest.approx(0.05 / 0.95, rel=0.1)
    assert 0 < found.error < found.seconds


def test_a_dry_run_of_few_cases_computes_them_all() -> None:
    found = estimate(load_text(SWING + GRID), workers=2)
    assert found.sample in (2, 4)  # what is done once may spoil the first batch
    assert set(found.statuses) == {"ok"}


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "swing.toml").write_text(SWING + GRID, encoding="utf-8")
    with pytest.raises(SystemExit) as ended:
        main(["sweep", str(tmp_path / "swing.toml"), "--dry-run", "--out", str(tmp_path / "out")])
    assert not ended.value.code
    told = capsys.readouterr().out
    for word in ("4 cases; a sample of", "time", "memory", "of HDF5 and"):
        assert word in told
    assert not (tmp_path / "out").exists()
    with pytest.raises(SystemExit) as ended:
        main(["sweep", str(tmp_path / "swing.toml")])
    assert ended.value.code == 2
    assert "--out" in capsys.readouterr().err


@pytest.mark.parametrize("num", [2, 2000])
def test_the_size_told_is_that_of_the_files(tmp_path: Path, num: int) -> None:
    """Of few cases as of many."""
    scene = load_text(BALL + f'h = {{ from = "1 m", to = "2 m", num = {num} }}')
    scene.sweep(out=tmp_path)
    told = estimate(scene).size
    assert told.result == pytest.approx((tmp_path / "ball.h5").stat().st_size, rel=0.5)
