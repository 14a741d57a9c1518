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
from tests.stress.misses.verdict import BEYOND, MISSED, RIGHT, TOLD

BATCHES = {"pulses": 200, "waves": 200, "peaks": 10, "asks": 10}  # cases of one scene, run as one sweep
SHOWN = 10  # faults that are shown


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
    found: dict[tuple[str, str, str], Counter[str]] = {}
    faults: list[str] = []
    with multiprocessing.Pool(given.jobs) as pool:
        for key, words, wrong in pool.imap_unordered(_batch, tasks):
            found.setdefault(key, Counter()).update(words)
            faults += wrong
    console.print(_table(found))
    for fault in faults[:SHOWN]:
        console.print(fault, markup=False)
    console.print(f"{len(faults)} faults in {time.monotonic() - begun:.0f} s")
    return 1 if faults else 0


def _batch(task: tuple[str, int]) -> tuple[tuple[str, str, str], Counter[str], list[str]]:
    kind, seed = task
    n = BATCHES[kind]
    if kind == "pulses":
        train, words, drawn = pulses.table(seed, n)
        what, route = "on a spring" if train.spring else "free", train.route
    elif kind == "waves":
        wave, words, drawn = waves.table(seed, n)
        what, route = wave.motion, wave.route
    elif kind == "peaks":
        peak, words, drawn = peaks.table(seed, n)
        what, route = peak.name, peak.route
    else:
        ask, words, drawn = asks.table(seed, n)
        what, route = ask.move, ask.route
    wrong = [
        f"{kind} {seed}, case {i} ({what}, {route or 'default'}): {word}: {drawn[i].tolist()}"
        for i, word in enumerate(words)
        if word in (BEYOND, MISSED)
    ]
    return (kind, what, route or "default"), Counter(words), wrong


def _table(found: dict[tuple[str, str, str], Counter[str]]) -> Table:
    columns = (RIGHT, TOLD, waves.NOT_JUDGED, BEYOND, MISSED)
    shown = Table("kind", "motion", "route", *columns, title="short beside the run")
    for key, counts in sorted(found.items()):
        bad = counts[BEYOND] + counts[MISSED]
        shown.add_row(*key, *(str(counts[word]) for word in columns), style="red" if bad else None)
    return shown


if __name__ == "__main__":
    sys.exit(main())
