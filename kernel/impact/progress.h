/* progress.h - whether a motion gets on from one instant to the next. */
#ifndef PM_PROGRESS_H
#define PM_PROGRESS_H

#include "state/workspace.h"

/* A run begins. */
void pm_progress_begin(pm_workspace *w);
/* At an instant, when its modes have been found: PM_ALTERNATES, or what stands in its way, where no time has passed since so many. */
int pm_progress_check(pm_workspace *w);

#endif
