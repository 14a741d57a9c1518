/* event_search.h - what fires first in the last step of a route: the interface of the search for events.
 *
 * Every step is sampled; then the functions of the phase that fire first after a place of it are located, one place after
 * the other, to the accuracy of the trajectory; at last zeros that have been left count again.  Places are those of the
 * route's progress coordinate.  What returns an int returns the status of the route's looks, unless it says otherwise. */
#ifndef PM_EVENT_SEARCH_H
#define PM_EVENT_SEARCH_H

#include "events/event.h"
#include "state/evidence.h"

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

/* ---- decisions (state/evidence.h) ---- */
/* An instant begins: notes how far each function that did not fire is from its zero.  The frame looks at the state.  marks: it is
 * only marked, and what touches takes part in no blow. */
void pm_event_evidence_instant(pm_workspace *w, int marks);
/* Whether the instant that begins is where something went through zero, not one that a time of the scene set. */
int pm_event_evidence_located(const pm_workspace *w);
/* Velocities jumped at an instant that was located.  Where a time of the scene was due at it, too, which of both came first
 * is not known. */
void pm_event_evidence_jump(pm_workspace *w);
/* How fast, in the route's progress, a function of the phase goes through its zero. */
void pm_event_evidence_rate(pm_workspace *w, int function, double rate);
/* What the decision is about, as PM_UNDECIDED tells it; *t: when it was taken, NaN if that is not known. */
pm_where pm_event_evidence_where(const pm_model *model, const pm_closest *closest, double *t);
/* The instant is over: what fired, and which contacts are closed in which mode, is mixed into the history. */
void pm_event_evidence_close(pm_workspace *w);

#endif
