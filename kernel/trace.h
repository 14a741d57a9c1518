/* trace.h - the record of one case: a row at every step, before and after every event. */
#ifndef PM_TRACE_H
#define PM_TRACE_H

#include "model.h"

typedef struct pm_record {
    int64_t nprogram, cap, needed;
    const int32_t *program;
    double *history; /* [cap][1 + nprogram] */
    int32_t *mark;   /* [cap] */
} pm_record;

/* Records w->state (0: step, 1: before an event, 2: after it); does nothing without a trace. */
int pm_trace_row(pm_workspace *w, int mark);

#endif
