"""Faults planted in `kernel/state/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "decision: nothing is compared after a series", "state/evidence.c", "log->instant = part * PART;", ""
    ),
    Fault(
        "fixed: bodies have no inertia",
        "state/frame.c",
        "if (frame->numbers->fixed[i]) return",
        "if (0) return",
    ),
    Fault(
        "frame: the sine of another angle that was looked at",
        "state/frame.h",
        "return x->angle == angle ? x :",
        "return x->angle < 10 ? x :",
    ),
    Fault(
        "massless: it has the energy of its stand-in",
        "state/frame.c",
        "frame->numbers->stand_in[3 * i + 2] > 0 ? 0",
        "0 ? 0",
    ),
    Fault(
        "error: the coarse run as tight as the run",
        "state/evidence.c",
        "? PM_COARSER * tightest : tightest",
        "? 2 * tightest : tightest",
    ),
    Fault(
        "limit: the clock is looked at once only",
        "state/patience.c",
        "p->left = p->span;",
        "p->left = 1 << 30;",
    ),
    Fault(
        "limit: of twice the time",
        "state/patience.c",
        "t - p->begun >= p->limit",
        "t - p->begun >= 2 * p->limit",
    ),
]
