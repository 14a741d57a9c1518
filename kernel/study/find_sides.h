/* find_sides.h - answers that differ on the two sides of what was found. */
#ifndef PM_FIND_SIDES_H
#define PM_FIND_SIDES_H

#include "study/find_look.h"

int pm_find_sides_create(pm_workspace *w);
/* Looks at both sides of what was found, and moves it to the side that is answered where the run is not of that side. */
int pm_find_sides(pm_workspace *w, pm_look *at);
/* After the run with what was found: the reasons of the answers that differ, and what the move adds to errors. */
void pm_find_sides_tell(pm_workspace *w);

#endif
