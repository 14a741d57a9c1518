"""`python -m tests.stress`: many changed scenes, and a table of what became of them (`make stress`)."""

from __future__ import annotations

import argparse
import os
import sys
import time

from rich.console import Console
from rich.table import Table as Shown

from tests.stress.fuzz import WRONG, Table, fuzz, outcome, scene


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=10_000, help="how many are changed")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", type=int, help="do this one again, here, and show it")
    given = parser.parse_args()
    if given.only is not None:
        print(scene(given.only))
        print(*outcome(scene(given.only)), sep="\n")
        return 0
    begun, table = time.monotonic(), Table()
    for ended in fuzz(range(given.first, given.first + given.scenes), given.jobs):
        table.add(*ended)
    show(table, time.monotonic() - begun)
    return 1 if table.wrong else 0


def show(table: Table, seconds: float) -> None:
    """The outcomes, and each that must not be."""
    shown = Shown("outcome", "scenes", title=f"{table.outcomes.total()} changed scenes in {seconds:.0f} s")
    shown.columns[1].justify = "right"
    for word in WRONG:
        shown.add_row(
            word, str(table.outcomes.get(word, 0)), style="red" if table.outcomes.get(word) else "green"
        )
    for word, count in table.outcomes.most_common():
        if word not in WRONG:
            shown.add_row(word, str(count))
    console = Console(soft_wrap=True)
    console.print(shown)
    console.print(f"the slowest, number {table.slowest[1]}, took {table.slowest[0]:.1f} s")
    for number, word, detail in table.wrong:
        console.print(f"{word}: python -m tests.stress --only {number}", markup=False)
        console.print(detail.strip().splitlines()[-1] if detail else "", markup=False)


if __name__ == "__main__":
    sys.exit(main())
