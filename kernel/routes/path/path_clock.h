/* path_clock.h - the time along a step of the path. */
#ifndef PM_PATH_CLOCK_H
#define PM_PATH_CLOCK_H

#include "routes/path/path.h"

/* The table of a path that has been created; all zero before. */
void pm_path_clock_fill_table(pm_clock_table *table);
/* Makes the clock of a step whose nodes are filled; 0 if they do not resolve it: its highest coefficients exceed `most`. */
int pm_path_clock_set(pm_path *p, int clock, double most);
/* Time at the fraction s of the step. */
double pm_path_clock_at(const pm_path *p, double s);

#endif
