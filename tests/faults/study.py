"""Faults planted in `kernel/study/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "margin: a coarse run that takes a series at once earlier has decided otherwise",
        "study/margin.c",
        "p->count[PM_COUNT_JUMPS] - p->alike",
        "p->count[PM_COUNT_JUMPS]",
    ),
    Fault(
        "margin: what nobody has seen is decided where no errors are estimated",
        "study/accuracy.c",
        "return status == PM_OK ? pm_margin_unseen(w) : status;",
        "return status;",
    ),
    Fault(
        "margin: what nobody has seen is decided",
        "study/margin.c",
        "is_tied(b) || is_unseen(a) || is_unseen(b)) return 0;",
        "is_tied(b)) return 0;",
    ),
    Fault(
        "margin: loads of other modes are compared",
        "study/margin.c",
        "&& x->trial == y->trial &&",
        "&&",
    ),
    Fault(
        "error: steps that nothing limits are the same",
        "study/pass.c",
        "w->numbers.coarse = coarse ? PM_ACCURACY_COARSE : 1",
        "w->numbers.coarse = 1",
    ),
    Fault(
        "error: one coarse run alone at loose accuracies",
        "study/accuracy.c",
        "if (errs_by_chance(w) ||",
        "if (",
    ),
    Fault(
        "error: what was not kept is not repeated", "study/accuracy.c", "trust[PM_TRUST_EXCESS] <= 1;", "1;"
    ),
    Fault(
        "error: passes whose steps are the same tell each other's error",
        "study/accuracy.c",
        "!steps_go_with_tolerance(&w->phase, e->spare, e->main))",
        "steps_go_with_tolerance(&w->phase, e->spare, e->main) > 1)",
    ),
    Fault(
        "margin: other counts in the coarse run",
        "study/margin.c",
        "if (a->outcome != b->outcome || ",
        "if (",
    ),
    Fault(
        "margin: other numbers of blows in the coarse run",
        "study/judge.c",
        "if (!alike && !(",
        "if (0 && !(",
    ),
    Fault(
        "margin: passes are always at the same instant",
        "study/margin.c",
        "if (!(margin < x.margin) || are_other_instants(a, i, b, j)) return x;",
        "(void)are_other_instants;\n    if (!(margin < x.margin)) return x;",
    ),
    Fault(
        "margin: a gap beside touching is compared as it is",
        "study/margin.c",
        "if (x->touching == 0 || y->touching == 0) return plain;",
        "if (x->touching >= 0) return plain;",
    ),
    Fault(
        "margin: where the other pass ended is not told",
        "study/margin.c",
        "else if (e->other->status != PM_OK)",
        "else if (0)",
    ),
    Fault(
        "margin: undecided is not told",
        "study/margin.c",
        "p->status = PM_UNDECIDED;",
        "",
    ),
    Fault(
        "error: what two runs tell alike by chance is believed",
        "study/judge.c",
        "PM_ACCURACY_OF_MOTION * e->late",
        "0 * e->late",
    ),
    Fault(
        "error: zero is known exactly, whatever cancels in it",
        "study/judge.c",
        "PM_ACCURACY_OF_TERMS * e->size.terms[ask]",
        "0 * e->size.terms[ask]",
    ),
    Fault(
        "find: a change of sign between samples is not seen",
        "study/find.c",
        "if (value * last < 0) status = close_bracket",
        "if (value * last < -1e300) status = close_bracket",
    ),
    Fault(
        "find: signs of loose samples are taken as they are",
        "study/find_sample.c",
        "return f->nzero > 0 ? confirm(w) : PM_OK;",
        "return f->nzero > 0 && f->samples < 0 ? confirm(w) : PM_OK;",
    ),
    Fault(
        "find: two roots between samples are not looked for",
        "study/find.c",
        "if (!status && i > 1 && value * last > 0",
        "if (!status && i > 1 && value * last > 1e300",
    ),
    Fault(
        "find: the ends of the bounds do not count",
        "study/find.c",
        "const int left = i == 0 || !is_feasible(p - 1)",
        "const int left = i > 0 && !is_feasible(p - 1)",
    ),
    Fault(
        "find: differences without Richardson's correction",
        "study/find_extremum.c",
        "for (int k = 1; k <= i; k++) {",
        "error = i == 0 ? *value = table[0][0], INFINITY : error; for (int k = 1; k <= 0; k++) {",
    ),
    Fault(
        "find: the least is taken for the greatest",
        "study/find_look.c",
        "(f->goal == PM_FIND_GREATEST ? 1 : -1) * pm_program_run",
        "(f->goal == PM_FIND_GREATEST ? 1 : 1) * pm_program_run",
    ),
    Fault(
        "find: the other value is given for the second parameter",
        "study/find_pair.c",
        "x[k] = f->low[k] + part * (f->high[k] - f->low[k]);\n    }\n    if (!c->status)",
        "x[k] = f->low[0] + part * (f->high[k] - f->low[k]);\n    }\n    if (!c->status)",
    ),
    Fault(
        "find: a pole is taken for a root",
        "study/find_root.c",
        "PM_ROOT_JUMP * fabs(fb - fa)",
        "1e300 * fabs(fb - fa)",
    ),
    Fault(
        "find: the outcome is bisected to the wrong side",
        "study/find_root.c",
        "if (look.holds) { *yes = look; } else {",
        "if (!look.holds) { *yes = look; } else {",
    ),
    Fault(
        "find: answers are not looked at on both sides",
        "study/find_sides.c",
        "for (int k = 0; k < f->nvary && !status; k++)",
        "for (int k = 0; k < 0; k++)",
    ),
    Fault(
        "find: the side that is answered is left to rounding",
        "study/find_sides.c",
        "asks_differ(w, HERE, near) > 0 ? move",
        "asks_differ(w, HERE, near) < 0 ? move",
    ),
    Fault(
        "margin: rates by time and by the path are one",
        "study/margin.c",
        "x->in_time != y->in_time",
        "x->in_time > 2",
    ),
    Fault(
        "errors: what two runs tell alike by chance is believed",
        "study/judge.c",
        "fmax(fmax(own, beside_others(w, share, ask, k, own)), late)",
        "fmax(own, late)",
    ),
    Fault(
        "margin: passes part where their histories first differ",
        "study/margin.c",
        "closest.parted = time_before(a, i);",
        "closest.parted = x->t;",
    ),
]
