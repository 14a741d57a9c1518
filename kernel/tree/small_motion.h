/* small_motion.h - the equations of motion next to a state, linearised; their eigenvalues (state/modes.h). */
#ifndef PM_SMALL_MOTION_H
#define PM_SMALL_MOTION_H

#include "state/workspace.h"

/* Where the scene asks for its modes. */
int pm_small_motion_create(pm_workspace *w);

#endif
