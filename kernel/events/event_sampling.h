/* event_sampling.h - what a phase watches, at the nodes of a step. */
#ifndef PM_EVENT_SAMPLING_H
#define PM_EVENT_SAMPLING_H

#include "state/workspace.h"

/* Samples functions (if asked for) and watched asks at all nodes of the step [step_begin, step_end] (state at its end). */
int pm_event_search_sample(pm_workspace *w, int with_functions);
/* The gap to the nearest member of a row has corners, that to one member has none: from now on the samples of function i
 * are those of the member that is met at x.  Whether it is the nearest at the root is seen there. */
void pm_event_search_sample_member(pm_workspace *w, int i, double x);

#endif
