/* find_extremum.h - the greatest value of the goal between two parameters. */
#ifndef PM_FIND_EXTREMUM_H
#define PM_FIND_EXTREMUM_H

#include "study/find_look.h"

/* The greatest goal between a and b, where `best` lies between them and is greater than both; it is replaced. */
int pm_find_extremum(pm_workspace *w, double a, double b, pm_look *best);

#endif
