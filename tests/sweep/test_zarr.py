"""Results as Zarr and tables as Parquet: beside HDF5 and CSV, by many writers, killed, damaged, in pieces."""

from __future__ import annotations

import itertools
import math
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from planemotion import Scene, StudyError, load
from planemotion.cli.main import main
from planemotion.sweep.chunking import Chunking
from planemotion.sweep.verify import verify
from tests import ROOT

zarr = pytest.importorskip("zarr")
SWING = """
id = "swing"
parameters = { angle = "60 deg", L = "1 m", m = "1 kg" }
bodies.bob = { rod = ["A", "B"], length = "L", mass = "m", at = { A = [0, 0] }, angle = "-angle" }
joints.rod = { pin = ["bob.A", "ground"] }
until = "t = 2 s"
ask.omega = "bob.omega"
ask.speeds = { of = "bob.omega", at = { each = "t", values = ["0.5 s", "1 s", "3 s"] } }
solve.route = "rk"
solve.max_steps = 60
[sweep]
angle = { from = "1 deg", to = "89 deg", num = 9 }
L = { from = "10 cm", to = "3 m", num = 7 }
m = ["1 kg", "2 kg"]
"""
FILL = """
import sys
from planemotion import load
from planemotion.sweep.forms import Form
from planemotion.sweep.run import sweep_files, sweep_shard
from planemotion.sweep.shard import Shard
study, out, shard = sys.argv[1:]
if shard == "all":
    sweep_files(load(study), out, workers=1, resume=True, form=Form("zarr", "none", 4))
else:
    sweep_shard(load(study), out, Shard.read(shard), workers=1, form=Form("zarr", "none", 4))
"""


def equal(one: xr.Dataset, other: xr.Dataset) -> None:
    """All that both hold, bit for bit."""
    assert set(one.variables) == set(other.variables)
    for name, values in one.variables.items():
        assert values.dims == other[name].dims
        np.testing.assert_array_equal(values.values, other[name].values, err_msg=str(name))


def opened(folder: Path) -> xr.Dataset:
    """A result without what only a store has."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return xr.open_zarr(folder / "swing.zarr").drop_vars("block_seconds").load()


def filling(study: Path, out: Path, shard: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "-c", FILL, str(study), str(out), shard], cwd=ROOT)


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "swing.toml").write_text(SWING, encoding="utf-8")
    return tmp_path / "swing.toml"


@pytest.mark.parametrize("shape", [(1,), (17,), (3, 5), (4, 1, 6), (2, 3, 4, 5)])
def test_chunks_are_boxes_of_consecutive_cases(shape: tuple[int, ...]) -> None:
    cases = math.prod(shape)
    number = np.arange(cases).reshape(shape)
    for wanted in range(1, cases + 2):
        chunking = Chunking.of(shape, wanted)
        found = list(chunking.boxes(0, cases))
        assert [chunk for chunk, _, _ in found] == list(range(chunking.count))
        assert np.concatenate([number[box].ravel() for _, _, box in found]).tolist() == list(range(cases))
        assert all(number[box].size == count <= max(wanted, 1) for _, count, box in found)
        starts = [chunking.start(chunk) for chunk in range(chunking.count + 1)]
        assert [chunking.at(case) for case in range(cases)] == [
            max(i for i, start in enumerate(starts) if start <= case) for case in range(cases)
        ]
        for (first, _), count in itertools.product(itertools.pairwise(starts), (1, 4, cases)):
            end = chunking.end_near(first, count, cases)
            assert end in starts
            assert end > first


@pytest.mark.parametrize("chunk", [None, 1, 5, 14, 1000])
def test_it_holds_what_hdf5_does(study: Path, tmp_path: Path, chunk: int | None) -> None:
    """Lists, errors, statuses and messages, whatever the chunks."""
    scene = load(study)
    hdf5 = scene.sweep(out=tmp_path / "hdf5")
    assert 0 < (hdf5["status"] != 0).sum() < hdf5["status"].size
    scene.sweep(out=tmp_path / "zarr", format="zarr", chunk=chunk)
    found = opened(tmp_path / "zarr")
    equal(found, hdf5.load())
    for name in ("cases", "cases_not_ok", "routes", "parameters", "scene", "manifest", "Conventions"):
        assert found.attrs[name] == hdf5.attrs[name]
    assert (tmp_path / "zarr/swing.csv").read_bytes() == (tmp_path / "hdf5/swing.csv").read_bytes()
    group = zarr.open_group(tmp_path / "zarr/swing.zarr", mode="r")
    assert group.metadata.zarr_format == 3


def test_shards_write_beside_each_other(study: Path, tmp_path: Path) -> None:
    """Three processes at once into one store; then it is whole."""
    processes = [filling(study, tmp_path / "out", f"{i}/3") for i in (1, 2, 3)]
    assert [process.wait(120) for process in processes] == [0, 0, 0]
    with pytest.raises(SystemExit) as ended:
        main(["merge", str(study), "--out", str(tmp_path / "out"), "--table", "none"])
    assert not ended.value.code
    equal(opened(tmp_path / "out"), load(study).sweep())
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["swing.png", "swing.zarr"]


def test_a_shard_that_is_missing_is_told(study: Path, tmp_path: Path) -> None:
    assert filling(study, tmp_path / "out", "1/2").wait(120) == 0
    with pytest.raises(SystemExit) as ended:
        main(["merge", str(study), "--out", str(tmp_path / "out")])
    assert ended.value.code == 2


def test_killed_again_and_again(study: Path, tmp_path: Path) -> None:
    """Blocks that are written stay; at last the same stands there."""
    ended, kills = None, 0
    while ended != 0:
        process = filling(study, tmp_path / "out", "all")
        there = len(list(tmp_path.glob("out/swing.zarr/block_seconds/c/*")))
        while (ended := process.poll()) is None and kills < 5:
            if len(list(tmp_path.glob("out/swing.zarr/block_seconds/c/*"))) > there + 2:
                process.send_signal(signal.SIGKILL)
                kills += 1
                break
            time.sleep(0.002)
        ended = process.wait(120)
    assert kills >= 2
    equal(opened(tmp_path / "out"), load(study).sweep())


def test_a_finished_one_is_not_computed_again(study: Path, tmp_path: Path) -> None:
    scene = load(study)
    scene.sweep(out=tmp_path, format="zarr", table="parquet")
    with pytest.raises(StudyError, match="is there already and is never overwritten"):
        scene.sweep(out=tmp_path, format="zarr")
    before = {path: path.stat().st_mtime_ns for path in tmp_path.glob("swing.zarr/omega/**/*")}
    (tmp_path / "swing.parquet").write_bytes(b"PAR1")
    scene.sweep(out=tmp_path, format="zarr", table="parquet", resume=True)
    assert {path: path.stat().st_mtime_ns for path in tmp_path.glob("swing.zarr/omega/**/*")} == before
    assert len(pd.read_parquet(tmp_path / "swing.parquet")) == 126
    with pytest.raises(StudyError, match="belongs to another sweep"):
        scene.with_values({"m": "3 kg", "solve.max_steps": 7}).sweep(out=tmp_path, format="zarr", resume=True)
    with pytest.raises(StudyError, match="was begun with chunks of"):
        scene.sweep(out=tmp_path, format="zarr", resume=True, chunk=3)


def test_damage_is_found(study: Path, tmp_path: Path) -> None:
    load(study).sweep(out=tmp_path, format="zarr", chunk=14)
    assert [one.faults for one in verify(tmp_path)] == [()]
    chunk = next((tmp_path / "swing.zarr/omega/c").rglob("0"))
    chunk = chunk if chunk.is_file() else next(path for path in chunk.rglob("*") if path.is_file())
    data = bytearray(chunk.read_bytes())
    data[len(data) // 2] ^= 1
    chunk.write_bytes(data)
    (found,) = verify(tmp_path / "swing.zarr")
    assert [fault.partition(":")[0] for fault in found.faults] == ["omega"]


def test_dask_reads_piece_by_piece(study: Path, tmp_path: Path) -> None:
    """Zarr and HDF5; what is computed so is what the whole gives."""
    pytest.importorskip("dask")
    scene = load(study)
    scene.sweep(out=tmp_path, format="zarr", chunk=14)
    whole = scene.sweep()
    lazy = xr.open_zarr(tmp_path / "swing.zarr", chunks={})
    assert len(lazy.chunksizes["angle"]) == 9
    expected = whole["omega"].where(whole["status"] == 0).mean("L").values
    np.testing.assert_allclose(lazy["omega"].where(lazy["status"] == 0).mean("L").compute(), expected)
    scene.sweep(out=tmp_path / "hdf5")
    lazy = xr.open_dataset(tmp_path / "hdf5/swing.h5", engine="h5netcdf", chunks={"angle": 2})
    assert len(lazy.chunksizes["angle"]) == 5
    np.testing.assert_allclose(lazy["omega"].where(lazy["status"] == 0).mean("L").compute(), expected)


def test_parquet_holds_what_csv_does(study: Path, tmp_path: Path) -> None:
    scene: Scene = load(study)
    scene.sweep(out=tmp_path / "a", table="parquet")
    scene.sweep(out=tmp_path / "b")
    assert not (tmp_path / "a/swing.csv").exists()
    one, other = pd.read_parquet(tmp_path / "a/swing.parquet"), pd.read_csv(tmp_path / "b/swing.csv")
    assert one.columns.tolist() == other.columns.tolist()
    for name in one.columns:
        if one[name].dtype.kind == "f":
            np.testing.assert_array_equal(one[name], other[name])
        else:
            assert one[name].tolist() == other[name].fillna("").tolist()
    listed = 'cases = { file = "a/swing.parquet", columns = ["angle", "L", "m"] }'
    (tmp_path / "again.toml").write_text(SWING.partition("angle = { from")[0] + listed, encoding="utf-8")
    np.testing.assert_array_equal(load(tmp_path / "again.toml").sweep()["omega"], one["omega [rad/s]"])


def test_the_command(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(
            [
                "sweep",
                str(study),
                "--out",
                str(tmp_path),
                "--format",
                "zarr",
                "--table",
                "parquet",
                "--chunk",
                "20",
            ]
        )
    assert not ended.value.code
    shown = capsys.readouterr()
    told = shown.out
    assert "126 cases, at most about" in shown.err
    assert "of Zarr, and its table as parquet" in shown.err
    assert all(f"{tmp_path}/swing.{end}" in told for end in ("zarr", "parquet", "png"))
    with pytest.raises(SystemExit) as ended:
        main(["check", str(tmp_path / "swing.zarr")])
    assert not ended.value.code


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"format": "hdf4"}, 'format = "hdf4": one of hdf5, zarr is wanted'),
        ({"table": "xlsx"}, 'table = "xlsx": one of csv, parquet, none is wanted'),
        ({"chunk": 0}, "chunk = 0: at least 1 case is wanted"),
    ],
)
def test_forms_that_there_are_not(study: Path, tmp_path: Path, given: dict[str, Any], told: str) -> None:
    with pytest.raises(StudyError, match=told):
        load(study).sweep(out=tmp_path, **given)


@pytest.mark.parametrize("given", [{"format": "zarr"}, {"table": "parquet"}])
def test_a_package_that_is_missing_is_told(
    study: Path, tmp_path: Path, given: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("zarr", "pyarrow", "pyarrow.parquet"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(StudyError, match=r'pip install "planemotion\[stores\]"'):
        load(study).sweep(out=tmp_path, **given)
