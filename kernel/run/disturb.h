/* disturb.h - in a coarse run each phase begins at a state that is off by some roundings. */
#ifndef PM_DISTURB_H
#define PM_DISTURB_H

#include "state/workspace.h"

/* Before a phase; does nothing but in a coarse run.  The frame is DYNAMIC before and after. */
int pm_disturb(pm_workspace *w);

#endif
