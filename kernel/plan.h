/* plan.h - which route computes a phase, and why. */
#ifndef PM_PLAN_H
#define PM_PLAN_H

#include "model.h"

/* Chooses w->route for the phase that begins at w->state with the active rows; w->rule tells why. */
int pm_plan_phase(pm_workspace *w);

#endif
