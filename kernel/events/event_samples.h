/* event_samples.h - a function of the phase along the last step: its samples, and how far they tell it. */
#ifndef PM_EVENT_SAMPLES_H
#define PM_EVENT_SAMPLES_H

#include "events/event.h"

typedef struct pm_event_course {
    double g[PM_NODES_MOST];   /* values at the nodes */
    double biggest, low, high; /* of their sizes; of them */
    int n;
} pm_event_course;

/* The route leaves its zeros to the samples, and the step may reach it. */
static inline int pm_event_samples_wanted(const pm_workspace *w, const pm_event_function *f)
{
    return !f->owned && !(f->kind == FUNCTION_GAP && w->event->culling.quiet[f->index]);
}

/* Value of a function (pm_event_function) at x, on the dense output; not a number where the route cannot look. */
double pm_event_samples_along(pm_workspace *w, double x, void *function);

void pm_event_samples_take(const pm_workspace *w, int i, pm_event_course *x);
/* How far the samples x of function i do not tell it, of their sizes; INFINITY between equidistant nodes. */
double pm_event_samples_tail(const pm_workspace *w, int i, const pm_event_course *x);
/* Whether they tell it between the nodes, too. */
int pm_event_samples_resolved(const pm_workspace *w, int i, const pm_event_course *x);
/* The same, and nothing need be taken: of function i. */
int pm_event_samples_resolve(const pm_workspace *w, int i);
/* How far a function of known tail may be from the polynomial through samples of that size. */
double pm_event_samples_residual(const pm_event_function *f, double biggest);

#endif
