/* crossing_course.c - the samples of one function of a phase, as the polynomial p through the nodes of a step.
 *
 * At the nodes of a spectral route (nodes.h) the highest Chebyshev coefficients of p over its greatest value, the tail, are
 * about the relative error of p (series.c).  A corner - the nearest of several members changes - leaves them large.
 * Equidistant nodes tell nothing between them. */
#include "crossing_course.h"

#include <math.h>

#include "greater.h"
#include "route.h"
#include "series.h"

#define RESOLVED 1e-6 /* tail of a function that its samples tell */
#define UNTOLD 10.0   /* times the tail: how far it may be from the polynomial */

double pm_crossing_along(pm_workspace *w, double x, void *function)
{
    const pm_event_function *f = function;
    if (pm_route_look(w, x, f->level)) return NAN;
    return pm_event_value(w, f);
}

void pm_crossing_take(const pm_workspace *w, int i, pm_course *x)
{
    const pm_event_function *f = &w->event->function[i];
    const double *value = pm_event_samples(w, i);
    x->n = w->nodes->n;
    x->low = INFINITY;
    x->high = -INFINITY;
    for (int k = 0; k < x->n; k++) {
        x->g[k] = pm_event_of_sample(f, value[k]);
        x->low = pm_less(x->g[k], x->low);
        x->high = pm_greater(x->g[k], x->high);
    }
    x->biggest = pm_greater(x->high, -x->low);
}

double pm_crossing_tail(const pm_workspace *w, int i, const pm_course *x)
{
    pm_event_function *f = &w->event->function[i];
    if (!pm_nodes_spectral(w->nodes)) return INFINITY;
    if (f->tail < 0) {
        f->tail = pm_series_tail(w->nodes, x->g);
        f->biggest = x->biggest;
    }
    return f->tail;
}

int pm_crossing_is_told(const pm_workspace *w, int i, const pm_course *x)
{
    return pm_crossing_tail(w, i, x) < RESOLVED;
}

int pm_crossing_resolves(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    pm_course x;
    if (f->tail >= 0) return f->tail < RESOLVED;
    if (!pm_nodes_spectral(w->nodes)) return 0;
    pm_crossing_take(w, i, &x);
    return pm_crossing_is_told(w, i, &x);
}

double pm_crossing_untold(const pm_event_function *f, double biggest) { return UNTOLD * f->tail * biggest; }
