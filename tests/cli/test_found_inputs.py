"""Files and devices that once hurt: classes 15 to 17 of the cases that were found, by the command itself."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests import CHAPTER

BODY = 'bodies.b = { mass = "1 kg", at = [0, 0] }\nask.x = "b.x"\n'
FINE = f'until = "t = 1 s"\n{BODY}'
CHAIN = "\n".join(f'p{i} = "p{i - 1} + (1 m)"' for i in range(1, 1500))
# What is refused, and the words that tell why.
REFUSED = {
    "nested lists": (f"x = {'[' * 5000}{']' * 5000}\n{FINE}", "more than 32 levels deep"),
    "2^31 steps": (f"solve.max_steps = {2**31}\n{FINE}", "2147483647 is wanted"),
    "2^31 events": (f"solve.max_events = {2**31}\n{FINE}", "2147483647 is wanted"),
    "an integer of 5000 digits": (f"solve.max_events = 1{'0' * 5000}\n{FINE}", "an integer of more than"),
    "a NUL in the name of a file": (f'{FINE}tables.t = {{ file = "a\\u0000b.csv" }}\n', "error"),
}
# What is a scene like others.
TAKEN = {
    "a chain of 1500 parameters": f'until = "t = 1 s"\n[parameters]\np0 = "1 m"\n{CHAIN}\n'
    '[bodies]\nb = { mass = "1 kg", at = ["p1499", 0] }\n[ask]\nx = "b.x"\n',
    "an end at once": FINE.replace("1 s", "0 s"),
}


def _call(
    *words: str | bytes | os.PathLike[str], out: int = subprocess.PIPE
) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, "-m", "planemotion.cli", *words]
    return subprocess.run(command, stdout=out, stderr=subprocess.PIPE, timeout=120)


@pytest.mark.parametrize("name", REFUSED)
def test_15_what_hurt_is_refused(name: str, tmp_path: Path) -> None:
    text, words = REFUSED[name]
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    found = _call("run", file)
    assert found.returncode == 2
    assert words in found.stderr.decode()
    assert b"Traceback" not in found.stderr


@pytest.mark.parametrize("name", TAKEN)
def test_15_what_hurt_runs(name: str, tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(TAKEN[name], encoding="utf-8")
    found = _call("run", file)
    assert (found.returncode, found.stderr) == (0, b"")


@pytest.mark.parametrize("word", ["check", "explain"])
@pytest.mark.parametrize("stem", ["17-106", "17-118"])
def test_15_commands_on_scenes_that_fell(word: str, stem: str) -> None:
    found = _call(word, CHAPTER / f"{stem}.toml")
    assert found.returncode == 0, found.stderr


def test_15_a_name_that_is_no_text(tmp_path: Path) -> None:
    file = os.fsencode(tmp_path) + b"/bad\xff.toml"
    Path(os.fsdecode(file)).write_text(FINE, encoding="utf-8")
    assert _call("run", file).returncode == 0


def test_15_devices_end(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for file, words in ((Path("/dev/zero"), b"larger than"), (tmp_path / "pipe", b"nothing was written")):
        found = _call("check", file)
        assert found.returncode == 2
        assert words in found.stderr


def test_17_an_output_that_takes_nothing_is_told(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(FINE, encoding="utf-8")
    with Path("/dev/full").open("wb") as full:
        found = _call("run", file, out=full.fileno())
    assert found.returncode == 2
    assert b"No space left" in found.stderr
    shell = f"exec {sys.executable} -m planemotion.cli run {file} >&-"
    closed = subprocess.run(["sh", "-c", shell], stderr=subprocess.PIPE, timeout=120)
    assert closed.returncode == 2
    assert b"it is closed" in closed.stderr
