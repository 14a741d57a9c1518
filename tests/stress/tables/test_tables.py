"""The quick part of `python -m tests.stress.tables`: changes of some models, in the kernel as installed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.stress.tables.corpus import scenes, write
from tests.stress.tables.program import installed

CHANGES, EACH = 4000, 3


@pytest.fixture(scope="module")
def program() -> Path:
    return installed()


def run(program: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


def test_no_changed_table_falls_hangs_or_answers_what_is_no_number(program: Path, tmp_path: Path) -> None:
    chosen = scenes()[::EACH]
    assert write(tmp_path / "models", chosen) == len(chosen)
    ended = run(program, tmp_path / "models", "0", str(CHANGES), "2")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    counts = dict(
        part.rsplit(" ", 1) for part in ended.stdout.split(":")[1].split("\n")[0].strip().split(", ")
    )
    assert counts["faults"] == "0"
    # Neither is everything refused, nor everything let through.
    assert min(int(counts["ok"]), int(counts["refused"])) > CHANGES / 20


def test_models_as_they_are(program: Path, tmp_path: Path) -> None:
    chosen = scenes()[:12]
    write(tmp_path / "models", chosen)
    for mode in ("--valid", "--threads"):
        ended = run(program, tmp_path / "models", mode)
        assert ended.returncode == 0, ended.stdout + ended.stderr


def test_a_file_that_is_none_is_told(program: Path, tmp_path: Path) -> None:
    (tmp_path / "models").write_bytes(b"\x05" * 30)
    ended = run(program, tmp_path / "models", "--valid")
    assert ended.returncode == 2
    assert "no models" in ended.stderr
