/* leg_allow.h - who may notice legs that are passed over. */
#ifndef PM_LEG_ALLOW_H
#define PM_LEG_ALLOW_H

#include "symmetry.h"

/* How many legs from w->state on triggers, asks, limits and w->leg->most allow to pass over; time: that of each, or 0. */
int64_t pm_leg_allowed(pm_workspace *w, const pm_shift *shift, double time);
/* The zero of the trigger moves with T. */
int pm_leg_moves_with_energy(const pm_workspace *w, int trigger);
/* Such a trigger has gone through its zero since the leg before those that were passed over. */
int pm_leg_signs_changed(const pm_workspace *w);

#endif
