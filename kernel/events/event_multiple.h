/* event_multiple.h - the multiples of a trigger of kind PM_TRIGGER_EVERY: which of them is next in a step. */
#ifndef PM_EVENT_MULTIPLE_H
#define PM_EVENT_MULTIPLE_H

#include "events/event.h"

/* The bracket of the next multiple that function i reaches in the step, which has been sampled, after it has fired last; 0 if there
 * is none. */
int pm_event_multiple_first(pm_workspace *w, int i, pm_event_at *value_at, pm_span *x);
/* It is still on the multiple on which it was, where its value is this. */
int pm_event_multiple_holds(const pm_event_set *event, const pm_event_function *f, double value);
/* It has fired: the trigger is on the multiple that was found. */
void pm_event_multiple_reach(pm_event_set *event, const pm_event_function *f);

#endif
