"""check, explain, draw, plot and help."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import click
import pytest

import planemotion
from planemotion.base import bounded
from planemotion.cli.main import main
from planemotion.pictures.instants import instant_of
from tests.cli.calls import TORN, invoke, left_in, write
from tests.scenes.pendulum import RELEASED


def test_check_counts_freedom(folder: Path) -> None:
    done = invoke("check", write(folder, "a.toml", RELEASED))
    assert done.exit_code == 0
    assert "1 degree of freedom: 3 coordinates, 2 constraints of joints" in done.stdout
    assert "0 of them redundant" in done.stdout


def test_check_tells_an_open_joint(folder: Path) -> None:
    done = invoke("check", write(folder, "a.toml", TORN))
    assert done.exit_code == 1
    assert "joints.B" in done.stderr or "joints.A" in done.stderr


def test_check_warns_of_a_start_that_moved_far(folder: Path) -> None:
    guess = RELEASED.replace('"-30 deg"', '"~50 deg"').replace(
        "joints.A =", 'ground.points.P = [0, "0.73 m"]\njoints.B = { pin = ["AB.B", "ground.P"] }\njoints.A ='
    )
    done = invoke("check", write(folder, "a.toml", guess))
    assert "warning: that is far" in done.stdout
    assert "0 degrees of freedom" in done.stdout


def test_explain_names_all_there_is(folder: Path) -> None:
    done = invoke("explain", write(folder, "a.toml", RELEASED), "--run", "--set", "L=1")
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
    scene = write(folder, "a.toml", RELEASED)
    assert invoke("draw", scene).stdout.strip() == "a.png"
    invoke("run", scene, "--history", "h.h5")
    assert invoke("plot", "h.h5").stdout.strip() == "h.png"
    invoke("sweep", scene, "--out", "out")
    assert invoke("plot", "out/pendulum.h5", "--out", "p.png").stdout.strip() == "p.png"
    for name in ("a.png", "h.png", "p.png"):
        assert (folder / name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("ending", ["png", "svg", "pdf", "PDF"])
def test_the_ending_of_a_picture_is_its_format(folder: Path, ending: str) -> None:
    scene = write(folder, "a.toml", RELEASED)
    invoke("run", scene, "--history", "h.h5")
    for call in (("draw", scene), ("plot", "h.h5")):
        assert invoke(*call, "--out", f"one.{ending}").exit_code == 0
        invoke(*call, "--out", f"two.{ending}")
        written = (folder / f"one.{ending}").read_bytes()
        assert written == (folder / f"two.{ending}").read_bytes(), "the same picture is the same file"
        if ending == "svg":
            assert ElementTree.fromstring(written).tag == "{http://www.w3.org/2000/svg}svg"
        else:
            assert written.startswith(b"\x89PNG" if ending == "png" else b"%PDF")


@pytest.mark.parametrize("name", ["p.jpg", "p", "png", ".svg"])
@pytest.mark.parametrize("command", ["draw", "plot"])
def test_another_ending_is_refused_before_anything_is_read(folder: Path, command: str, name: str) -> None:
    done = invoke(command, "missing", "--out", name)
    assert done.exit_code == 2
    assert f"{name}: has " in done.stderr
    assert "a picture is written as one of .png, .svg, .pdf" in done.stderr
    assert left_in(folder) == set()


def test_draw_shows_a_scene_that_cannot_be_assembled(folder: Path) -> None:
    done = invoke("draw", write(folder, "a.toml", TORN))
    assert done.exit_code == 1
    assert "open by" in done.stderr
    assert (folder / "a.png").exists()


@pytest.mark.parametrize("name", ["missing.h5", "a.toml"])
def test_plot_of_what_is_no_result(folder: Path, name: str) -> None:
    write(folder, "a.toml", RELEASED)
    done = invoke("plot", name)
    assert done.exit_code == 2
    assert name in done.stderr
    assert left_in(folder) == {"a.toml"}


def test_pictures_that_cannot_be_written(folder: Path) -> None:
    scene = write(folder, "a.toml", RELEASED)
    done = invoke("draw", scene, "--out", "missing/a.png")
    assert done.exit_code == 2
    assert "missing/a.png" in done.stderr
    assert left_in(folder) == {"a.toml"}


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
    assert "..." not in main.get_help(click.Context(main, terminal_width=80)).partition("Commands:")[2]


def test_check_verifies_a_result_and_a_folder(folder: Path) -> None:
    invoke("sweep", write(folder, "scene.toml", RELEASED), "--out", "o")
    for path in ("o", "o/pendulum.h5"):
        done = invoke("check", path)
        assert (done.exit_code, done.stderr) == (0, "")
        assert "o/pendulum.h5: as it was written" in done.stdout
    Path("o/pendulum.csv").write_text("L\n")
    done = invoke("check", "o")
    assert done.exit_code == 1
    assert "o/pendulum.csv: it is not the table of pendulum.h5" in done.stderr
    Path("empty").mkdir()
    assert "empty: there is no result (*.h5, *.zarr) in this folder" in invoke("check", "empty").stderr


def test_a_pipe_that_nobody_writes_hangs_no_command(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounded, "_PATIENCE", 0.2)
    os.mkfifo("pipe")
    Path("o").mkdir()
    os.mkfifo("o/pipe.h5")
    for call in (("check", "pipe"), ("explain", "pipe"), ("run", "pipe"), ("draw", "pipe")):
        done = invoke(*call)
        assert done.exit_code == 2
        assert "pipe: cannot be read: nothing was written into it for 0.2 s" in done.stderr
    assert "pipe: there is no such file" in invoke("plot", "pipe").stderr
    assert "pipe.h5: it cannot be read: " in invoke("check", "o").stderr
    assert "pipe: cannot be read" in invoke("sweep", "pipe", "--out", "o").stderr


@pytest.mark.parametrize(
    ("at", "wanted"),
    [
        *(("0.1 s", 0.1), ("0.35 s", 0.35), ("0 s", 0.0)),
        *(("low", None), ("low 1", None), ("before low", None)),
    ],
)
def test_a_scene_is_drawn_at_an_instant(folder: Path, at: str, wanted: float | None) -> None:
    scene = planemotion.load(write(folder, "a.toml", RELEASED))
    shown = instant_of(scene, at)
    if wanted is None:
        assert shown.poses["AB"][2] == pytest.approx(math.radians(-60), abs=1e-9)
        assert shown.when.startswith(f"{at}, t = 0.")
    else:
        history = scene.history("AB.angle", every="0.05 s")["AB.angle"]
        assert shown.poses["AB"][2] == pytest.approx(
            float(history.isel(t=round(wanted / 0.05))) if wanted < 0.3 else float(history[-1]), abs=1e-9
        )
    assert invoke("draw", "a.toml", "--at", at).exit_code == 0
    assert left_in(folder) == {"a.toml", "a.png"}


@pytest.mark.parametrize(
    ("at", "reason"),
    [
        ("0.5 s", "the run ends before it, at 0.35 s"),
        ("strike", "nothing of that name happens in the run; there is low"),
        ("low 2", "the run has 1 of these"),
        ("before low 2", "the run has 1 of these"),
        ("after low", 'write "low": that is just after the event, "before low" just before it'),
        ("low soon", "the run has 1 of these"),
        ("", "nothing of that name happens"),
        ("3 kg", "a mass; a time such as"),
        ("0.1", "a plain number; a time such as"),
        (".1", "a plain number; a time such as"),
        ("-1 s", "a run begins at 0 s"),
    ],
)
def test_an_instant_that_does_not_come_is_told(folder: Path, at: str, reason: str) -> None:
    done = invoke("draw", write(folder, "a.toml", RELEASED), "--at", at)
    assert done.exit_code == 2
    assert f'a.toml: at = "{at}": {reason}' in done.stderr
    assert left_in(folder) == {"a.toml"}


STRUCK = """
until = "strike strikes"
bodies.AB = { rod = ["A", "B"], length = "1.2 m", mass = "3 kg", at = { A = [0, 0] }, angle = "-90 deg" }
bodies.ball = { mass = "0.5 kg", at = "AB.B" }
joints.A = { pin = ["AB.A", "ground"] }
contacts.strike = { touch = ["ball", "AB.B"], normal = "180 deg" }
start.ball.velocity.x = "4 m/s"
"""


@pytest.mark.parametrize("kind", ["free-body", "kinetic", "impulse-momentum", "energy"])
@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_a_figure_of_the_book_is_what_its_ending_says(folder: Path, kind: str, ending: str) -> None:
    scene = write(folder, "a.toml", STRUCK)
    done = invoke("draw", scene, "--at", "strike", "--as", kind, "--out", f"a.{ending}")
    assert (done.exit_code, done.stdout.strip()) == (0, f"a.{ending}")
    written = (folder / f"a.{ending}").read_bytes()
    if ending == "svg":
        assert ElementTree.fromstring(written).tag == "{http://www.w3.org/2000/svg}svg"
    else:
        assert written.startswith(b"\x89PNG" if ending == "png" else b"%PDF")


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (
            ("--as", "momentum"),
            "'momentum' is not one of 'free-body', 'kinetic', 'impulse-momentum', 'energy'",
        ),
        (("--as", "kinetic", "--body", "CD"), 'unknown body "CD"; there is AB, ball'),
        (("--as", "energy", "--body", "AB"), "work and energy are those of all bodies together"),
        (("--body", "AB"), "--body goes with --as"),
        (("--as", "kinetic", "--at", "hit"), "nothing of that name happens in the run; there is "),
        (("--as", "kinetic", "--out", "a.jpg"), "a.jpg: has the ending .jpg; a picture is written as one of"),
    ],
)
def test_a_figure_that_cannot_be_drawn_is_told(folder: Path, options: tuple[str, ...], reason: str) -> None:
    done = invoke("draw", write(folder, "a.toml", STRUCK), *options)
    assert done.exit_code == 2
    assert reason in done.stderr
    assert left_in(folder) == {"a.toml"}


def test_an_instant_without_a_blow_has_no_impulses(folder: Path) -> None:
    later = STRUCK.replace('"strike strikes"', '"t = 0.1 s"')
    done = invoke("draw", write(folder, "a.toml", later), "--as", "impulse-momentum", "--at", "0.05 s")
    assert done.exit_code == 2
    assert 'at = "0.05 s": nothing is struck there; blows of the run are at 0 s' in done.stderr
    done = invoke("draw", write(folder, "b.toml", RELEASED), "--as", "impulse-momentum")
    assert "b.toml: impulse-momentum: nothing is struck in the run" in done.stderr
