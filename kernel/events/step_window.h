/* step_window.h - a step is sampled as a whole, or in windows where its samples do not show what is watched. */
#ifndef PM_STEP_WINDOW_H
#define PM_STEP_WINDOW_H

#include "state/workspace.h"

/* The state is at the end of the route's step; of a window before the last one it is not. */
static inline int pm_step_window_is_last(const pm_step *step) { return !(step->end < step->whole_end); }

/* Samples the step that the route has made, or as much of it from its begin on as the nodes show: that is from now on
 * [step.begin, step.end]. */
int pm_step_window_first(pm_workspace *w);
/* The same for what is left of it after the last window. */
int pm_step_window_next(pm_workspace *w);

#endif
