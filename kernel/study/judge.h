/* judge.h - errors and margin of the main pass. */
#ifndef PM_JUDGE_H
#define PM_JUDGE_H

#include "state/workspace.h"

/* By the pass that the main one is compared with: error[nout] in the unit of out, NaN where there is none; excess and margin
 * in trust[PM_TRUSTS]. */
void pm_judge(pm_workspace *w, double *error, double *trust);

/* What a pass at a tighter tolerance, e->spare, shows of the main one's errors, which may have seemed smaller by chance; the greatest over what
 * the accuracy asked allows. */
double pm_judge_again(const pm_workspace *w, double *error);
/* Whether the difference to a main pass before, which is e->other and e->before, is as much smaller than the errors of that one
 * as they go with the tolerance, or rounding. */
int pm_judge_goes_with_tolerance(const pm_workspace *w);

#endif
