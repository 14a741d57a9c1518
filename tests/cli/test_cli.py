"""The command line: what goes to stdout, what to stderr, which exit status, and what is left on the disk."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from click.testing import CliRunner, Result

import planemotion
from planemotion.cli.main import main
from tests.waiting import HANGS, wait_for

PENDULUM = """
id = "pendulum"
title = "A rod that swings"
until = "t = 0.35 s"
parameters = { L = "0.73 m" }
bodies.AB = { rod = ["A", "B"], length = "L", mass = "1.3 kg", at = { A = [0, 0] }, angle = "-30 deg" }
joints.A = { pin = ["AB.A", "ground"] }
events.low = "AB.angle = -60 deg"
sweep.L = { from = "0.5 m", to = "1 m", num = 6 }
[ask]
omega = { of = "AB.omega", unit = "rad/s" }
reaction = { of = "A.force.norm", at = "low", unit = "N" }
speeds = { of = "AB.B.speed", at = { each = "t", values = ["0.1 s", "0.2 s"] }, unit = "m/s" }
"""
# Another angle than the rod can reach: one ask has no number.
NOT_REACHED = PENDULUM.replace('"AB.angle = -60 deg"', '"AB.angle = 60 deg"').replace(
    '"pendulum"', '"unreached"'
)
UNKNOWN_KEY = PENDULUM.replace("length =", "lenght =")
# The run ends by its limit: an answer that cannot stand for the asked end.
ENDLESS = 'id = "endless"\n' + PENDULUM.replace('id = "pendulum"', "").replace(
    'until = "t = 0.35 s"', 'until = "AB.angle = 60 deg"\nsolve.max_time = "0.2 s"'
)
# The two ends of the rod are pinned farther apart than it is long.
TORN = PENDULUM.replace(
    "joints.A =", 'ground.points.P = [2, 0]\njoints.B = { pin = ["AB.B", "ground.P"] }\njoints.A ='
).replace("[2, 0]", '["2 m", 0]')


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def invoke(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def strict_json(text: str) -> Any:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is no JSON")

    return json.loads(text, parse_constant=refuse)


def command(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "planemotion.cli", *(str(argument) for argument in arguments)]


def left_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


# ---- run ------------------------------------------------------------------------------------------------


def test_json_on_stdout_is_the_contract(folder: Path) -> None:
    scene = write(folder, "pendulum.toml", PENDULUM)
    done = invoke("run", scene, "--json", "-")
    assert done.exit_code == 0
    [entry] = strict_json(done.stdout)["scenes"]
    assert entry["id"] == "pendulum"
    assert entry["file"] == str(scene)
    assert entry["status"] == "ok"
    assert entry["route"] == ["path"]
    assert set(entry["audit"]) == {"energy", "momentum", "constraint"}
    omega = entry["asks"]["omega"]
    assert (omega["value"], omega["unit"]) == (planemotion.load(scene).run().omega, "rad/s")
    assert 0 < omega["error"] < 1e-9
    assert 0 < entry["error_over_accuracy"] < 1
    assert len(entry["asks"]["speeds"]["value"]) == 2
    assert "error" not in entry


def test_an_answer_that_is_missing_is_null_with_a_reason(folder: Path) -> None:
    done = invoke("run", write(folder, "a.toml", NOT_REACHED), "--json", "-")
    [entry] = strict_json(done.stdout)["scenes"]
    assert entry["asks"]["reaction"]["value"] is None
    assert "not reached" in entry["asks"]["reaction"]["reason"]
    assert entry["asks"]["omega"]["value"] is not None


def test_a_scene_that_fails_does_not_stop_the_others(folder: Path) -> None:
    write(folder, "a_torn.toml", TORN)
    write(folder, "b_unknown.toml", UNKNOWN_KEY)
    write(folder, "c_endless.toml", ENDLESS)
    write(folder, "d_good.toml", PENDULUM)
    done = invoke("run", folder, "--json", "out.json")
    assert done.exit_code == 2
    assert done.stdout == ""
    entries = strict_json((folder / "out.json").read_text(encoding="utf-8"))["scenes"]
    assert [entry["status"] for entry in entries] == ["assembly", "bad_input", "limit_time", "ok"]
    assert [entry["id"] for entry in entries] == ["pendulum", "b_unknown", "endless", "pendulum"]
    for entry in entries[:3]:
        assert entry["error"] in done.stderr
    assert 'did you mean "length"' in entries[1]["error"]
    assert "b_unknown.toml" in entries[1]["error"]


@pytest.mark.parametrize(
    ("text", "status"), [(PENDULUM, 0), (TORN, 1), (ENDLESS, 1), (UNKNOWN_KEY, 2), ("x = [", 2)]
)
def test_exit_status_of_a_process(folder: Path, text: str, status: int) -> None:
    done = subprocess.run(
        command("run", write(folder, "s.toml", text)), capture_output=True, text=True, check=False
    )
    assert done.returncode == status
    assert "Traceback" not in done.stderr
    assert ("error: " in done.stderr) == (status != 0)


def test_the_table_has_values_units_status_and_audit(folder: Path) -> None:
    done = invoke("run", write(folder, "a.toml", NOT_REACHED))
    assert "A rod that swings: ok" in done.stdout
    assert "rad/s" in done.stdout
    assert "(not reached)" in done.stdout
    assert "audit: energy" in done.stdout
    assert "nan" not in done.stdout


def test_a_missing_file_and_a_folder_without_scenes(folder: Path) -> None:
    missing = invoke("run", "nothing.toml")
    assert missing.exit_code == 2
    assert "nothing.toml: cannot be read: No such file" in missing.stderr
    (folder / "empty").mkdir()
    empty = invoke("run", folder / "empty")
    assert empty.exit_code == 2
    assert "no scene files" in empty.stderr


def test_set_takes_a_number_with_and_without_unit(folder: Path) -> None:
    scene = write(folder, "a.toml", PENDULUM)
    answers = [
        strict_json(invoke("run", scene, "--json", "-", "--set", text).stdout)["scenes"][0]["asks"]
        for text in ("L=0.61", "L = 0.61 m", "L=(0.5 m) + (0.11 m)", "L=0.62")
    ]
    assert answers[0] == answers[1]
    assert answers[0]["omega"]["value"] == pytest.approx(answers[2]["omega"]["value"], rel=1e-12)
    assert answers[0] != answers[3]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("l=1 m", 'unknown parameter "l"'),
        ("L=3 kg", "length"),
        ("L", "write name=value"),
        ("=2", "write name=value"),
        ("L=nan", "L"),
    ],
)
def test_a_wrong_set_is_told(folder: Path, text: str, message: str) -> None:
    done = invoke("run", write(folder, "a.toml", PENDULUM), "--set", text)
    assert done.exit_code == 2
    assert message in done.stderr


def test_places_that_cannot_be_written_are_known_before_the_work(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(_scene: object) -> None:
        raise AssertionError("it ran")

    monkeypatch.setattr("planemotion.run.simulate", never)
    scene = write(folder, "a.toml", PENDULUM)
    for option in ("--json", "--history"):
        for place in ("missing/out", "a.toml/out", "."):
            done = invoke("run", scene, option, place)
            assert done.exit_code == 2
            assert place in done.stderr
    assert left_in(folder) == {"a.toml"}


def test_a_full_disk_behind_stdout_is_told(folder: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full")
    with open("/dev/full", "w") as full:
        run = command("run", write(folder, "a.toml", PENDULUM))
        done = subprocess.run(run, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode != 0
    assert "No space left" in done.stderr


def test_a_device_is_written_and_not_replaced(folder: Path) -> None:
    assert invoke("run", write(folder, "a.toml", PENDULUM), "--json", "/dev/null").exit_code == 0
    assert Path("/dev/null").is_char_device()


# ---- history --------------------------------------------------------------------------------------------


def test_a_history_holds_what_moved_and_pushed(folder: Path) -> None:
    done = invoke("run", write(folder, "a.toml", PENDULUM), "--history", "h.h5")
    assert done.exit_code == 0
    with h5py.File("h.h5") as file:
        assert file["t"].attrs["units"] == "s"
        assert file["AB.omega"].attrs["units"] == "rad/s"
        assert file["energy.total"].attrs["units"] == "J"
        assert file["A.force.x"].attrs["units"] == "N"
        t, mark, total = file["t"][...], file["mark"][...], file["energy.total"][...]
        assert t[0] == 0
        assert np.all(np.diff(t) >= 0)
        assert set(mark.tolist()) == {0, 1, 2}
        assert np.ptp(total) < 1e-9
        assert file["AB.omega"][-1] == planemotion.load("a.toml").run().omega
    assert left_in(folder) == {"a.toml", "h.h5"}


def test_a_history_of_runs_has_a_group_for_each(folder: Path) -> None:
    runs = '\n[runs]\nshort = { L = "0.5 m" }\nlong = { L = "1 m" }\n'
    invoke("run", write(folder, "a.toml", PENDULUM + runs), "--history", "h.h5")
    with h5py.File("h.h5") as file:
        assert {name for name, item in file.items() if isinstance(item, h5py.Group)} == {"short", "long"}


def test_no_history_is_left_of_bad_input(folder: Path) -> None:
    (folder / "h.h5").write_text("old")
    assert invoke("run", write(folder, "a.toml", UNKNOWN_KEY), "--history", "h.h5").exit_code == 2
    assert (folder / "h.h5").read_text() == "old"
    assert left_in(folder) == {"a.toml", "h.h5"}


def test_a_history_is_of_one_scene(folder: Path) -> None:
    write(folder, "a.toml", PENDULUM)
    write(folder, "b.toml", PENDULUM)
    done = invoke("run", folder, "--history", "h.h5")
    assert done.exit_code == 2
    assert "one scene" in done.stderr


# ---- sweep ----------------------------------------------------------------------------------------------


def test_a_sweep_leaves_three_files_and_tells_their_paths(folder: Path) -> None:
    done = invoke("sweep", write(folder, "a.toml", PENDULUM), "--out", "out", "--workers", "2")
    assert done.exit_code == 0
    assert left_in(folder / "out") == {"pendulum.h5", "pendulum.csv", "pendulum.png"}
    for name in left_in(folder / "out"):
        assert os.path.join("out", name) in done.stdout
    assert "6 cases (6 ok)" in done.stdout
    names, units, *_ = done.stdout.splitlines()
    assert names.split()[:2] == ["L", "omega"]
    assert units.split()[:2] == ["[m]", "[rad/s]"]
    assert "6 of 6 cases" in done.stderr
    with open("out/pendulum.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["ok"] * 6
    single = planemotion.load("a.toml").run(L="0.7 m")
    assert float(rows[2]["omega [rad/s]"]) == single.omega


def test_a_sweep_setting_is_set_by_its_dotted_name(folder: Path) -> None:
    done = invoke("sweep", write(folder, "a.toml", PENDULUM), "--out", "out", "--set", "sweep.L.num=3")
    assert "3 cases (3 ok)" in done.stdout


def test_results_are_not_overwritten_but_resumed(folder: Path) -> None:
    scene = write(folder, "a.toml", PENDULUM)
    invoke("sweep", scene, "--out", "out")
    before = (folder / "out/pendulum.h5").read_bytes()
    again = invoke("sweep", scene, "--out", "out")
    assert again.exit_code == 2
    assert "out/pendulum.h5" in again.stderr
    resumed = invoke("sweep", scene, "--out", "out", "--resume")
    assert resumed.exit_code == 0
    assert "0 computed" in resumed.stdout
    assert (folder / "out/pendulum.h5").read_bytes() == before


@pytest.mark.parametrize(
    ("text", "arguments", "message"),
    [
        (PENDULUM, ["--set", "sweep.L.num=0"], "sweep.L.num = 0"),
        (PENDULUM, ["--workers", "0"], "--workers"),
        (PENDULUM.replace("sweep.L", "#"), [], "nothing to sweep"),
        (UNKNOWN_KEY, [], "did you mean"),
    ],
)
def test_a_sweep_that_cannot_be_leaves_nothing(
    folder: Path, text: str, arguments: list[str], message: str
) -> None:
    done = invoke("sweep", write(folder, "a.toml", text), "--out", "out", *arguments)
    assert done.exit_code == 2
    assert message in done.stderr
    assert left_in(folder) == {"a.toml"}


def test_a_sweep_into_a_file_is_refused(folder: Path) -> None:
    scene = write(folder, "a.toml", PENDULUM)
    done = invoke("sweep", scene, "--out", scene)
    assert done.exit_code == 2
    assert scene.read_text(encoding="utf-8") == PENDULUM


def test_a_sweep_without_one_good_case_fails_but_is_kept(folder: Path) -> None:
    done = invoke("sweep", write(folder, "a.toml", TORN), "--out", "out")
    assert done.exit_code == 1
    assert "no case came to its end" in done.stderr
    assert "pendulum.csv" in left_in(folder / "out")


# The second: where the interrupt met an import, Python itself ends as the signal would have; a shell
# tells 130, too.
INTERRUPTED = (130, -signal.SIGINT)


def processor_seconds(process: subprocess.Popen[str]) -> float:
    """What the process has used of the processor so far."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.fixture
def long_sweep(folder: Path) -> list[str]:
    """A sweep that nobody waits for."""
    text = PENDULUM.replace("0.35 s", "20 s").replace("num = 6", "num = 400001")
    return command("sweep", write(folder, "long.toml", text), "--out", "out", "--workers", "1")


def test_ctrl_c_keeps_what_is_done_and_resume_goes_on(folder: Path, long_sweep: list[str]) -> None:
    process = subprocess.Popen(long_sweep, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    parts = folder / "out" / "pendulum.parts"
    wait_for(process, lambda: any(parts.glob("part-*.npy")))
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=HANGS)
    assert process.returncode in INTERRUPTED
    assert "cases are saved in out" in told
    assert "--resume" in told
    assert "Traceback" not in told
    assert list(parts.glob("part-*.npy"))
    assert not list(folder.rglob("*.tmp"))


def test_ctrl_c_ends_a_run(folder: Path) -> None:
    text = PENDULUM.replace(
        '"t = 0.35 s"', '"t = 500000 s"\nsolve.max_time = "900000 s"\nsolve.max_steps = 2000000000'
    )
    process = subprocess.Popen(
        command("run", write(folder, "a.toml", text), "--json", "out.json"), stderr=subprocess.PIPE, text=True
    )
    wait_for(process, lambda: any(folder.glob(".out.json*")))  # the place is claimed just before the run
    begun = processor_seconds(process)
    wait_for(process, lambda: processor_seconds(process) > begun + 0.3)  # which is what works now
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=HANGS)
    assert process.returncode in INTERRUPTED
    assert "Traceback" not in told
    assert left_in(folder) == {"a.toml"}


# ---- check, explain, pictures ---------------------------------------------------------------------------


def test_check_counts_freedom(folder: Path) -> None:
    done = invoke("check", write(folder, "a.toml", PENDULUM))
    assert done.exit_code == 0
    assert "1 degree of freedom: 3 coordinates, 2 rows of joints" in done.stdout
    assert "0 of them redundant" in done.stdout


def test_check_tells_an_open_joint(folder: Path) -> None:
    done = invoke("check", write(folder, "a.toml", TORN))
    assert done.exit_code == 1
    assert "joints.B" in done.stderr or "joints.A" in done.stderr


def test_check_warns_of_a_start_that_moved_far(folder: Path) -> None:
    guess = PENDULUM.replace('"-30 deg"', '"~50 deg"').replace(
        "joints.A =", 'ground.points.P = [0, "0.73 m"]\njoints.B = { pin = ["AB.B", "ground.P"] }\njoints.A ='
    )
    done = invoke("check", write(folder, "a.toml", guess))
    assert "warning: that is far" in done.stdout
    assert "0 degrees of freedom" in done.stdout


def test_explain_names_all_there_is(folder: Path) -> None:
    done = invoke("explain", write(folder, "a.toml", PENDULUM), "--run", "--set", "L=1")
    assert done.exit_code == 0
    for word in (
        "AB",
        "rod",
        "1.3 kg",
        "0.108333 kg*m^2",
        "AB.A - ground",
        "AB.angle = -60 deg",
        "rk",
        "audit",
        "phases",
    ):
        assert word in done.stdout, word


def test_draw_and_plot_write_where_they_say(folder: Path) -> None:
    scene = write(folder, "a.toml", PENDULUM)
    assert invoke("draw", scene).stdout.strip() == "a.png"
    invoke("run", scene, "--history", "h.h5")
    assert invoke("plot", "h.h5").stdout.strip() == "h.png"
    invoke("sweep", scene, "--out", "out")
    assert invoke("plot", "out/pendulum.h5", "--out", "p.png").stdout.strip() == "p.png"
    for name in ("a.png", "h.png", "p.png"):
        assert (folder / name).read_bytes().startswith(b"\x89PNG")


def test_draw_shows_a_scene_that_cannot_be_assembled(folder: Path) -> None:
    done = invoke("draw", write(folder, "a.toml", TORN))
    assert done.exit_code == 1
    assert "open by" in done.stderr
    assert (folder / "a.png").exists()


@pytest.mark.parametrize("name", ["missing.h5", "a.toml"])
def test_plot_of_what_is_no_result(folder: Path, name: str) -> None:
    write(folder, "a.toml", PENDULUM)
    done = invoke("plot", name)
    assert done.exit_code == 2
    assert name in done.stderr
    assert left_in(folder) == {"a.toml"}


def test_pictures_that_cannot_be_written(folder: Path) -> None:
    scene = write(folder, "a.toml", PENDULUM)
    done = invoke("draw", scene, "--out", "missing/a.png")
    assert done.exit_code == 2
    assert "missing/a.png" in done.stderr
    assert left_in(folder) == {"a.toml"}


# ---- start-up -------------------------------------------------------------------------------------------


def test_help_and_version_import_nothing_heavy() -> None:
    code = (
        "import sys\n"
        "from planemotion.cli.main import main\n"
        "main(sys.argv[1:], standalone_mode=False)\n"
        "heavy = {'numpy', 'pydantic', 'h5py', 'matplotlib', 'xarray', 'pint', 'rich'} & set(sys.modules)\n"
        "sys.exit(', '.join(heavy) or 0)\n"
    )
    for option in ("--help", "--version"):
        done = subprocess.run(
            [sys.executable, "-c", code, option], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        assert "planemotion" in done.stdout or "Usage" in done.stdout


def test_every_command_has_a_help() -> None:
    for name, found in main.commands.items():
        done = invoke(name, "--help")
        assert done.exit_code == 0
        assert found.help
