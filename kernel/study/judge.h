/* judge.h - errors and margin of the main pass. */
#ifndef PM_JUDGE_H
#define PM_JUDGE_H

#include "state/workspace.h"

/* By the pass that the main one is compared with: error[nout] in the unit of out, NaN where there is none; excess and margin
 * in trust[PM_TRUSTS]. */
void pm_judge(pm_workspace *w, double *error, double *trust);

#endif
