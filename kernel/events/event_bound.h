/* event_bound.h - where a function first goes through zero between two samples, by bounds. */
#ifndef PM_EVENT_BOUND_H
#define PM_EVENT_BOUND_H

#include "events/event.h"

/* Something is known of function i in the step, which has been sampled, that bounds it. */
int pm_event_bound_is_known(const pm_workspace *w, int i);
/* A value of such a function at x is no rounding, however small it is beside others: what its law makes of that at one place. */
int pm_event_bound_tells(const pm_workspace *w, int i, double x, double value);
/* Its rate at x by its law, in time; not a number where none is known. */
double pm_event_bound_slope(const pm_workspace *w, int i, double x);
/* The first zero of such a function, of those that count, in the part x of the step: x narrows to a bracket of that zero alone; 0:
 * there is none.  g: its samples; x->a, x->b are beyond zero. */
int pm_event_bound_first(pm_workspace *w, int i, const double *g, pm_event_at *value_at, pm_span *x);

#endif
