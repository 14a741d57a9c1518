"""A loop written by hand in C for each scene: the limit of what any engine can reach.

Closed forms where there are any; elsewhere the order 8 method of Dormand and Prince.
Compiled with the machine's own compiler, -O3 -march=native.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

from ..problems import HERE, Floats, Problem
from ..rows import Attempt
from ..timing import LEAST_SAMPLE

NAME = "C loop"
SOURCE = HERE / "peers" / "c_loop.c"
KERNEL = HERE.parent.parent / "kernel"
COMPILER = "cc"
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC", "-lm")
# Relative tolerance of a step, or panels of a quadrature; closed forms take neither.
TOLERANCES = (1e-6, 1e-8, 1e-10, 1e-12, 1e-14)
IN_TIME = ("double_pendulum", "slider_crank", "pendulum_a01", "four_bars_2", "four_bars_40")
PANELS = {"rolling_collar": (16, 32, 64, 128), "linkage_c5": (16, 64, 256, 1024)}
MOST_COPIES = 4096


def attempts(problem: Problem, quick: bool) -> Iterator[Attempt]:
    if shutil.which(COMPILER) is None:
        yield Attempt(NAME, "", "", skip="not installed: no C compiler")
        return
    if problem.name in IN_TIME:
        settings = {f"rtol {rtol:g}": rtol for rtol in TOLERANCES}
    else:
        settings = {f"{n} panels": float(n) for n in PANELS.get(problem.name, ())} or {"closed form": 0.0}
    for setting, value in list(settings.items())[-1:] if quick else settings.items():
        yield Attempt(NAME, setting, compiler_version(), CBatch(problem, value), note="by hand")


class CBatch:
    """All cases of a problem in one call, several times over if that is short."""

    def __init__(self, problem: Problem, setting: float) -> None:
        self._function = getattr(library(), problem.name)
        self._function.argtypes = (ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double)
        self._once, self._setting = problem.cases, setting
        self._copy(problem.exact().shape[1], 1)

    def _copy(self, columns: int, copies: int) -> None:
        self._cases = np.ascontiguousarray(np.tile(self._once, (copies, 1)))
        self._out = np.full((len(self._cases), columns), np.nan)

    def answers(self) -> Floats:
        self._function(len(self._cases), self._cases.ctypes.data, self._out.ctypes.data, self._setting)
        return self._out[: len(self._once)]

    def lengthen(self, seconds: float) -> None:
        copies = int(min(max(LEAST_SAMPLE / max(seconds, 1e-7), 1), MOST_COPIES))
        self._copy(self._out.shape[1], copies)

    def runs(self) -> int:
        return len(self._cases)

    def steps(self) -> float | None:
        return None

    def said(self) -> str:
        return ""


@cache
def library() -> ctypes.CDLL:
    """The compiled loops."""
    folder = Path(tempfile.mkdtemp())
    target = folder / "c_loop.so"
    subprocess.run(
        [COMPILER, f"-I{KERNEL}", str(SOURCE), "-o", str(target), *FLAGS], check=True, capture_output=True
    )
    loaded = ctypes.CDLL(str(target))
    shutil.rmtree(folder)
    return loaded


@cache
def compiler_version() -> str:
    found = subprocess.run([COMPILER, "-dumpfullversion"], check=True, capture_output=True, text=True)
    return found.stdout.strip()
