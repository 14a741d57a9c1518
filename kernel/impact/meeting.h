/* meeting.h - the place where a contact is struck. */
#ifndef PM_MEETING_H
#define PM_MEETING_H

#include "state/workspace.h"

/* The frame looks at w->state, DYNAMIC, where a step was cut: if a gap closes there, w->state moves on, or back, to where it is
 * zero, within the rounding of its time.  The frame looks at it, DYNAMIC.  Statuses of pm_saddle_accelerate. */
int pm_meeting_reach(pm_workspace *w);

#endif
