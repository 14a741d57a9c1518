/* path_rigid.h - an open tree of one coordinate in which all that moves is one rigid group: its places without the tree. */
#ifndef PM_PATH_RIGID_H
#define PM_PATH_RIGID_H

#include "routes/path/path.h"

/* Whether the tree is such a one; p->rigid is made for the phase then, where the frame looks. */
int pm_path_rigid_build(pm_workspace *w);
/* All of the place at coordinate u but the coordinate.  The frame looks at it where other forces than weights act. */
void pm_path_rigid_place(pm_workspace *w, double u, pm_place *place);

#endif
