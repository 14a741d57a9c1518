/* repeat.h - segments of a path that repeat the one before - the next member of a pattern, the next lap, the next swing - are
 * not computed again. */
#ifndef PM_REPEAT_H
#define PM_REPEAT_H

#include "scene/symmetry.h"
#include "state/workspace.h"

/* Memory of the last segment; PM_NO_MEMORY. */
int pm_repeat_create(pm_workspace *w);

/* A new case, or a phase on another route: nothing is known. */
void pm_repeat_forget(struct pm_repeat *repeat);
/* A path phase begins at w->state (the frame looks at it, the constraints are built).  If it repeats the last segment, the next
 * ones are passed over that are sure to go like it and that nobody asks about; *passed = 1: w->state is the begin of the one
 * after them, and the constraints are built for it.  Statuses of the route and of the constraints. */
int pm_repeat_begin(pm_workspace *w, int *passed);
/* The segment ends at w->state, where the frame looks, before the blows of the instant. */
void pm_repeat_end(pm_workspace *w);

/* ---- for the files that pass over segments of a path which repeat the one before ---- */

/* The last segment, which was computed, and what leads from one to the next. */
typedef struct pm_repeat {
    int known;      /* `begin` is the begin of the last segment */
    pm_state begin; /* of it */
    double late, unresolved,
        clock; /* s, of the path's clock there: what rounding has left out, what its nodes leave out, its error */
    double kinetic;    /* J, T there */
    double before;     /* J, T at its end, before the blow */
    double lowest;     /* J, least T on it */
    double end;        /* place in the step at which it ended */
    int64_t steps;     /* of which it consisted */
    int ends_by_force; /* what ended it goes with T, as forces of contacts do */
    int64_t count[PM_COUNT_COLUMNS];
    int64_t *event_count; /* [nevent] both at its begin */
    int *side;            /* [ntrigger] 1, -1: sign of a trigger all along it; 0: it had both */
    double unsure;      /* J, T of the nearest segment of this series that is not sure; NAN: none is known */
    double by[2];       /* m, the shift to the next one */
    double *rotation;   /* [nbody] rad, how far each body has rotated */
    int member;         /* so many members on in a pattern */
    double work, ratio; /* J, W and m of repeat_energy.c */
    int steady;         /* T and the places are the same from one to the next: a period */
    struct pm_rest *rest; /* repeat_rest.h */
} pm_repeat;

/* Segments from now on. */
typedef struct pm_repeats {
    int64_t n;      /* that are passed over */
    double kinetic; /* J, T with which the one after them begins */
    double lost;    /* J, what their blows take */
    double error;   /* J, of T after them */
    int is_last;    /* the one after them is the last that gets over the barrier */
} pm_repeats;

/* repeat_match.c: 1 if the phase at w->state, where T = kinetic, begins like the last segment: then by, rotation and
 * member lead there from the begin of that. */
int pm_repeat_match(pm_workspace *w, double kinetic);

/* Segments that nothing ever ends. */
#define PM_REPEAT_FOR_EVER INT64_MAX

/* repeat_limit.c: how many segments like the last one (l) from w->state on triggers, asks and limits allow to pass over; time: s, of each, or 0.
 * PM_REPEAT_FOR_EVER: if they are all alike, the run does not end. */
int64_t pm_repeat_limit(pm_workspace *w, const pm_repeat *l, const pm_symmetry_shift *shift, double time);
/* The zero of a trigger goes with T. */
int pm_repeat_limit_moves(const pm_model *model, int trigger);
/* Reads the sides of the triggers along the last segment; 1 if one of them has changed. */
int pm_repeat_limit_read_sides(pm_workspace *w);
/* The instants of a segment that count as events: of a period in which nothing fires and nothing jumps none, it turns back. */
int64_t pm_repeat_limit_instants(const pm_workspace *w, const pm_repeat *l);
/* How often an event has fired since the begin of the last segment. */
int64_t pm_repeat_limit_fires(const pm_firing *firing, const pm_repeat *repeat, int event);

/* The path's clock at w->state, where segment l begins; how long it has taken since then, s. */
void pm_repeat_pass_begin(const pm_workspace *w, pm_repeat *l);
double pm_repeat_pass_time(const pm_workspace *w, const pm_repeat *l);

/* The status of a run that does not end. */
int pm_repeat_limit_never(pm_workspace *w);

/* repeat_energy.c: the work on the segment that ended at w->state, J. */
double pm_repeat_energy_work(const pm_workspace *w);
/* From the begin of a segment down to the least T on it, J. */
double pm_repeat_energy_depth(const pm_repeat *l);
/* One more is passed over. */
void pm_repeat_energy_add(const pm_repeat *l, pm_repeats *segments);
/* Of `most` segments, the first of which begins with T = begin, those before the one that is known not to be sure which get
 * over the barrier, as the segment after each of them does, too: that one is left to be looked at.  error: of T, J. */
pm_repeats pm_repeat_energy_over_barrier(const pm_repeat *l, double begin, int64_t most, double error);

/* repeat_replay.c: w->state is at the begin of the segment after the last one, which pm_route_path is ready to begin.  What
 * the last one was computed with looks at a later one; w->state stays, the frame looks at it.
 *
 * *sure = 1: nothing that goes with T becomes zero in a segment that begins with T = kinetic; so it does in none between. */
int pm_repeat_replay_check(pm_workspace *w, double kinetic, int *sure);
/* The segment after these, if it is sure, is told: extremes that are asked see it; *found = 0: it must be computed. */
int pm_repeat_replay_tell(pm_workspace *w, const pm_repeats *segments, int *found);

/* repeat_pass.c: moves w->state on by these segments, like l, and counts them; kinetic: T there now, time: s, of each, or 0.  The
 * frame looks at w->state, the constraints are built for it. */
int pm_repeat_pass(pm_workspace *w, const pm_repeat *l, const pm_repeats *segments, double kinetic,
                   double time);

#endif
