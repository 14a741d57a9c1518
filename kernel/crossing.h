/* crossing.h - where functions of a phase go through zero within the last step. */
#ifndef PM_CROSSING_H
#define PM_CROSSING_H

#include "model.h"

#define PM_SAME_PLACE 1e-11 /* of a step: events closer than this are one instant */

/* Locates the functions, which have been sampled, that fire first after `from`: w->event->hit, *first the place (INFINITY:
 * none), *taken where w->probe holds an exact state. */
int pm_crossing_first(pm_workspace *w, double from, double *first, double *taken);
/* The step is over: zeros that were held and have been left count again. */
void pm_crossing_leave(pm_workspace *w);

#endif
