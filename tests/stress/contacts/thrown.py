"""What became of a throw: its run, its mirror image, its contacts in another order, other routes."""

from __future__ import annotations

import multiprocessing
from collections import Counter
from collections.abc import Iterable, Iterator

import planemotion
from planemotion.base.errors import SimulationError
from tests.stress.contacts.rest import Pose, faults
from tests.stress.contacts.throws import Throw, throw

# A blow that no motion obeys is checked by enumeration in verdict.py.
BY_THEORY = ("ok", "not_unique", "painleve", "no_motion", "alternates", "undecided", "limit_cpu")
ROUTES = ("rk", "ida")
OTHER_ROUTES = 20  # one in so many is run on them
OFF = 20.0  # times the errors told, together: more is a fault
LEAST = 1e-9  # m, rad


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


def become(number: int) -> tuple[int, str, str, str]:
    """Number and kind of the throw, what became of it, and why."""
    thrown = throw(number)
    return number, thrown.kind, *_verdict(number, thrown)


def _verdict(number: int, thrown: Throw) -> tuple[str, str]:
    count = len(thrown.bodies)
    first = Ran(thrown.text(), count)
    if first.status != "ok":
        return first.status, first.why
    wrong = faults(thrown, first.poses, first.kinetic)
    if wrong:
        return "wrong", "; ".join(wrong)
    mirror = Ran(thrown.mirrored().text(), count)
    if mirror.status == "ok" and _differs(first, mirror, mirror.mirrored()):
        return "wrong: mirror image", ""
    others = [Ran(thrown.text(turned=True), count)]
    if number % OTHER_ROUTES == 0:
        others += [Ran(thrown.text(route=route), count) for route in ROUTES]
    for name, other in zip(("order in the file", *ROUTES), others, strict=False):
        if other.status == "ok" and _differs(first, other, other.poses):
            return f"wrong: {name}", ""
        if other.status == "failed":
            return f"failed: {name}", other.why
    return "ok", ""


def table(numbers: Iterable[int], jobs: int) -> Iterator[tuple[int, str, str, str]]:
    with multiprocessing.Pool(jobs, maxtasksperchild=200) as pool:
        yield from pool.imap_unordered(become, numbers, chunksize=5)


def counts(rows: Iterable[tuple[int, str, str, str]]) -> dict[str, Counter[str]]:
    """By kind, how often what happened."""
    found: dict[str, Counter[str]] = {}
    for _, kind, word, _ in rows:
        found.setdefault(kind, Counter())[word] += 1
    return found
