/* gap_passage.h - circles that go through each other between two nodes of a step. */
#ifndef PM_GAP_PASSAGE_H
#define PM_GAP_PASSAGE_H

#include "state/workspace.h"

/* The time in which two circles that are open may be missed: what moves through between two of the nodes of a step.  Where
 * the frame looks at w->state, of velocities v[nq] and accelerations a[nq]; INFINITY if there are none, or nothing moves. */
double pm_gap_passage_time(const pm_workspace *w, const double *v, const double *a);
/* Whether the nodes of the step, which have been sampled, show all circles that meet in it. */
int pm_gap_passage_is_shown(const pm_workspace *w);

#endif
