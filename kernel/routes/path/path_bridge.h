/* path_bridge.h - places on the path next to a singular position, and at it. */
#ifndef PM_PATH_BRIDGE_H
#define PM_PATH_BRIDGE_H

#include "routes/path/path.h"

/* A phase begins, or another driver tells the path. */
void pm_path_bridge_forget(pm_path *p);
/* A place at u that the rows determine well. */
void pm_path_bridge_determined(pm_path *p, double u, const pm_place *place);
/* The coordinates, their slopes and the pose of the frame at u, which the rows determine badly or not at all.
 * PM_SINGULAR or PM_ASSEMBLY where the branch cannot be followed. */
int pm_path_bridge_place(pm_workspace *w, double u, pm_place *place);
/* Accelerations at the frame (its forces are known) from the branch, reactions left open; 0 if there is no bridge. */
int pm_path_bridge_accelerate(pm_workspace *w);

#endif
