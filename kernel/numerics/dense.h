/* dense.h - small dense factorisations, the measured hot path.  Row-major, order n, leading dimension n. */
#ifndef PM_DENSE_H
#define PM_DENSE_H

/* A = L L^T in the lower triangle; returns 0, or 1 + the index of a pivot that is not above `tiny` times its
 * diagonal. */
int pm_dense_cholesky_factor(int n, double *a);
void pm_dense_cholesky_solve(int n, const double *a, double *x);
/* The same where row i of A and L begins at column first[i]: what is left of it is zero, and not looked at. */
int pm_dense_skyline_factor(int n, const int *first, double *a);
/* L x = b, where b is zero before `from` and L^-1 b from `to` on, and L^T x = b; in place. */
void pm_dense_skyline_part(int n, int from, int to, const int *first, const double *a, double *x);
void pm_dense_skyline_lower(int n, const int *first, const double *a, double *x);
void pm_dense_skyline_upper(int n, const int *first, const double *a, double *x);
/* P A = L U with partial pivoting; returns 0, or 1 + the column without a pivot. */
int pm_dense_lu_factor(int n, double *a, int *pivot);
void pm_dense_lu_solve(int n, const double *a, const int *pivot, double *x);
/* A^-1 in place; returns 0, or 1 + the column without a pivot. */
int pm_dense_lu_invert(int n, double *a, int *pivot);

/* The same where rows below bottom[j] begin beyond column j, and rows up to bottom[j] end at column right[j]; neither falls
 * with j.  Nothing else of A is looked at.  Factors of one kind are not for the solvers of the other. */
int pm_dense_band_factor(int n, const int *bottom, const int *right, double *a, int *pivot);
void pm_dense_band_solve(int n, const int *bottom, const int *right, const double *a, const int *pivot,
                         double *x);
void pm_dense_band_solve_transposed(int n, const int *bottom, const int *right, const double *a,
                                    const int *pivot, double *x);

#endif
