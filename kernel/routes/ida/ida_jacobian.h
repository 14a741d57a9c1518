/* ida_jacobian.h - the blocks of the Newton matrix. */
#ifndef PM_IDA_JACOBIAN_H
#define PM_IDA_JACOBIAN_H

#include "routes/ida/ida.h"

/* Numbers of doubles and ints that the blocks need; places them in memory of that size. */
size_t pm_ida_jacobian_doubles(const pm_model *m);
size_t pm_ida_jacobian_ints(const pm_model *m);
void pm_ida_jacobian_place(pm_ida_jacobian *x, const pm_model *m, double *doubles, int *ints);
/* All blocks at (t, y, y'). */
void pm_ida_jacobian_evaluate(pm_workspace *w, double t, double cj, const double *y, const double *yp);

#endif
