/* event_bracket.h - between which places of a step a function goes through zero. */
#ifndef PM_EVENT_BRACKET_H
#define PM_EVENT_BRACKET_H

#include "events/event.h"

/* The first bracket of function i in the step, which has been sampled, after `from`; 0 if there is none. */
int pm_event_bracket(pm_workspace *w, int i, double from, pm_span *x);

#endif
