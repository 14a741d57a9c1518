"""How a scene is computed, phase by phase: the planner's choices and what they leave out, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import groupby

from .. import _layout as layout
from ..compile.flatten import FlatScene
from ..engine import call
from ..engine.outcome import Phase, Start

# Phases are alike in all but the time, the steps, the segments passed over before them and the gaps skipped.
_OWN = ("steps", "repeated_segments", "skipped")


def plan(flat: FlatScene, start: Start) -> list[str]:
    """Before a run: the first phase, what it has to compute and what is left out."""
    if start.message:
        return []
    first = call.phases(flat, most=1)
    if not first:
        return [
            _title("plan", flat),
            "  no motion is computed: the start, and blows at it, answer all that is asked",
        ]
    phase = first[0]
    return [
        _title("plan", flat),
        f"  first phase: {phase.route} ({phase.reason})",
        f"  {_sizes(phase)}",
        *(f"  skipped: {what}" for what in _idle(flat)),
        *(f"  skipped: {what}" for what in _skipped(phase)),
    ]


def ran(flat: FlatScene) -> list[str]:
    """After a run: its phases; those alike that follow each other on one line."""
    lines = []
    number = 0
    for _, group in groupby(call.phases(flat, flat.defaults), key=_kind):
        alike = list(group)
        first, number = number + 1, number + len(alike)
        which = f"{first}" if number == first else f"{first} to {number}"
        steps = sum(phase.column["steps"] for phase in alike)
        repeated = sum(phase.column["repeated_segments"] for phase in alike)
        gaps = sum(phase.column["skipped"] for phase in alike)
        time = "" if math.isnan(alike[0].time) else f" from t = {alike[0].time:.6g} s"
        lines += [
            f"  {which}{time}: {alike[0].route} ({alike[0].reason})",
            f"    {_sizes(alike[0])}; {_count(steps, 'step')}"
            + (f", {_count(repeated, 'segment')} that repeat passed over" if repeated else ""),
            *(f"    skipped: {what}" for what in _skipped(alike[0])),
            *(f"    {line}" for line in shared_lines(alike[0].shared)),
            *([f"    skipped: {_count(gaps, 'look')} at gaps (out of reach of the step)"] if gaps else []),
        ]
    idle = [f"  skipped throughout: {what}" for what in _idle(flat)]
    return [_title("phases", flat), *lines, *idle] if lines else []


def shared_lines(groups: tuple[tuple[str, ...], ...]) -> list[str]:
    """What shares its loads, group by group."""
    return [
        f"{', '.join(group)} share their loads: the motion is right, but single reactions may not be unique"
        for group in groups
    ]


def _title(word: str, flat: FlatScene) -> str:
    return word if flat.run is None else f"{word} of run {flat.run}"


# What a run may leave out, by table, and the word for it.
_IDLE = {
    layout.PM_TABLE_BODY: "bodies",
    layout.PM_TABLE_JOINT: "joints",
    layout.PM_TABLE_CONTACT: "contacts",
    layout.PM_TABLE_FORCE: "forces",
    layout.PM_TABLE_EVENT: "events",
}


def _idle(flat: FlatScene) -> Iterator[str]:
    """What no answer depends on, if there is any; the ledger of the audit does not hold it."""
    left = []
    for table, word in _IDLE.items():
        names = (
            (flat.bodies if table == layout.PM_TABLE_BODY else flat.names[table])
            if table in flat.names
            else ()
        )
        needed = call.needs(flat, table)
        idle = dict.fromkeys(name for name, is_needed in zip(names, needed, strict=False) if not is_needed)
        written = [name.removeprefix(f"{word}.") for name in idle if name]
        if written:
            left.append(f"{word} {', '.join(written)}")
    if left:
        yield f"{'; '.join(left)} (nothing that is asked depends on them; the audit is of the rest)"


def _kind(phase: Phase) -> tuple[object, ...]:
    return (
        phase.route,
        phase.reason,
        phase.shared,
        *(value for name, value in phase.column.items() if name not in _OWN),
    )


def _sizes(phase: Phase) -> str:
    x = phase.column
    solved = x["constraints"] - x["loops"]
    parts = [
        _count(x["unknowns"], "coordinate")
        + (f" (they meet {_count(solved, 'constraint')} by themselves)" if solved else ""),
        f"{_count(x['loops'], 'constraint')} to be solved with"
        + (f", {x['redundant']} left out" if x["redundant"] else ""),
        f"{_count(x['freedom'], 'degree')} of freedom",
        f"{_count(x['watched'], 'event function')} watched",
    ]
    return ", ".join(parts)


def _skipped(phase: Phase) -> Iterator[str]:
    """What this phase does not compute, and why."""
    x = phase.column
    if not x["clock"]:
        yield "the time (nothing asks for it)"
    if not x["dynamic"]:
        yield "accelerations and reactions within steps (nothing that is watched needs them)"
    if x["fixed"]:
        yield f"{_bodies(x['fixed'])} (fixed by {'its' if x['fixed'] == 1 else 'their'} joints)"
    if x["out_of_reach"]:
        gaps = _count(x["out_of_reach"], "contact")
        yield f"the gap of {gaps} (out of reach wherever the joints let the bodies go)"
    if not x["watched"]:
        yield "the search for events (none can come before the time that is asked for)"
    if phase.route == "path":
        yield "integration in time (speeds follow from work and energy)"
    if phase.route == "uniform":
        yield "steps (the motion is a polynomial of the time)"


def _bodies(number: int) -> str:
    return f"{number} {'body' if number == 1 else 'bodies'}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
