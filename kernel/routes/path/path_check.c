/* path_check.c - what the route does not use, against what it does: evidence for the audit.
 *
 *   open work       V1 - V2 + work of forces without potential   against   the integral of the generalised force by u
 *   broken constraint      G t                                          against   0,  t the direction of the motion
 *   missed force    f . t of the frame                           against   dT/du */
#include <float.h>
#include <math.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "equations/saddle.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"

/* The work of all forces against the energy. */
static double open_work(const pm_workspace *w)
{
    const pm_path *p = w->path;
    const double first = p->node[0].potential, last = p->node[PM_NODES_MOST - 1].potential;
    double scale = w->ledger.energy_scale, z = 0; /* the step may begin and end at rest */
    for (int k = 0; k < p->nodes->n; k++) scale = pm_max(p->node[k * p->every].kinetic, scale);
    if (!(scale > 0) || pm_chebyshev_tail(p->nodes, p->force) >= PM_WORK_TAIL) return 0;
    const double work = p->h * pm_chebyshev_whole(p->nodes, p->force);
    if (w->model->nz_work > 0) z = pm_path_work(w->model, w->state.z) - pm_path_work(w->model, p->weight);
    const double rounding = PM_PATH_CHECK_ROUNDINGS * DBL_EPSILON * pm_max(fabs(first), fabs(last));
    return pm_max(fabs(first - last + z - work) - rounding, 0) / scale;
}

/* The direction of the motion at the end against the constraints, which were evaluated there and which the tree knows
 * nothing of: the greatest part of it that breaks one. */
static double worst_broken(const pm_workspace *w)
{
    const double *t = w->path->node[PM_NODES_MOST - 1].tangent;
    double fastest = 0, worst = 0;
    for (int i = 0; i < w->model->nq; i++)
        fastest = pm_max(fabs(t[i]) * (i % 3 == 2 ? w->numbers.size : 1), fastest);
    for (int i = 0; i < w->active.n; i++) {
        const double *j = w->active.constraint[i].j,
                     off = fabs(pm_constraint_times(&w->frame, &w->active.constraint[i], t));
        double size = 0;
        for (int k = 0; k < 6; k++) size += fabs(j[k]) / (k % 3 == 2 ? w->numbers.size : 1);
        worst = pm_max(off / (size * fastest), worst);
    }
    return worst;
}

/* What the forces of the frame do along it, against dT/du. */
static double missed_force(const pm_frame *frame, const pm_path *path)
{
    const pm_place *last = &path->node[PM_NODES_MOST - 1];
    const double size = pm_path_force_size(frame, last);
    double force = 0;
    for (int i = 0; i < frame->model->nq; i++) force += frame->f[i] * last->tangent[i];
    return size > 0 ? fabs(force - last->force) / size : 0;
}

void pm_path_check(pm_workspace *w)
{
    pm_force_all(w);
    pm_saddle_evaluate(&w->active, &w->frame);
    w->ledger.evidence = pm_max(open_work(w), w->ledger.evidence);
    w->ledger.evidence = pm_max(worst_broken(w), w->ledger.evidence);
    w->ledger.evidence = pm_max(missed_force(&w->frame, w->path), w->ledger.evidence);
}
