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
        "more |= join(w->model, w->perturbation, w->active.constraint[i].body[0], "
        "w->active.constraint[i].body[1])",
        "more |= 0",
    ),
]
