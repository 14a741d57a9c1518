"""Runs flat scenes in the compiled kernel: arrays in, arrays out, SI units only.

Every array that the kernel writes is allocated here; its type and shape are checked here, because f2py would
convert silently.  The kernel runs without the GIL.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _layout as layout
from ..base.errors import SimulationError
from ..compile.columns import named, with_unit
from ..compile.flatten import FlatScene

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Longs = npt.NDArray[np.int64]

_STATUS_TEXT_LENGTH = 256
# Rows that a history is first given room for; the kernel says how many it needs.
_FIRST_ROWS = 4096

_STATUS_NAMES = {value: name.removeprefix("PM_").lower() for name, value in layout.pm_status.items()}
_ROUTE_NAMES = {value: name.removeprefix("PM_ROUTE_").lower() for name, value in layout.pm_route.items()}
AUDITS = tuple(name.removeprefix("PM_AUDIT_").lower() for name in layout.pm_audit if name != "PM_AUDITS")
REASONS: Mapping[int, str] = {
    layout.PM_REASON_NONE: "",
    layout.PM_REASON_NOT_REACHED: "not reached",
    layout.PM_REASON_UNDEFINED: "undefined: the expression has no value at some instant",
    layout.PM_REASON_FAILED: "the run failed",
    layout.PM_REASON_INFINITE: "infinite",
}
_SETTINGS = {layout.PM_SETTING_NUDGE: "start.nudge", layout.PM_SETTING_ROUTE: "solve.route"}
_TABLE_NAMES = {value: name.removeprefix("PM_TABLE_").lower() for name, value in layout.pm_table.items()}


@dataclass(frozen=True)
class CaseResults:
    """What the kernel says of each case; row i belongs to case i.

    `out` [ncase, nout] in SI (not-a-number where there is no answer), `reason` [ncase, nask], `status`
    [ncase], `where` [ncase, 3], `detail` [ncase, 3], `audit` [ncase, 3], `count` [ncase, 9], `found`
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
    after an event; `status` as of the run."""

    time: Floats
    columns: Mapping[str, Floats]
    units: Mapping[str, str]
    mark: Ints
    status: int


@dataclass(frozen=True)
class Start:
    """The assembled start: `status`, counts and sizes by name, `pose` and `velocity` [nbody, 3] of the
    mass centres (x, y, angle) in SI, and the message if it failed."""

    status: int
    info: Mapping[str, int]
    number: Mapping[str, float]
    pose: Floats
    velocity: Floats
    message: str


def run_cases(
    flat: FlatScene,
    param: npt.ArrayLike,
    *,
    workers: int = 1,
    stop: Ints | None = None,
    progress: Longs | None = None,
) -> CaseResults:
    """Runs one case for each row of `param` [ncase, parameters] (SI, in the order of `flat.parameters`).

    `stop` [1]: raised by another thread to end early; cases not begun are then "cancelled".  `progress` [1]:
    number of cases finished, to be read meanwhile.  A case that fails has a negative status and does not stop
    the others.  Raises SimulationError if the kernel takes the tables as a whole for wrong, or has no memory.
    """
    cases = _params(flat, param)
    if workers < 1:
        raise ValueError(f"workers is {workers}; at least 1 is wanted")
    stop = _flag(stop, np.dtype(np.int32), "stop")
    progress = _flag(progress, np.dtype(np.int64), "progress")
    count = len(cases)
    results = CaseResults(
        out=np.full((count, flat.out_columns), np.nan),
        reason=np.zeros((count, len(flat.asks)), np.int32),
        status=np.zeros(count, np.int32),
        where=np.full((count, layout.PM_WHERE_COLUMNS), layout.PM_NONE, np.int32),
        detail=np.full((count, layout.PM_DETAIL_COLUMNS), np.nan),
        audit=np.full((count, layout.PM_AUDITS), np.nan),
        count=np.zeros((count, layout.PM_COUNT_COLUMNS), np.int64),
        found=np.full((count, layout.PM_FOUND_COLUMNS), np.nan),
        param=cases,
        error=np.full((count, max(flat.out_columns, 1)), np.nan),
        margin=np.full((count, max(len(flat.asks), 1)), np.nan),
        trust=np.full((count, layout.PM_TRUSTS), np.nan),
    )
    if count == 0:
        return results
    arrays = (results.out, results.reason, results.status, results.where)
    more = (results.detail, results.audit, results.count, results.found)
    errors = (results.error, results.margin, results.trust)
    status = _kernel().pm_batch(
        flat.table, flat.constant, cases, workers, stop, progress, *arrays, *more, *errors
    )
    if status != layout.PM_OK:
        _raise(flat, status, results.where[0], results.detail[0])
    return results


def trace(flat: FlatScene, param: npt.ArrayLike) -> History:
    """Runs one case and records the columns of `flat.trace` at every step and around every event.

    `param` [parameters]; what is sought is found first.  Raises SimulationError only if nothing at all can be
    recorded; a run that fails on the way gives what it has, with its status.
    """
    case = _found(flat, _params(flat, np.atleast_2d(np.asarray(param))))[0]
    programs = np.array([program for program, _ in flat.trace.values()], np.int32)
    rows = _FIRST_ROWS
    while True:
        history = np.full((rows, 1 + len(programs)), np.nan)
        mark = np.zeros(rows, np.int32)
        needed = np.zeros(1, np.int64)
        where, detail = _place()
        status = _kernel().pm_trace(
            flat.table, flat.constant, case, programs, history, mark, needed, where, detail
        )
        if needed[0] <= rows:
            break
        rows = int(needed[0])
    if needed[0] == 0 and status < layout.PM_OK:
        _raise(flat, status, where, detail)
    used = int(needed[0])
    columns = {name: history[:used, 1 + index].copy() for index, name in enumerate(flat.trace)}
    units = {name: unit for name, (_, unit) in flat.trace.items()}
    return History(history[:used, 0].copy(), columns, units, mark[:used], int(status))


@dataclass(frozen=True)
class Phase:
    """A phase of a run: when it begins (s, NaN where the time is not computed), its route, why the planner
    took it, and sizes: a `column` of enum pm_phase_column each."""

    time: float
    route: str
    reason: str
    column: Mapping[str, int]


def phases(flat: FlatScene, param: npt.ArrayLike | None = None, most: int = 0) -> list[Phase]:
    """The phases of one case, all or the first `most`.

    `param` [parameters] defaults to the scene's own values; if given, what is sought is found first.  A run
    that fails gives the phases that it has begun.
    """
    cases = _params(flat, np.atleast_2d(flat.defaults if param is None else np.asarray(param)))
    case = (cases if param is None else _found(flat, cases))[0]
    rows = _FIRST_ROWS
    while True:
        row = np.zeros((rows, layout.PM_PHASE_COLUMNS), np.int32)
        time = np.full(rows, np.nan)
        needed = np.zeros(1, np.int64)
        where, detail = _place()
        _kernel().pm_phases(flat.table, flat.constant, case, most, row, time, needed, where, detail)
        if needed[0] <= rows:
            break
        rows = int(needed[0])
    names = {value: name.removeprefix("PM_PHASE_").lower() for name, value in layout.pm_phase_column.items()}
    return [
        Phase(
            float(time[i]),
            route_name(int(row[i, layout.PM_PHASE_ROUTE])),
            _text(_kernel().pm_rule_text, int(row[i, layout.PM_PHASE_RULE])),
            {name: int(row[i, column]) for column, name in names.items() if column < row.shape[1]},
        )
        for i in range(int(needed[0]))
    ]


def needs(flat: FlatScene, table: int) -> npt.NDArray[np.bool_]:
    """Which rows of a table the answers of the scene depend on [rows]; a run leaves the others out."""
    needed = np.zeros(len(flat.rows(table)), np.int32)
    where, detail = _place()
    status = _kernel().pm_needs(flat.table, flat.constant, len(flat.parameters), table, needed, where, detail)
    if status != layout.PM_OK:
        _raise(flat, status, where, detail)
    return needed != 0


def check(flat: FlatScene, param: npt.ArrayLike | None = None) -> Start:
    """Assembles the start of one case without running it; `param` defaults to the scene's own values."""
    given = flat.defaults if param is None else np.asarray(param)
    case = _params(flat, np.atleast_2d(given))[0]
    info = np.zeros(layout.PM_CHECK_COLUMNS, np.int32)
    number = np.zeros(layout.PM_CHECK_NUMBERS)
    pose, velocity = np.zeros((len(flat.bodies), 3)), np.zeros((len(flat.bodies), 3))
    where, detail = _place()
    status = _kernel().pm_check(flat.table, flat.constant, case, info, number, pose, velocity, where, detail)
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
    )


def values(flat: FlatScene, param: npt.ArrayLike | None = None) -> Floats:
    """The value table of one case, SI, as the kernel computes it: for pictures and messages."""
    from .evaluator import value_table

    given = flat.defaults if param is None else param
    return value_table(flat, _params(flat, np.atleast_2d(np.asarray(given)))[0])


# ---- words ----------------------------------------------------------------------------------------------


def status_name(status: int) -> str:
    """The word of a status: "ok", "limit_time", "assembly" ..."""
    return _STATUS_NAMES.get(status, f"status {status}")


def route_name(route: int) -> str:
    """The word of a route: "rk", "ida"."""
    return _ROUTE_NAMES.get(route, f"route {route}")


def status_text(status: int) -> str:
    """The kernel's own sentence for a status."""
    return _text(_kernel().pm_status_text, status)


def _text(function: Callable[[int, npt.NDArray[np.int8]], int], number: int) -> str:
    """A text of the kernel."""
    text = np.zeros(_STATUS_TEXT_LENGTH, np.int8)
    length = function(number, text)
    return bytes(text[:length].tobytes()).decode("utf-8")


def message(flat: FlatScene, results: CaseResults, i: int) -> str:
    """What happened to case i, in the scene's own words; "" if it is ok."""
    status = int(results.status[i])
    if status == layout.PM_OK:
        return ""
    text = describe(flat, status, results.where[i], results.detail[i], results.param[i])
    if status < layout.PM_OK and not np.isnan(results.out[i]).all():
        text += "; the answers that are there were reached before, while the audit closed"
    return text


def describe(flat: FlatScene, status: int, where: Ints, detail: Floats, param: Floats | None = None) -> str:
    """File, place, what is wrong, value and bound of a status that is not ok; `param`: of the case."""
    from .find_text import FIND_STATUSES, describe_find

    place = _place_name(flat, where, status)
    if status in FIND_STATUSES and flat.find is not None:
        sentence = describe_find(flat, status, where, detail, flat.defaults if param is None else param)
        return f"{flat.file}: {sentence}" if flat.file else sentence
    found, bound, time = (float(number) for number in detail)
    text = _DESCRIPTIONS.get(status)
    if status == layout.PM_BAD_VALUE:
        sentence = _bad_value(place, found, bound, _unit(flat, where))
    else:
        sentence = text(place, found, bound) if text is not None else ""
    if not sentence:
        sentence = ": ".join(piece for piece in (place, status_text(status)) if piece)
        if math.isfinite(found):
            numbers = f"{found:.6g}" + (f", bound {bound:.6g}" if math.isfinite(bound) else "")
            sentence += f" ({numbers})"
    if math.isfinite(time) and time > 0:
        sentence += f", at t = {time:.6g} s"
    return f"{flat.file}: {sentence}" if flat.file else sentence


def _named(flat: FlatScene, where: Ints) -> tuple[str, str]:
    """Key and unit of the number that is out of its bound."""
    table, row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
    if table < 0 or row < 0:
        return "", ""
    return named(table, flat.rows(table)[row], int(where[layout.PM_WHERE_MEMBER]))


def _unit(flat: FlatScene, where: Ints) -> str:
    return _named(flat, where)[1]


def _place_name(flat: FlatScene, where: Ints, status: int) -> str:
    """The key path of the row at fault; of a number out of its bound that of the number."""
    table, row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
    names = flat.names.get(table, ())
    if table == layout.PM_TABLE_SETTING and row in _SETTINGS:
        return _SETTINGS[row]
    if 0 <= row < len(names):
        member = int(where[layout.PM_WHERE_MEMBER])
        if status == layout.PM_BAD_VALUE:
            return f"{names[row]}.{_named(flat, where)[0]}".removesuffix(".")
        is_contact = table == layout.PM_TABLE_CONTACT
        return f"{names[row]}[{member}]" if is_contact and member > 0 else names[row]
    return _TABLE_NAMES.get(table, "") if table >= 0 else ""


def _here(place: str) -> str:
    return " where it is added" if place.startswith("events.") else " at the start"


def _open_joint(place: str, found: float, bound: float) -> str:
    if place.startswith("events."):
        return (
            f"{place}: the joint does not fit there: it is open by {found:.4g} m (allowed {bound:.2g} m); "
            "add it where its partners are as drawn"
        )
    if place.startswith("couplings.") and bound == 0:
        return (
            f"start: {place}: no straight strand as drawn: one circle reaches over the other by {found:.4g} m"
        )
    if place.startswith("couplings."):
        return (
            f"start: {place}: the pitch circles are drawn {found:.4g} m from touching each other "
            f"(allowed {bound:.2g} m); move one of the centres, or change a radius"
        )
    # The kernel measures openings in m, or rad where a direction is held.
    return (
        f"start: the joints cannot be met with the values written: {place or 'a joint'} is open by "
        f'{found:.4g} m (allowed {bound:.2g} m); mark a value as a guess, such as angle = "~0 deg", '
        "or change a length"
    )


def _rate_unit(place: str) -> str:
    return "rad/s" if place.endswith("omega") else "m/s"


def _bad_value(place: str, found: float, bound: float, unit: str) -> str:
    if place == "spin.angle":
        return (
            f"{place}: {found:.6g} m/s^2 of the weight act across the axis; a plane that turns keeps its "
            'weight only along a vertical axis (angle = "90 deg"), or has none in it (plane = "horizontal")'
        )
    if place == "spin.inertia" and found == 0:
        return f"{place}: nothing that turns has an inertia about the axis at the start; give it"
    if math.isfinite(bound):
        return f"{place or 'a value'}: it is {with_unit(found, unit)}; the bound is {bound:.6g}"
    return f"{place}: it is {found:.6g} at the start; a force is finite, and a power needs a motion"


_DESCRIPTIONS: dict[int, Any] = {
    layout.PM_LIMIT_TIME: lambda place, found, bound: (
        f"until: not reached within solve.max_time ({bound:g} s); does it happen at all? else allow more"
    ),
    layout.PM_LIMIT_EVENTS: lambda place, found, bound: "until: not reached within solve.max_events",
    layout.PM_LIMIT_STEPS: lambda place, found, bound: "until: not reached within solve.max_steps",
    layout.PM_CANCELLED: lambda place, found, bound: "cancelled before it was finished",
    layout.PM_STAYS_AT_REST: lambda place, found, bound: (
        "until: not reached; everything has come to rest and stays"
        if found > 0
        else "until: not reached; everything is at rest from the start and stays: give a velocity in "
        "start, or by start.nudge the side to which an unstable rest is left"
    ),
    layout.PM_UNDECIDED: lambda place, found, bound: (
        "the run came to its end, but a decision on the way (what fires first, what touches, what holds) is "
        f"closer to its threshold than the errors of the run: margin {found:.2g}, at least 1 is wanted; "
        "ask for more solve.accuracy"
    ),
    layout.PM_ASSEMBLY: _open_joint,
    layout.PM_START_CONFLICT: lambda place, found, bound: (
        f"{place}: {with_unit(found, _rate_unit(place))} is given, but the other start values and the joints "
        f"give {bound:.6g}; leave one of them out"
    ),
    layout.PM_START_OPEN: lambda place, found, bound: (
        f"start: what is given leaves the motion of {place} undetermined; give its omega or a velocity"
    ),
    layout.PM_SINGULAR: lambda place, found, bound: (
        f"{place}: it has no mass, and nothing else determines its motion here; give it one, or fasten it"
        if place.startswith("bodies.")
        else f"{place or 'the scene'}: the joints do not determine the accelerations here: a singular "
        "position (a dead centre, or two joints that have come together); end the run before it, or "
        "change a length"
    ),
    layout.PM_ENDS_SINGULAR: lambda place, found, bound: (
        f"{place or 'the scene'}: a singular position was reached before the end of the run (a dead centre, "
        "or two joints that have come together), and on this route nothing tells how the motion goes on; "
        'what was answered before stands; end the run before it, or try solve.route = "path"'
    ),
    layout.PM_STEP_TOO_SMALL: lambda place, found, bound: (
        "the integrator cannot go on at solve.accuracy: the motion has no smooth continuation here (a "
        "singular position, a force that jumps); end the run before it, or lower the accuracy"
    ),
    layout.PM_UNSUPPORTED: lambda place, found, bound: (
        f"{place}: a blow loads this joint: not built yet for friction that goes with the load"
        if place.endswith(".friction")
        else f"{place}: another nudge acts at the same instant; one at a time"
        if place.endswith(".nudge")
        else f'{place} = "{route_name(int(found))}": this route does not compute the motion; it takes '
        f"{_text(_kernel().pm_route_text, int(found))}; leave {place} out"
        if place == "solve.route"
        else ""
    ),
    layout.PM_NO_TIME_ROUTE: lambda place, found, bound: (
        f'{place} = "{route_name(int(found))}": no time passes: everything that is asked is answered at the '
        "start, without any integration; the answers stand"
    ),
    layout.PM_SOLVER: lambda place, found, bound: (
        f"{place + ': ' if place else ''}the solver of this route gave up (its code {found:.0f}); "
        'try solve.route = "rk" or another accuracy'
    ),
    layout.PM_BLOWS_ENDLESS: lambda place, found, bound: (
        f"the blows one by one at this instant do not end ({found:.0f} of them): bodies wedged without loss; "
        'lower a restitution, or solve.simultaneous = "together"'
    ),
    layout.PM_BLOW_GAINS: lambda place, found, bound: (
        f"{place}: with this friction its law of restitution would create energy ({found:.4g} J): "
        'the slip changes in the blow; law = "stronge" cannot'
    ),
    layout.PM_BLOW_TURNS: lambda place, found, bound: (
        f"{place}: its slip turns (to {found:.3g} m/s) in a blow in which several contacts take part, "
        'and no law says how; solve.simultaneous = "one by one" follows each'
    ),
    layout.PM_BLOW_SEVERAL: lambda place, found, bound: (
        f"{place}.law: it is for one contact at a time and {found:.0f} take part in a blow; "
        'take law = "newton", or solve.simultaneous = "one by one"'
    ),
    layout.PM_PENETRATION: lambda place, found, bound: (
        f"{place}: the two overlap by {abs(found):.4g} m{_here(place)}; move one of them"
    ),
    layout.PM_NUDGE_UNSTEADY: lambda place, found, bound: (
        f"{place}: it acts where there is neither rest nor a steady motion that could be left to either "
        "side: the motion goes another way by itself; leave out the nudge, or put it at another instant"
    ),
    layout.PM_NUDGE_STABLE: lambda place, found, bound: (
        f"{place}: nothing that it could begin grows: "
        + ("what grows there does not move what it names" if found > 0 else "the rest or motion is stable")
        + "; name a velocity that changes as it is left"
    ),
    layout.PM_NO_IMPULSE: lambda place, found, bound: (
        f"{place}: no impulse on this body does the work {found:.6g} J and keeps the sense in which it turns"
        + (f"; {bound:.6g} J would stop it" if math.isfinite(bound) and bound != 0 else "; it does not turn")
    ),
}


# ---- arrays ---------------------------------------------------------------------------------------------


def _kernel() -> Any:
    """The extension, imported when the first run needs it."""
    from .. import _kernel as kernel

    return kernel


def _params(flat: FlatScene, param: npt.ArrayLike) -> Floats:
    given = np.asarray(param)
    if given.dtype.kind not in "fiu":
        raise TypeError(f"param has the type {given.dtype}; real numbers are wanted")
    if given.ndim != 2 or given.shape[1] != len(flat.parameters):
        raise ValueError(f"param has the shape {given.shape}; (cases, {len(flat.parameters)}) is wanted")
    return np.ascontiguousarray(given, dtype=np.float64)


def _found(flat: FlatScene, cases: Floats) -> Floats:
    """The cases with what their finds found.  Raises SimulationError where nothing was."""
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
    """A shared one-number array: the caller's own, never a copy."""
    if flag is None:
        return np.zeros(1, dtype)
    if flag.dtype != dtype or flag.shape != (1,):
        raise ValueError(
            f"{name} has the type {flag.dtype} and shape {flag.shape}; {dtype} and (1,) are wanted"
        )
    return flag


def _place() -> tuple[Ints, Floats]:
    """Where and detail of a single case."""
    where = np.full(layout.PM_WHERE_COLUMNS, layout.PM_NONE, np.int32)
    return where, np.full(layout.PM_DETAIL_COLUMNS, np.nan)


def _raise(flat: FlatScene, status: int, where: Ints, detail: Floats) -> None:
    time = float(detail[layout.PM_DETAIL_TIME])
    known = time if math.isfinite(time) else None
    raise SimulationError(describe(flat, int(status), where, detail), status=int(status), time=known)


def _column(name: str) -> str:
    return name.removeprefix("PM_CHECK_").lower()
