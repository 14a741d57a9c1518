"""`python -m tests.stress.misses`: random pulses, waves, peaks and asks, and what became of them."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections import Counter

from rich.console import Console
from rich.table import Table

from tests.stress.misses import asks, peaks, pulses, waves
from tests.stress.misses.verdict import BEYOND, MISSED, NOT_JUDGED, RIGHT, TOLD, Errors, Verdict, told_columns

BATCHES = {"pulses": 200, "waves": 200, "peaks": 10, "asks": 10}  # cases of one scene, run as one sweep
WORDS = (RIGHT, TOLD, NOT_JUDGED, BEYOND, MISSED)
SHOWN = 10  # faults that are shown

Key = tuple[str, str, str]  # kind, motion, route


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pulses", type=int, default=10_000)
    parser.add_argument("--waves", type=int, default=10_000)
    parser.add_argument("--peaks", type=int, default=4_000)
    parser.add_argument("--asks", type=int, default=4_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first batch")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    given = parser.parse_args()
    console = Console(soft_wrap=True)
    begun = time.monotonic()
    tasks = [
        (kind, given.first + i)
        for kind, batch in BATCHES.items()
        for i in range(-(-getattr(given, kind) // batch))
    ]
    found: dict[Key, list[Verdict]] = {}
    faults: list[str] = []
    with multiprocessing.Pool(given.jobs) as pool:
        for key, verdict, wrong in pool.imap_unordered(_batch, tasks):
            found.setdefault(key, []).append(verdict)
            faults += wrong
    console.print(_table(found))
    for fault in faults[:SHOWN]:
        console.print(fault, markup=False)
    console.print(f"{len(faults)} faults in {time.monotonic() - begun:.0f} s")
    return 1 if faults else 0


def _batch(task: tuple[str, int]) -> tuple[Key, Verdict, list[str]]:
    kind, seed = task
    n = BATCHES[kind]
    if kind == "pulses":
        train, verdict, drawn = pulses.table(seed, n)
        what, route = "on a spring" if train.spring else "free", train.route
    elif kind == "waves":
        wave, verdict, drawn = waves.table(seed, n)
        what, route = wave.motion, wave.route
    elif kind == "peaks":
        peak, verdict, drawn = peaks.table(seed, n)
        what, route = peak.name, peak.route
    else:
        ask, verdict, drawn = asks.table(seed, n)
        what, route = ask.move, ask.route
    wrong = [
        f"{kind} {seed}, case {i} ({what}, {route or 'default'}): {word}: {drawn[i].tolist()}"
        for i, word in enumerate(verdict.words)
        if word in (BEYOND, MISSED)
    ]
    return (kind, what, route or "default"), verdict, wrong


def _table(found: dict[Key, list[Verdict]]) -> Table:
    shown = Table(
        "kind", "motion", "route", *WORDS, "answers", "true <= estimate [%]", "median estimate / true"
    )
    for key, verdicts in sorted(found.items()):
        _add(shown, key, verdicts)
    _add(shown, ("all", "", ""), [one for verdicts in found.values() for one in verdicts])
    return shown


def _add(shown: Table, key: Key, verdicts: list[Verdict]) -> None:
    counts = Counter(word for one in verdicts for word in one.words)
    errors = Errors.joined(one.errors for one in verdicts)
    style = "red" if counts[BEYOND] + counts[MISSED] else None
    shown.add_row(*key, *told_columns(counts, WORDS, errors), style=style)


if __name__ == "__main__":
    sys.exit(main())
