/* drives.h - what happens where that which drives prescribe switches. */
#ifndef PM_DRIVES_H
#define PM_DRIVES_H

#include "state/workspace.h"

/* At an instant; the frame looks at w->state, also afterwards. *jumped: 1 if a rate jumps, which is a blow. PM_DRIVE_JUMPS
 * where a prescribed place does: where = joint; detail = by how much, m or rad. */
int pm_drives_strike(pm_workspace *w, int *jumped);

#endif
