/* find.h - a case that looks for one or two of its parameters by whole runs. */
#ifndef PM_FIND_H
#define PM_FIND_H

#include "state/workspace.h"

int pm_find_create(pm_workspace *w);
void pm_find_free(pm_workspace *w);

/* Runs a case: as pm_run where nothing is sought; else finds the varied parameters, gives them in found
 * [PM_FOUND_COLUMNS] and leaves the run with them as the case's results. */
int pm_find_run(pm_workspace *w, const double *param, double *found);

/* Relative: how well the last find can know its parameters, where they bound an outcome; else 0. */
double pm_find_resolution(const pm_workspace *w);

#endif
