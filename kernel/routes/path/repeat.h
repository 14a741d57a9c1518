/* repeat.h - what a path phase has shown once is used again: for the next period of a row, for the next turn of a closed
 * path. */
#ifndef PM_REPEAT_H
#define PM_REPEAT_H

#include "state/workspace.h"

/* Memory of the last segment; PM_NO_MEMORY. */
int pm_repeat_create(pm_workspace *w);

/* A new case, or a phase on another route: nothing is known. */
void pm_repeat_forget(struct pm_repeat *repeat);
/* A path phase begins at w->state (the frame looks at it, the rows are built): if it repeats the last segment, as many
 * segments are passed over as nobody asks about and as are sure to go like it; *passed = 1: w->state is the begin of a later
 * one and the rows are built for it.  Statuses of the route and of the rows. */
int pm_repeat_begin(pm_workspace *w, int *passed);
/* The segment ends at w->state, where the frame looks, before the blows of the instant. */
void pm_repeat_end(pm_workspace *w);

#endif
