/* repeat_pass.h - legs are passed over. */
#ifndef PM_REPEAT_PASS_H
#define PM_REPEAT_PASS_H

#include "routes/path/repeat_energy.h"

/* Moves w->state on by these legs, and counts them; kinetic: T there now, time: that of each, or 0.  The frame looks at
 * w->state, the rows are built for it. */
int pm_repeat_pass(pm_workspace *w, const pm_repeats *legs, double kinetic, double time);

#endif
