/* equilibrium.h - a scene that starts in an equilibrium near the positions given. */
#ifndef PM_EQUILIBRIUM_H
#define PM_EQUILIBRIUM_H

#include "equations/start_positions.h"

/* Where the scene asks for it. */
int pm_equilibrium_create(pm_workspace *w);
static inline int pm_equilibrium_wanted(const pm_model *m)
{
    return PM_SETTING(m, PM_SETTING_EQUILIBRIUM) != 0;
}
/* Moves w->state, which is assembled and whose contacts are open, to it; w->start is there, too.  The report tells how far, and
 * whether it is stable.  PM_NO_EQUILIBRIUM, PM_EQUILIBRIUM_MOVES or PM_EQUILIBRIUM_OPEN where there is none. */
int pm_equilibrium_find(pm_workspace *w, pm_start_report *report);
/* After the instant of the start, whose contacts are found by their laws: all must rest.  The frame is DYNAMIC. */
int pm_equilibrium_check(pm_workspace *w);

#endif
