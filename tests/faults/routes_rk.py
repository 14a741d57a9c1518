"""Faults planted in `kernel/routes/rk/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "rk: the first step of a case that begins on another route is that of the case before",
        "routes/rk/route_rk.c",
        "    w->rk->next = 0;\n    w->rk->level",
        "    w->rk->level",
    ),
    Fault(
        "rk: what became of the energy in the case before is taken over",
        "routes/rk/route_rk.c",
        "    w->rk->level.returned = 0;\n",
        "",
    ),
    Fault(
        "rk: coordinates that are dependent where a step begins",
        "routes/rk/route_rk.c",
        "if (status != PM_SINGULAR) return status;\n    pm_tree_partition",
        "if (status) return status;\n    pm_tree_partition",
    ),
    Fault(
        "rk: stages that cancel are rounded",
        "routes/rk/rk_formula.c",
        "(pm_lanes_load(x + 2) - b)",
        "(pm_lanes_load(x + 2) - 1.0000000000001 * b)",
    ),
    Fault(
        "rk: what a weak pulse beside a strong one adds to a step is not seen",
        "routes/rk/rk_error.c",
        "error <= 1 ? fmax(pm_rk_time_error(w, h), error) : error",
        "error",
    ),
    Fault(
        "rk: rounding of the time makes steps short",
        "routes/rk/rk_time.c",
        "fmax(fabs(sum) - rounding, 0)",
        "fabs(sum)",
    ),
    Fault(
        "rk: a motion from rest is measured by the speed where the step begins",
        "routes/rk/rk_error.c",
        "if (!(at_end > PM_RK_FROM_REST * speed)) return error;",
        "return error;",
    ),
    Fault(
        "rk: stiffness is not seen",
        "routes/rk/rk_stiff.c",
        "stretch(w) > PM_RK_STABLE",
        "stretch(w) > 1e9 * PM_RK_STABLE",
    ),
    Fault(
        "rk: a digit of the dense output", "routes/rk/dop853.h", "18.148505520854727", "18.148515520854727"
    ),
    Fault(
        "rk: a digit of the step",
        "routes/rk/dop853.h",
        "0.04471061572777259};",
        "0.04471071572777259};",
    ),
    Fault(
        "rk: a sign of the dense output",
        "routes/rk/rk_formula.c",
        "2 * change - (f0 + f1)",
        "2 * change - (f0 - f1)",
    ),
    Fault(
        "rk: a step is accepted where the first estimator of its error passes through zero",
        "routes/rk/rk_formula.c",
        "(of_5 + PM_RK_BESIDE * beside) / (1 + PM_RK_BESIDE)",
        "of_5",
    ),
    Fault(
        "rk: rounding of the time is taken for an error of the stages",
        "routes/rk/rk_error.c",
        "error > 1 ? pm_rk_time_rounding(w, h) : 0",
        "0",
    ),
    Fault(
        "rk: a phase begins with a step that has no length",
        "routes/rk/route_rk.c",
        "fmin(fmax(r->next, 2 * PM_RK_LEAST_STEP * fabs(r->t0)), longest_step(w))",
        "fmin(r->next, longest_step(w))",
    ),
    Fault(
        "rk: no control of the error",
        "routes/rk/rk_formula.c",
        "return e5 <= 0 ? 0 :",
        "return e5 > -1 ? 0 :",
    ),
    Fault(
        "rk: errors of the last coordinate",
        "routes/rk/rk_formula.c",
        "i < n; i += 2) {",
        "i + 2 < n; i += 2) {",
    ),
    Fault(
        "rk: loop rows keep the rates that the energy did not return",
        "routes/rk/rk_state.c",
        "gamma *= factor * factor",
        "gamma *= 1",
    ),
    Fault(
        "rk: impulses of a sampled step",
        "routes/rk/rk_state.c",
        "if (!w->rk->ledger) pm_ledger_follow",
        "pm_ledger_follow",
    ),
    Fault(
        "rk: stages near a singular position only shorten the step",
        "routes/rk/route_rk.c",
        "t->part.least_regular < PM_RK_NEAR_SINGULAR * t->part.most_regular",
        "t->part.least_regular < 0",
    ),
    Fault(
        "rk: steps outrun the reactions",
        "routes/rk/route_rk.c",
        "return w->active.n > 0 ? w->rk->rotation_time : INFINITY;",
        "return INFINITY;",
    ),
    Fault(
        "rk: windows of a step change what the next one integrates",
        "routes/rk/route_rk.c",
        "r->ledger = r->next_ledger;",
        "r->ledger = samples_ledger(&w->result, w->rk);",
    ),
    Fault(
        "coarse run: takes the single step of the main one",
        "routes/rk/route_rk.c",
        "if (w->numbers.coarse > 1) h = coarse_step",
        "if (0) h = coarse_step",
    ),
    Fault(
        "coarse run: takes a step of the main one to where that ended within a longer one",
        "routes/rk/rk_state.c",
        "if (!pm_evidence_is_coarse(&w->evidence)) note_place(r, t);",
        "",
    ),
    Fault(
        "coarse run: takes the few steps of the main one",
        "routes/rk/route_rk.c",
        "if (pm_evidence_is_fine(&w->evidence)) h =",
        "if (0) h =",
    ),
    Fault(
        "rk: a step from rest goes as far as its formula is exact",
        "routes/rk/rk_error.c",
        "return error <= 1 ? fmax(way_over_allowed(w), error) : error;",
        "return error;",
    ),
    Fault(
        "rk: reactions may turn as far as they like in a step from rest",
        "routes/rk/rk_error.c",
        "turned > 1 ? eighth_power(turned) / loose : 0",
        "turned > 1e9",
    ),
    Fault(
        "rk: rounding of places far away makes steps short",
        "routes/rk/rk_error.c",
        "return PM_RK_PLACE_ROUNDED * most;",
        "return 0 * most;",
    ),
]
