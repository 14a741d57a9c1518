/* trace.h - the record of one case: a row at every step, before and after every event; in the long steps of a route that
 * goes along the way, also at the nodes inside. */
#ifndef PM_TRACE_H
#define PM_TRACE_H

#include "model.h"

typedef struct pm_record {
    int64_t nprogram, cap, needed;
    const int32_t *program;
    double *history;       /* [cap][1 + nprogram] */
    int32_t *mark;         /* [cap] */
    double length, inside; /* of the present step: its full length; rows are there up to this place */
} pm_record;

/* Records w->state (0: step, 1: before an event, 2: after it); does nothing without a trace. */
int pm_trace_row(pm_workspace *w, int mark);
/* A step has been made: w->step_begin to w->step_end. */
void pm_trace_step(pm_workspace *w);
/* Records the nodes inside the present step up to place x that are not there yet; w->probe is lost. */
int pm_trace_inside(pm_workspace *w, double x);

#endif
