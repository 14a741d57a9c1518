/* dense.h - small dense factorisations, the measured hot path.  Row-major, order n, leading dimension n. */
#ifndef PM_DENSE_H
#define PM_DENSE_H

/* A = L L^T in the lower triangle; returns 0, or 1 + the index of a pivot that is not above `tiny` times its
 * diagonal. */
int pm_cholesky_factor(int n, double *a);
void pm_cholesky_solve(int n, const double *a, double *x);
/* P A = L U with partial pivoting; returns 0, or 1 + the column without a pivot. */
int pm_lu_factor(int n, double *a, int *pivot);
void pm_lu_solve(int n, const double *a, const int *pivot, double *x);

#endif
