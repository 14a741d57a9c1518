"""Sweeps that were killed are finished; what does not fit together is refused."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
import xarray as xr

from planemotion.base.errors import StudyError
from planemotion.sweep import cases, forms, run
from tests.sweep.fake import BIG, FakeEngine, FakeScene, data_of
from tests.sweep.processes import child, files_in, parts, wait_for_parts


def test_a_killed_sweep_is_finished_without_repeating_or_changing_a_row(
    killed: Path, engine: FakeEngine, tmp_path: Path
) -> None:
    stored = parts(killed)
    assert not (killed / "fake.h5").exists()
    assert not (killed / "fake.csv").exists()
    with pytest.raises(StudyError, match=r"unfinished sweep is there.*--resume"):
        run.sweep_files(FakeScene(BIG), killed)
    assert parts(killed) == stored
    files = run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert sum(engine.chunks) == files.computed == 1200 - sum(int(name.split("-")[2]) for name in stored)
    run.sweep_files(FakeScene(BIG), tmp_path / "straight")
    assert data_of(killed / "fake.h5") == data_of(tmp_path / "straight/fake.h5")
    assert (killed / "fake.csv").read_bytes() == (tmp_path / "straight/fake.csv").read_bytes()
    assert sorted(path.name for path in killed.iterdir()) == ["fake.csv", "fake.h5"]


def test_killed_again_and_again_it_still_finishes(tmp_path: Path, engine: FakeEngine) -> None:
    out = tmp_path / "out"
    for wanted in (1, 3, 5):
        with child(out, "resume") as process:
            wait_for_parts(process, out, wanted)
            process.send_signal(signal.SIGKILL)
    run.sweep_files(FakeScene(BIG), out, resume=True)
    run.sweep_files(FakeScene(BIG), tmp_path / "straight")
    assert data_of(out / "fake.h5") == data_of(tmp_path / "straight/fake.h5")


def test_a_changed_comment_does_not_matter(killed: Path, engine: FakeEngine) -> None:
    run.sweep_files(FakeScene(BIG, text="# new\nfake"), killed, resume=True)
    with xr.open_dataset(killed / "fake.h5", engine="h5netcdf") as data:
        assert data.attrs["scene"] == "# new\nfake"


def test_resume_begins_where_nothing_is_there(engine: FakeEngine, tmp_path: Path) -> None:
    files = run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True)
    assert files.computed == 1200
    assert run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True).computed == 0
    files.table.unlink()
    run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True)
    assert files.table.exists()


def test_killed_before_the_table_was_written(
    engine: FakeEngine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(forms, "write_csv", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            run.sweep_files(FakeScene(BIG), tmp_path)
    assert run.sweep_files(FakeScene(BIG), tmp_path, resume=True).computed == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fake.csv", "fake.h5"]


def test_a_finished_sweep_is_not_overwritten(engine: FakeEngine, tmp_path: Path) -> None:
    run.sweep_files(FakeScene(BIG), tmp_path)
    before = (tmp_path / "fake.h5").read_bytes()
    with pytest.raises(StudyError, match="is there already and is never overwritten; give another --out"):
        run.sweep_files(FakeScene(BIG), tmp_path)
    assert (tmp_path / "fake.h5").read_bytes() == before


@pytest.mark.parametrize("state", ["unfinished", "finished"])
def test_resume_says_what_is_different(
    killed: Path, engine: FakeEngine, state: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if state == "finished":
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    before = files_in(killed)
    other = {**BIG, "d": {"from": "1 in", "to": "7 in", "num": 30}}
    with pytest.raises(StudyError, match=r"another sweep.*Different: sweep\.d\.to \(6\.0, now 7\.0\)\. Give"):
        run.sweep_files(FakeScene(other), killed, resume=True)
    with pytest.raises(StudyError, match="scene with the line `another text`"):
        run.sweep_files(FakeScene(BIG, text="fake\nanother text"), killed, resume=True)
    heavier = FakeScene(BIG, parameters={"d": "1 in", "w": "2 rad/s", "m": 4})
    with pytest.raises(StudyError, match="tables"):
        run.sweep_files(heavier, killed, resume=True)
    monkeypatch.setattr(cases, "row_versions", lambda: {"planemotion": "2"})
    with pytest.raises(StudyError, match=r'versions.planemotion \("1", now "2"\)'):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert files_in(killed) == before


@pytest.mark.parametrize("damage", ["flipped", "cut", "empty"])
def test_a_damaged_part_is_named_and_nothing_is_touched(
    killed: Path, engine: FakeEngine, damage: str
) -> None:
    path = sorted(killed.glob("fake.parts/part-*"))[1]
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes({"flipped": bytes(data), "cut": bytes(data[:-100]), "empty": b""}[damage])
    before = parts(killed)
    with pytest.raises(StudyError, match=rf"{path.name}: this part file is damaged.*Remove it"):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert parts(killed) == before
    path.unlink()
    run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert (killed / "fake.h5").exists()


def test_parts_of_an_earlier_version_are_refused(killed: Path, engine: FakeEngine) -> None:
    manifest = killed / "fake.parts/manifest.json"
    manifest.write_text(manifest.read_text().replace('"format": 5', '"format": 4'))
    with pytest.raises(StudyError, match=r"another version of planemotion, in another format \(4, now 5\)"):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    manifest.write_text("[]")
    with pytest.raises(StudyError, match=r"in another format \(missing, now 5\)"):
        run.sweep_files(FakeScene(BIG), killed, resume=True)


def test_a_damaged_manifest_is_named(killed: Path, engine: FakeEngine) -> None:
    (killed / "fake.parts/manifest.json").write_text("{")
    with pytest.raises(StudyError, match=r"manifest.json: cannot be read"):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert parts(killed)
