"""Faults planted in `kernel/routes/start/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "escape: axes that turn the other way",
        "routes/start/fastest_growth.c",
        "(e->dv[i] - rotated(e->spin",
        "(e->dv[i] + rotated(e->spin",
    ),
    Fault(
        "escape: steady at one time only",
        "routes/start/fastest_growth.c",
        "for (int i = 0; i < 3; i++) { const double t",
        "for (int i = 0; i < 1; i++) { const double t",
    ),
    Fault("nudge: to the other side", "routes/start/perturbation.c", "if (there < 0 &&", "if (there > 0 &&"),
    Fault(
        "nudge: by positions alone",
        "routes/start/perturbation.c",
        "s->v[i] += part * e->v[i]",
        "s->v[i] += 0 * part",
    ),
    Fault(
        "nudge: against the forces",
        "routes/start/perturbation.c",
        "pm_path_requested(w, w->frame.a) > 0",
        "pm_path_requested(w, w->frame.a) < 0",
    ),
    Fault(
        "nudge: a stable rest on a path",
        "routes/start/perturbation.c",
        "status || goes ? status : fail(&w->request, &w->result, PM_NUDGE_STABLE, 0)",
        "status",
    ),
    Fault(
        "nudge: bodies that hang together",
        "routes/start/perturbation.c",
        "more |= join(w->model, w->perturbation, w->active.constraint[i].body[p - 1], "
        "w->active.constraint[i].body[p])",
        "more |= 0",
    ),
    Fault(
        "equilibrium: against the forces",
        "routes/start/equilibrium_search.c",
        "x->step[k] -= along / x->value[i]",
        "x->step[k] += along / x->value[i]",
    ),
    Fault(
        "equilibrium: nothing sinks",
        "routes/start/equilibrium_search.c",
        "if (!sink(w, x, &met) && (met || !newton(w, x))) return PM_OK;",
        "if (!newton(w, x)) return PM_OK;",
    ),
    Fault(
        "equilibrium: what pulls stays closed",
        "routes/start/equilibrium.c",
        "if (!status && !changed) changed = open_pulling(w);",
        "",
    ),
    Fault(
        "equilibrium: bodies sink through what they meet",
        "routes/start/equilibrium.c",
        "if (!status) status = close_overlapping(w, &changed);",
        "",
    ),
    Fault(
        "equilibrium: overlaps stay",
        "routes/start/equilibrium_search.c",
        "if (!status) status = pm_projection_apply(w, &w->state); /* contacts that overlap */",
        "",
    ),
    Fault(
        "equilibrium: friction holds anything",
        "routes/start/equilibrium.c",
        "return status ? status : check_friction(w);",
        "return status;",
    ),
    Fault(
        "equilibrium: the start is where it was drawn",
        "routes/start/equilibrium.c",
        "    pm_state_copy(&w->start, &w->state);\n    return settled;",
        "    return settled;",
    ),
    Fault(
        "equilibrium: all are stable",
        "routes/start/equilibrium.c",
        "return m->growth > 0 ? PM_EQUILIBRIUM_UNSTABLE",
        "return m->growth > 1e99 ? PM_EQUILIBRIUM_UNSTABLE",
    ),
]
