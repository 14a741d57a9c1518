/* start.h - the start of a run: positions that meet the joints, velocities that agree with what is written. */
#ifndef PM_START_H
#define PM_START_H

#include "equations/start_positions.h"

/* Assembles w->state from the case's values (also copied to w->start); the frame looks at it.  PM_ASSEMBLY, PM_START_CONFLICT,
 * PM_START_OPEN, PM_PENETRATION. */
int pm_start(pm_workspace *w, pm_start_report *report);

#endif
