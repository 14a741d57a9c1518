"""Sweeps computed shard by shard, by processes that know nothing of each other, and put together."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import planemotion
from planemotion.base.errors import StudyError
from planemotion.sweep import run
from planemotion.sweep.locks import OutputLock, ShardLock
from planemotion.sweep.shard import Shard
from tests.cli.calls import command, invoke, left_in, write
from tests.scenes.pendulum import RELEASED
from tests.sweep.fake import BIG, FakeEngine, FakeScene, data_of
from tests.sweep.processes import child, parts, wait_for_parts
from tests.waiting import HANGS

STUDY = RELEASED.replace("num = 6", "num = 101")


def test_shards_cover_the_cases_once() -> None:
    for cases, of in ((10, 3), (1, 4), (7, 7), (10**15 + 1, 999)):
        ranges = [Shard(i, of).range(cases) for i in range(1, of + 1)]
        assert (ranges[0][0], ranges[-1][1]) == (0, cases)
        assert all(before[1] == after[0] for before, after in pairwise(ranges))
        sizes = {end - first for first, end in ranges}
        assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize("written", ["0/3", "4/3", "3", "1/0", "a/b", "-1/3", "1/3/5", ""])
def test_what_is_no_shard_is_refused(written: str) -> None:
    with pytest.raises(StudyError, match=r"i/n is wanted with i from 1 to n"):
        Shard.read(written)


def test_shards_in_any_order_leave_what_one_sweep_leaves(tmp_path: Path, engine: FakeEngine) -> None:
    whole = run.sweep_files(FakeScene(BIG), tmp_path / "whole")
    out = tmp_path / "out"
    for number, missing in ((3, 800), (1, 400), (2, 0)):
        done = run.sweep_shard(FakeScene(BIG), out, Shard(number, 3))
        assert (done.cases, done.computed, done.missing) == (400, 400, missing)
        again = run.sweep_shard(FakeScene(BIG), out, Shard(number, 3))
        assert (again.computed, again.missing) == (0, missing)
    files = run.merge_shards(FakeScene(BIG), out)
    assert data_of(files.result) == data_of(whole.result)
    assert files.table.read_bytes() == whole.table.read_bytes()
    assert left_in(out) == {"fake.h5", "fake.csv"}
    assert run.sweep_shard(FakeScene(BIG), out, Shard(2, 3)).computed == 0  # a job that comes too late


def test_merge_names_what_is_missing_and_leaves_the_parts(tmp_path: Path, engine: FakeEngine) -> None:
    with pytest.raises(StudyError, match="no shard of the sweep fake has been computed there"):
        run.merge_shards(FakeScene(BIG), tmp_path)
    run.sweep_shard(FakeScene(BIG), tmp_path, Shard(2, 3))
    before = parts(tmp_path)
    with pytest.raises(StudyError, match=r"800 of 1200 cases are missing: 0 to 399, 800 to 1199. Compute"):
        run.merge_shards(FakeScene(BIG), tmp_path)
    assert parts(tmp_path) == before
    files = run.sweep_files(FakeScene(BIG), tmp_path, resume=True)
    assert files.computed == 800


def test_a_part_that_reaches_into_another_shard_is_used(killed: Path, engine: FakeEngine) -> None:
    """A sweep that was killed is gone on with in shards; none of its cases is computed twice."""
    stored = sum(int(name.split("-")[2]) for name in parts(killed))
    for number in range(1, 8):
        run.sweep_shard(FakeScene(BIG), killed, Shard(number, 7))
    assert sum(engine.chunks) == 1200 - stored
    run.merge_shards(FakeScene(BIG), killed)


def test_a_shard_of_another_sweep_is_refused(tmp_path: Path, engine: FakeEngine) -> None:
    run.sweep_shard(FakeScene(BIG), tmp_path, Shard(1, 3))
    other = {**BIG, "d": {"from": "1 in", "to": "7 in", "num": 30}}
    with pytest.raises(StudyError, match=r"belongs to another sweep.*sweep\.d\.to \(6\.0, now 7\.0\)"):
        run.sweep_shard(FakeScene(other), tmp_path, Shard(2, 3))


def test_a_damaged_part_of_another_shard_is_found_by_merge(tmp_path: Path, engine: FakeEngine) -> None:
    for number in (1, 2):
        run.sweep_shard(FakeScene(BIG), tmp_path, Shard(number, 2))
        if number == 1:
            part = next(tmp_path.glob("fake.parts/part-*"))
            part.write_bytes(part.read_bytes()[:-1])
    with pytest.raises(StudyError, match=rf"{part.name}: this part file is damaged"):
        run.merge_shards(FakeScene(BIG), tmp_path)


def test_locks_of_shards(tmp_path: Path) -> None:
    one, two, one_again = (ShardLock(tmp_path, Shard(number, 2)) for number in (1, 2, 1))
    whole = OutputLock(tmp_path)
    one.acquire()
    two.acquire()
    with pytest.raises(StudyError, match=rf"shard 1/2 is being computed already \(process {os.getpid()}"):
        one_again.acquire()
    one_again.release()
    with pytest.raises(StudyError, match="another sweep writes into this folder"):
        whole.acquire()
    one.release()
    with pytest.raises(StudyError, match="another sweep writes into this folder"):
        whole.acquire()
    two.release()
    whole.acquire()
    with pytest.raises(StudyError, match="another sweep writes into this folder"):
        one.acquire()
    one.release()
    whole.release()
    assert list(tmp_path.iterdir()) == []


def test_a_killed_shard_goes_on(tmp_path: Path, engine: FakeEngine) -> None:
    out = tmp_path / "out"
    for wanted in (1, 2):
        with child(out, "shard", "2/3") as process:
            wait_for_parts(process, out, wanted)
            process.send_signal(signal.SIGKILL)
    stored = sum(int(name.split("-")[2]) for name in parts(out))
    assert run.sweep_shard(FakeScene(BIG), out, Shard(2, 3)).computed == 400 - stored


def test_all_shards_at_once_from_the_command_line_while_merge_waits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path
    scene = write(folder, "a.toml", STUDY)
    assert invoke("sweep", scene, "--out", "whole").exit_code == 0
    assert invoke("merge", scene, "--out", "out").exit_code == 2
    assert invoke("sweep", scene, "--out", "out", "--shard", "4/3").exit_code == 2
    merge = command("merge", scene, "--out", "out", "--wait")
    waiting = subprocess.Popen(merge, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    shards = [
        subprocess.Popen(
            command("sweep", scene, "--out", "out", "--shard", f"{i}/3", "--workers", "1"),
            stderr=subprocess.PIPE,
            text=True,
        )
        for i in (1, 2, 3)
    ]
    told = [shard.communicate(timeout=HANGS)[1] for shard in shards]
    assert [shard.returncode for shard in shards] == [0, 0, 0], told
    assert any("all shards are there" in text for text in told)
    assert "shard 1/3: 33 cases, 33 computed" in told[0]
    shown, _ = waiting.communicate(timeout=HANGS)
    assert waiting.returncode == 0
    assert "101 cases (101 ok)" in shown
    assert data_of(folder / "out/pendulum.h5") == data_of(folder / "whole/pendulum.h5")
    assert (folder / "out/pendulum.csv").read_bytes() == (folder / "whole/pendulum.csv").read_bytes()
    assert left_in(folder / "out") == {"pendulum.h5", "pendulum.csv", "pendulum.png"}
    again = invoke("merge", scene, "--out", "out")
    assert again.exit_code == 0


def test_from_python(tmp_path: Path) -> None:
    scene = planemotion.load_text(STUDY)
    for number in (2, 1):
        done = scene.sweep_shard(number, 2, out=tmp_path)
        assert done.cases in (50, 51)
    with scene.sweep(out=tmp_path, resume=True) as data:
        assert data.sizes["L"] == 101


TWO_WORKERS = """
import sys
from itertools import pairwise
from pathlib import Path
from dask.distributed import Client, LocalCluster
import planemotion

def main():
    out, text = Path(sys.argv[1]), Path(sys.argv[2]).read_text()
    scene = planemotion.load_text(text)
    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        with Client(cluster) as client:
            scene.sweep(out=out, executor=client).close()

if __name__ == "__main__":
    main()
"""


def test_two_workers_of_dask_leave_the_same_bytes(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    (tmp_path / "run.py").write_text(TWO_WORKERS)
    (tmp_path / "a.toml").write_text(STUDY)
    command = [sys.executable, "run.py", "dask", "a.toml"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=HANGS, check=False)
    assert done.returncode == 0, done.stderr
    files = run.sweep_files(planemotion.load_text(STUDY), tmp_path / "threads")
    assert data_of(files.result) == data_of(tmp_path / "dask/pendulum.h5")
    assert files.table.read_bytes() == (tmp_path / "dask/pendulum.csv").read_bytes()
