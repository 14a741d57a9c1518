/* repeat_energy.h - kinetic energies of legs that repeat. */
#ifndef PM_REPEAT_ENERGY_H
#define PM_REPEAT_ENERGY_H

#include "routes/path/repeat_record.h"

/* Legs from now on. */
typedef struct pm_repeats {
    int64_t n;      /* that are passed over */
    double kinetic; /* T with which the one after them begins */
    double lost;    /* what their blows take */
    double error;   /* of T after them */
    int is_last;    /* the one after them is the last that gets over the barrier */
} pm_repeats;

/* The work on the leg that ended at w->state. */
double pm_repeat_energy_work(const pm_workspace *w);
/* From the begin of a leg down to the least T on it. */
double pm_repeat_energy_depth(const pm_repeat *l);
/* One more is passed over. */
void pm_repeat_energy_add(const pm_repeat *l, pm_repeats *legs);
/* Of `most` legs, the first of which begins with T = begin, those that get over the barrier, as the leg after each of them
 * does, too: that one is left to be looked at.  error: of T. */
pm_repeats pm_repeat_energy_over_barrier(const pm_repeat *l, double begin, int64_t most, double error);

#endif
