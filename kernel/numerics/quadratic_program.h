/* quadratic_program.h - the least s.K s / 2 + c.s over all s[k] with A s + b >= 0; with K = 0 a linear program.
 *
 * Its conditions of optimality are a linear complementarity problem with a matrix that is not negative, which Lemke's method
 * solves or shows to have no solution.  [R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, 2009,
 * ch. 1.2 and 4.4] */
#ifndef PM_QUADRATIC_PROGRAM_H
#define PM_QUADRATIC_PROGRAM_H

#include <stddef.h>

#include "numerics/lemke.h"

/* Unknowns of the complementarity problem, doubles and integers of scratch. */
#define PM_QUADRATIC_ORDER(k, n) (2 * (size_t)(k) + (size_t)(n))
#define PM_QUADRATIC_SCRATCH(k, n) \
    (PM_QUADRATIC_ORDER(k, n) * (PM_QUADRATIC_ORDER(k, n) + 2) + PM_LEMKE_SCRATCH(PM_QUADRATIC_ORDER(k, n)))

typedef struct pm_quadratic_program {
    int k, n;
    const double *K; /* [k][k] symmetric, not negative; NULL: 0 */
    const double *c; /* [k] */
    const double *A; /* [n][k], scaled to about one, as all that is given */
    const double *b; /* [n] */
    double *s;       /* [k] found */
    double *bound;   /* [n] found: multipliers; > 0 where the condition bounds the minimum */
    double *scratch; /* [PM_QUADRATIC_SCRATCH(k, n)] */
    int *basis;      /* [PM_QUADRATIC_ORDER(k, n)] scratch */
} pm_quadratic_program;

/* 1; 0 where nothing meets all conditions, or there is no least value. */
int pm_quadratic_program_solve(const pm_quadratic_program *x);

#endif
