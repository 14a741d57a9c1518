"""Faults planted in `kernel/routes/path/`: errors at given times."""

from tests.faults.fault import Fault

FAULTS = [
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
]
