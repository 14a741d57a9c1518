/* event_bound.h - whether what a trigger watches goes through zero and back between two samples. */
#ifndef PM_EVENT_BOUND_H
#define PM_EVENT_BOUND_H

#include "state/workspace.h"

/* The first place (0 to 1 of the step) that is met in [from, to] where the program times `sign` is below -nothing, by its law;
 * NaN: there is none, or the law is not known. */
double pm_event_bound_beyond(const pm_workspace *w, int program, double sign, double nothing, double from,
                             double to);

#endif
