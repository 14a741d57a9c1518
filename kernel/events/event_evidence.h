/* event_evidence.h - decisions of the functions of a phase, for their log (state/evidence.h). */
#ifndef PM_EVENT_EVIDENCE_H
#define PM_EVENT_EVIDENCE_H

#include "events/event.h"
#include "state/evidence.h"

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
