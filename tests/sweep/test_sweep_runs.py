"""Sweeps with the engine: rows are runs of their own, whether in memory or in a file."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import planemotion
from planemotion._layout import (
    PM_BAD_VALUE,
)
from planemotion.compile.flatten import flatten
from planemotion.run import simulate
from planemotion.sweep import cases, run
from planemotion.sweep.plan import plan_sweep
from tests.scenes.parts import on_axle
from tests.scenes.pendulum import THROWN


@pytest.mark.parametrize("workers", [1, 2])
def test_every_row_is_a_run_of_its_own_bit_for_bit(workers: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cases, "_MAX_CASES", 5 * workers)
    scene = planemotion.load_text(THROWN)
    data = scene.sweep(workers=workers)
    plan = plan_sweep(scene)
    assert data.sizes == {"L": 3, "omega0": 8, "ask": 3, "angles_at": 2}
    assert data.angles_at.values.tolist() == [-89, -80]
    for case in range(plan.cases):
        values = plan.case(case)
        alone = scene.run(**values)
        row = data.sel({name: float(text.split()[0]) for name, text in values.items()})
        assert (row.height.item(), row.swing.item()) == (alone.height, alone.swing)
        assert np.array_equal(row.angles.values, np.array(alone.angles, float), equal_nan=True)
        assert row.audit_energy.item() == alone.audit["energy"]


def content(data: Any) -> Any:
    """A result without what differs from call to call, or belongs to its file."""
    other = ("created", "elapsed_seconds", "checksums")
    return data.drop_attrs(deep=False).assign_attrs(
        {key: value for key, value in data.attrs.items() if key not in other}
    )


def test_tables_are_made_once_for_all_grids_and_anew_for_another_scene(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    made = []

    def counted(scene: Any, run: str | None = None, *, history: bool = True) -> Any:
        made.append(scene.data.id)
        return flatten(scene, run, history=history)

    monkeypatch.setattr(cases, "flatten", counted)
    scene = planemotion.load_text(THROWN)

    def agrees(tables: Any, **grids: Any) -> Any:
        before = len(made)
        found = scene.sweep(workers=1, **grids)
        assert len(made) - before == tables
        anew = planemotion.Scene.from_table(scene.table)
        assert content(found).identical(content(anew.sweep(workers=1, **grids)))
        return found

    agrees(1, L=["18 in", "2 ft"])
    agrees(0, L={"from": "10 in", "to": "20 in", "num": 40})
    agrees(1, omega0=["30 deg/s"])  # another parameter is one that a case gives
    agrees(0, L=["18 in"])
    lighter = agrees(0, L=["18 in"]).height.item()
    scene.parameters(omega0="40 deg/s")
    assert agrees(1, L=["18 in"]).height.item() > lighter
    scene.parameters(omega0="50 deg/s")
    scene.table["parameters"]["omega0"] = "60 deg/s"  # of a copy
    assert agrees(1, L=["18 in"]).attrs["scene"].count("50 deg/s") == 1
    stored = scene.sweep(workers=1, out=tmp_path, L=["18 in"])
    with stored:
        assert content(stored).identical(content(agrees(0, L=["18 in"])))


def test_a_case_that_fails_does_not_stop_the_others() -> None:
    data = planemotion.load_text(THROWN).sweep(m=["1 kg", "-1 kg", "2 kg"])
    assert data.status.values.tolist() == [0, PM_BAD_VALUE, 0]
    assert np.isfinite(data.height.values).tolist() == [True, False, True]
    assert "bodies.AB" in str(data.message[1].values)


def test_a_case_that_fails_late_keeps_what_it_had_answered(tmp_path: Path) -> None:
    """The couple has no value from t = T on; what was asked before stands, as it does in a run alone."""
    scene = planemotion.load_text(LATE)
    exact = [1.5 / 0.4 * 2 / 3 * T * (1 - (1 - 0.5 / T) ** 1.5) for T in (1, 3)]
    data = scene.sweep()
    assert data.status.values[0] < 0
    assert data.status.values[1] == 0
    assert data.omega.values == pytest.approx(exact, rel=1e-9)
    assert np.isnan(data.end.values).tolist() == [True, False]
    assert data.omega.values[0] == simulate(scene).asks["omega"].value
    out = tmp_path / "out"
    run.sweep_files(scene, out)
    with xr.open_dataset(out / "late.h5", engine="h5netcdf") as stored:
        assert stored.omega.values == pytest.approx(exact, rel=1e-9)
        assert np.isnan(stored.end.values).tolist() == [True, False]
    with open(out / "late.csv", newline="") as file:
        header, *rows = csv.reader(file)
    assert [float(row[1]) for row in rows] == pytest.approx(exact, rel=1e-9)
    assert header[1].startswith("omega [")
    assert rows[0][-2] != ""


ZIPPED = {"m": ["1 kg", "-1 kg"], "b": ["10 in", "1 ft"], "zip": [["m", "b"]]}

LATE = f"""
id = "late"
until = "t = 2 s"
plane = "horizontal"
parameters = {{ T = "1 s", M = "1.5 N*m" }}
{on_axle(mass="2 kg", inertia="0.4 kg*m^2")}
[forces]
engine = {{ couple = "wheel", value = "M*sqrt(1 - t/T)" }}
[events]
half = "t = 0.5 s"
[ask]
omega = {{ of = "wheel.omega", at = "half" }}
end = "wheel.omega"
[sweep]
T = ["1 s", "3 s"]
"""


@pytest.mark.parametrize(
    ("grids", "statuses"),
    [({"m": ["1 kg", "-1 kg", "2 kg"]}, [0, PM_BAD_VALUE, 0]), (ZIPPED, [0, PM_BAD_VALUE])],
    ids=["one grid", "zipped"],
)
def test_in_memory_as_in_the_file(grids: dict[str, Any], statuses: list[int], tmp_path: Path) -> None:
    """A sweep without a folder gives what one with a folder leaves: values, names, attributes."""
    scene = planemotion.load_text(THROWN)
    in_memory, from_file = scene.sweep(**grids), scene.sweep(out=tmp_path, **grids).load()
    assert in_memory.status.dims == ("m",)
    assert in_memory.status.values.tolist() == statuses
    del from_file.attrs["checksums"]  # of the file
    for data in (in_memory, from_file):
        for name in ("created", "elapsed_seconds"):
            del data.attrs[name]
    xr.testing.assert_identical(in_memory, from_file)
