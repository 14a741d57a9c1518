/* event_samples.c - the samples of one function of a phase, as the polynomial p through the nodes of a step.
 *
 * At the nodes of a spectral route (chebyshev_nodes.h) the highest Chebyshev coefficients of p over its greatest value, the tail, are
 * about the relative error of p (chebyshev.c).  A corner - the nearest of several members changes - leaves them large.
 * Equidistant nodes tell nothing between them. */
#include "events/event_samples.h"

#include <math.h>

#include "events/step.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "state/route.h"
#include "state/workspace.h"

#define RESOLVED 1e-6 /* tail of a function that its samples tell */
#define UNTOLD 10.0   /* times the tail: how far it may be from the polynomial */

double pm_event_samples_along(pm_workspace *w, double x, void *function)
{
    const pm_event_function *f = function;
    if (pm_step_look(w, x, f->level)) return NAN;
    return pm_event_value(w, f);
}

void pm_event_samples_take(const pm_workspace *w, int i, pm_event_course *x)
{
    const pm_event_function *f = &w->event->function[i];
    const double *value = pm_event_samples(w, i);
    x->n = w->step.nodes->n;
    x->low = INFINITY;
    x->high = -INFINITY;
    for (int k = 0; k < x->n; k++) {
        x->g[k] = pm_event_of_sample(f, value[k]);
        x->low = pm_min(x->g[k], x->low);
        x->high = pm_max(x->g[k], x->high);
    }
    x->biggest = pm_max(x->high, -x->low);
}

double pm_event_samples_tail(const pm_workspace *w, int i, const pm_event_course *x)
{
    pm_event_function *f = &w->event->function[i];
    if (!pm_chebyshev_nodes_spectral(w->step.nodes)) return INFINITY;
    if (f->tail < 0) {
        f->tail = pm_chebyshev_tail(w->step.nodes, x->g);
        f->biggest = x->biggest;
    }
    return f->tail;
}

int pm_event_samples_resolved(const pm_workspace *w, int i, const pm_event_course *x)
{
    return pm_event_samples_tail(w, i, x) < RESOLVED;
}

int pm_event_samples_resolve(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    pm_event_course x;
    if (f->tail >= 0) return f->tail < RESOLVED;
    if (!pm_chebyshev_nodes_spectral(w->step.nodes)) return 0;
    pm_event_samples_take(w, i, &x);
    return pm_event_samples_resolved(w, i, &x);
}

double pm_event_samples_residual(const pm_event_function *f, double biggest)
{
    return UNTOLD * f->tail * biggest;
}
