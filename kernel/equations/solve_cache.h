/* solve_cache.h - the accelerations and reactions that were found last, for a state that is looked at again. */
#ifndef PM_SOLVE_CACHE_H
#define PM_SOLVE_CACHE_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* What a constraint was evaluated to: all else of it stays while the active set does. */
typedef struct pm_evaluated {
    double j[PM_CONSTRAINT_COORDINATES], g, rate, gamma;
} pm_evaluated;

typedef struct pm_solve_cache {
    int known;                /* something is kept */
    int closed;               /* nothing else is to be kept for now */
    int64_t active_version;   /* version of the active set when it was found */
    double *pose;             /* [nq] x, y, angle, as the frame had them */
    double *velocity;         /* [nq] likewise */
    double *a, *lambda;       /* [nq], [nconstraint] what was found */
    pm_memory *memory;        /* [nmemory] */
    pm_evaluated *constraint; /* [nconstraint] of the active ones, there */
    /* the set of constraints that was built last */
    int64_t built; /* its version, or PM_NONE */
    pm_slot *slot; /* [nslot] */
    double *q;     /* [nq] */
} pm_solve_cache;

int pm_solve_cache_create(pm_workspace *w);
/* Another case begins. */
void pm_solve_cache_forget(pm_solve_cache *cache);

/* Makes the frame DYNAMIC where it looks at what it looked at when pm_solve_cache_keep was called last; 0 if it does not. */
int pm_solve_cache_take(pm_workspace *w);
void pm_solve_cache_keep(pm_workspace *w);
/* Evaluates the active constraints in the same case. */
int pm_solve_cache_take_constraints(pm_workspace *w);

/* The active constraints are those that were built last, here and for the same contacts. */
int pm_solve_cache_is_built(const pm_workspace *w);
void pm_solve_cache_built(pm_workspace *w);

#endif
