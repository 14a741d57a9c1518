"""Faults planted in `kernel/routes/path/`: errors of the time, at given times, and of places."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "path: what more nodes of the same step do not make smaller is rounding",
        "routes/path/path_clock.c",
        "if (p->h < p->clock.length) p->clock.longer",
        "p->clock.longer",
    ),
    Fault(
        "path: coefficients that are no numbers are as good as any",
        "routes/path/path_clock.c",
        "return isnan(all) ? NAN : greatest;",
        "return all == INFINITY ? NAN : greatest;",
    ),
    Fault(
        "path: the tail of the clock is that of its last two coefficients alone",
        "routes/path/path_clock.c",
        "return pm_max(last, here * sqrt(*falls));",
        "return last;",
    ),
    Fault(
        "path: a clock that falls slowly is good enough at a loose tolerance",
        "routes/path/path_step.c",
        "pm_min(most, PM_PATH_TIME_LOOSE)",
        "most",
    ),
    Fault(
        "path: a clock takes nothing for a constant",
        "routes/path/path_clock.c",
        "falls > PM_CLOCK_FALLS ? pm_min(1, PM_CLOCK_CONSTANT * pow(falls, power)) : 0;",
        "0 * power * falls;",
    ),
    Fault(
        "path: a clock knows T between the nodes as well as itself",
        "routes/path/path_clock.c",
        "PM_CLOCK_OFF * off, tail",
        "off, tail",
    ),
    Fault(
        "path: no step leaves most of what is left out of the time",
        "routes/path/path_error.c",
        "return pm_max(PM_CLOCK_LIKELY * clock->unresolved, clock->greatest);",
        "return PM_CLOCK_LIKELY * clock->unresolved;",
    ),
    Fault(
        "path: what is asked at a time is not late",
        "routes/path/path_error_time.c",
        ": by_kinetic + fabs(all) / x.dt * (dt + x.late);",
        ": by_kinetic;",
    ),
    Fault(
        "path: periods that are passed over do not err in time",
        "routes/path/repeat_pass.c",
        "p->clock.error += n * (p->clock.error - l->clock);",
        "",
    ),
    Fault(
        "path: a place beside a given time is as clear as any",
        "routes/path/path_error_time.c",
        "(w->path->clock.error + x.late + PM_ERROR_TIME_ROUNDINGS * fabs(w->frame.t)) / x.dt",
        "1e-30 / x.dt",
    ),
    Fault(
        "path: the place where a motion turns back is exact",
        "routes/path/path_error.c",
        "by_kinetic + pm_path_aside_turn(w, program, value);",
        "by_kinetic;",
    ),
    Fault(
        "path: what is left of loops does no work",
        "routes/path/path_error.c",
        "if (!(more > 0)) return;",
        "return;",
    ),
    Fault(
        "path: from rest it does not turn back before the first node",
        "routes/path/path_step.c",
        "turns_before(p, k) ? nodes->at[k] * p->h : 0;",
        "0;",
    ),
    Fault(
        "path: the first place meets its loops as the state does",
        "routes/path/path_begin.c",
        "!is_balanced(&w->frame, x) && pm_path_meet(w, x)",
        "0",
    ),
]
