/* step.h - places of the last step of a route: where they are, and the frame's looks at them.
 *
 * A place is given by the route's progress coordinate x: the time, or the way along the path (state/route.h).  What looks
 * returns the status of the route, or that of the saddle point; the frame is at no known place if it is not PM_OK. */
#ifndef PM_STEP_H
#define PM_STEP_H

#include "state/workspace.h"

/* Place x of a node of the step as it was sampled. */
double pm_step_node(const pm_step *step, int node);

/* The frame looks at x, by the dense output of the route, at enum pm_level; w->probe may be lost. */
int pm_step_look(pm_workspace *w, double x, int level);
/* The same to the accuracy of the trajectory; w->probe is the state there. */
int pm_step_look_exactly(pm_workspace *w, double x, int level);
/* Accelerations and reactions at a state of the step that the frame looks at; all is smooth there. */
int pm_step_react(pm_workspace *w);

/* The state is at the end of the route's step; of a window before the last one it is not. */
static inline int pm_step_is_last(const pm_step *step) { return !(step->end < step->whole_end); }

#endif
