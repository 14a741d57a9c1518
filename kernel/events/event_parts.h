/* event_parts.h - what the files share that search a step for events: samples, brackets, locations. */
#ifndef PM_EVENT_PARTS_H
#define PM_EVENT_PARTS_H

#include "events/event_search.h"

/* ---- event_samples.c: a function of the phase along the last step, and how far its samples show it ---- */
typedef struct pm_event_course {
    const double *g;           /* [n] values at the nodes: the samples, or `own` */
    double biggest, low, high; /* of their sizes; of them */
    int bounded; /* something is known that bounds it (event_bound.h); set in event_bracket.c alone */
    int n;
    double own[PM_NODES_MOST]; /* values that are not the samples */
} pm_event_course;

/* The route leaves its zeros to the samples, and the step may reach it. */
static inline int pm_event_samples_wanted(const struct pm_event_set *event, const pm_event_function *f)
{
    return !f->owned && !(f->kind == FUNCTION_GAP && event->culling.skipped[f->index]);
}

/* Value of a function (pm_event_function) of the workspace at x, on the dense output; NaN where the route cannot look. */
double pm_event_samples_along(void *workspace, double x, void *function);
void pm_event_samples_take(const pm_step *step, struct pm_event_set *event, int i, pm_event_course *x);
/* Makes the value at a node another one, in the course alone. */
void pm_event_course_set(pm_event_course *x, int node, double value);
/* How far the samples x of function i do not show it, of their sizes; INFINITY between equidistant nodes. */
double pm_event_samples_tail(const pm_step *step, struct pm_event_set *event, int i,
                             const pm_event_course *x);
/* Whether they show it between the nodes, too. */
int pm_event_samples_resolved(const pm_step *step, struct pm_event_set *event, int i,
                              const pm_event_course *x);
/* How far a function of known tail may be from the polynomial through samples of that size. */
double pm_event_samples_residual(const pm_event_function *f, double biggest);
/* The gap to the nearest member of a pattern has corners, that to one member has none: from now on the samples of
 * function i are those of the member that is met at x.  Whether it is the nearest at the root is seen there. */
void pm_event_samples_of_member(pm_workspace *w, int i, double x);

/* ---- event_bracket.c: between which places of a step a function goes through zero ---- */
/* The first bracket of function i in the step, which has been sampled, after `from`; 0 if there is none. */
int pm_event_bracket_first(pm_workspace *w, int i, double from, pm_span *x);
/* The first zero within x: by bounds, where there are any, else if the values at its ends show one. */
int pm_event_bracket_within(pm_workspace *w, int i, const pm_event_course *of, pm_span *x);

/* ---- event_sides.c: on which side of zero a function is that may have either sign ---- */
/* Function i from `from` on, in the whole step or the rest of it: on its zero it is held, and comes from its side. */
void pm_event_sides_enter(pm_workspace *w, int i, double from, int whole, pm_event_course *of);
/* On zero at x->a, and looked for until x->b: 1, and the bracket of its next zero. */
int pm_event_sides_leaves(pm_workspace *w, int i, const pm_event_course *of, pm_span *x);
/* Its last value in the step, not after `place`, that has a sign; or its side before; 0: not known. */
double pm_event_sides_last(const pm_step *step, struct pm_event_set *e, int i, double place);
/* The side on which it ends the step is kept. */
void pm_event_sides_leave(const pm_step *step, struct pm_event_set *e, int i);

/* ---- event_locate.c: where in its bracket it is zero ---- */
/* The root of function i in the bracket x, on the dense output; the samples may become those of one member of a pattern. */
int pm_event_locate_root(pm_workspace *w, int i, const pm_span *x, double *place);
/* That root is taken: its rate is noted as a decision, and *place moves onto the zero of the exact states; *taken is where
 * w->probe holds one.  Neither is touched where the step ends exactly there. */
int pm_event_locate_settle(pm_workspace *w, int i, const pm_span *x, double *place, double *taken);

#endif
