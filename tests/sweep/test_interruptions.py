"""Two sweeps at once, Ctrl-C, full disks, a million cases."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

from planemotion.base.errors import StudyError
from planemotion.sweep import run
from tests import ROOT
from tests.sweep.fake import BIG, FakeEngine, FakeScene, data_of
from tests.sweep.processes import child, parts, wait_for_parts


def test_two_sweeps_on_one_output_are_refused(tmp_path: Path, engine: FakeEngine) -> None:
    out = tmp_path / "out"
    with child(out) as process:
        wait_for_parts(process, out, 1)
        said = rf"another sweep writes into this folder \(process {process.pid} on "
        for resume in (False, True):
            with pytest.raises(StudyError, match=said):
                run.sweep_files(FakeScene(BIG), out, resume=resume)
        assert process.wait() == 0
    assert (out / "fake.h5").exists()


def test_ctrl_c_stops_in_the_middle_and_says_what_is_saved(tmp_path: Path, engine: FakeEngine) -> None:
    out = tmp_path / "out"
    with child(out, pause=0.1) as process:  # the whole would take two minutes
        wait_for_parts(process, out, 2)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
    assert process.returncode == 1
    stored = sum(int(name.split("-")[2]) for name in parts(out))
    assert stored < 600
    assert f"stopped: {stored} of 1200 cases are saved in {out}; go on with --resume" in error
    assert run.sweep_files(FakeScene(BIG), out, resume=True).computed == 1200 - stored


@pytest.mark.parametrize("place", ["/proc/no/such", "file", "file/below"])
def test_an_output_that_cannot_be_written_is_refused(engine: FakeEngine, tmp_path: Path, place: str) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(StudyError, match=r"is a file|cannot be written"):
        run.sweep_files(FakeScene(BIG), tmp_path / place)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert engine.chunks == []


@pytest.mark.parametrize(
    ("limit", "file"), [(500, "manifest.json"), (10_000, "part-"), (40_000, "fake.h5"), (141_000, "fake.csv")]
)
def test_a_full_disk_is_said_and_leaves_nothing_half_written(
    tmp_path: Path, engine: FakeEngine, limit: int, file: str
) -> None:
    out = tmp_path / "out"
    with child(out, "small-files", str(limit), pause=0.0002) as process:
        _, error = process.communicate()
    assert process.returncode == 1
    assert "StudyError" in error
    assert "is full" in error
    assert file in error
    assert not list(out.rglob(".*"))
    assert file == "fake.csv" or not (out / "fake.h5").exists()
    assert not (out / "fake.csv").exists()
    run.sweep_files(FakeScene(BIG), out, resume=True)
    run.sweep_files(FakeScene(BIG), tmp_path / "straight")
    assert data_of(out / "fake.h5") == data_of(tmp_path / "straight/fake.h5")


# ---- size ---------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_million_cases_stay_below_500_megabytes(tmp_path: Path) -> None:
    code = (
        "import re, sys; from tests.sweep import fake\n"
        "from planemotion.sweep import run\n"
        "fake.plant(fake.FakeEngine())\n"
        "run.sweep_files(fake.FakeScene(fake.MILLION), sys.argv[1], workers=2)\n"
        # The greatest memory of this program alone: that of getrusage begins with the one that started it.
        "print(int(re.search(r'VmHWM:\\s*(\\d+)', open('/proc/self/status').read())[1]) // 1024)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 500
    with xr.open_dataset(tmp_path / "fake.h5", engine="h5netcdf") as data:
        assert data.status.shape == (2000, 500)
        assert float(data["sum"][-1, -1]) == (6 * 0.0254 + 5) / 0.3048
