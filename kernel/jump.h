/* jump.h - blows: the impulsive change of velocities while positions stay. */
#ifndef PM_JUMP_H
#define PM_JUMP_H

#include "model.h"

/* Closes the contacts that touch and do not part, and resolves all blows at this instant, one after the other; *jumped = how many.  The frame looks at w->state
 * afterwards (KINEMATIC); struck contacts' triggers are marked. */
int pm_jump(pm_workspace *w, int *jumped);

#endif
