"""What an undecided case leaves open: the decision that lies within its errors, or what was not looked at."""

from __future__ import annotations

import math

from .. import _layout as layout
from ..base.arrays import Floats, Ints

# What is decided at a place, by enum pm_decision.
_DECISIONS = {
    layout.PM_DECISION_OUTCOME: "a decision on the way (what fires first, what touches, what holds)",
    layout.PM_DECISION_HAPPENS: "whether it comes to it",
    layout.PM_DECISION_REVERSES: "whether its threshold is passed or the motion turns back there",
    layout.PM_DECISION_ORDER: "whether a blow comes before a time of the scene or after it",
    layout.PM_DECISION_STRIKES: "whether it strikes",
    layout.PM_DECISION_PULLS_IN_BLOW: "whether it takes part in a blow",
    layout.PM_DECISION_SLIDES_IN_BLOW: "whether it slides in a blow",
    layout.PM_DECISION_JOINS: "whether it joins a blow",
    layout.PM_DECISION_PULLS: "whether it stays closed",
    layout.PM_DECISION_SLIDES: "whether it slides",
    layout.PM_DECISION_SLIP_LEFT: "whether slip is left after a blow",
    layout.PM_DECISION_MEETS: "whether the two points meet",
    layout.PM_DECISION_PARTS: "whether the two part",
    layout.PM_DECISION_SHARES: "whether it and those that share its load hold",
    layout.PM_DECISION_ENDS: "whether the run can go on there",
}


def undecided(place: str, where: Ints, detail: Floats) -> str:
    """What is open at `place`, and when; `where` [3] and `detail` [3] as of `describe`."""
    margin, _, time = (float(number) for number in detail)
    decision = int(where[layout.PM_WHERE_MEMBER])
    if decision == layout.PM_DECISION_UNSEEN:
        return _unseen(place, int(where[layout.PM_WHERE_TABLE]), time)
    what = _DECISIONS.get(decision, _DECISIONS[layout.PM_DECISION_OUTCOME])
    here = f"{place}: " if place else ""
    when = f", at t = {time:.6g} s" if math.isfinite(time) and time > 0 else ""
    return (
        f"{here}{what} lies within the errors of the run (margin {margin:.2g}, at least 1 is wanted); "
        f"the answers are those of one of the outcomes{when}"
    )


def _unseen(place: str, table: int, time: float) -> str:
    """A step was halved as often as may be, and bounds do not tell the sign of what is watched everywhere."""
    happens = "anything changes at it" if table == layout.PM_TABLE_CONTACT else "it fires"
    return (
        f"{place}: it is not told whether {happens} at about t = {time:.6g} s: too much of what it waits for "
        "lies so near its threshold that not every place could be looked at; the answers are those of one "
        "of the outcomes; tighten solve.accuracy, write a simpler expression, or try another solve.route"
    )
