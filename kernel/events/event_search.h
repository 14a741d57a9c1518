/* event_search.h - what fires first in the last step of a route: the interface of the search for events.
 *
 * Every step is sampled; then the functions of the phase that fire first after a place of it are located, one place after
 * the other, to the accuracy of the trajectory; at last zeros that have been left count again.  Places are those of the
 * route's progress coordinate.  What returns an int returns the status of the route's looks, unless it says otherwise. */
#ifndef PM_EVENT_SEARCH_H
#define PM_EVENT_SEARCH_H

#include "events/event.h"
#include "events/event_evidence.h"

/* Samples functions (if asked for) and watched asks at all nodes of the step; *shown = 0: they might do more between the nodes,
 * and there are no finer ones. */
int pm_event_samples_fill(pm_workspace *w, int with_functions, int *shown);
/* 1 if the samples of function i show it between the nodes, too. */
int pm_event_samples_resolve(const pm_step *step, struct pm_event_set *event, int i);

/* Locates the functions, which have been sampled, that fire first after `from`: w->event->hit, *first the place (INFINITY:
 * none), *taken where w->probe holds an exact state. */
int pm_event_search_first(pm_workspace *w, double from, double *first, double *taken);
/* The phase ends at `first`, if that is in the step: from which side its triggers came there. */
void pm_event_search_keep_sides(pm_workspace *w, double first);
/* The step is over: zeros that were held and have been left count again. */
void pm_event_search_leave(const pm_step *step, struct pm_event_set *e);

#endif
