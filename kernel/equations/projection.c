/* projection.c - Newton on g(q) = 0 with dq = -M^-1 G^T (G M^-1 G^T)^-1 g, then the same once for G v = w, the prescribed
 * rates (0 of all constraints that are not driven). */
#include "equations/projection.h"

#include <math.h>

#include "elements/constraint.h"
#include "equations/saddle.h"
#include "equations/solve_cache.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* x += M^-1 G^T l, with S l = rhs.  Projection always works on G: the friction that rides on a normal force is no constraint. */
static int move_symmetric(pm_workspace *w, double *x)
{
    const int asymmetric = w->active.asymmetric;
    w->active.asymmetric = 0;
    const int status = pm_saddle_factor(w);
    if (!status) pm_saddle_move(&w->saddle, x);
    w->active.asymmetric = asymmetric;
    return status;
}

int pm_projection_velocity(pm_workspace *w, pm_state *s)
{
    const double worst =
        pm_constraint_slips(&w->frame, w->active.constraint, w->active.n, NULL, s->v, w->saddle.rhs);
    w->active.evaluated = worst <= PM_MET * w->numbers.speed;
    if (w->active.evaluated) return PM_OK;
    const int status = move_symmetric(w, s->v);
    if (status) return status;
    pm_frame_look_state(&w->frame, s);
    return PM_OK;
}

static int project(pm_workspace *w, pm_state *s, int evaluated)
{
    double before = INFINITY;
    if (w->active.n == 0) return PM_OK;
    for (int sweep = 0;; sweep++) {
        if ((sweep > 0 || !evaluated) && !pm_solve_cache_take_constraints(w))
            pm_saddle_evaluate(&w->active, &w->frame);
        const double worst = pm_constraint_openings(w->active.constraint, w->active.n, NULL, w->saddle.rhs);
        if (pm_projection_ends(&w->numbers, sweep, worst, before)) break;
        before = worst;
        const int status = move_symmetric(w, s->q);
        if (status) return status;
        pm_frame_look_state(&w->frame, s);
    }
    return pm_projection_velocity(w, s);
}

int pm_projection_apply(pm_workspace *w, pm_state *s)
{
    pm_frame_look_state(&w->frame, s);
    return project(w, s, 0);
}

int pm_projection_near(pm_workspace *w, pm_state *s)
{
    pm_frame_look_state(&w->frame, s);
    if (w->active.n == 0) return PM_OK;
    if (!pm_solve_cache_take_constraints(w)) pm_saddle_evaluate(&w->active, &w->frame);
    const double off = pm_constraint_openings(w->active.constraint, w->active.n, NULL, w->saddle.rhs);
    return off > PM_PROJECTION_NEAR * w->numbers.size ? PM_OK : project(w, s, 1);
}

int pm_projection_built(pm_workspace *w, pm_state *s) { return project(w, s, w->active.evaluated); }

double pm_projection_residual(const pm_frame *frame, const pm_active_set *active)
{
    double worst = 0;
    for (int i = 0; i < active->n; i++) {
        const pm_constraint *x = &active->constraint[i];
        const double slip = pm_constraint_times(frame, x, frame->v) - x->rate;
        worst = pm_max(fabs(slip) / frame->numbers->speed, pm_max(fabs(x->g) / frame->numbers->size, worst));
    }
    return worst;
}
