/* repeat_limit.h - who may notice legs that are passed over. */
#ifndef PM_REPEAT_LIMIT_H
#define PM_REPEAT_LIMIT_H

#include "scene/symmetry.h"

/* How many legs from w->state on triggers, asks, limits and w->leg->most allow to pass over; time: that of each, or 0. */
int64_t pm_repeat_limit(pm_workspace *w, const pm_symmetry_shift *shift, double time);
/* The zero of the trigger moves with T. */
int pm_repeat_limit_moves(const pm_workspace *w, int trigger);
/* Such a trigger has gone through its zero since the leg before those that were passed over. */
int pm_repeat_limit_signs_changed(const pm_workspace *w);

#endif
