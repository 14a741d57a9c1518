/* ida_sparse.h - the linear systems of Newton's iteration where there are many unknowns, by KLU. */
#ifndef PM_IDA_SPARSE_H
#define PM_IDA_SPARSE_H

#include "routes/ida/ida.h"

/* Is the phase one of many unknowns? */
int pm_ida_sparse_serves(const pm_workspace *w);
/* Memory for the most active rows that the scene can have. */
int pm_ida_sparse_create(pm_workspace *w);
void pm_ida_sparse_free(pm_workspace *w);
/* Factors the blocks of w->ida->jacobian; PM_SINGULAR if the rows depend on each other, PM_SOLVER if the rest has no pivot,
 * PM_NO_MEMORY. */
int pm_ida_sparse_factor(pm_workspace *w);
/* Of b, all unknowns of the phase: q[nq], vl[nq + nactive] = (v, L) and mu[nactive]. */
void pm_ida_sparse_solve(pm_workspace *w, const double *b, double *q, double *vl, double *mu);

#endif
