/* natural_size.h - what asks and triggers are measured against: the size of their terms. */
#ifndef PM_NATURAL_SIZE_H
#define PM_NATURAL_SIZE_H

#include "state/workspace.h"

typedef struct pm_natural_size {
    double *ask;     /* [nask] what it would change by if the state changed by its own size */
    double *terms;   /* [nask] the same, of all that it reads by the greatest of their kinds in the run */
    double *largest; /* [nask] the greater of both */
    double *trigger; /* [ntrigger] as ask */
    double *rate;    /* [nask] by the time at the end, in the unit of the answer a second */
    unsigned char *shifts; /* [nask] it reads a kind of quantity that `terms` is about */
    int level;             /* enum pm_level that asks and triggers need */
} pm_natural_size;

int pm_natural_size_create(pm_workspace *w, pm_natural_size *x);
/* Sizes at the end of the run that has just been made, in the unit of the answer; scratch: ask[nask], trigger[ntrigger].  0
 * where there is no acceleration at the end. */
void pm_natural_size_find(pm_workspace *w, pm_natural_size *x, double *ask, double *trigger);
/* Rates of the asks along the motion at w->state; 0 where there is no acceleration.  Scratch: ask[nask]. */
void pm_natural_size_find_rates(pm_workspace *w, pm_natural_size *x, double *ask);

#endif
