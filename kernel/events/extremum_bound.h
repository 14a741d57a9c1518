/* extremum_bound.h - the extremes of what an ask watches that nodes do not show (extremum.h), by bounds. */
#ifndef PM_EXTREMUM_BOUND_H
#define PM_EXTREMUM_BOUND_H

#include "state/workspace.h"

/* Offers what may be above the best so far in the step, where the law of the ask's program is known; extremes beside nodes have
 * been offered. */
int pm_extremum_bound_by_law(pm_workspace *w, int ask);

#endif
