/* beyond.h - whether what came to its zero as a phase ended goes beyond it. */
#ifndef PM_BEYOND_H
#define PM_BEYOND_H

#include "state/workspace.h"

/* Blows are over and modes are settled, the frame is DYNAMIC, before and after: what waits for a value to rise above, or to fall
 * below, has not fired where the value stays on its zero, or turns back there (PM_FIRED_SHORT). */
int pm_beyond_leave_out(pm_workspace *w);

#endif
