/* leg_pass.h - legs are passed over. */
#ifndef PM_LEG_PASS_H
#define PM_LEG_PASS_H

#include "leg_energy.h"

/* Moves w->state on by these legs, and counts them; kinetic: T there now, time: that of each, or 0.  The frame looks at
 * w->state, the rows are built for it. */
int pm_leg_pass(pm_workspace *w, const pm_legs *legs, double kinetic, double time);

#endif
