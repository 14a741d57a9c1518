"""A quick part of `python -m tests.stress.files`, and that its faults are seen."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import pytest

from tests.stress.files.trials import STUDY, Sweep, differences, full_disk, half_written, killed, resumed


@pytest.fixture(scope="module")
def sweep(tmp_path_factory: pytest.TempPathFactory) -> Sweep:
    """Of 200 cases."""
    folder = tmp_path_factory.mktemp("sweep")
    scene = folder / "few.toml"
    scene.write_text(STUDY.read_text().replace("num = 200", "num = 20").replace("num = 100", "num = 10"))
    return Sweep.unhurt(folder, scene)


@pytest.mark.slow
def test_a_sweep_killed_at_random_ends_with_the_same_bytes(sweep: Sweep, tmp_path: Path) -> None:
    assert killed(sweep, tmp_path / "out", 1) == ""


@pytest.mark.slow
def test_a_full_disk_is_told_and_leaves_nothing_half_written(sweep: Sweep, tmp_path: Path) -> None:
    assert full_disk(sweep, tmp_path / "out", 4) == ""


@pytest.mark.slow
def test_what_must_not_be_is_seen(sweep: Sweep, tmp_path: Path) -> None:
    """A result that is cut, and tables with a number changed."""
    out = tmp_path / "out"
    shutil.copytree(sweep.straight, out)
    (file,) = out.glob("*.h5")
    whole = file.read_bytes()
    assert half_written(out) == differences(sweep, out) == ""
    file.write_bytes(whole[: len(whole) // 2])
    assert "is there" in half_written(out)
    assert "--resume says" in resumed(sweep, out)
    file.write_bytes(whole)
    with h5py.File(file, "r+") as data:
        data["omega_B"][0, 0] += 1e-15
    assert "omega_B" in differences(sweep, out)
    (table,) = out.glob("*.csv")
    table.write_text(table.read_text().replace("1", "2", 1))
    assert table.name in differences(sweep, out)
