"""Histories as files, and what is refused."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import xarray

import planemotion
from tests.cli.calls import invoke, left_in, write
from tests.test_history import BALL, SWING


@pytest.mark.parametrize("ending", ["h5", "nc", "csv"])
def test_the_ending_of_a_history_is_its_format(folder: Path, ending: str) -> None:
    scene = write(folder, "a.toml", BALL)
    assert invoke("run", scene, "--history", f"h.{ending}", "--every", "100 ms").exit_code == 0
    assert left_in(folder) == {"a.toml", f"h.{ending}"}
    wanted = planemotion.load(scene).history(every="0.1 s")
    if ending == "csv":
        with open("h.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        assert [float(row["t [s]"]) for row in rows] == wanted.t.values.tolist()
        assert [float(row["b.y [m]"]) for row in rows] == wanted["b.y"].values.tolist()
        assert [row["event"] for row in rows] == wanted.event.values.tolist()
    else:
        with xarray.open_dataset(f"h.{ending}", engine="h5netcdf") as found:
            for name in wanted.data_vars:
                np.testing.assert_array_equal(found[name], wanted[name])
                assert found[name].attrs["units"] == wanted[name].attrs["units"]
            assert found.event.values.tolist() == wanted.event.values.tolist()
        assert invoke("check", f"h.{ending}").exit_code == 0
        assert invoke("plot", f"h.{ending}").exit_code == 0


def test_what_is_recorded_is_chosen_on_the_command_line(folder: Path) -> None:
    scene = write(folder, "a.toml", SWING)
    invoke("run", scene, "--history", "h.csv", "--quantity", "A.force.norm", "--quantity", "AB.omega")
    with open("h.csv", encoding="utf-8") as file:
        assert file.readline() == "t [s],A.force.norm [N],AB.omega [rad/s],mark,event\n"


def test_a_table_of_runs_names_them(folder: Path) -> None:
    runs = '\n[runs]\nlow = { v = "1 m/s" }\nhigh = { v = "5 m/s" }\n'
    text = 'parameters.v = "3 m/s"\n' + BALL.replace('"2 m/s", "3 m/s"', '"2 m/s", "v"') + runs
    invoke("run", write(folder, "a.toml", text), "--history", "h.csv", "--every", "1 s")
    with open("h.csv", newline="", encoding="utf-8") as file:
        assert {row["run"] for row in csv.DictReader(file)} == {"low", "high"}


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("--history", "h.xls"), "a history is written as one of .h5, .nc, .csv"),
        (("--every", "1 s"), "are for --history FILE"),
        (("--history", "h.csv", "--every", "1 kg"), 'such as "10 ms"'),
        (
            ("--history", "h.csv", "--every", "0.1"),
            'a.toml: every = "0.1": a plain number; a time such as "10 ms" is wanted',
        ),
        (("--history", "h.csv", "--quantity", "b.z"), 'no point or quantity "z"'),
    ],
)
def test_a_history_that_cannot_be_is_refused(folder: Path, options: tuple[str, ...], reason: str) -> None:
    (folder / "h.csv").write_text("old")
    done = invoke("run", write(folder, "a.toml", BALL), *options)
    assert done.exit_code == 2
    assert reason in done.stderr
    assert "wrote" not in done.stderr
    assert (folder / "h.csv").read_text() == "old"
