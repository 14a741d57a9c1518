/* event_search.h - where functions of a phase go through zero within the last step. */
#ifndef PM_EVENT_SEARCH_H
#define PM_EVENT_SEARCH_H

#include "state/workspace.h"

#define PM_SAME_PLACE 1e-11 /* of a step: events closer than this are one instant */

/* Locates the functions, which have been sampled, that fire first after `from`: w->event->hit, *first the place (INFINITY:
 * none), *taken where w->probe holds an exact state. */
int pm_event_search_first(pm_workspace *w, double from, double *first, double *taken);
/* The step is over: zeros that were held and have been left count again. */
void pm_event_search_leave(pm_workspace *w);

#endif
