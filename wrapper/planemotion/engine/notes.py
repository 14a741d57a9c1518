"""What a result says beside its answers: what was assumed in it, and what would be computed otherwise."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from .. import _layout as layout
from ..compile.flatten import FlatScene
from .outcome import CaseResults


def _blows(count: int) -> str:
    return f"{count} blows" if count > 1 else "a blow"


def first_ordered(runs: Sequence[tuple[FlatScene, CaseResults]]) -> str:
    """When the first of the `ordered_blows` was, and of which contacts; "" if no run that is ok has one."""
    for flat, results in runs:
        row, other = (
            int(results.where[0, column]) for column in (layout.PM_WHERE_ROW, layout.PM_WHERE_MEMBER)
        )
        if int(results.status[0]) != layout.PM_OK or row < 0:
            continue
        names = flat.names[layout.PM_TABLE_CONTACT]
        struck = " and ".join(dict.fromkeys(names[i] for i in (row, other) if i >= 0))
        return f"at t = {results.detail[0, layout.PM_DETAIL_VALUE]:.6g} s of {struck}"
    return ""


def two_sided(runs: Sequence[tuple[FlatScene, CaseResults]]) -> tuple[str, ...]:
    """The keys of answers that are others on the other side of what a find has found."""
    return tuple(
        asked.key
        for flat, results in runs
        for asked in flat.asks
        if layout.PM_REASON_TWO_SIDED in results.reason[0, asked.row : asked.row + asked.rows]
    )


def notes_of(
    excess: float | None,
    counts: Mapping[str, int],
    routes: Sequence[str],
    ordered: str,
    sided: Sequence[str] = (),
) -> tuple[str, ...]:
    """Sentences for people.

    `excess`: the greatest error as a part of what solve.accuracy allows; `ordered`: by `first_ordered`;
    `sided`: by `two_sided`.
    """
    notes = []
    if sided:
        notes.append(
            f"on the two sides of what was found {', '.join(sided)} differ{'s' if len(sided) == 1 else ''}: "
            "answered is the side on which the conditions of [find] hold, or else that of the lower parameter"
        )
    if excess is not None and math.isinf(excess):
        notes.append(
            "solve.accuracy may not be reached: errors are taken from a second run of the case, and that one "
            "failed or went another way"
        )
    elif excess is not None and excess > 1:
        notes.append(
            f"solve.accuracy was not reached: the greatest estimated error is {excess:.2g} times as large"
        )
    if counts["stiff_phases"]:
        notes.append(
            "the motion is stiff, a force changes far faster than it (a strong damper?): stability made the "
            "steps of the route rk short, "
            + ("and ida went on" if "ida" in routes else 'not accuracy; solve.route = "ida" may be faster')
        )
    if counts["limited_blows"]:
        notes.append(
            f"{_blows(counts['limited_blows'])} with friction would have gained energy by the law of "
            'restitution, which was lowered until nothing is gained; law = "stronge" never gains'
        )
    if counts["shared_blows"]:
        notes.append(
            f"{_blows(counts['shared_blows'])} by the laws poisson and stronge took several contacts at "
            "once: how these share it is assumed, all are compressed and released at one pace; smooth "
            'contacts that all have law = "stronge" and a stiffness share it by that'
        )
    if counts["ordered_blows"]:
        notes.append(_ordered_note(counts["ordered_blows"], ordered))
    if counts["unstable_starts"]:
        notes.append(
            "the equilibrium at the start is unstable: without start.nudge the scene stays there only "
            "because nothing disturbs it; drawn farther away it finds another"
        )
    return tuple(notes)


def _ordered_note(count: int, first: str) -> str:
    several = count > 1
    place = f" ({'the first ' if several else ''}{first})" if first else ""
    were, leave = ("were", "they leave") if several else ("was", "it leaves")
    return (
        f"{_blows(count)} of several contacts{place} {were} taken together; one by one {leave} another "
        'motion: choose by solve.impacts = "simultaneous" or "sequential"'
    )
