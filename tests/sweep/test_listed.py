"""Cases that are listed: in CSV and Parquet files, in the scene, in tables of pandas; their faults."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planemotion import SceneError, load, load_text
from planemotion.cli.main import main
from tests.scenes import G

FALL = """
id = "fall"
parameters = { h = "1 m", v = "0 m/s", m = "1 kg", e = 0.5, long = "2*h" }
bodies.ball = { mass = "m", at = [0, "h"] }
start.ball.velocity.x = "v"
until = "ball.y = 0 m"
ask.T = "t"
ask.x = "ball.x"
[forces.wind]
force = "ball"
value = ["1 N", 0]
active = false
[sweep]
"""
CSV = "# measured\nh [mm],v [m/s]\n1000,2\n\n2500,3\n1000,2\n"
H, V = np.array([1.0, 2.5, 1.0]), np.array([2.0, 3.0, 2.0])


def written(folder: Path, sweep: str, csv: str = CSV) -> Path:
    (folder / "cases.csv").write_text(csv, encoding="utf-8")
    (folder / "fall.toml").write_text(FALL + sweep, encoding="utf-8")
    return folder / "fall.toml"


def distances(h: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.asarray(v * np.sqrt(2 * h / G))


def test_the_rows_of_a_csv_file_are_the_cases(tmp_path: Path) -> None:
    dataset = load(written(tmp_path, 'cases = "cases.csv"')).sweep()
    assert dataset["x"].dims == ("case",)
    assert dataset["h"].attrs["units"] == "mm"
    np.testing.assert_array_equal(dataset["h"], 1000 * H)
    np.testing.assert_allclose(dataset["x"], distances(H, V), rtol=1e-12)


def test_a_grid_goes_beside_listed_cases(tmp_path: Path) -> None:
    dataset = load(written(tmp_path, 'm = ["1 kg", "2 kg"]\ncases = "cases.csv"')).sweep()
    assert dict(dataset["x"].sizes) == {"m": 2, "case": 3}
    np.testing.assert_allclose(dataset["x"], [distances(H, V)] * 2, rtol=1e-12)


def test_a_row_has_the_bits_of_a_run(tmp_path: Path) -> None:
    scene = load(written(tmp_path, 'cases = "cases.csv"', "h [in],v [ft/s]\n0.1,0.3\n37.3,1.7\n"))
    dataset = scene.sweep()
    for row, (h, v) in enumerate([("0.1 in", "0.3 ft/s"), ("37.3 in", "1.7 ft/s")]):
        assert float(dataset["x"][row]) == scene.with_values({"h": h, "v": v}).run()["x"]


def test_columns_may_be_chosen(tmp_path: Path) -> None:
    csv = "name,v [m/s],h [cm]\nA,2,100\nB,3,250\n"
    scene = load(written(tmp_path, 'cases = { file = "cases.csv", columns = ["h", "v"] }', csv))
    np.testing.assert_allclose(scene.sweep()["x"], distances(H[:2], V[:2]), rtol=1e-12)


def test_a_table_of_pandas_and_columns_in_the_scene() -> None:
    scene = load_text(FALL)
    by_frame = scene.sweep(cases=pd.DataFrame({"h [mm]": [1000, 2500], "v": [2.0, 3.0]}))
    by_columns = load_text(FALL + 'cases = { h = ["1 m", "250 cm"], v = ["2 m/s", 3] }').sweep()
    for dataset in (by_frame, by_columns):
        np.testing.assert_allclose(dataset["x"], distances(H[:2], V[:2]), rtol=1e-12)
        assert dataset["x"].dims == ("case",)


def test_parquet(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    frame = pd.DataFrame({"h [mm]": [1000, 2500], "v [m/s]": [2.0, 3.0], "who": ["A", "B"]})
    frame.to_parquet(tmp_path / "cases.parquet")
    scene = load(written(tmp_path, 'cases = { file = "cases.parquet", columns = ["h", "v"] }'))
    np.testing.assert_allclose(scene.sweep()["x"], distances(H[:2], V[:2]), rtol=1e-12)
    frame.loc[1, "v [m/s]"] = np.nan
    frame.to_parquet(tmp_path / "other.parquet")
    with pytest.raises(SceneError, match=r'other.parquet: .*"v \[m/s\]": row 2: a finite number is wanted'):
        scene.with_values({"sweep.cases.file": "other.parquet"}).sweep()


def test_options_may_be_columns(tmp_path: Path) -> None:
    """The same option again and again: two scenes, and their answers in the order of the file."""
    csv = "forces.wind.active,h [m]\ntrue,1\nfalse,2\ntrue,3\nfalse,4\n"
    dataset = load(written(tmp_path, 'cases = "cases.csv"', csv)).sweep()
    h = np.arange(1.0, 5)
    np.testing.assert_allclose(dataset["x"], np.array([1, 0, 1, 0]) * h / G, rtol=1e-12, atol=1e-12)
    assert dataset["forces.wind.active"].values.tolist() == ["true", "false", "true", "false"]


def test_the_command_and_its_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, 'cases = "cases.csv"')
    with pytest.raises(SystemExit) as ended:
        main(["sweep", str(path), "--out", str(tmp_path / "out")])
    assert not ended.value.code
    assert "deviation" not in capsys.readouterr().out  # nobody has drawn them
    table = (tmp_path / "out" / "fall.csv").read_text(encoding="utf-8").splitlines()
    assert table[0].startswith("h [mm],v [m/s],T [s],")
    assert [line.split(",")[0] for line in table[1:]] == ["1000.0", "2500.0", "1000.0"]
    again = 'cases = { file = "out/fall.csv", columns = ["h", "v"] }'  # what a sweep has left is read again
    np.testing.assert_allclose(load(written(tmp_path, again)).sweep()["x"], distances(H, V), rtol=1e-12)


def test_a_changed_file_is_another_sweep(tmp_path: Path) -> None:
    path = written(tmp_path, 'cases = "cases.csv"')
    load(path).sweep(out=tmp_path / "out")
    written(tmp_path, 'cases = "cases.csv"', CSV.replace("2500", "2600"))
    with pytest.raises(Exception, match="belongs to another sweep"):
        load(path).sweep(out=tmp_path / "out", resume=True)


@pytest.mark.parametrize(
    ("csv", "told"),
    [
        ("", r"cases.csv:1: sweep.cases: the file is empty; a header"),
        ("h [mm]\n", r"cases.csv:1: sweep.cases: there are no cases below the header"),
        ("h [mm]\n1\n2,3\n", r"cases.csv:3: sweep.cases: 2 fields; the header has 1"),
        ("h [mm]\n1\n\nx\n", r"cases.csv:4: sweep.cases: h = x: a finite number is wanted"),
        ("h [mm]\n1\nnan\n", r"cases.csv:3: sweep.cases: h = nan: a finite number is wanted"),
        ("h\n1\n", r'cases.csv:1: sweep.cases: the column "h" has no unit: write "h \[m\]"'),
        ("h [s]\n1\n", r"cases.csv:1: sweep.cases: the column h is of time, but the parameter is a length"),
        ("h [mmm]\n1\n", r'cases.csv:1: sweep.cases: in the column "h \[mmm\]": '),
        ("hh [mm]\n1\n", r'cases.csv:1: sweep.cases: .*"hh".*columns = '),
        ("h [mm],h [m]\n1,2\n", r"cases.csv:1: sweep.cases: there are 2 columns h"),
        ("forces.wind.actve\ntrue\n", r"actve"),
    ],
)
def test_faults_in_a_file(tmp_path: Path, csv: str, told: str) -> None:
    with pytest.raises(SceneError, match=told):
        load(written(tmp_path, 'cases = "cases.csv"', csv)).sweep()


@pytest.mark.parametrize(
    ("sweep", "told"),
    [
        ('cases = "none.csv"', 'sweep.cases.file = "none.csv": cannot be read: No such file'),
        ("cases = 3", "sweep.cases = 3: the name of a CSV or Parquet file is wanted"),
        ("cases = {}", "the name of a CSV or Parquet file is wanted"),
        ('cases = { file = "cases.csv", column = "h" }', 'did you mean "columns"?'),
        ('cases = { file = "cases.csv", columns = ["w"] }', 'cases.csv "w"; there is h, v'),
        ('cases = "cases.csv"\nh = ["1 m"]', "sweep.h: its values are listed in sweep.cases"),
        ('cases = "cases.csv"\nzip = [["h", "v"]]', "sweep.zip: "),
        ('cases = "cases.csv"\ndesign = { latin = 5 }', "listed or drawn by a design, not both"),
        ('cases = { h = ["1 m", "2 m"], v = [1] }', "all columns are of one length: h has 2, v has 1"),
        ('cases = { h = ["1 m", "2 s"] }', 'sweep.cases.h[1] = "2.0 s": a time'),
        ('cases = { "h [s]" = [1] }', "the column h is of time, but the parameter is a length"),
        ('cases = { "h [x]" = [1] }', "sweep.cases.h [x]"),
        ("cases = { q = [1] }", "sweep.q"),
    ],
)
def test_faults_in_the_scene(tmp_path: Path, sweep: str, told: str) -> None:
    with pytest.raises(SceneError, match=re.escape(told)):
        load(written(tmp_path, sweep)).sweep()


def test_a_long_file_is_read_once(tmp_path: Path) -> None:
    """A hundred thousand rows; each variant of the scene looks at the file that was read."""
    rows = "\n".join(f"{1 + i / 1e5!r},{'true' if i % 2 else 'false'}" for i in range(100_000))
    path = written(tmp_path, 'cases = "cases.csv"', f"h [m],forces.wind.active\n{rows}\n")
    dataset = load(path).sweep()
    h = np.asarray(dataset["h"])
    np.testing.assert_allclose(dataset["x"], np.mod(np.arange(100_000), 2) * h / G, rtol=1e-9, atol=1e-12)
