/* shared_loads.h - reactions that are not unique: what constraints that depend on each other carry together.
 *
 *   H^T z = 0      a balance z: reactions p + s z go with the same motion, whatever s
 *
 * One z for each redundant constraint (active_set.h).  Those that have a constraint in common make a group.  A group stands
 * as long as some s gives loads that its contacts allow:
 *
 *   N >= 0,  |T| <= mu N where a contact sticks
 *
 * Its slack is the greatest m for which s gives N >= m and mu N - |T| >= m in all of them: it becomes 0 when the last
 * distribution of loads is used up, and then those contacts give way that bound it.
 * [J.-S. Pang and J. C. Trinkle, Math. Program. 73 (1996) 199] */
#ifndef PM_SHARED_LOADS_H
#define PM_SHARED_LOADS_H

#include "numerics/quadratic_program.h"
#include "state/workspace.h"

/* Of a contact in a group: which of its conditions bound the slack. */
enum pm_shared_bound {
    PM_BOUND_NORMAL = 1,  /* N */
    PM_BOUND_FORWARD = 2, /* mu N - T */
    PM_BOUND_BACKWARD = 4 /* mu N + T */
};

typedef struct pm_shared {
    int known;            /* what follows is of the frame as it was looked at last */
    int is_least;         /* and its reactions are the least (shared_reading.c) */
    int64_t version;      /* of the active set */
    double *pose, *loads; /* [5 (nbody + 1)], [nconstraint] of that frame */
    int n;                /* vectors z; 0 where they cannot be told */
    double *z;            /* [n][nconstraint] of the active ones; its own redundant one has the load `own` */
    double *own;          /* [n]; the largest entry of each z is 1 */
    int *group;           /* [n] the first of its group */
    double *slack;        /* [n] of a group, at its first: N; infinite where no contact takes part */
    int *bounded;         /* [n] of a group: its contacts bound the slack; 0: the forces of the scene do */
    int *slot_group;      /* [nslot] group of a contact, or PM_NONE */
    int *bound;           /* [nslot] enum pm_shared_bound, flags */
    /* scratch */
    double *force, *response, *rhs; /* [nq], [nq], [nconstraint] */
    double *kept;                   /* [njoint_constraint + 2 nslot] at least, and [nconstraint] */
    double *matrix, *right;         /* of a program: conditions [rows][unknowns], and [rows] */
    double *amount;                 /* [n] how much of each the least distribution takes (shared_reading.c) */
    double *cost, *found, *multiplier, *square;
    int *member, *row_slot, *row_bound;
    pm_quadratic_program program;
    int most,
        most_rows; /* redundant constraints and conditions of one group that are treated; more: no slack */
} pm_shared;

int pm_shared_create(pm_workspace *w);
/* Brings all of it to the frame, which is DYNAMIC; 0 where no reaction is shared. */
int pm_shared_look(pm_workspace *w);
/* Whether all of it is of the frame as it is. */
int pm_shared_is_known(const pm_workspace *w);
/* The vectors z and their groups alone, at the frame. */
int pm_shared_look_vectors(pm_workspace *w);
/* The entry of vector i at a place of the active set. */
double pm_shared_entry(const pm_workspace *w, int i, int place);
/* 1 if the contact in a slot is in a group; its slack, N. */
int pm_shared_slack(pm_workspace *w, int slot, double *slack);
/* 1 if it is, and contacts bound the slack. */
int pm_shared_is_bounded(pm_workspace *w, int slot, double *slack);
/* What bounds the slack there (enum pm_shared_bound, flags); 0: nothing. */
int pm_shared_bound_of(pm_workspace *w, int slot);
/* The group of each joint and contact, 1, 2, ..., or 0: joint[], contact[] in the order of the caller's tables, 0 before. */
void pm_shared_elements(pm_workspace *w, int32_t *joint, int32_t *contact);

/* For shared_reading.c: fills x->matrix and x->right with the conditions of the group that begins with vector `first` on loads
 * of the active constraints, in units of `size`, with x->member[] its vectors: how many conditions; -1: too many. */
int pm_shared_conditions(pm_workspace *w, const double *load, int first, double size, int *nmember);
/* The least of the program posed in x->cost, x->matrix and x->right, with k unknowns, n conditions and the squares K (NULL: 0):
 * x->found and x->multiplier; 0: there is none. */
int pm_shared_solve(pm_shared *x, int k, int n, const double *square);

#endif
