"""Faults planted in `kernel/run/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "advance: what is due now waits for a step",
        "run/advance.c",
        "if (is_due_now(w)) return PM_OK;",
        "if (0 && is_due_now(w)) return PM_OK;",
    ),
    Fault("event: a mark at a step's end comes again", "run/advance.c", "hold_hits(w, w->step.end);", ";"),
    Fault("event: a turn is passed as a mark", "run/advance.c", "!due && !w->step.reverses &&", "!due &&"),
    Fault("event: a mark passed twice", "run/advance.c", "fmax(x, e->function[i].located)", "0"),
    Fault(
        "event: a mark passed again beside its place",
        "run/advance.c",
        "fmax(x, e->function[i].located)",
        "x",
    ),
    Fault(
        "uniform: missed end of a slip",
        "run/advance.c",
        "e->hit[i] |= e->root[i] != 0",
        "e->hit[i] |= e->root[i] != 0 && e->function[i].kind != FUNCTION_SLIP",
    ),
    Fault(
        "run: one that fails late keeps nothing",
        "run/run.c",
        "if (status < 0 && started)",
        "if (status < 0 && started && 0)",
    ),
    Fault(
        "batch: counts from the case before", "run/run.c", "pm_trigger_reset(w->model, &w->firing)", "(void)0"
    ),
    Fault(
        "error: nothing of rounding",
        "run/disturb.c",
        "1 + PM_DISTURBED_SPEED * pm_evidence_noise",
        "1 + 0 * PM_DISTURBED_SPEED * pm_evidence_noise",
    ),
    Fault(
        "run: nothing is slow",
        "run/speed_scale.c",
        "if (w->numbers.speed == 0) w->numbers.speed = crossing;",
        "if (w->numbers.speed == 0) w->numbers.speed = w->numbers.size;",
    ),
    Fault(
        "switch: it ends no phase",
        "run/advance.c",
        "PM_EVENT_ROW(m, of)[PM_EVENT_EFFECT] != PM_EFFECT_NONE || ",
        "",
    ),
    Fault(
        "switch: sides are not taken as a run begins",
        "run/run.c",
        "    pm_trigger_take_sides(w);\n",
        "",
    ),
    Fault(
        "plan: a nudge is no rule",
        "run/plan.c",
        "return w->request.program != PM_NONE;",
        "return 0 * w->request.program;",
    ),
    Fault(
        "plan: a singular position is no rule",
        "run/plan.c",
        "return w->phase.singular;",
        "return 0 * w->phase.singular;",
    ),
    Fault(
        "plan: stiff motion is no rule",
        "run/plan.c",
        "return w->phase.stiff == PM_STIFF && w->ida;",
        "return 0 * w->phase.stiff;",
    ),
    Fault("plan: a rule without its condition", "run/plan.c", "(!r->when || r->when(w)) && ", ""),
    Fault(
        "run: a joint's friction holds what starts at its dead centre",
        "run/run.c",
        "|| w->model->nfriction > 0",
        "",
    ),
    Fault(
        "start: what rests in a spring has the speed that rounding makes",
        "run/speed_scale.c",
        "fastest = shifted / sqrt(PM_SHIFT);",
        "(void)shifted;",
    ),
    Fault(
        "start: a small body on a long arm has the speed of one that spins about itself",
        "run/speed_scale.c",
        "return inverse * round > PM_SPEED_ARM ? 1 / round : inverse;",
        "(void)round; return inverse;",
    ),
]
