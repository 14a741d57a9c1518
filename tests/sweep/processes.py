"""Sweeps in processes of their own, to be killed, interrupted or kept short of disk."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any

from planemotion.base.errors import StudyError
from planemotion.sweep import chunks, run
from planemotion.sweep.shard import Shard
from tests import ROOT
from tests.sweep.fake import BIG, FakeEngine, FakeScene, plant
from tests.waiting import wait_for


def child(
    out: Path, *arguments: str, pause: float = 0.001, sweep: dict[str, Any] = BIG
) -> subprocess.Popen[str]:
    """A sweep in a process of its own."""
    command = [sys.executable, "-m", "tests.sweep.processes", str(out), json.dumps(sweep), str(pause)]
    return subprocess.Popen(
        [*command, *arguments], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def run_child(out: Path, sweep: dict[str, Any], pause: float, *arguments: str) -> None:
    """What the process does."""
    if "small-files" in arguments:
        limit = int(arguments[arguments.index("small-files") + 1])
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
    chunks.CHUNK_SECONDS = 0.1
    plant(FakeEngine(pause))
    try:
        if "shard" in arguments:
            shard = Shard.read(arguments[arguments.index("shard") + 1])
            run.sweep_shard(FakeScene(sweep), out, shard, workers=2)
            return
        run.sweep_files(FakeScene(sweep), out, resume="resume" in arguments, workers=2,
                          progress=lambda done, total: print(done, flush=True))  # fmt: skip
    except StudyError as error:
        sys.exit(f"{type(error).__name__}: {error}")


def wait_for_parts(process: subprocess.Popen[str], folder: Path, wanted: int) -> None:
    wait_for(process, lambda: len(list(folder.glob("fake.parts/part-*"))) >= wanted)


def files_in(folder: Path) -> dict[Path, bytes]:
    """Names and contents; the lock that a killed sweep left may go."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.name != "sweep.lock"]
    return {path: path.read_bytes() for path in files}


def parts(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.glob("fake.parts/part-*")}


if __name__ == "__main__":
    folder, grids, seconds, *rest = sys.argv[1:]
    run_child(Path(folder), json.loads(grids), float(seconds), *rest)
