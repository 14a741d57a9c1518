"""What became of a throw: its run, its mirror image, its contacts in another order, other routes."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import planemotion
from planemotion.base.errors import SimulationError
from tests.stress.contacts.instants import REFUTED, TOLD, last, recounted
from tests.stress.contacts.rest import Pose, faults
from tests.stress.contacts.throws import Throw, throw

RIGHT, UNDECIDED = "ok", "undecided"
# What the laws leave open is enumerated where a throw ends so (instants.py).
OPEN = ("not_unique", "painleve", "no_motion", "alternates")
BY_THEORY = (RIGHT, *OPEN, UNDECIDED)
ROUTES = ("rk", "ida")
OTHER_ROUTES = 20  # one in so many is run on them
OFF = 20.0  # times the errors told, together: more is a fault
LEAST = 1e-9  # m, rad


class Became(NamedTuple):
    """What became of a throw, and why; `seconds` over all the ways in which it was run.

    `recount`: whether enumeration confirms what the laws leave open.
    """

    number: int
    kind: str
    law: str
    word: str
    why: str
    seconds: float
    recount: str = ""


class Ran:
    """Status of a run, poses [(x, y, angle)], kinetic energy, and the greatest estimated error."""

    def __init__(self, text: str, bodies: int) -> None:
        try:
            result = planemotion.load_text(text).run()
        except SimulationError as failed:
            self.why = str(failed)
            self.status = "no_motion" if "no motion obeys its law" in self.why else "failed"
            return
        self.status, self.why = result.status, str(result.error or "")
        if self.status == "stays_at_rest":
            self.status = "ok"
        if self.status != "ok":
            return
        self.kinetic = _number(result.asks["kinetic"].value)
        self.poses: list[Pose] = []
        for i in range(bodies):
            x, y, angle = (_number(result.asks[f"b{i}_{word}"].value) for word in "xya")
            self.poses.append((x, y, angle))
        self.error = max(_number(ask.error or 0) for name, ask in result.asks.items() if name != "kinetic")

    def mirrored(self) -> list[Pose]:
        return [(-x, y, -angle) for x, y, angle in self.poses]


def _number(value: object) -> float:
    assert isinstance(value, int | float)
    return float(value)


def _differs(a: Ran, b: Ran, poses: list[Pose]) -> bool:
    off = max(
        abs(p - q) for one, other in zip(a.poses, poses, strict=True) for p, q in zip(one, other, strict=True)
    )
    return off > LEAST + OFF * (a.error + b.error)


def become(number: int) -> Became:
    thrown, begun = throw(number), time.process_time()
    word, why = _verdict(number, thrown)
    recount = recounted(last(thrown), word) if word in TOLD else ""
    if recount == REFUTED:
        word = f"wrong: {word}"
    return Became(number, thrown.kind, thrown.law, word, why, time.process_time() - begun, recount)


def _verdict(number: int, thrown: Throw) -> tuple[str, str]:
    count = len(thrown.bodies)
    first = Ran(thrown.text(), count)
    if first.status != RIGHT:
        return first.status, first.why
    wrong = faults(thrown, first.poses, first.kinetic)
    if wrong:
        return "wrong", "; ".join(wrong)
    others = [("mirror image", Ran(thrown.mirrored().text(), count))]
    others.append(("order in the file", Ran(thrown.text(turned=True), count)))
    if number % OTHER_ROUTES == 0:
        others += [(route, Ran(thrown.text(route=route), count)) for route in ROUTES]
    for name, other in others:
        if other.status not in (RIGHT, UNDECIDED):
            return f"failed: {name}", f"{other.status}: {other.why}"
        if other.status == UNDECIDED:
            continue
        if _differs(first, other, other.mirrored() if name == "mirror image" else other.poses):
            return f"wrong: {name}", ""
    return RIGHT, ""


def table(numbers: Iterable[int], jobs: int) -> Iterator[Became]:
    with multiprocessing.Pool(jobs, maxtasksperchild=200) as pool:
        yield from pool.imap_unordered(become, numbers, chunksize=5)
