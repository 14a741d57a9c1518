/* step_window.h - a step is sampled as a whole, or in windows where its samples do not show what is watched. */
#ifndef PM_STEP_WINDOW_H
#define PM_STEP_WINDOW_H

#include "state/workspace.h"

/* Samples the step that the route has made, or as much of it from its begin on as the nodes show: that is from now on
 * [step.begin, step.end]. */
int pm_step_window_first(pm_workspace *w);
/* The same for what is left of it after the last window. */
int pm_step_window_next(pm_workspace *w);

#endif
