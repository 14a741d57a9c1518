"""`python -m tests.stress.kinds`: scenes of many kinds beside their truth, and what became of them."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import random
import sys
import time
from collections import Counter
from functools import partial

from rich.console import Console
from rich.table import Table

from tests.stress.kinds import blows, flights, forces, friction, multiples, swings, thrusts
from tests.stress.kinds.drawn import FAILED, UNDECIDED, Drawn, Judged, Kind, judged
from tests.stress.misses.verdict import BEYOND, MISSED, NOT_JUDGED, RIGHT, TOLD, Errors, told_columns

KINDS: dict[str, Kind] = {
    one.__name__.replace("_", " "): one
    for one in (
        flights.bounces_for_ever,
        flights.bounces_for_a_while,
        flights.thrown_against_drag,
        flights.top_beside_a_level,
        flights.past_a_point,
        friction.up_an_incline,
        friction.pushed_loose,
        friction.skids_until_it_rolls,
        forces.measured,
        forces.thin_region,
        forces.power_of_a_depth,
        forces.bumper,
        multiples.beside_others,
        multiples.of_an_oscillator,
        swings.damped,
        swings.driven,
        swings.dry,
        blows.balls_in_a_row,
        blows.ball_on_a_rod,
        thrusts.at_a_small_disk,
        thrusts.at_a_rod,
        thrusts.at_marks,
        thrusts.at_a_peg_on_its_way_round,
    )
}
ROUTES, OFTEN = ("auto", "rk", "ida"), (0.45, 0.45, 0.1)
ACCURACIES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
WORDS = (RIGHT, NOT_JUDGED, TOLD, UNDECIDED, FAILED, BEYOND, MISSED)
SHOWN = 20  # faults that are shown

Found = tuple[int, str, str, float, Judged]  # number, kind, route, accuracy, what became of it


def draw(number: int, kind: str | None = None) -> tuple[str, str, float, Drawn]:
    """Kind, route, accuracy and scene of a number; the kinds take turns, or all are of one."""
    own = random.Random(number)
    name = kind or list(KINDS)[number % len(KINDS)]
    (route,), accuracy = own.choices(ROUTES, OFTEN), own.choice(ACCURACIES)
    return name, route, accuracy, KINDS[name](own)


def _of(number: int, kind: str | None = None) -> Found:
    name, route, accuracy, drawn = draw(number, kind)
    return number, name, route, accuracy, judged(drawn, route, accuracy)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", type=int, help="show this one and what became of it")
    parser.add_argument("--kind", choices=KINDS, help="all of this kind")
    given = parser.parse_args()
    if given.only is not None:
        *how, drawn = draw(given.only, given.kind)
        print(*how, drawn.text, _of(given.only, given.kind)[-1], sep="\n")
        return 0
    begun = time.monotonic()
    with multiprocessing.Pool(given.jobs) as pool:
        numbers = range(given.first, given.first + given.scenes)
        found = [*pool.imap_unordered(partial(_of, kind=given.kind), numbers, chunksize=8)]
    console = Console(soft_wrap=True, width=160)
    console.print(_table(found))
    faults = [one for one in sorted(found, key=lambda one: one[0]) if one[-1].word in (BEYOND, MISSED)]
    others = [one for one in sorted(found, key=lambda one: one[0]) if one[-1].word in (FAILED, UNDECIDED)]
    for one in faults[:SHOWN] + others[:SHOWN]:
        number, name, route, accuracy, what = one
        console.print(
            f"--only {number} ({name}, {route}, {accuracy:g}) {what.word}: {what.detail}", markup=False
        )
    console.print(f"{len(faults)} faults in {time.monotonic() - begun:.0f} s")
    return 1 if faults else 0


def _table(found: list[Found]) -> Table:
    shown = Table("kind", "route", *WORDS, "answers", "true <= estimate [%]", "median estimate / true")
    by: dict[tuple[str, str], list[Judged]] = {}
    for _, name, route, _, what in found:
        by.setdefault((name, route), []).append(what)
    for key, some in sorted(by.items()):
        _add(shown, key, some)
    _add(shown, ("all", ""), [one[-1] for one in found])
    return shown


def _add(shown: Table, key: tuple[str, str], some: list[Judged]) -> None:
    counts, errors = Counter(one.word for one in some), Errors.joined(one.errors for one in some)
    style = "red" if counts[BEYOND] + counts[MISSED] else None
    shown.add_row(*key, *told_columns(counts, WORDS, errors), style=style)


if __name__ == "__main__":
    sys.exit(main())
