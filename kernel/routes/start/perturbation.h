/* perturbation.h - the side to which an unstable rest, or an unstable steady motion, is left.
 *
 * A nudge is a program that is > 0 for velocities on its side; it waits until the next phase begins.  One degree of freedom
 * at rest leaves along its path (route_path.c), everything else along the deviation that grows fastest (fastest_growth.c). */
#ifndef PM_PERTURBATION_H
#define PM_PERTURBATION_H

#include "state/workspace.h"

/* The scene has nudges, at its start or by events. */
int pm_perturbation_any(const pm_model *m);
int pm_perturbation_create(pm_workspace *w);

/* A case begins: that of the start waits, if there is one. */
void pm_perturbation_begin(const pm_model *model, pm_request *request);
/* For run.c, before a phase is planned: w->state leaves its steady motion, unless the path route will do that. */
int pm_perturbation_leave(pm_workspace *w);
/* The phase has begun: nothing waits any more. */
void pm_perturbation_end(pm_request *request);

#endif
