"""Faults planted in `kernel/state/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "margin: what rises has nearly not fallen",
        "state/evidence.c",
        "return f->side * f->direction > 0;",
        "return 0 * f->side;",
    ),
    Fault(
        "margin: rates by time and by the path are one",
        "state/evidence.c",
        "x->in_time != y->in_time",
        "x->in_time > 2",
    ),
    Fault(
        "margin: what touches has nearly not struck",
        "state/evidence.c",
        "return f->kind == FUNCTION_GAP && pm",
        "return 0 && pm",
    ),
    Fault(
        "error: what fired in the step had to",
        "state/evidence.c",
        "f->held && !(f->since > w->step.begin)",
        "f->held",
    ),
    Fault(
        "decision: nothing is compared after a series", "state/evidence.c", "log->instant = part * PART;", ""
    ),
    Fault(
        "still: bodies have no inertia",
        "state/frame.c",
        "if (frame->numbers->fixed[i]) return",
        "if (0) return",
    ),
    Fault(
        "massless: it has the energy of its stand-in",
        "state/frame.c",
        "frame->numbers->stand_in[3 * i + 2] > 0 ? 0",
        "0 ? 0",
    ),
]
