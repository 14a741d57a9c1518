/* history.h - the record of one case: a record at every step, before and after every event; in the long steps of a route
 * that goes along the way, also at the nodes inside. */
#ifndef PM_HISTORY_H
#define PM_HISTORY_H

#include "state/workspace.h"

typedef struct pm_history {
    int64_t nprogram, cap, needed;
    const int32_t *program;
    double *history;              /* [cap][1 + nprogram] */
    int32_t *mark;                /* [cap] */
    double begin, length, inside; /* of the present step, in full; records are there up to this place */
} pm_history;

/* Records w->state (0: step, 1: before an event, 2: after it); does nothing without a trace. */
int pm_history_append(pm_workspace *w, int mark);
/* A step has been made: w->step_begin to w->step_end. */
void pm_history_step(const pm_step *step, pm_record *record);
/* Records the nodes inside the present step up to place x that are not there yet; w->probe is lost. */
int pm_history_inside(pm_workspace *w, double x);

#endif
