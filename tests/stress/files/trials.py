"""Trials: a sweep of the command line is hurt, then resumed; what it leaves is set beside one that was not.

What must not be: a traceback, a message that does not say what happened, a result that is there but not
whole, hidden leftovers, other bytes in the end.  Each trial has a number, from which alone it follows.
"""

from __future__ import annotations

import random
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import h5py

from tests import ROOT

PLANEMOTION = Path(sys.executable).with_name("planemotion")
STUDY = ROOT / "studies/sphere_over_bars_grid.toml"
LEAST, MOST = 2.0, 6.6  # powers of ten, bytes: the largest file of the sweep has 10^6.5


@dataclass(frozen=True)
class Sweep:
    """A scene, a folder for what it gives, and what it gives unhurt."""

    scene: Path
    straight: Path
    seconds: float

    @classmethod
    def unhurt(cls, folder: Path, scene: Path = STUDY) -> Sweep:
        begun = time.monotonic()
        command(scene, folder / "straight").check_returncode()
        return cls(scene, folder / "straight", time.monotonic() - begun)


def command(
    scene: Path, out: Path, *options: str, limit: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[str]:
    arguments: list[str | Path] = [PLANEMOTION, "sweep", scene, "--out", out, *options]
    return subprocess.run(arguments, capture_output=True, text=True, check=False, preexec_fn=limit)


def killed(sweep: Sweep, out: Path, number: int) -> str:
    """A fault, or nothing: SIGKILL at random, also while it goes on."""
    chosen = random.Random(number)
    while True:
        arguments: list[str | Path] = [PLANEMOTION, "sweep", sweep.scene, "--out", out, "--resume"]
        with subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                process.wait(chosen.uniform(0, sweep.seconds))
            except subprocess.TimeoutExpired:
                process.kill()
        if fault := half_written(out):
            return fault
        if chosen.random() < 0.5:
            return resumed(sweep, out)


def full_disk(sweep: Sweep, out: Path, number: int) -> str:
    """A fault, or nothing: no file can have more than so many bytes, as on a disk with that much left."""
    most = int(10 ** random.Random(number).uniform(LEAST, MOST))

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

    ended = command(sweep.scene, out, limit=limit)
    said = ended.stderr
    if "Traceback" in said:
        return f"at {most} bytes: {said}"
    if ended.returncode != 0 and "is full" not in said:
        return f"at {most} bytes it says: {said}"
    if hidden := [path.name for path in out.rglob(".*")]:
        return f"at {most} bytes it leaves {hidden}"
    return half_written(out) or resumed(sweep, out)


def half_written(out: Path) -> str:
    """Results under their own names are whole."""
    for file in sorted(out.glob("*.h5")):
        ended = subprocess.run([PLANEMOTION, "check", file], capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            return f"{file.name} is there: {ended.stdout}{ended.stderr}"
    return ""


def resumed(sweep: Sweep, out: Path) -> str:
    ended = command(sweep.scene, out, "--resume")
    if ended.returncode != 0:
        return f"--resume says: {ended.stderr}"
    return differences(sweep, out)


def differences(sweep: Sweep, out: Path) -> str:
    """Other bytes than those of the sweep that was not hurt."""
    for table in sweep.straight.glob("*.csv"):
        if table.read_bytes() != (out / table.name).read_bytes():
            return f"{table.name} has other bytes"
    return "".join(_differs(file, out / file.name) for file in sweep.straight.glob("*.h5"))


def _differs(one: Path, other: Path) -> str:
    """Variables with other bits; attributes tell of the time of computing."""
    with h5py.File(one) as a, h5py.File(other) as b:
        if set(a) != set(b):
            return f"{one.name} has other variables"
        names = [n for n in a if isinstance(a[n], h5py.Dataset) and _bits(a[n]) != _bits(b[n])]
        return f"{one.name}: other bits in {names}" if names else ""


def _bits(data: h5py.Dataset) -> object:
    """Of numbers their bytes; texts stand elsewhere."""
    whole = data[()]
    return whole.tolist() if data.dtype.hasobject else whole.tobytes()
