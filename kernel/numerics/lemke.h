/* lemke.h - the linear complementarity problem of order m: w = M z + q, w >= 0, z >= 0, w_i z_i = 0.
 *
 * Lemke's method with lexicographic pivoting, which cannot cycle. [R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear
 * Complementarity Problem, SIAM 2009, ch. 4.4 and 4.9] */
#ifndef PM_LEMKE_H
#define PM_LEMKE_H

/* Doubles of scratch for order m. */
#define PM_LEMKE_SCRATCH(m) ((size_t)(m) * (2 * (size_t)(m) + 3))

/* z[m] for M[m][m], row-major, and q[m], both scaled to about one; scratch[PM_LEMKE_SCRATCH(m)], basis[m].  Returns 1; or 0
 * where the method ends on a ray, which does not prove that nothing solves the problem: it may do so with another `try`
 * (0, 1, 2, ...), which begins elsewhere. */
int pm_lemke_solve(int m, const double *matrix, const double *q, int try, double *scratch, int *basis,
                   double *z);

#endif
