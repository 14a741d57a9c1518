/* extremum.h - the extremes of what an ask watches, in the step that has been sampled.
 *
 * What ask_step.c uses; extremum_parts.h is for the files extremum*.c, which find them: beside nodes that are better than
 * those next to them (extremum.c), where nodes show nothing (extremum_hidden.c), on the branches of a program that switches
 * (extremum_branch.c); by the polynomial through the nodes where they resolve the value nearly (extremum_rise.c), by looks
 * where they do not (extremum_search.c). */
#ifndef PM_EXTREMUM_H
#define PM_EXTREMUM_H

#include "state/workspace.h"

/* Offers the extremes of the watched value in the step to the ask (pm_ask_offer), as far as they may be better than the best
 * so far; what is left out is noted in pm_ask_set.bound.  All nodes are sampled; the frame looks anywhere afterwards. */
int pm_extremum_take(pm_workspace *w, int ask);
/* 1 if the value at the end of a step that was shortened since may be better than the best so far. */
int pm_extremum_end_counts(pm_workspace *w, int ask);

#endif
