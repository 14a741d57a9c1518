/* leg_same.h - whether a phase begins like the last leg. */
#ifndef PM_LEG_SAME_H
#define PM_LEG_SAME_H

#include "model.h"

/* 1 if it does at w->state, where T = kinetic: then w->leg->by, turn, member lead there from the begin of that leg. */
int pm_leg_is_same(pm_workspace *w, double kinetic);

#endif
