/* start.h - the start of a run: positions that meet the joints, velocities that agree with what is written. */
#ifndef PM_START_H
#define PM_START_H

#include "state/workspace.h"

typedef struct pm_start_report {
    double moved;   /* greatest displacement by the assembly, m */
    double opening; /* greatest residual after it, m */
} pm_start_report;

/* Assembles w->state from the case's values (also copied to w->start); the frame looks at it. */
int pm_start(pm_workspace *w, pm_start_report *report);

#endif
