"""run: what goes to stdout, what to stderr, which exit status, and what is left on the disk."""

from __future__ import annotations

import os
import shlex
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

import planemotion
from tests.cli.calls import (
    ENDLESS,
    NOT_REACHED,
    TORN,
    UNKNOWN_KEY,
    command,
    invoke,
    left_in,
    strict_json,
    write,
)
from tests.scenes.pendulum import RELEASED


def test_json_on_stdout_is_the_contract(folder: Path) -> None:
    scene = write(folder, "pendulum.toml", RELEASED)
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
    write(folder, "d_good.toml", RELEASED)
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
    ("text", "status"), [(RELEASED, 0), (TORN, 1), (ENDLESS, 1), (UNKNOWN_KEY, 2), ("x = [", 2)]
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
    named = write(folder, "a.toml", NOT_REACHED)
    assert f"; did you mean {named}?" in invoke("run", named.with_suffix("")).stderr
    (folder / "empty").mkdir()
    empty = invoke("run", folder / "empty")
    assert empty.exit_code == 2
    assert "no scene files" in empty.stderr


def test_set_takes_a_number_with_and_without_unit(folder: Path) -> None:
    scene = write(folder, "a.toml", RELEASED)
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
    done = invoke("run", write(folder, "a.toml", RELEASED), "--set", text)
    assert done.exit_code == 2
    assert message in done.stderr


def test_places_that_cannot_be_written_are_known_before_the_work(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(_scene: object) -> None:
        raise AssertionError("it ran")

    monkeypatch.setattr("planemotion.run.simulate", never)
    scene = write(folder, "a.toml", RELEASED)
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
        run = command("run", write(folder, "a.toml", RELEASED))
        done = subprocess.run(run, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode != 0
    assert "No space left" in done.stderr


def test_a_device_is_written_and_not_replaced(folder: Path) -> None:
    assert invoke("run", write(folder, "a.toml", RELEASED), "--json", "/dev/null").exit_code == 0
    assert Path("/dev/null").is_char_device()


def test_a_history_holds_what_moved_and_pushed(folder: Path) -> None:
    done = invoke("run", write(folder, "a.toml", RELEASED), "--history", "h.h5")
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
    invoke("run", write(folder, "a.toml", RELEASED + runs), "--history", "h.h5")
    with h5py.File("h.h5") as file:
        assert {name for name, item in file.items() if isinstance(item, h5py.Group)} == {"short", "long"}


def test_no_history_is_left_of_bad_input(folder: Path) -> None:
    (folder / "h.h5").write_text("old")
    assert invoke("run", write(folder, "a.toml", UNKNOWN_KEY), "--history", "h.h5").exit_code == 2
    assert (folder / "h.h5").read_text() == "old"
    assert left_in(folder) == {"a.toml", "h.h5"}


def test_a_history_is_of_one_scene(folder: Path) -> None:
    write(folder, "a.toml", RELEASED)
    write(folder, "b.toml", RELEASED)
    done = invoke("run", folder, "--history", "h.h5")
    assert done.exit_code == 2
    assert "one scene" in done.stderr


def test_a_file_whose_name_is_no_text_is_read_told_and_answered(folder: Path) -> None:
    """Bytes that are no UTF-8 in the name of the file, which is also the id of the scene."""
    name = os.fsdecode(b"caf\xe9.toml")
    Path(name).write_text(RELEASED.replace('id = "pendulum"', ""), encoding="utf-8")
    sweep = ("sweep", name, "--out", "o")
    for call in (
        *(("check", name), ("explain", name), ("run", name), ("run", name, "--json", "-")),
        *(("run", name, "--json", "a.json"), sweep, (*sweep, "--resume")),
    ):
        done = subprocess.run(command(*call), capture_output=True, check=False)
        assert done.returncode == 0, done.stderr.decode()
    said = strict_json(Path("a.json").read_text(encoding="utf-8"))["scenes"][0]
    assert (said["id"], said["file"]) == ("caf\\xe9", name)


@pytest.mark.parametrize("how", [">&-", "| true"])
def test_a_closed_standard_output_is_an_error(folder: Path, how: str) -> None:
    """Nothing is answered and no exit status 0; answers that go to a file need no standard output."""
    file = write(folder, "scene.toml", RELEASED)
    for word in ("run", "explain", "check"):
        shell = f"set -o pipefail; {shlex.join(command(word, file))} {how}"
        done = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, check=False)
        assert done.returncode in (1, 2), done.stderr
        assert "Traceback" not in done.stderr
        assert how != ">&-" or "standard output: it is closed" in done.stderr
    shell = shlex.join(command("run", file, "--json", "a.json"))
    assert subprocess.run(["bash", "-c", f"{shell} >&-"], check=False).returncode == 0
    assert Path("a.json").exists()
