"""`python -m tests.stress.values`: scenes with other values, on the default route and on another.

A part of `make stress`.  All parameters of each scene of the chapter and each study are changed at random,
but for whole numbers without a unit.  Where both routes say `ok`, their answers differ by no more than the
errors that both tell.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from rich.console import Console
from rich.table import Table

import planemotion
from planemotion import _layout as layout
from planemotion.base.errors import SceneError
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call, kernel
from planemotion.engine.outcome import CaseResults
from studies.benchmarks.agreement import ask_keys
from studies.benchmarks.problems import Floats
from tests import CHAPTER, ROOT

AGREES, WITHIN, DIFFERS, TOLD, DECLINED = "agrees", "within ten", "differs", "told", "declined"
WORDS = (AGREES, WITHIN, DIFFERS, TOLD, DECLINED)
BEYOND = 10.0  # times the errors that both routes tell
LEAST = 1e-14  # of an answer: closer than that two routes need not be
# Computing time of a case on one route.
PATIENCE = "5 s"
SHOWN = 20


@dataclass
class Found:
    """Of one scene."""

    words: Counter[str] = field(default_factory=Counter)
    statuses: Counter[str] = field(default_factory=Counter)
    differs: list[str] = field(default_factory=list)


def names() -> list[str]:
    files = [*sorted((ROOT / "studies").glob("*.toml")), *sorted(CHAPTER.glob("*.toml"))]
    return [str(file.relative_to(ROOT)) for file in files]


def changed(scene: planemotion.Scene, flat: FlatScene, rng: np.random.Generator, n: int, by: float) -> Floats:
    """[n, parameters] in SI: each times exp(x), x normal of this size; counts stay."""
    factor = np.exp(rng.normal(0, by, (n, len(flat.parameters))))
    for i, name in enumerate(flat.parameters):
        if isinstance(scene.data.parameters.get(name), int):
            factor[:, i] = 1
    return np.asarray(flat.defaults) * factor


def compared(name: str, route: str, first: int, cases: int, by: float) -> Found:
    """A scene on the default route and on this one."""
    scene, found = planemotion.load(ROOT / name), Found()
    usual = _flat(scene, "auto")
    try:
        flat = _flat(scene, route)
    except SceneError:
        found.words[DECLINED] += cases
        return found
    param = changed(scene, usual, np.random.default_rng([first, *name.encode()]), cases, by)
    one, other = call.run_cases(usual, param), call.run_cases(flat, param)
    keys = ask_keys(usual)
    for i in range(cases):
        word, detail = _word(keys, one, other, i)
        found.words[word] += 1
        if word == TOLD:
            found.statuses[detail] += 1
        if word == DIFFERS:
            values = ", ".join(f"{k}={v:.6g}" for k, v in zip(usual.parameters, param[i], strict=True))
            found.differs.append(f"{name}, {route}, first {first}, case {i}: {detail}; SI: {values}")
    return found


def _flat(scene: planemotion.Scene, route: str) -> FlatScene:
    settings = {"solve.route": route, "solve.max_cpu": PATIENCE}
    return flatten(scene.with_values(settings), history=False)


def _word(keys: list[str], one: CaseResults, other: CaseResults, i: int) -> tuple[str, str]:
    status = [int(results.status[i]) for results in (one, other)]
    if status[1] in (layout.PM_UNSUPPORTED, layout.PM_NO_TIME_ROUTE):
        return DECLINED, ""
    if any(status):
        return TOLD, " / ".join(kernel.status_name(s) for s in status)
    a, b = one.out[i], other.out[i]
    off = np.where(np.isnan(a) & np.isnan(b), 0.0, np.abs(a - b))
    told = np.nan_to_num(one.error[i], posinf=np.inf) + np.nan_to_num(other.error[i], posinf=np.inf)
    least = LEAST * np.maximum(np.abs(np.nan_to_num(a)), np.finfo(float).tiny)
    ratio = np.where(np.isnan(off), np.inf, off / np.maximum(told, least))
    k = int(np.argmax(ratio)) if ratio.size else -1
    if k < 0 or ratio[k] <= 1:
        return AGREES, ""
    if ratio[k] <= BEYOND:
        return WITHIN, ""
    return DIFFERS, f"{keys[k]} is {a[k]!r} and {b[k]!r}, {ratio[k]:.3g} times what is told"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("words", nargs="*", help="only scenes whose file has one of these in its name")
    parser.add_argument("--route", default="rk", choices=("rk", "ida"))
    parser.add_argument("--cases", type=int, default=60, help="of each scene")
    parser.add_argument("--by", type=float, default=0.15, help="how far values are changed")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    given = parser.parse_args()
    chosen = [name for name in names() if not given.words or any(word in name for word in given.words)]
    begun, total = time.monotonic(), Found()
    work = partial(compared, route=given.route, first=given.first, cases=given.cases, by=given.by)
    with multiprocessing.Pool(given.jobs) as pool:
        for found in pool.imap_unordered(work, chosen):
            total.words += found.words
            total.statuses += found.statuses
            total.differs += found.differs
    show(total, given.route, time.monotonic() - begun)
    return 1 if total.differs else 0


def show(total: Found, route: str, seconds: float) -> None:
    console = Console(soft_wrap=True)
    shown = Table(
        title=f"{total.words.total()} cases with other values, {route} beside the default, {seconds:.0f} s"
    )
    for word in WORDS:
        shown.add_column(word, justify="right")
    shown.add_row(*(str(total.words[word]) for word in WORDS))
    console.print(shown)
    console.print("told: " + "; ".join(f"{word} {n}" for word, n in total.statuses.most_common()))
    for line in total.differs[:SHOWN]:
        console.print(line, markup=False)


if __name__ == "__main__":
    sys.exit(main())
