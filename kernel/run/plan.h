/* plan.h - which route computes a phase, and why. */
#ifndef PM_PLAN_H
#define PM_PLAN_H

#include "state/workspace.h"

/* Chooses w->route for the phase that begins at w->state with the active rows; w->rule tells why. */
int pm_plan_phase(pm_workspace *w);

/* The phase serves to pass a singular position, and that lies behind: the route that was asked for goes on. */
int pm_plan_has_passed(pm_workspace *w);

/* By its structure the run ends at its start, nothing can touch, and nothing that is asked needs accelerations. */
int pm_plan_kinematic(const pm_workspace *w);
/* The run has ended before any phase: its route is `state`, or `jump` if there were blows. */
void pm_plan_no_phase(pm_workspace *w);
/* The status of a case that has one: PM_NO_TIME_ROUTE where all is well, but rk or ida was asked for to compute a motion
 * and there was none (evidence of two routes in time would be no evidence). */
int pm_plan_end(pm_workspace *w, int status);

#endif
