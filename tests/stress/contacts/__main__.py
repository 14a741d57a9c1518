"""`python -m tests.stress.contacts`: random blows, starts from rest and throws, and what became of them."""

from __future__ import annotations

import argparse
import itertools
import multiprocessing
import os
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from typing import TypeVar

from rich.console import Console
from rich.table import Table

from tests.stress.contacts import one_body, thrown, throws
from tests.stress.contacts.verdict import BY_THEORY, is_fault

BATCH = 500  # cases of one law and one number of contacts, run as one sweep
CONTACTS = (1, 2, 3, 4)
TELL = 20  # s: so often how far it is
Row = TypeVar("Row")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--blows", type=int, default=2000, help="for each law, over all numbers of contacts")
    parser.add_argument("--starts", type=int, default=2000, help="from rest")
    parser.add_argument("--throws", type=int, default=500)
    parser.add_argument("--kind", choices=[kind.__name__ for kind in throws.KINDS], help="throw these alone")
    parser.add_argument(
        "--first", type=int, default=0, help="number of the first batch, and of the first throw"
    )
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    given = parser.parse_args()
    console = Console(soft_wrap=True)
    begun = time.monotonic()
    faults = one_body_table(given, console)
    faults += throw_table(given, console)
    console.print(f"{time.monotonic() - begun:.0f} s")
    return 1 if faults else 0


def _told(rows: Iterable[Row], of: int, what: str) -> Iterator[Row]:
    """Tells how far it is now and then: a table shows nothing before its end, which may be far."""
    told = time.monotonic()
    for done, row in enumerate(rows, 1):
        if time.monotonic() - told > TELL:
            told = time.monotonic()
            print(f"{done} of {of} {what}", file=sys.stderr, flush=True)
        yield row


def _batch(task: tuple[int, int, str, bool]) -> tuple[tuple[str, int], Counter[str], list[str], float]:
    seed, contacts, law, blow = task
    begun = time.process_time()
    words = one_body.judged(one_body.seeded(seed, BATCH, contacts, law, blow=blow), law, blow=blow)
    row = law if blow else "from rest", contacts
    faults = [
        f"{row[0]}, {contacts} contacts, seed {seed}, case {i}: {word}"
        for i, word in enumerate(words)
        if is_fault(word)
    ]
    return row, Counter(words), faults, time.process_time() - begun


def one_body_table(given: argparse.Namespace, console: Console) -> int:
    """Blows by law, and starts, on one body with so many contacts; how many are faults."""
    tasks = [
        (given.first + i, contacts, law, blow)
        for law, blow, count in [
            *((law, True, given.blows) for law in one_body.LAWS),
            ("newton", False, given.starts),
        ]
        for contacts in CONTACTS
        for i in range(-(-count // (BATCH * len(CONTACTS))))
    ]
    found: dict[tuple[str, int], Counter[str]] = {}
    seconds: defaultdict[tuple[str, int], float] = defaultdict(float)
    named: list[str] = []
    with multiprocessing.Pool(given.jobs) as pool:
        for key, words, faults, took in _told(pool.imap_unordered(_batch, tasks), len(tasks), "batches"):
            found.setdefault(key, Counter()).update(words)
            seconds[key] += took
            named += faults
    shown = Table(
        "law", "contacts", *BY_THEORY, "wrong or failed", "s", title="one body, beside the laws restated"
    )
    for (law, contacts), words in sorted(found.items()):
        bad = sum(n for word, n in words.items() if is_fault(word))
        counted = (str(words[word]) for word in BY_THEORY)
        row = [law, str(contacts), *counted, str(bad), f"{seconds[law, contacts]:.0f}"]
        shown.add_row(*row, style="red" if bad else None)
    console.print(shown)
    for fault in sorted(named):
        console.print(fault, markup=False)
    return len(named)


def throw_table(given: argparse.Namespace, console: Console) -> int:
    """What became of throws, by kind and law; how many are faults."""
    numbers = (n for n in itertools.count(given.first) if given.kind in (None, throws.throw(n).kind))
    became = thrown.table(itertools.islice(numbers, given.throws), given.jobs)
    rows = sorted(_told(became, given.throws, "throws"))
    shown = Table("thrown", "law", *thrown.BY_THEORY, "wrong", "failed", "s", title="thrown until they rest")
    for kind, law in sorted({(row.kind, row.law) for row in rows}):
        of_it = [row for row in rows if (row.kind, row.law) == (kind, law)]
        words = Counter(row.word for row in of_it)
        wrong = sum(n for word, n in words.items() if word.startswith("wrong"))
        failed = sum(n for word, n in words.items() if word not in thrown.BY_THEORY) - wrong
        counted = (str(words[word]) for word in thrown.BY_THEORY)
        took = f"{sum(row.seconds for row in of_it):.0f}"
        style = "red" if wrong or failed else None
        shown.add_row(kind, law, *counted, str(wrong), str(failed), took, style=style)
    console.print(shown)
    for recount, n in sorted(Counter(row.recount for row in rows if row.recount).items()):
        console.print(f"of what the laws leave open, by enumeration of all motions there, {recount}: {n}")
    for row in rows:
        if row.word != thrown.RIGHT:
            console.print(f"throw {row.number} ({row.kind}): {row.word}: {row.why}", markup=False)
    slowest = max(rows, key=lambda row: row.seconds, default=None)
    if slowest is not None:
        console.print(f"the slowest, throw {slowest.number}, took {slowest.seconds:.1f} s")
    return sum(row.word not in thrown.BY_THEORY for row in rows)


if __name__ == "__main__":
    sys.exit(main())
