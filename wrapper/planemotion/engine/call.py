"""Runs flat scenes in the compiled kernel: arrays in, arrays out, SI units only.

Every array that the kernel writes is allocated here; its type and shape are checked here, because f2py would
convert silently.  The kernel runs without the GIL.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _layout as layout
from ..base.arrays import Floats, Ints, Longs
from ..base.errors import SimulationError, StudyError
from ..compile.flatten import FlatScene
from .evaluator import value_table
from .heard import heard
from .kernel import kernel, kernel_text, route_name
from .messages import describe, message
from .outcome import CaseResults, History, Phase, Start

# Rows that a history is first given room for; the kernel says how many it needs.
_FIRST_ROWS = 4096
# Numbers of the largest history: 1.6 GB.
_MOST_NUMBERS = 200_000_000


def run_cases(
    flat: FlatScene,
    param: npt.ArrayLike,
    *,
    workers: int = 1,
    stop: Ints | None = None,
    progress: Longs | None = None,
) -> CaseResults:
    """Runs one case for each row of `param` [ncase, parameters] (SI, in the order of `flat.parameters`).

    `stop` [1]: raised by another thread to end early; cases not ended are then "cancelled".  Without it
    Ctrl-C ends them all (KeyboardInterrupt).  `progress` [1]: number of cases finished, to be read meanwhile.
    A case that fails has a negative status and does not stop the others.  Raises SimulationError if the
    kernel takes the tables as a whole for wrong, or has no memory.
    """
    cases = _params(flat, param)
    if workers < 1:
        raise ValueError(f"workers is {workers}; at least 1 is wanted")
    progress = _flag(progress, np.dtype(np.int64), "progress")
    count = len(cases)
    results = CaseResults(
        out=np.full((count, flat.out_columns), np.nan),
        reason=np.zeros((count, flat.ask_rows), np.int32),
        status=np.zeros(count, np.int32),
        where=np.full((count, layout.PM_WHERE_COLUMNS), layout.PM_NONE, np.int32),
        detail=np.full((count, layout.PM_DETAIL_COLUMNS), np.nan),
        audit=np.full((count, layout.PM_AUDITS), np.nan),
        count=np.zeros((count, layout.PM_COUNT_COLUMNS), np.int64),
        found=np.full((count, layout.PM_FOUND_COLUMNS), np.nan),
        param=cases,
        error=np.full((count, max(flat.out_columns, 1)), np.nan),
        margin=np.full((count, max(flat.ask_rows, 1)), np.nan),
        trust=np.full((count, layout.PM_TRUSTS), np.nan),
    )
    if count == 0:
        return results
    arrays = (results.out, results.reason, results.status, results.where)
    more = (results.detail, results.audit, results.count, results.found)
    errors = (results.error, results.margin, results.trust)

    def batch(flag: Ints) -> int:
        return int(
            kernel().pm_batch(
                flat.table, flat.constant, cases, workers, flag, progress, *arrays, *more, *errors
            )
        )

    status = heard(batch) if stop is None else batch(_flag(stop, np.dtype(np.int32), "stop"))
    if status != layout.PM_OK:
        _raise(flat, status, results.where[0], results.detail[0])
    return results


def trace(
    flat: FlatScene, param: npt.ArrayLike, *, every: float = 0.0, bends: npt.ArrayLike | None = None
) -> History:
    """Runs one case and records the columns of `flat.instants` and `flat.trace`, each once, in this order.

    At its start and end, around every event and, between them, every so many seconds, or else at places of
    every step: so many that a straight line over time misses column i by at most `bends[i]` in its SI unit
    (None: whatever it misses).  `param` [parameters]; what is sought is found first.  Raises SimulationError
    only if nothing at all can be recorded, or too much is asked for; a run that fails on the way gives what
    it has, with its status.
    """
    case = found_cases(flat, _params(flat, np.atleast_2d(np.asarray(param))))[0]
    recorded = {**flat.instants, **flat.trace}
    programs = np.array([program for program, _ in recorded.values()], np.int32)
    bend = np.full(len(programs), np.inf) if bends is None else np.ascontiguousarray(bends, np.float64)
    if bend.shape != programs.shape:
        raise ValueError(f"bends has the shape {bend.shape}; {programs.shape} is wanted")
    rows = _FIRST_ROWS
    while True:
        history = np.full((rows, 1 + len(programs)), np.nan)
        mark = np.zeros(rows, np.int32)
        needed = np.zeros(1, np.int64)
        where, detail = _place()
        given = (every, programs, bend, history, mark, needed, where, detail)
        status = heard(partial(_with_stop, kernel().pm_trace, (flat.table, flat.constant, case), given))
        if needed[0] <= rows:
            break
        rows = int(needed[0])
        if rows * (1 + len(programs)) > _MOST_NUMBERS:
            raise StudyError(
                f"a history of {rows:.3g} instants with {len(programs)} columns is too large; "
                f"record less often, or fewer quantities (at most {_MOST_NUMBERS:.0e} numbers)"
            )
    if needed[0] == 0 and status < layout.PM_OK:
        _raise(flat, status, where, detail)
    used = int(needed[0])
    columns = {name: history[:used, 1 + index].copy() for index, name in enumerate(recorded)}
    units = {name: unit for name, (_, unit) in recorded.items()}
    return History(history[:used, 0].copy(), columns, units, mark[:used], int(status))


def phases(flat: FlatScene, param: npt.ArrayLike | None = None, most: int = 0) -> list[Phase]:
    """The phases of one case, all or the first `most`.

    `param` [parameters] defaults to the scene's own values; if given, what is sought is found first.  A run
    that fails gives the phases that it has begun.
    """
    cases = _params(flat, np.atleast_2d(flat.defaults if param is None else np.asarray(param)))
    case = (cases if param is None else found_cases(flat, cases))[0]
    rows = _FIRST_ROWS
    while True:
        row = np.zeros((rows, layout.PM_PHASE_COLUMNS), np.int32)
        time = np.full(rows, np.nan)
        needed = np.zeros(1, np.int64)
        joint, contact = _groups(flat, rows)
        where, detail = _place()
        room = (most, row, time, joint, contact, needed, where, detail)
        heard(partial(_with_stop, kernel().pm_phases, (flat.table, flat.constant, case), room))
        if needed[0] <= rows:
            break
        rows = int(needed[0])
    names = {value: name.removeprefix("PM_PHASE_").lower() for name, value in layout.pm_phase_column.items()}
    return [
        Phase(
            float(time[i]),
            route_name(int(row[i, layout.PM_PHASE_ROUTE])),
            kernel_text(kernel().pm_rule_text, int(row[i, layout.PM_PHASE_RULE])),
            {name: int(row[i, column]) for column, name in names.items() if column < row.shape[1]},
            _shared(flat, joint[i], contact[i]),
        )
        for i in range(int(needed[0]))
    ]


def needs(flat: FlatScene, table: int) -> npt.NDArray[np.bool_]:
    """Which rows of a table the answers of the scene depend on [rows]; a run leaves the others out."""
    needed = np.zeros(len(flat.rows(table)), np.int32)
    where, detail = _place()
    status = kernel().pm_needs(flat.table, flat.constant, len(flat.parameters), table, needed, where, detail)
    if status != layout.PM_OK:
        _raise(flat, status, where, detail)
    return needed != 0


def check(flat: FlatScene, param: npt.ArrayLike | None = None) -> Start:
    """Assembles the start of one case without running it.

    `param` [parameters], SI, defaults to the scene's own values.
    """
    given = flat.defaults if param is None else np.asarray(param)
    case = _params(flat, np.atleast_2d(given))[0]
    info = np.zeros(layout.PM_CHECK_COLUMNS, np.int32)
    number = np.zeros(layout.PM_CHECK_NUMBERS)
    pose, velocity = np.zeros((len(flat.bodies), 3)), np.zeros((len(flat.bodies), 3))
    joint, contact = (groups[0] for groups in _groups(flat, 1))
    where, detail = _place()
    room = (info, number, pose, velocity, joint, contact, where, detail)
    status = heard(partial(_with_stop, kernel().pm_check, (flat.table, flat.constant, case), room))
    if status in (layout.PM_BAD_TABLE, layout.PM_NO_MEMORY):
        _raise(flat, status, where, detail)
    return Start(
        status=int(status),
        info={
            _column(name): int(info[index])
            for name, index in layout.pm_check_column.items()
            if index < len(info)
        },
        number={
            _column(name): float(number[i]) for name, i in layout.pm_check_number.items() if i < len(number)
        },
        pose=pose,
        velocity=velocity,
        message="" if status == layout.PM_OK else describe(flat, int(status), where, detail),
        shared=_shared(flat, joint, contact),
    )


def values(flat: FlatScene, param: npt.ArrayLike | None = None) -> Floats:
    """The values [values] of one case, SI, as the kernel computes them; `param` [parameters] in SI."""
    given = flat.defaults if param is None else param
    return value_table(flat, _params(flat, np.atleast_2d(np.asarray(given)))[0])


def found(flat: FlatScene) -> dict[str, float]:
    """What is sought, by parameter, SI; empty if nothing is.  Raises SimulationError if it is not found."""
    if flat.find is None:
        return {}
    case = found_cases(flat, np.atleast_2d(flat.defaults))[0]
    return {name: float(case[flat.parameters.index(name)]) for name in flat.find.vary}


def _params(flat: FlatScene, param: npt.ArrayLike) -> Floats:
    given = np.asarray(param)
    if given.dtype.kind not in "fiu":
        raise TypeError(f"param has the type {given.dtype}; real numbers are wanted")
    if given.ndim != 2 or given.shape[1] != len(flat.parameters):
        raise ValueError(f"param has the shape {given.shape}; (cases, {len(flat.parameters)}) is wanted")
    return np.ascontiguousarray(given, dtype=np.float64)


def _with_stop(
    function: Callable[..., int], scene: tuple[Any, ...], more: tuple[Any, ...], stop: Ints
) -> int:
    """A function of the kernel that takes the flag behind what it takes of the scene."""
    return int(function(*scene, stop, *more))


def found_cases(flat: FlatScene, cases: Floats) -> Floats:
    """The cases [ncase, parameters] with what their finds found.  Raises SimulationError if nothing was."""
    if flat.find is None:
        return cases
    results = run_cases(flat, cases)
    if results.status[0] < layout.PM_OK:
        raise SimulationError(message(flat, results, 0), status=int(results.status[0]))
    found = cases.copy()
    for number, name in enumerate(flat.find.vary):
        found[:, flat.parameters.index(name)] = results.found[:, number]
    return found


def _flag(flag: npt.NDArray[Any] | None, dtype: np.dtype[Any], name: str) -> npt.NDArray[Any]:
    """A shared array [1]: the caller's own, never a copy."""
    if flag is None:
        return np.zeros(1, dtype)
    if flag.dtype != dtype or flag.shape != (1,):
        raise ValueError(
            f"{name} has the type {flag.dtype} and shape {flag.shape}; {dtype} and (1,) are wanted"
        )
    return flag


# Joints and contacts: what may share its loads with others.
_SHARING = (layout.PM_TABLE_JOINT, layout.PM_TABLE_CONTACT)


def _groups(flat: FlatScene, rows: int) -> list[Ints]:
    """For each of `rows` the number of the group of each joint, and of each contact; 0: none."""
    return [np.zeros((rows, max(1, len(flat.rows(table)))), np.int32) for table in _SHARING]


def _shared(flat: FlatScene, *groups: Ints) -> tuple[tuple[str, ...], ...]:
    """The key paths of each group."""
    members: dict[int, list[str]] = {}
    for table, numbers in zip(_SHARING, groups, strict=True):
        for row, number in enumerate(numbers):
            if number:
                members.setdefault(int(number), []).append(flat.names[table][row])
    return tuple(tuple(dict.fromkeys(members[number])) for number in sorted(members))


def _place() -> tuple[Ints, Floats]:
    """Where [3] (table, row, member) and detail [3] (value, bound in SI, time in s) of a single case."""
    where = np.full(layout.PM_WHERE_COLUMNS, layout.PM_NONE, np.int32)
    return where, np.full(layout.PM_DETAIL_COLUMNS, np.nan)


def _raise(flat: FlatScene, status: int, where: Ints, detail: Floats) -> None:
    time = float(detail[layout.PM_DETAIL_TIME])
    known = time if math.isfinite(time) else None
    raise SimulationError(describe(flat, int(status), where, detail), status=int(status), time=known)


def _column(name: str) -> str:
    return name.removeprefix("PM_CHECK_").lower()
