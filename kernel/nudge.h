/* nudge.h - the side to which an unstable rest, or an unstable steady motion, is left.
 *
 * A nudge is a program that is > 0 for velocities on its side; it waits until the next phase begins.  One degree of freedom
 * at rest leaves along its path (route_path.c), everything else along the deviation that grows fastest (escape.c). */
#ifndef PM_NUDGE_H
#define PM_NUDGE_H

#include "model.h"

/* The scene has nudges, at its start or by events. */
int pm_nudge_any(const pm_model *m);
int pm_nudge_create(pm_workspace *w);
void pm_nudge_free(pm_workspace *w);

/* A case begins: that of the start waits, if there is one. */
void pm_nudge_begin(pm_workspace *w);
/* That of an action waits from now on; PM_UNSUPPORTED if another does. */
int pm_nudge_add(pm_workspace *w, int action);
int pm_nudge_waits(const pm_workspace *w);
/* The sign of the motion along `tangent` that it asks for; 0: it does not tell.  The frame looks at the state. */
double pm_nudge_side(pm_workspace *w, const double *tangent);
/* For run.c, before a phase is planned: w->state leaves its steady motion, unless the path route will do that. */
int pm_nudge_leave(pm_workspace *w);
/* The phase has begun: nothing waits any more. */
void pm_nudge_end(pm_workspace *w);

#endif
