"""What became of a blow, or of a start from rest, beside the laws restated: one word for the tables."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from planemotion import _layout as layout
from tests.stress.contacts import course
from tests.stress.contacts.laws import (
    CLOSE,
    SHARP,
    Array,
    Problem,
    accelerations,
    goes_on,
    is_admissible,
    motions,
    obeys,
    one_contact,
)

RIGHT, LIMITED, NOT_UNIQUE, NO_MOTION = "right", "limited", "not unique", "no motion"
BY_THEORY = (RIGHT, LIMITED, NOT_UNIQUE, NO_MOTION)
# Statuses that theory may demand: what the table calls them, and what must be so.
OPEN_BY_THEORY = {
    layout.PM_NOT_UNIQUE: (NOT_UNIQUE, course.SEVERAL),
    layout.PM_BLOW_UNDECIDED: (NO_MOTION, course.NO_MOTION),
    layout.PM_PAINLEVE: (NO_MOTION, course.NO_MOTION),
}
# Contacts: up to here all motions of each case are enumerated; of more those of the cases without an answer.
ENUMERATED = 3


def is_fault(word: str) -> bool:
    """Whether the engine is to blame."""
    return word not in BY_THEORY


def verdict(x: Problem, after: Array, status: int, counts: Array, law: str, *, blow: bool) -> str:
    """One of BY_THEORY, or what is wrong; `counts`: those of the case, by the numbers of PM_COUNT.

    What seems wrong is looked at again, sharply: motions that nearly obey the laws, or nearly are the same,
    may be taken for such that do.
    """
    word = _verdict(x, after, status, counts, law, blow, CLOSE)
    return _verdict(x, after, status, counts, law, blow, SHARP) if is_fault(word) else word


def _verdict(x: Problem, after: Array, status: int, counts: Array, law: str, blow: bool, close: float) -> str:
    followed = blow and law != "newton"
    struck = counts[layout.PM_COUNT_JUMPS] > 0
    limited = counts[layout.PM_COUNT_LIMITED_BLOWS] > 0
    plastic = replace(x, restitution=0 * x.restitution)
    asked = plastic if limited else x  # that of the blow without restitution
    if status in OPEN_BY_THEORY:
        word, why = OPEN_BY_THEORY[status]
        if struck:
            return word if _is_open_after(x, law, limited, why, close) else f"wrong: {word} after the blow"
        return word if _is_open(asked, law, followed, why, close) else f"wrong: {word}"
    if status < 0:
        return f"failed: status {status}"
    if not blow:
        return RIGHT if obeys(x, after) else "wrong: laws"
    if len(x) <= ENUMERATED and not goes_on(x, after, close):
        return "wrong: none goes on, or several, from the blow"
    if limited:
        return LIMITED if is_admissible(x, after) else "wrong: limited"
    return _followed(x, after, law, close) if followed else _at_once(x, after, close)


def _is_open(x: Problem, law: str, followed: bool, why: str, close: float) -> bool:
    """Whether the laws have no motion, or several: by enumeration."""
    if followed:
        return course.follow(x, law, close).why == why
    return _are(motions(x, close), why)


def _are(found: list[Array], why: str) -> bool:
    return not found if why == course.NO_MOTION else len(found) > 1


def _is_open_after(x: Problem, law: str, limited: bool, why: str, close: float) -> bool:
    """Whether no motion goes on from the blow, or several do."""
    after = left(x, law, close) if not limited else _left_by_half(x, close)
    return after is not None and _are(accelerations(x, after, close), why)


def left(x: Problem, law: str, close: float = CLOSE) -> Array | None:
    """The velocities that the blow leaves, if one motion obeys its law."""
    if len(x) == 1:
        return one_contact(x, 0, law)
    if law != "newton":
        return course.follow(x, law, close).after
    whole = motions(x, close)
    if len(whole) != 1:
        return None
    alone = _alone(x, whole[0])
    return whole[0] if alone is None else alone


def _left_by_half(x: Problem, close: float) -> Array | None:
    """Between the blow without restitution and that with it, as far as no energy is gained."""
    whole, plastic = motions(x, close), motions(replace(x, restitution=0 * x.restitution), close)
    if len(whole) != 1 or len(plastic) != 1:
        return None
    d, none = whole[0] - plastic[0], x.energy(x.before) - x.energy(plastic[0])
    slope = float(d @ (x.mass * plastic[0]))
    root = float(np.sqrt(max(0.0, slope**2 + 4 * none * x.energy(d))))
    return np.asarray(plastic[0] + (root - slope) / (2 * x.energy(d)) * d)


def _is(x: Problem, after: Array, expected: Array) -> bool:
    return bool(np.abs(expected - after).max() <= 1e2 * CLOSE * x.scale)


def _at_once(x: Problem, after: Array, close: float) -> str:
    """Where one contact pushes alone its course is the blow, unless another one still approaches then."""
    whole = motions(x, close) if len(x) <= ENUMERATED else [after]
    if len(whole) > 1:
        return "wrong: not unique"
    alone = _alone(x, whole[0]) if whole else None
    if alone is not None:
        return RIGHT if _is(x, after, alone) else "wrong: one contact"
    return RIGHT if obeys(x, after) else "wrong: laws"


def _alone(x: Problem, whole: Array) -> Array | None:
    """What the course of the one contact that pushes leaves, if none of the others approaches then."""
    pushing = _pushing(x, whole)
    alone = one_contact(x, pushing[0], "newton") if len(pushing) == 1 else None
    if alone is None or (np.delete(x.jacobian[:, 0] @ alone, pushing[0]) < -CLOSE * x.scale).any():
        return None
    return alone


def _pushing(x: Problem, after: Array) -> list[int]:
    """The contacts that part with their restitution, and no faster."""
    close = CLOSE * x.scale * 10
    return [i for i, parts in enumerate(x.jacobian[:, 0] @ after - x.wanted) if abs(parts) <= close]


def _followed(x: Problem, after: Array, law: str, close: float) -> str:
    expected = one_contact(x, 0, law) if len(x) == 1 else course.follow(x, law, close).after
    if expected is not None:
        return RIGHT if _is(x, after, expected) else "wrong: course"
    return "wrong: none goes on"
