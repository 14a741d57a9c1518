/* crossing_course.h - a function of the phase along the last step: its samples, and how far they tell it. */
#ifndef PM_CROSSING_COURSE_H
#define PM_CROSSING_COURSE_H

#include "event.h"

typedef struct pm_course {
    double g[PM_NODES_MOST];   /* values at the nodes */
    double biggest, low, high; /* of their sizes; of them */
    int n;
} pm_course;

/* The route leaves its zeros to the samples, and the step may reach it. */
static inline int pm_crossing_is_sampled(const pm_workspace *w, const pm_event_function *f)
{
    return !f->owned && !(f->kind == FUNCTION_GAP && w->event->clear.quiet[f->index]);
}

/* Value of a function (pm_event_function) at x, on the dense output; not a number where the route cannot look. */
double pm_crossing_along(pm_workspace *w, double x, void *function);

void pm_crossing_take(const pm_workspace *w, int i, pm_course *x);
/* How far the samples x of function i do not tell it, of their sizes; INFINITY between equidistant nodes. */
double pm_crossing_tail(const pm_workspace *w, int i, const pm_course *x);
/* Whether they tell it between the nodes, too. */
int pm_crossing_is_told(const pm_workspace *w, int i, const pm_course *x);
/* The same, and nothing need be taken: of function i. */
int pm_crossing_resolves(const pm_workspace *w, int i);
/* How far a function of known tail may be from the polynomial through samples of that size. */
double pm_crossing_untold(const pm_event_function *f, double biggest);

#endif
