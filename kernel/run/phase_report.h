/* phase_report.h - the list of the phases of one case. */
#ifndef PM_PHASE_REPORT_H
#define PM_PHASE_REPORT_H

#include "state/workspace.h"

typedef struct pm_phase_report {
    int64_t cap, most, needed;
    int32_t *row;                /* [cap][PM_PHASE_COLUMNS] */
    double *time;                /* [cap] */
    int64_t spared, steps, legs; /* of the case, when the last phase began */
} pm_phase_report;

/* The phase that w->route has begun; PM_CANCELLED if no more are wanted.  Does nothing without a list. */
int pm_phase_report_add(pm_workspace *w);
/* The run has ended: steps of its last phase. */
void pm_phase_report_end(pm_workspace *w);

#endif
