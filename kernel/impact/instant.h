/* instant.h - what happens at one instant: blows, changes of modes, firings, answers. */
#ifndef PM_INSTANT_H
#define PM_INSTANT_H

#include "state/workspace.h"

/* The start: blows and modes at t = 0; the frame is DYNAMIC before and after. */
int pm_instant_start(pm_workspace *w);
/* An instant that ends a phase; the frame is DYNAMIC before and after.  *ended = 1: the end of the run. */
int pm_instant_full(pm_workspace *w, int *ended);
/* An instant at w->state that only fires triggers. */
int pm_instant_mark(pm_workspace *w, int *ended);
/* Where a route cannot go on: PM_OK if an impact without collision of a contact that its friction all but draws does, which the
 * next instant begins with; PM_PAINLEVE if that contact is to stop; else the status as it was. */
int pm_instant_jams(pm_workspace *w, int status);
/* What every instant closes with: events are counted, asks answered, limits looked at. */
int pm_instant_finish(pm_workspace *w, int *ended);

#endif
