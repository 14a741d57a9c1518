"""What became of a blow, or of a start from rest, beside the laws restated: one word for the tables."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from planemotion import _layout as layout
from tests.stress.contacts import course
from tests.stress.contacts.laws import CLOSE, Array, Problem, is_admissible, motions, obeys, one_contact

RIGHT, LIMITED, NOT_UNIQUE, NO_MOTION = "right", "limited", "not unique", "no motion"
BY_THEORY = (RIGHT, LIMITED, NOT_UNIQUE, NO_MOTION)
# Contacts: up to here all motions of each case are enumerated; of more those of the cases without an answer.
ENUMERATED = 3


def is_fault(word: str) -> bool:
    """Whether the engine is to blame."""
    return word not in BY_THEORY


def verdict(x: Problem, after: Array, status: int, counts: Array, law: str, *, blow: bool) -> str:
    """One of BY_THEORY, or what is wrong; `counts`: those of the case, by the numbers of PM_COUNT."""
    followed = blow and law != "newton"
    struck = counts[layout.PM_COUNT_JUMPS] > 0
    limited = counts[layout.PM_COUNT_LIMITED_BLOWS] > 0
    asked = (
        replace(x, restitution=0 * x.restitution) if limited else x
    )  # that of the blow without restitution
    if status == layout.PM_NOT_UNIQUE:
        return (
            NOT_UNIQUE if struck or _is_open(asked, law, followed, course.SEVERAL) else "wrong: it is unique"
        )
    if status in (layout.PM_BLOW_UNDECIDED, layout.PM_PAINLEVE):
        return (
            NO_MOTION
            if struck or _is_open(asked, law, followed, course.NO_MOTION)
            else "wrong: there is a motion"
        )
    if status < 0:
        return f"failed: status {status}"
    if limited:
        return LIMITED if is_admissible(x, after) else "wrong: limited"
    if not blow:
        return RIGHT if obeys(x, after) else "wrong: laws"
    return _followed(x, after, law) if followed else _at_once(x, after)


def _is_open(x: Problem, law: str, followed: bool, why: str) -> bool:
    """Whether the laws have no motion, or several: by enumeration."""
    if followed:
        return course.follow(x, law).why in (why, course.SHARED)
    found = motions(x)
    return not found if why == course.NO_MOTION else len(found) > 1


def _is(x: Problem, after: Array, expected: Array) -> bool:
    return bool(np.abs(expected - after).max() <= 1e2 * CLOSE * x.scale)


def _at_once(x: Problem, after: Array) -> str:
    """Where one contact pushes alone its course is the blow, unless another one still approaches then."""
    whole = motions(x) if len(x) <= ENUMERATED else [after]
    if len(whole) > 1:
        return "wrong: not unique"
    pushing = _pushing(x, whole[0]) if whole else []
    if len(pushing) == 1:
        alone = one_contact(x, pushing[0], "newton")
        if alone is not None and (np.delete(x.jacobian[:, 0] @ alone, pushing[0]) >= -CLOSE * x.scale).all():
            return RIGHT if _is(x, after, alone) else "wrong: one contact"
    return RIGHT if obeys(x, after) else "wrong: laws"


def _pushing(x: Problem, after: Array) -> list[int]:
    """The contacts that part with their restitution, and no faster."""
    close = CLOSE * x.scale * 10
    return [i for i, parts in enumerate(x.jacobian[:, 0] @ after - x.wanted) if abs(parts) <= close]


def _followed(x: Problem, after: Array, law: str) -> str:
    expected = one_contact(x, 0, law) if len(x) == 1 else course.follow(x, law).after
    if expected is not None:
        return RIGHT if _is(x, after, expected) else "wrong: course"
    if len(x) > 1 and course.follow(x, law).why != course.SHARED:
        return "wrong: none goes on"
    return RIGHT if is_admissible(x, after) else "wrong: laws"
