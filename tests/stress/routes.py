"""`python -m tests.stress.routes`: whether `ida` agrees with the default on studies and benchmark scenes.

A part of `make stress`.  Each scene runs at accuracy 1e-10 on both, in a process with a limit of its time;
of a sweep some cases from its first to its last.  Differences are relative; an answer that cancels, or that
the default cannot tell from zero, is compared with the greatest figure of its unit, in SI where all are zero.
"""

from __future__ import annotations

import argparse
import contextlib
import multiprocessing
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection

import numpy as np
from rich.console import Console
from rich.table import Table

import planemotion
from planemotion import _layout as layout
from planemotion.base.errors import SceneError
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine import call, kernel, messages
from planemotion.engine.outcome import CaseResults
from studies.benchmarks.agreement import ask_keys, relative_difference, scenes, some_cases
from studies.benchmarks.problems import Floats
from tests import CHAPTER
from tests.chapter17.chapter import CANCELS

ACCURACY, AGREES = 1e-10, 1e-8
# CPU s of a scene on both routes.
PATIENCE = 60
WORDS = ("agrees", "declined", "told", "differs", "no answer")
WRONG = ("differs", "no answer")
# Of these ida has no answer, or one that its estimate covers: scene, why.
EXPLAINED = {
    "17-C3": "errors of energy grow 40 000 times in the last speed: its file asks for 1e-13",
    "17-C5": "a dead centre, which ida does not pass; the default passes it by work and energy",
}

Source = tuple[str, Callable[[], planemotion.Scene]]


@dataclass(frozen=True)
class Outcome:
    """Of one scene.  told: the error that both routes say of the answer that differs most."""

    name: str
    word: str
    detail: str = ""
    difference: float = 0.0
    told: float = 0.0
    seconds: float = 0.0

    @property
    def is_wrong(self) -> bool:
        return self.word in WRONG and self.name not in EXPLAINED


def sources() -> list[Source]:
    """Studies and benchmark scenes, and those of the chapter."""
    return [
        *scenes(),
        *((path.stem, partial(planemotion.load, path)) for path in sorted(CHAPTER.glob("*.toml"))),
    ]


def outcome(source: Source) -> Outcome:
    """Of a scene, from a process of its own: a case cannot be stopped, a process can."""
    context = multiprocessing.get_context("fork")
    near, far = context.Pipe(duplex=False)
    child = context.Process(target=_send, args=(source, far))
    begun = time.monotonic()
    child.start()
    far.close()
    found = None
    with contextlib.suppress(EOFError):  # it has ended without a word
        found = near.recv()
    child.join()
    if found is not None:
        return found
    limited = child.exitcode in (-signal.SIGXCPU, -signal.SIGKILL)
    why = f"not finished in {PATIENCE} s" if limited else f"exit status {child.exitcode}"
    return Outcome(source[0], "no answer", why, seconds=time.monotonic() - begun)


def _send(source: Source, out: Connection) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE + 1))
    out.send(compared(*source))


def compared(name: str, make: Callable[[], planemotion.Scene]) -> Outcome:
    """The default beside ida."""
    scene, begun = make(), time.process_time()
    default = _flat(scene, "auto")
    param = some_cases(scene, default)
    usual = call.run_cases(default, param)
    try:
        flat = _flat(scene, "ida")
    except SceneError as error:
        return Outcome(name, "declined", str(error).rsplit("solve.route", 1)[-1])
    other = call.run_cases(flat, param)
    spent = time.process_time() - begun
    for status in other.status:
        if status in (layout.PM_UNSUPPORTED, layout.PM_NO_TIME_ROUTE):
            return Outcome(name, "declined", _message(flat, other), seconds=spent)
    if list(usual.status) != list(other.status):
        words = " / ".join(kernel.status_name(int(s)) for r in (usual, other) for s in r.status[:1])
        return Outcome(name, "no answer", f"{words}: {_message(flat, other)}", seconds=spent)
    size = sizes(default, usual.out, usual.error)
    difference = relative_difference(usual.out, other.out, size)
    case, column = np.unravel_index(int(np.argmax(difference)), difference.shape)
    greatest = float(difference[case, column])
    told = float((usual.error + other.error)[case, column] / size[case, column])
    word = "agrees" if greatest <= AGREES else "told" if greatest <= told else "differs"
    return Outcome(name, word, ask_keys(default)[int(column)], greatest, told, spent)


def _flat(scene: planemotion.Scene, route: str) -> FlatScene:
    return flatten(scene.with_values({"solve.route": route, "solve.accuracy": ACCURACY}), history=False)


def _message(flat: FlatScene, results: CaseResults) -> str:
    worst = int(np.argmax(results.status != layout.PM_OK))
    return messages.message(flat, results, worst).removeprefix(f"{flat.file}: ")


def sizes(flat: FlatScene, out: Floats, error: Floats) -> Floats:
    """[cases, columns] what differences are relative to."""
    unit = np.array([ask.unit for ask in flat.asks for _ in range(ask.count)])
    size = np.abs(np.nan_to_num(out))
    found = size.copy()
    for word in set(unit):
        of = unit == word
        most = np.max(size[:, of], axis=1, keepdims=True)
        greatest = np.broadcast_to(np.where(most > CANCELS, most, 1.0), size[:, of].shape)
        small = (size[:, of] <= CANCELS * greatest) | (size[:, of] <= np.nan_to_num(error[:, of]))
        found[:, of] = np.where(small, greatest, size[:, of])
    return found


def outcomes(of: Sequence[Source]) -> Iterator[Outcome]:
    return map(outcome, of)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("words", nargs="*", help="only scenes whose name has one of these")
    given = parser.parse_args()
    chosen = [s for s in sources() if not given.words or any(word in s[0] for word in given.words)]
    found = list(outcomes(chosen))
    show(found)
    return 1 if any(one.is_wrong for one in found) else 0


def show(found: Sequence[Outcome]) -> None:
    """How many ended how, and each that ida takes and that does not simply agree."""
    shown = Table(title=f"ida beside the default at {ACCURACY:g}: {len(found)} scenes, to {AGREES:g}")
    for word in ("scene", "", "greatest difference", "told", "of"):
        shown.add_column(word)
    for one in found:
        if one.word in ("agrees", "declined"):
            continue
        style = "red" if one.is_wrong else ""
        numbers = [f"{one.difference:.1e}", f"{one.told:.1e}"] if one.difference else ["", ""]
        shown.add_row(one.name, one.word, *numbers, EXPLAINED.get(one.name, one.detail), style=style)
    console = Console(soft_wrap=True)
    console.print(shown)
    console.print(", ".join(f"{word} {sum(one.word == word for one in found)}" for word in WORDS))
    worst = max((one for one in found if one.word == "agrees"), key=lambda one: one.difference, default=None)
    if worst:
        console.print(f"of those that agree {worst.name} does least: {worst.difference:.1e}")


if __name__ == "__main__":
    sys.exit(main())
