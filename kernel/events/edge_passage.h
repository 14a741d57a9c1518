/* edge_passage.h - marks that go through an edge between two nodes of a step. */
#ifndef PM_EDGE_PASSAGE_H
#define PM_EDGE_PASSAGE_H

#include "events/event.h"

/* The gap of function i (to an edge) is positive at node k: the first bracket where it is no longer, before node k + 1; 0: there
 * is none. */
int pm_edge_passage_between(pm_workspace *w, int i, int k, pm_event_at *gap_at, pm_span *x);
/* Likewise where the mark touches the edge at node k, and no more at the next: it bounces, and comes back before it has passed
 * the end.  Where the bracket begins at node k it bounces inside. */
int pm_edge_passage_after(pm_workspace *w, int i, int k, pm_event_at *gap_at, pm_span *x);

#endif
