"""What a call of the kernel gives back: arrays with their shapes, in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..base.arrays import Floats, Ints, Longs


@dataclass(frozen=True)
class CaseResults:
    """What the kernel says of each case; row i belongs to case i.

    `out` [ncase, nout] in SI (not-a-number where there is no answer), `reason` [ncase, nask], `status`
    [ncase], `where` [ncase, 3], `detail` [ncase, 3], `audit` [ncase, 3], `count` [ncase, 14], `found`
    [ncase, 4] (the sought parameters and their errors, SI), `error` [ncase, nout or 1] as `out`, `margin`
    [ncase, nask or 1], `trust` [ncase, 2]: the columns are those of planemotion.h.  `param`
    [ncase, parameters]: as given.
    """

    out: Floats
    reason: Ints
    status: Ints
    where: Ints
    detail: Floats
    audit: Floats
    count: Longs
    found: Floats
    param: Floats
    error: Floats
    margin: Floats
    trust: Floats


@dataclass(frozen=True)
class History:
    """One run over time: `time` [n], `columns` name -> [n] in SI, `units`; `mark` 0 step, 1 before and 2
    after an event; `status` as of the run; `events` [n]: what happened there, by name, "" where nothing or
    nothing that has a name did."""

    time: Floats
    columns: Mapping[str, Floats]
    units: Mapping[str, str]
    mark: Ints
    status: int
    events: tuple[str, ...] = ()


@dataclass(frozen=True)
class Start:
    """The assembled start: `status`, counts and sizes by name, `pose` and `velocity` [nbody, 3] of the
    mass centres (x, y, angle) in SI, and the message if it failed.  `shared`: as in Phase."""

    status: int
    info: Mapping[str, int]
    number: Mapping[str, float]
    pose: Floats
    velocity: Floats
    message: str
    shared: tuple[tuple[str, ...], ...] = ()


@dataclass(frozen=True)
class Phase:
    """A phase of a run: when it begins (s, NaN where the time is not computed), its route, why the planner
    took it, and sizes: a `column` of enum pm_phase_column each.  `shared`: groups of joints and contacts,
    by their key paths, whose loads are not unique."""

    time: float
    route: str
    reason: str
    column: Mapping[str, int]
    shared: tuple[tuple[str, ...], ...] = ()
