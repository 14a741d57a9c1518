/* crossing.h - where functions of a phase go through zero within the last step. */
#ifndef PM_CROSSING_H
#define PM_CROSSING_H

#include "event.h"

#define PM_SAME_PLACE 1e-11 /* of a step: events closer than this are one instant */

/* Place of a node in the last step. */
double pm_crossing_node(const pm_workspace *w, int node);
/* Samples functions (if asked for) and watched asks at all nodes of the step [step_begin, step_end] (state at its end). */
int pm_crossing_sample(pm_workspace *w, int with_functions);
/* Whether the samples of function i tell it between the nodes, too. */
int pm_crossing_resolves(const pm_workspace *w, int i);
/* Locates the functions that fire first after `from`: w->event->hit, *first the place (INFINITY: none), *taken where
 * w->probe holds an exact state. */
int pm_crossing_first(pm_workspace *w, double from, double *first, double *taken);
/* The step is over: zeros that were held and have been left count again. */
void pm_crossing_leave(pm_workspace *w);

#endif
