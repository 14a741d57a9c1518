/* route.h - the one interface of all ways to compute a phase.
 *
 * A phase is smooth motion with the fixed active constraints of the workspace (active_set.h).  The event loop calls
 *   applies whether the phase that starts at w->state may be of its kind, by structure and modes; NULL: always
 *   forget  a new run begins: nothing of the last one is kept; NULL: nothing ever is
 *   prepare looks at that phase: 1 if the route can compute it, and is ready to begin it; NULL: it can
 *   begin   the phase starts at w->state: consistent with the constraints, the frame looks at it
 *   step    one accepted step from w->state towards the time t_limit, never beyond it: afterwards w->state is at
 *           w->step_end, projected on the constraints; w->step_begin is where the step began; w->step.reverses: the motion
 *           reverses there
 *   at      a state inside the last step (slightly outside is allowed), from the route's dense output: t, q, v, z;
 *           memory and slots are those of w->state
 * Places in a step are given by the route's progress coordinate x: the time, or the way along the path.
 *   exact   the same to the accuracy of the trajectory, projected, with memory and slots of w->state in it; used where
 *           an event or an extremum is taken
 *   look    the frame looks at a state inside the last step, DYNAMIC if the level says so; NULL: by `at` and `react`
 *   react   accelerations and reactions at such a state, which the frame looks at; NULL: by the saddle point
 *   sampled all that is watched has been sampled at the nodes of a step; NULL: nobody wants to know
 *   error_of  notes the error of out[column], the value of the program at the frame, where the route knows its own errors
 *           (pm_evidence_answer); NULL: never
 *   beside  the frame, which looks at an instant, looks at a state of the motion beside it, DYNAMIC if the level says so; what a
 *           function changes by until there, times the result, is what the time makes of its error at the instant; on_time: of a
 *           function of the time alone; 0, and the frame stays: nothing, or the route does not tell; NULL: never
 *   back    after any other result: the frame looks at the instant again
 *   resolves  1 if positions of the route resolve any bounce of the contact that has just closed; NULL: never
 * All return a status.  Events are found in the samples of a step (events/event_search.h).  A route that knows in closed
 * form where contacts close ends its step at the first and marks it in w->event->root, which advance.c clears before the
 * step. */
#ifndef PM_ROUTE_H
#define PM_ROUTE_H

#include "numerics/chebyshev_nodes.h"
#include "state/workspace.h"

/* What becomes of a phase whose route can make no further step. */
enum pm_when_lost {
    PM_LOST_FAILS = 0,
    PM_LOST_TO_NEXT_RULE = 1, /* where no route is forced, the plan goes on without this one */
    PM_LOST_TO_PASSAGE = 2    /* near a singular position the plan knows a passage (phase.singular) */
};

typedef struct pm_route_ops {
    int route;                      /* enum pm_route */
    int (*create)(pm_workspace *w); /* its memory, which the workspace owns */
    int (*applies)(const pm_workspace *w);
    void (*forget)(pm_workspace *w);
    int (*prepare)(pm_workspace *w);
    int (*begin)(pm_workspace *w);
    int (*step)(pm_workspace *w, double t_limit);
    int (*at)(pm_workspace *w, double t, pm_state *s);
    int (*exact)(pm_workspace *w, double t, pm_state *s);
    int (*look)(pm_workspace *w, double t, int level);
    int (*react)(pm_workspace *w);
    void (*sampled)(pm_workspace *w);
    void (*error_of)(pm_workspace *w, int ask, int column, int program, double value);
    double (*beside)(pm_workspace *w, int level, int on_time);
    void (*back)(pm_workspace *w);
    int (*resolves)(const pm_workspace *w, int contact);
    int (*accelerate)(
        pm_workspace *w); /* at the frame, where the constraints are singular; 0: it cannot; NULL: never */
    double finest;        /* tolerance below which it does not get better */
    double spread;        /* how far its errors scatter about what goes with the tolerance, as a factor */
    double
        steps_by_tolerance; /* their number goes with its reciprocal to this power; 0: errors of another kind */
    int locates_contacts; /* it ends its steps where functions of contacts are zero; the others are sampled */
    int sees_ends;        /* a step sees what drives it at its end alone, not in between */
    int in_time;          /* its progress coordinate is the time */
    int meets_places;     /* it meets every place of a step exactly, to rounding */
    int on_tree;          /* its unknowns are the coordinates of the tree (tree/tree.h) */
    int reuses_segments; /* a segment of its motion that has been before is taken over (routes/path/repeat.h) */
    int when_lost;       /* enum pm_when_lost */
    int price;           /* routes in order of their cost */
    const pm_chebyshev_nodes *nodes; /* where its steps are sampled, unless a step says otherwise */
} pm_route_ops;

/* 1 if the route computes the phase that starts at w->state: then it is ready to begin it. */
static inline int pm_route_prepare(pm_workspace *w, const pm_route_ops *route)
{
    return (!route->applies || route->applies(w)) && (!route->prepare || route->prepare(w));
}

extern const pm_route_ops pm_route_rk, pm_route_ida, pm_route_uniform, pm_route_path;

/* Creates what all routes need. */
int pm_routes_create(pm_workspace *w);
/* Those of them that were created forget the last run. */
void pm_routes_forget(pm_workspace *w);
/* The route of a number of enum pm_route; NULL if there is none. */
const pm_route_ops *pm_routes_find(int route);
/* The one that the settings ask for; rk where phases choose, and before anything moves (`state`, `jump`). */
const pm_route_ops *pm_routes_default(const pm_model *m);

#endif
