/* run.h - one case from its start to its end. */
#ifndef PM_RUN_H
#define PM_RUN_H

#include "equations/start.h"
#include "state/workspace.h"

/* Runs a case: out, reason, audit, count of the workspace are filled; w->where on an early stop or failure. */
int pm_run(pm_workspace *w, const double *param);
/* No ask has an answer: the case failed. */
void pm_run_fail_asks(pm_workspace *w);
/* Only the start of a case, ready for its first phase (rows built, projected, accelerations known). */
int pm_run_start(pm_workspace *w, const double *param, pm_start_report *report);

#endif
