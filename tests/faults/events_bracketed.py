"""Faults planted in `kernel/events/`: between which places of a step a function goes through zero."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "gap: the bottom of what grazes is told by a polynomial",
        "events/event_bracket.c",
        "return f->kind == FUNCTION_GAP && !pm_event_samples_resolve(",
        "return 0 && !pm_event_samples_resolve(",
    ),
    Fault(
        "a passage near the end of an edge is not looked for",
        "events/event_bracket.c",
        "if (f->edge != PM_NONE && of->g[k] > 0",
        "if (0 && of->g[k] > 0",
    ),
    Fault(
        "crossing: what is near is far",
        "events/event_bracket.c",
        "least > PM_DIP_FAR * x->biggest;",
        "least > 0;",
    ),
    Fault("margin: near misses", "events/event_bracket.c", "if (least > 0 && least < f->near &&", "if (0 &&"),
    Fault("missed root: two in one step", "events/event_bracket.c", "return least <= 0", "return 0"),
    Fault(
        "missed root: a dip beside the end of a step",
        "events/event_bracket.c",
        "if (near && returns(w,",
        "if (0 && returns(w,",
    ),
    Fault(
        "missed root: dips do not show at nodes",
        "events/event_bracket.c",
        "return b < a ? k + 2",
        "if (b >= 0) return 0; return b < a ? k + 2",
    ),
    Fault(
        "missed root: a step ends before it, the next begins behind it",
        "events/event_bracket.c",
        "if (!f->held && apart && k < of->n)",
        "if (0 && apart && k < of->n)",
    ),
    Fault(
        "missed root: a phase ends on it, the next leaves it on the other side",
        "events/event_bracket.c",
        "|| (since_began && pm_event_way_crosses(f, f->left, g))",
        "",
    ),
    Fault(
        "missed root: leaves its zero on the other side",
        "events/event_bracket.c",
        "resolved ? pm_chebyshev_value(",
        "resolved ? -pm_chebyshev_value(",
    ),
    Fault(
        "missed root: leaves a held zero the wrong way and comes back",
        "events/event_bracket.c",
        "!(of->g[k] < 0) && !dips_at_once(w, f, of, k, x) &&",
        "!(of->g[k] < 0) &&",
    ),
    Fault(
        "a slip that is next to nothing ends where it began, again and again",
        "events/event_bracket.c",
        "if (f->kind == FUNCTION_SLIP) leaves_later(w, f, a, end, x);",
        "",
    ),
    Fault(
        "missed root: comes back to a held zero at once",
        "events/event_bracket.c",
        "return now || first_within(w, i, of, x)",
        "return now",
    ),
    Fault(
        "event: the wrong way",
        "events/event.h",
        "f->direction <= 0 && a > 0 && b <= 0",
        "f->direction >= 0 && a > 0 && b <= 0",
    ),
    Fault(
        "event: what has rested on zero leaves it unseen",
        "events/event_bracket.c",
        "isfinite(f->rested) && g * f->direction > 0",
        "isfinite(f->rested) && g * f->direction < 0",
    ),
    Fault(
        "dip: coming back does not count",
        "events/event_bracket.c",
        "*x = pm_event_way_may_cross(f, g[k]) ?",
        "*x = pm_event_way_may_cross(f, g[k]) || 1 ?",
    ),
    Fault(
        "meeting: between two nodes points are nearest once",
        "events/event_bound.c",
        "return f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND",
        "return f->kind == FUNCTION_STRAND",
    ),
    Fault(
        "meeting: few nodes tell how often points are nearest",
        "events/event_samples.c",
        "const int meets = functions && may_meet(&w->step, w->event);",
        "const int meets = 0;",
    ),
    Fault(
        "meeting: points that do not meet on exact states end the phase",
        "events/event_search.c",
        "return !*status && !pm_capture_meets(",
        "return 0 && !pm_capture_meets(",
    ),
    Fault(
        "bound: a part is left where its first zero is not alone",
        "events/event_bound.c",
        "k < (known ? 3 : 1)",
        "k < 3",
    ),
    Fault(
        "bound: what both ends show is the first zero",
        "events/event_bracket.c",
        "return (of->bounded && (shown || may_reach(of, x)) &&",
        "return (of->bounded && (!shown && may_reach(of, x)) &&",
    ),
    Fault(
        "bound: zeros in a dip of three nodes are one",
        "events/event_bracket.c",
        "of->biggest, pm_event_samples_along, x)) return 1;",
        "of->biggest, pm_event_samples_along, x) * 0) return 1;",
    ),
    Fault(
        "bound: three nodes tell that no zero is near",
        "events/event_bracket.c",
        "return x->n >= PM_NODES &&",
        "return",
    ),
    Fault(
        "search: what is on one side of zero is far from it",
        "events/event_bracket.c",
        "return PM_DIP_FAR * pm_max(of->biggest,",
        "return 0 * pm_max(of->biggest,",
    ),
    Fault(
        "bound: three nodes tell that no dip is deeper",
        "events/event_bracket.c",
        "return of->n < PM_NODES ||",
        "return",
    ),
]
