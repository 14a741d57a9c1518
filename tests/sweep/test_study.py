"""Sweeps against an engine that is no more than a formula: grids, chunks, kills, resume, locks, messages."""

import csv
import json
import signal
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

import planemotion
from planemotion._layout import (
    PM_ASSEMBLY,
    PM_AUDITS,
    PM_BAD_VALUE,
    PM_CANCELLED,
    PM_COUNT_COLUMNS,
    PM_COUNT_ROUTE,
    PM_LIMIT_TIME,
    PM_REASON_FAILED,
    PM_REASON_NOT_REACHED,
    PM_ROUTE_RK,
)
from planemotion.base.errors import SceneError, StudyError
from planemotion.compile.asks import Asked
from planemotion.compile.flatten import flatten
from planemotion.compile.grids import read_grid
from planemotion.language import units
from planemotion.model.tables import Grid
from planemotion.reading.validate import validate
from planemotion.run import simulate
from planemotion.sweep import cases, chunks, run
from planemotion.sweep.plan import Axis, SweepPlan, plan_sweep
from tests import ROOT
from tests.waiting import wait_for

# ---- an engine and a scene to sweep -------------------------------------------------------------------


class FakeScene:
    """What a sweep uses of a scene."""

    def __init__(self, sweep, parameters=None, runs=None, ask=None, text="fake"):
        raw = {
            "id": "fake",
            "until": "t = 1 s",
            "bodies": {"A": {"mass": "1 kg", "at": [0, 0]}},
            "parameters": parameters or {"d": "1 in", "w": "2 rad/s", "m": 3},
            "ask": ask or {"sum": {"of": "d", "unit": "ft"}, "list": {"of": "w", "unit": "rpm"}, "odd": "m"},
            "sweep": sweep,
            "runs": runs or {},
        }
        self.raw, self.file = raw, "fake.toml"
        self.data = validate(raw, file=self.file)
        self.text = text

    def to_toml(self):
        return "\n".join(line for line in self.text.splitlines() if not line.startswith("#"))


RPM = units.factor("rpm")[0]
ASKS = (
    Asked(key="sum", unit="ft", factor=0.3048, first=0, count=1, is_list=False),
    Asked(key="list", unit="rpm", factor=RPM, first=1, count=2, is_list=True),
    Asked(key="odd", unit="", factor=1.0, first=3, count=1, is_list=False),
)


def fake_flatten(scene, run=None, *, history=True):
    """Three parameters; asks that are not of this run are left out."""
    data = scene.data
    values = {**data.parameters, **(data.runs[run] if run else {})}
    names = tuple(name for name in values if name != "g")
    return SimpleNamespace(
        table=np.arange(5, dtype=np.int32),
        constant=np.zeros(1),
        parameters=names,
        defaults=np.array([units.parse_quantity(values[name]).value_si for name in names]),
        asks=tuple(
            replace(ask, text=data.ask[ask.key].text)
            for ask in ASKS
            if ask.key in data.ask and data.ask[ask.key].run in (None, run)
        ),
    )


class FakeEngine:
    """Rows follow from their own parameters only; `pause` s per case."""

    def __init__(self, pause=0.0):
        self.pause = pause
        self.chunks = []

    def run_cases(self, flat, param, *, workers=1, stop=None, progress=None):
        assert param.dtype == np.float64
        assert param.flags.c_contiguous
        n = len(param)
        self.chunks.append(n)
        d, w, m = param.T
        out = np.stack([d + w, w, w * d, m], axis=1)
        status = np.zeros(n, np.int32)
        reason = np.zeros((n, len(flat.asks)), np.int32)
        status[m == 13] = PM_ASSEMBLY
        status[m == 14] = PM_LIMIT_TIME
        reason[m == 13] = PM_REASON_FAILED
        reason[m == 14, 0] = PM_REASON_NOT_REACHED
        reason[m == 15, 0] = PM_REASON_NOT_REACHED
        out[reason[:, 0] > 0, 0] = np.nan
        out[m == 13] = np.nan  # as the kernel does where nothing stands
        count = np.zeros((n, PM_COUNT_COLUMNS), np.int64)
        count[:, PM_COUNT_ROUTE] = PM_ROUTE_RK
        for i in range(n if self.pause else 0):
            if stop[0]:
                status[i:] = PM_CANCELLED
                break
            time.sleep(self.pause)
            progress[0] = i + 1
        progress[0] = n
        audit = np.stack([d * 1e-15] * PM_AUDITS, axis=1)
        trust = np.stack([1 + d, np.full(n, 0.5)], axis=1)
        numbers = {"out": out, "error": 1e-12 * out, "audit": audit, "trust": trust}
        return SimpleNamespace(**numbers, reason=reason, status=status, count=count)

    def message(self, flat, results, i):
        return f"case with status {results.status[i]}, as said"


def plant(engine):
    cases.call = cases.messages = engine
    cases.flatten, cases.versions = fake_flatten, lambda: {"planemotion": "1"}


@pytest.fixture
def engine(monkeypatch):
    engine = FakeEngine()
    monkeypatch.setattr(cases, "call", engine)
    monkeypatch.setattr(cases, "messages", engine)
    monkeypatch.setattr(cases, "flatten", fake_flatten)
    monkeypatch.setattr(cases, "versions", lambda: {"planemotion": "1"})
    return engine


SWEEP = {"d": {"from": "1 in", "to": "6 in", "num": 501}, "m": [1, 13, 14, 15]}
MILLION = {
    "d": {"from": "1 in", "to": "6 in", "num": 2000},
    "w": {"from": "0 rad/s", "to": "5 rad/s", "num": 500},
}
BIG = {"d": {"from": "1 in", "to": "6 in", "num": 30}, "w": {"from": "0 rad/s", "to": "5 rad/s", "num": 40}}


def data_of(path):
    """Names and bytes of everything in a result."""
    with h5py.File(path) as file:
        return {name: file[name][...].tolist() if file[name].dtype.kind == "O" else file[name][...].tobytes()
                for name in file}  # fmt: skip


# ---- grids --------------------------------------------------------------------------------------------


def grid(raw, unit=""):
    raw = {"values": tuple(raw)} if isinstance(raw, list) else raw
    return read_grid(Grid.model_validate(raw), path="sweep.d", unit=unit)


def test_a_linear_grid_has_the_decimals_that_one_would_write():
    unit, values = grid({"from": "1 in", "to": "6 in", "num": 501})
    assert unit == "in"
    assert values.tolist() == [float(f"{i // 100}.{i % 100:02}") for i in range(100, 601)]


def test_a_step_and_a_number_make_the_same_grid():
    stepped, counted = {"from": "0 m", "to": "0.3 m", "step": "5 mm"}, {"from": 0, "to": "0.3 m", "num": 61}
    assert grid(stepped)[1].tolist() == grid(counted, "m")[1].tolist()
    down = grid({"from": "30 deg", "to": "-90 deg", "step": "-10 deg"})[1]
    assert down.tolist() == list(range(30, -91, -10))


def test_a_step_that_does_not_divide_its_range_stops_before_the_end():
    assert grid({"from": "1 in", "to": "2 in", "step": "0.3 in"})[1].tolist() == [1, 1.3, 1.6, 1.9]


def test_one_value_is_the_first():
    assert grid({"from": "1 in", "to": "2 in", "num": 1})[1].tolist() == [1]


def test_a_logarithmic_grid_keeps_its_ends():
    values = grid({"from": "0.3 N", "to": "300 N", "num": 4, "scale": "log"})[1]
    assert values[[0, 3]].tolist() == [0.3, 300]
    assert values == pytest.approx([0.3, 3, 30, 300], rel=1e-15)


def test_a_list_is_in_the_unit_of_its_first_value():
    unit, values = grid([0, "2 ft", "6 in", "1 ft"])
    assert (unit, values.tolist()) == ("ft", [0, 2, pytest.approx(0.5, rel=1e-15), 1])
    assert grid([True, False])[1].tolist() == [1, 0]


def test_bare_numbers_take_the_declared_unit():
    assert grid([1, 2], "in")[0] == "in"


@pytest.mark.parametrize(
    ("raw", "message"),
    [
        ({"from": "1 in", "to": "2 in", "num": 0}, "sweep.d.num = 0: an empty sweep; at least 1 value"),
        ({"from": "1 in", "to": "2 in", "num": -3}, "sweep.d.num = -3: an empty sweep"),
        ({"from": "1 in", "to": "2 in", "num": 10**9}, "at most 10000000"),
        ([], 'sweep.d = "[]": an empty sweep; at least 1 value is needed'),
        (["1 in", "2 lb"], 'sweep.d[1] = "2.0 lb": a force, but this grid is of length'),
        (["1 in", 2], "sweep.d[1]"),
        (["r + 1"], "sweep.d[0]"),
        ({"from": "1 in", "to": "2 in", "step": "-0.5 in"}, "the step must lead"),
        ({"from": "1 in", "to": "2 in", "step": 0}, "the step must lead"),
        ({"from": "1 in", "to": "2 in", "step": "1e-9 in"}, "at most 10000000"),
        ({"from": "0 in", "to": "2 in", "num": 3, "scale": "log"}, "sweep.d.scale"),
        ({"from": "1 in", "to": "2 in", "step": "1 in", "scale": "log"}, 'needs "num"'),
    ],
)
def test_a_grid_that_makes_no_sense_is_refused_with_its_place(raw, message):
    with pytest.raises(SceneError) as error:
        grid(raw)
    assert message in str(error.value)


@given(
    st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.integers(2, 60),
    st.sampled_from(["in", "ft", "mm", "lb", "rpm", "deg", ""]),
)  # fmt: skip
@settings(deadline=None)
def test_a_case_written_out_gives_the_bits_of_the_grid(first, last, num, unit):
    raw = {"from": f"{first!r} {unit}", "to": f"{last!r} {unit}", "num": num}
    axis = Axis("d", *grid(raw))
    plan = SweepPlan(((axis,),))
    column = plan.block(0, num)[:, 0]
    written = [units.parse_quantity(plan.case(i)["d"]).value_si for i in range(num)]
    assert column.tobytes() == np.array(written).tobytes()
    assert axis.values[[0, -1]].tolist() == [first, last]


# ---- plans --------------------------------------------------------------------------------------------


def test_cases_are_numbered_in_the_order_of_c():
    plan = plan_sweep(FakeScene({"d": ["1 in", "2 in"], "m": [5, 6, 7]}))
    assert (plan.names, plan.dims, plan.cases) == (("d", "m"), (("d", 2), ("m", 3)), 6)
    assert plan.block(2, 3).tolist() == [[0.0254, 7], [0.0508, 5], [0.0508, 6]]
    assert plan.case(3) == {"d": "2.0 in", "m": "5.0"}


def test_zipped_parameters_share_a_dimension():
    sweep = {"m": [1, 2], "w": ["1 rad/s", "2 rad/s"], "d": [3, 4], "zip": [["d", "m"]]}
    plan = plan_sweep(FakeScene(sweep))
    assert plan.dims == (("d", 2), ("w", 2))
    assert plan.block(0, 3).tolist() == [[3 * 0.0254, 1, 1], [3 * 0.0254, 1, 2], [4 * 0.0254, 2, 1]]


@pytest.mark.parametrize(
    ("sweep", "message"),
    [
        ({}, "fake.toml: sweep: nothing to sweep"),
        ({"d": ["1 in"], "m": [1, 2], "zip": [["d", "m"]]}, "fake.toml: sweep.zip[0]: zipped grids"),
        ({"d": ["1 lb"]}, "fake.toml: sweep.d: the grid is of force, but the parameter is a length"),
        ({"d": {"from": "1 in", "to": "2 in", "num": 0}}, "fake.toml: sweep.d.num = 0: an empty sweep"),
    ],
)
def test_a_sweep_that_cannot_be_is_refused(engine, sweep, message):
    with pytest.raises(SceneError) as error:
        plan_sweep(FakeScene(sweep))
    assert message in str(error.value)


def test_an_ask_cannot_have_the_name_of_another_column(engine, tmp_path, monkeypatch):
    scene = FakeScene({"d": ["1 in"]}, ask={"d": "d"})
    monkeypatch.setattr(sys.modules[__name__], "ASKS", (replace(ASKS[0], key="d"), *ASKS[1:]))
    with pytest.raises(SceneError, match=r"fake\.toml: ask\.d: this name"):
        run.sweep_files(scene, tmp_path / "out")
    assert not (tmp_path / "out").exists()


# ---- results ------------------------------------------------------------------------------------------


def test_a_result_opens_in_xarray_with_labels_and_units(engine, tmp_path):
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


def test_the_table_has_a_row_per_case_and_the_status_last(engine, tmp_path):
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


def test_without_an_output_nothing_is_left_behind(engine, tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    data = run.run_sweep(FakeScene(SWEEP))
    assert float(data["sum"].sel(d=1.01, m=1)) == (1.01 * 0.0254 + 2) / 0.3048
    assert list(tmp_path.iterdir()) == []


def test_zipped_coordinates_are_labelled(engine):
    data = run.run_sweep(FakeScene({"d": ["1 in", "2 in"], "m": [5, 6], "zip": [["d", "m"]]}))
    assert data["sum"].dims == ("d",)
    assert data.m.dims == ("d",)
    assert "m" in data.coords


def test_named_runs_have_a_dimension_and_keep_their_own_values(engine):
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


def test_chunks_change_no_row(monkeypatch, engine, tmp_path):
    scene = FakeScene(BIG)
    run.sweep_files(scene, tmp_path / "a", workers=1)
    monkeypatch.setattr(cases, "_MAX_CASES", 7)
    run.sweep_files(scene, tmp_path / "b", workers=3)
    assert max(engine.chunks[-50:]) <= 9
    assert data_of(tmp_path / "a/fake.h5") == data_of(tmp_path / "b/fake.h5")
    assert (tmp_path / "a/fake.csv").read_bytes() == (tmp_path / "b/fake.csv").read_bytes()


def test_chunks_grow_to_half_a_second_of_work(engine, tmp_path):
    engine.pause = 0.002
    seen = []
    run.sweep_files(FakeScene(BIG), tmp_path, workers=1, progress=lambda *progress: seen.append(progress))
    assert 150 < max(engine.chunks) < 350
    assert seen == sorted(seen)
    assert seen[-1] == (1200, 1200)
    assert len(seen) > 15


def test_a_broken_engine_is_not_swallowed(engine, tmp_path, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("broken")

    monkeypatch.setattr(engine, "run_cases", broken)
    with pytest.raises(RuntimeError, match="broken"):
        run.sweep_files(FakeScene(SWEEP), tmp_path / "out")
    assert not (tmp_path / "out").exists()


# ---- the real engine ---------------------------------------------------------------------------------------


PENDULUM = """
id = "pendulum"
until = "AB.omega < 0"
parameters = { L = "2*b", b = "10 in", omega0 = "30 deg/s", m = "1 kg" }
sweep = { L = ["18 in", "0.5 m", "2 ft"], omega0 = { from = "30 deg/s", to = "100 deg/s", num = 8 } }
start.AB.omega = "omega0"
joints.A = { pin = ["AB.A", "ground"] }
[bodies]
AB = { rod = ["A", "B"], length = "L", mass = "m", at = { A = [0, 0] }, angle = "-90 deg" }
[ask]
height = { of = "AB.B.y", unit = "in" }
swing = "t"
angles = { of = "t", at = { each = "AB.angle", values = ["-89 deg", "-80 deg"] }, unit = "min" }
"""


@pytest.mark.parametrize("workers", [1, 2])
def test_every_row_is_a_run_of_its_own_bit_for_bit(workers, monkeypatch):
    monkeypatch.setattr(cases, "_MAX_CASES", 5 * workers)
    scene = planemotion.load_text(PENDULUM)
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


def content(data):
    """A result without what differs from call to call."""
    return data.drop_attrs(deep=False).assign_attrs(
        {key: value for key, value in data.attrs.items() if key not in ("created", "elapsed_seconds")}
    )


def test_tables_are_made_once_for_all_grids_and_anew_for_another_scene(monkeypatch, tmp_path):
    made = []

    def counted(scene, run=None, *, history=True):
        made.append(scene.data.id)
        return flatten(scene, run, history=history)

    monkeypatch.setattr(cases, "flatten", counted)
    scene = planemotion.load_text(PENDULUM)

    def agrees(tables, **grids):
        before = len(made)
        found = scene.sweep(workers=1, **grids)
        assert len(made) - before == tables
        anew = planemotion.Scene.from_raw(scene.raw)
        assert content(found).identical(content(anew.sweep(workers=1, **grids)))
        return found

    agrees(1, L=["18 in", "2 ft"])
    agrees(0, L={"from": "10 in", "to": "20 in", "num": 40})
    agrees(1, omega0=["30 deg/s"])  # another parameter is one that a case gives
    agrees(0, L=["18 in"])
    lighter = agrees(0, L=["18 in"]).height.item()
    scene.parameters(omega0="40 deg/s")
    assert agrees(1, L=["18 in"]).height.item() > lighter
    scene.raw["parameters"]["omega0"] = "50 deg/s"
    assert agrees(1, L=["18 in"]).attrs["scene"].count("50 deg/s") == 1
    stored = scene.sweep(workers=1, out=tmp_path, L=["18 in"])
    with stored:
        assert content(stored).identical(content(agrees(0, L=["18 in"])))


def test_a_case_that_fails_does_not_stop_the_others():
    data = planemotion.load_text(PENDULUM).sweep(m=["1 kg", "-1 kg", "2 kg"])
    assert data.status.values.tolist() == [0, PM_BAD_VALUE, 0]
    assert np.isfinite(data.height.values).tolist() == [True, False, True]
    assert "bodies.AB" in str(data.message[1].values)


LATE = """
id = "late"
until = "t = 2 s"
plane = "horizontal"
parameters = { T = "1 s", M = "1.5 N*m" }
[bodies]
wheel = { mass = "2 kg", inertia = "0.4 kg*m^2", at = [0, 0] }
[joints]
axle = { pin = ["wheel.center", "ground"] }
[forces]
engine = { couple = "wheel", value = "M*sqrt(1 - t/T)" }
[events]
half = "t = 0.5 s"
[ask]
omega = { of = "wheel.omega", at = "half" }
end = "wheel.omega"
[sweep]
T = ["1 s", "3 s"]
"""


def test_a_case_that_fails_late_keeps_what_it_had_answered(tmp_path):
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


# ---- resume -------------------------------------------------------------------------------------------


def child(out, *arguments, pause=0.001, sweep=BIG):
    """A sweep in a process of its own."""
    code = (
        "import sys, json, resource; sys.path.insert(0, sys.argv[1]); import tests.sweep.test_study as t\n"
        "t.run_child(sys.argv[2], json.loads(sys.argv[3]), float(sys.argv[4]), sys.argv[5:])\n"
    )
    return subprocess.Popen(
        [sys.executable, "-c", code, str(ROOT), str(out), json.dumps(sweep), str(pause), *arguments],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def run_child(out, sweep, pause, arguments):
    if "small-files" in arguments:
        import resource

        limit = int(arguments[arguments.index("small-files") + 1])
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
    chunks.CHUNK_SECONDS = 0.1
    plant(FakeEngine(pause))
    try:
        run.sweep_files(FakeScene(sweep), out, resume="resume" in arguments, workers=2,
                          progress=lambda done, total: print(done, flush=True))  # fmt: skip
    except StudyError as error:
        sys.exit(f"{type(error).__name__}: {error}")


def wait_for_parts(process, folder, wanted):
    wait_for(process, lambda: len(list(folder.glob("fake.parts/part-*"))) >= wanted)


@pytest.fixture
def killed(tmp_path):
    """The folder of a sweep that was killed in the middle."""
    with child(tmp_path / "out") as process:
        wait_for_parts(process, tmp_path / "out", 3)
        process.send_signal(signal.SIGKILL)
    return tmp_path / "out"


def files_in(folder):
    """Names and contents; the lock that a killed sweep left may go."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.name != "sweep.lock"]
    return {path: path.read_bytes() for path in files}


def parts(folder):
    return {path.name: path.read_bytes() for path in folder.glob("fake.parts/part-*")}


def test_a_killed_sweep_is_finished_without_repeating_or_changing_a_row(killed, engine, tmp_path):
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


def test_killed_again_and_again_it_still_finishes(tmp_path, engine):
    out = tmp_path / "out"
    for wanted in (1, 3, 5):
        with child(out, "resume") as process:
            wait_for_parts(process, out, wanted)
            process.send_signal(signal.SIGKILL)
    run.sweep_files(FakeScene(BIG), out, resume=True)
    run.sweep_files(FakeScene(BIG), tmp_path / "straight")
    assert data_of(out / "fake.h5") == data_of(tmp_path / "straight/fake.h5")


def test_a_changed_comment_does_not_matter(killed, engine):
    run.sweep_files(FakeScene(BIG, text="# new\nfake"), killed, resume=True)
    with xr.open_dataset(killed / "fake.h5", engine="h5netcdf") as data:
        assert data.attrs["scene"] == "# new\nfake"


def test_resume_begins_where_nothing_is_there(engine, tmp_path):
    files = run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True)
    assert files.computed == 1200
    assert run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True).computed == 0
    files.table.unlink()
    run.sweep_files(FakeScene(BIG), tmp_path / "new/folder", resume=True)
    assert files.table.exists()


def test_killed_before_the_table_was_written(engine, tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(run, "write_csv", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            run.sweep_files(FakeScene(BIG), tmp_path)
    assert run.sweep_files(FakeScene(BIG), tmp_path, resume=True).computed == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fake.csv", "fake.h5"]


def test_a_finished_sweep_is_not_overwritten(engine, tmp_path):
    run.sweep_files(FakeScene(BIG), tmp_path)
    before = (tmp_path / "fake.h5").read_bytes()
    with pytest.raises(StudyError, match="is there already and is never overwritten; give another --out"):
        run.sweep_files(FakeScene(BIG), tmp_path)
    assert (tmp_path / "fake.h5").read_bytes() == before


@pytest.mark.parametrize("state", ["unfinished", "finished"])
def test_resume_says_what_is_different(killed, engine, state, monkeypatch):
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
    monkeypatch.setattr(cases, "versions", lambda: {"planemotion": "2"})
    with pytest.raises(StudyError, match=r'versions.planemotion \("1", now "2"\)'):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert files_in(killed) == before


@pytest.mark.parametrize("damage", ["flipped", "cut", "empty"])
def test_a_damaged_part_is_named_and_nothing_is_touched(killed, engine, damage):
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


def test_a_damaged_manifest_is_named(killed, engine):
    (killed / "fake.parts/manifest.json").write_text("{")
    with pytest.raises(StudyError, match=r"manifest.json: cannot be read"):
        run.sweep_files(FakeScene(BIG), killed, resume=True)
    assert parts(killed)


# ---- locks, disks, Ctrl-C -----------------------------------------------------------------------------


def test_two_sweeps_on_one_output_are_refused(tmp_path, engine):
    out = tmp_path / "out"
    with child(out) as process:
        wait_for_parts(process, out, 1)
        said = rf"another sweep writes into this folder \(process {process.pid} on "
        for resume in (False, True):
            with pytest.raises(StudyError, match=said):
                run.sweep_files(FakeScene(BIG), out, resume=resume)
        assert process.wait() == 0
    assert (out / "fake.h5").exists()


def test_ctrl_c_stops_in_the_middle_and_says_what_is_saved(tmp_path, engine):
    out = tmp_path / "out"
    with child(out, pause=0.1) as process:  # the whole would take two minutes
        wait_for_parts(process, out, 2)
        process.send_signal(signal.SIGINT)
        error = process.stderr.read()
        assert process.wait() == 1
    stored = sum(int(name.split("-")[2]) for name in parts(out))
    assert stored < 600
    assert f"stopped: {stored} of 1200 cases are saved in {out}; go on with --resume" in error
    assert run.sweep_files(FakeScene(BIG), out, resume=True).computed == 1200 - stored


@pytest.mark.parametrize("place", ["/proc/no/such", "file", "file/below"])
def test_an_output_that_cannot_be_written_is_refused(engine, tmp_path, place):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(StudyError, match=r"is a file|cannot be written"):
        run.sweep_files(FakeScene(BIG), tmp_path / place)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert engine.chunks == []


@pytest.mark.parametrize(
    ("limit", "file"), [(500, "manifest.json"), (10_000, "part-"), (40_000, "fake.h5"), (141_000, "fake.csv")]
)
def test_a_full_disk_is_said_and_leaves_nothing_half_written(tmp_path, engine, limit, file):
    out = tmp_path / "out"
    with child(out, "small-files", str(limit), pause=0.0002) as process:
        error = process.stderr.read()
        assert process.wait() == 1
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
def test_a_million_cases_stay_below_500_megabytes(tmp_path):
    code = (
        "import sys, resource; sys.path.insert(0, sys.argv[1]); import tests.sweep.test_study as t\n"
        "t.plant(t.FakeEngine())\n"
        "t.run.sweep_files(t.FakeScene(t.MILLION), sys.argv[2], workers=2)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(ROOT), tmp_path], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 500
    with xr.open_dataset(tmp_path / "fake.h5", engine="h5netcdf") as data:
        assert data.status.shape == (2000, 500)
        assert float(data["sum"][-1, -1]) == (6 * 0.0254 + 5) / 0.3048


ZIPPED = {"m": ["1 kg", "-1 kg"], "b": ["10 in", "1 ft"], "zip": [["m", "b"]]}


@pytest.mark.parametrize(
    ("grids", "statuses"),
    [({"m": ["1 kg", "-1 kg", "2 kg"]}, [0, PM_BAD_VALUE, 0]), (ZIPPED, [0, PM_BAD_VALUE])],
    ids=["one grid", "zipped"],
)
def test_in_memory_as_in_the_file(grids, statuses, tmp_path):
    """A sweep without a folder gives what one with a folder leaves: values, names, attributes."""
    scene = planemotion.load_text(PENDULUM)
    in_memory, from_file = scene.sweep(**grids), scene.sweep(out=tmp_path, **grids).load()
    assert in_memory.status.dims == ("m",)
    assert in_memory.status.values.tolist() == statuses
    for data in (in_memory, from_file):
        for name in ("created", "elapsed_seconds"):
            del data.attrs[name]
    xr.testing.assert_identical(in_memory, from_file)
