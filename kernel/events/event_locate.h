/* event_locate.h - where in its bracket a function is zero. */
#ifndef PM_EVENT_LOCATE_H
#define PM_EVENT_LOCATE_H

#include "events/event.h"

/* The root of function i in the bracket x, on the dense output; the samples may become those of one member of a row. */
int pm_event_locate(pm_workspace *w, int i, const pm_span *x, double *place);
/* That root is taken: its rate is noted as a decision, and *place moves onto the zero of the exact states; *taken is where
 * w->probe holds one.  Neither is touched where the step ends exactly there. */
int pm_event_locate_settle(pm_workspace *w, int i, const pm_span *x, double *place, double *taken);

#endif
