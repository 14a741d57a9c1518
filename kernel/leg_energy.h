/* leg_energy.h - kinetic energies of legs that repeat. */
#ifndef PM_LEG_ENERGY_H
#define PM_LEG_ENERGY_H

#include "leg_keep.h"

/* Legs from now on. */
typedef struct pm_legs {
    int64_t n;      /* that are passed over */
    double kinetic; /* T with which the one after them begins */
    double lost;    /* what their blows take */
    double error;   /* of T after them */
    int is_last;    /* the one after them is the last that gets over the barrier */
} pm_legs;

/* The work on the leg that ended at w->state. */
double pm_leg_work(const pm_workspace *w);
/* From the begin of a leg down to the least T on it. */
double pm_leg_depth(const pm_leg *l);
/* One more is passed over. */
void pm_leg_add(const pm_leg *l, pm_legs *legs);
/* Of `most` legs, the first of which begins with T = begin, those that get over the barrier, as the leg after each of them
 * does, too: that one is left to be looked at.  error: of T. */
pm_legs pm_leg_over_barrier(const pm_leg *l, double begin, int64_t most, double error);

#endif
