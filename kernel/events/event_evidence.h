/* event_evidence.h - the decisions of an instant that the event functions tell. */
#ifndef PM_EVENT_EVIDENCE_H
#define PM_EVENT_EVIDENCE_H

#include "state/workspace.h"

/* An instant begins: notes how far each function that did not fire is from its zero.  The frame looks at the state. */
void pm_event_evidence_instant(pm_workspace *w);
/* How fast, in the route's progress, a function of the phase goes through its zero. */
void pm_event_evidence_rate(pm_workspace *w, int function, double rate);
/* The instant is over: what fired, and which contacts are closed in which mode, is mixed into the history. */
void pm_event_evidence_close(pm_workspace *w);

#endif
