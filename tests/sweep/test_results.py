"""What a sweep leaves: names, units, rows, chunks; the engine is a formula."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from planemotion._layout import (
    PM_ASSEMBLY,
    PM_LIMIT_TIME,
    PM_REASON_NOT_REACHED,
)
from planemotion.sweep import cases, run
from tests.sweep.fake import BIG, RPM, SWEEP, FakeEngine, FakeScene, data_of


def test_a_result_opens_in_xarray_with_labels_and_units(engine: FakeEngine, tmp_path: Path) -> None:
    data = run.run_sweep(FakeScene(SWEEP), out=tmp_path, workers=2)
    with data, xr.open_dataset(tmp_path / "fake.h5", engine="h5netcdf") as again:
        assert data.identical(again)
        assert data.sizes == {"d": 501, "m": 4, "ask": 3, "list_number": 2}
        assert data.d.attrs["units"] == "in"
        assert data["sum"].attrs == {"units": "ft", "long_name": "d", "ancillary_variables": "sum_error"}
        assert data["sum_error"].attrs == {"units": "ft", "long_name": "estimated absolute error of sum"}
        assert float(data["list_error"].sel(d=6, m=1)[1]) == pytest.approx(1e-12 * 2 * (6 * 0.0254) / RPM)
        assert float(data["margin"].sel(d=6, m=1)) == pytest.approx(1 + 6 * 0.0254)
        assert float(data["error_over_accuracy"].sel(d=6, m=1)) == 0.5
        assert float(data["sum"].sel(d=1.01, m=1)) == (1.01 * 0.0254 + 2) / 0.3048
        assert data.list.sel(d=6, m=1).values.tolist() == [2 / RPM, 2 * (6 * 0.0254) / RPM]
        failed = data.sel(d=1.5, m=13)
        assert failed.status == PM_ASSEMBLY
        assert str(failed.message.values) == f"case with status {PM_ASSEMBLY}, as said"
        assert np.isnan(failed["sum"])
        assert np.isnan(failed.list).all()
        early = data.sel(d=1.5, m=14)
        assert (int(early.status), float(early.odd)) == (PM_LIMIT_TIME, 14)
        assert int(early.reason.sel(ask="sum")) == PM_REASON_NOT_REACHED
        assert "limit_time" in data.status.attrs["flag_meanings"]
        assert [data.attrs[name] for name in ("scene", "cases", "cases_not_ok", "routes")] == [
            "fake",
            2004,
            1002,
            "rk",
        ]
        assert data.audit_energy.sel(m=1, d=1.0) == 0.0254e-15
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fake.csv", "fake.h5"]


def test_the_table_has_a_row_per_case_and_the_status_last(engine: FakeEngine, tmp_path: Path) -> None:
    run.sweep_files(FakeScene(SWEEP), tmp_path)
    with open(tmp_path / "fake.csv", newline="") as file:
        header, *rows = csv.reader(file)
    asks = ["sum [ft]", "list[1] [rpm]", "list[2] [rpm]", "odd [1]"]
    errors = ["sum error [ft]", "list error [rpm]", "odd error [1]", "margin"]
    assert header == ["d [in]", "m [1]", *asks, *errors, "reason", "status"]
    assert len(rows) == 2004
    assert rows[4][:3] == ["1.01", "1.0", repr((1.01 * 0.0254 + 2) / 0.3048)]
    assert rows[4][6:] == ["6.65e-12", "1.91e-11", "1e-12", "1.03", "", "ok"]
    assert rows[5][2:6] == ["nan"] * 4
    assert rows[5][-2:] == [f"case with status {PM_ASSEMBLY}, as said", "assembly"]
    assert rows[7][2] == "nan"
    assert rows[7][-2:] == ["sum: not reached", "ok"]


def test_without_an_output_nothing_is_left_behind(
    engine: FakeEngine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    data = run.run_sweep(FakeScene(SWEEP))
    assert float(data["sum"].sel(d=1.01, m=1)) == (1.01 * 0.0254 + 2) / 0.3048
    assert list(tmp_path.iterdir()) == []


def test_zipped_coordinates_are_labelled(engine: FakeEngine) -> None:
    data = run.run_sweep(FakeScene({"d": ["1 in", "2 in"], "m": [5, 6], "zip": [["d", "m"]]}))
    assert data["sum"].dims == ("d",)
    assert data.m.dims == ("d",)
    assert "m" in data.coords


def test_named_runs_have_a_dimension_and_keep_their_own_values(engine: FakeEngine) -> None:
    ask = {"sum": {"of": "d", "run": "one", "unit": "ft"}, "odd": {"of": "m", "run": "two"}}
    scene = FakeScene({"d": ["1 in", "2 in"], "m": [1, 14]}, runs={"one": {}, "two": {"m": 13}}, ask=ask)
    data = run.run_sweep(scene)
    assert data.run.values.tolist() == ["one", "two"]
    assert (data.run_status.sel(run="two") == PM_ASSEMBLY).all()
    assert data.run_status.sel(run="one", d=1).values.tolist() == [0, PM_LIMIT_TIME]
    assert (data.status == PM_ASSEMBLY).all()
    assert str(data.message.values[0, 0]).startswith("runs.two: case with status")
    assert np.isnan(data.odd).all()
    assert np.isfinite(data["sum"].sel(m=1)).all()


def test_chunks_change_no_row(monkeypatch: pytest.MonkeyPatch, engine: FakeEngine, tmp_path: Path) -> None:
    scene = FakeScene(BIG)
    run.sweep_files(scene, tmp_path / "a", workers=1)
    monkeypatch.setattr(cases, "_MAX_CASES", 7)
    run.sweep_files(scene, tmp_path / "b", workers=3)
    assert max(engine.chunks[-50:]) <= 9
    assert data_of(tmp_path / "a/fake.h5") == data_of(tmp_path / "b/fake.h5")
    assert (tmp_path / "a/fake.csv").read_bytes() == (tmp_path / "b/fake.csv").read_bytes()


def test_chunks_grow_to_half_a_second_of_work(engine: FakeEngine, tmp_path: Path) -> None:
    engine.pause = 0.002
    seen = []
    run.sweep_files(FakeScene(BIG), tmp_path, workers=1, progress=lambda *progress: seen.append(progress))
    assert 150 < max(engine.chunks) < 350
    assert seen == sorted(seen)
    assert seen[-1] == (1200, 1200)
    assert len(seen) > 15


def test_a_broken_engine_is_not_swallowed(
    engine: FakeEngine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: Any, **__: Any) -> None:
        raise RuntimeError("broken")

    monkeypatch.setattr(engine, "run_cases", broken)
    with pytest.raises(RuntimeError, match="broken"):
        run.sweep_files(FakeScene(SWEEP), tmp_path / "out")
    assert not (tmp_path / "out").exists()
