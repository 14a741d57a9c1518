"""sweep: files, resuming, what is refused, Ctrl-C."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
from pathlib import Path

import pytest

import planemotion
from planemotion.examples import text_of
from tests.cli.calls import TORN, UNKNOWN_KEY, command, invoke, left_in, write
from tests.scenes.pendulum import RELEASED
from tests.waiting import HANGS, wait_for


def test_a_sweep_leaves_three_files_and_tells_their_paths(folder: Path) -> None:
    done = invoke("sweep", write(folder, "a.toml", RELEASED), "--out", "out", "--workers", "2")
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
    done = invoke("sweep", write(folder, "a.toml", RELEASED), "--out", "out", "--set", "sweep.L.num=3")
    assert "3 cases (3 ok)" in done.stdout


def test_results_are_not_overwritten_but_resumed(folder: Path) -> None:
    scene = write(folder, "a.toml", RELEASED)
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
        (RELEASED, ["--set", "sweep.L.num=0"], "sweep.L.num = 0"),
        (RELEASED, ["--workers", "0"], "--workers"),
        (
            RELEASED.replace("sweep.L", "#"),
            [],
            'nothing to sweep; write for example sweep.L = { from = 0, to = "1 m", num = 11 }',
        ),
        (text_of("pendulum"), [], "write for example sweep.e = { from = 0, to = 1, num = 11 }"),
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
    scene = write(folder, "a.toml", RELEASED)
    done = invoke("sweep", scene, "--out", scene)
    assert done.exit_code == 2
    assert scene.read_text(encoding="utf-8") == RELEASED


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
    text = RELEASED.replace("0.35 s", "20 s").replace("num = 6", "num = 400001")
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
    bounds = 'route = "rk", max_time = "1e9 s", max_steps = 2000000000, max_events = 2000000000'  # hours
    text = RELEASED.replace('"t = 0.35 s"', f'"t = 5e8 s"\nsolve = {{ {bounds} }}')
    process = subprocess.Popen(
        command("run", write(folder, "a.toml", text), "--json", "out.json"), stderr=subprocess.PIPE, text=True
    )
    wait_for(process, lambda: any(folder.glob(".out.json*")))  # the place is claimed just before the run
    begun = processor_seconds(process)
    wait_for(process, lambda: processor_seconds(process) > begun + 0.3)  # which is what works now
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=HANGS)
    assert process.returncode in INTERRUPTED, told
    assert "Traceback" not in told
    assert left_in(folder) == {"a.toml"}
