/* ida.h - what the files of the ida route share.
 *
 *   route_ida.c     the route: begin, step, at, exact
 *   ida_system.c    unknowns, residual, error weights
 *   ida_jacobian.c  the blocks of the Newton matrix
 *   ida_linear.c    their elimination, as a linear solver of SUNDIALS
 *   ida_sparse.c    the same for many unknowns
 *   ida_root.c      event functions
 *   ida_vector.c    vector operations
 *   ida_library.c   versions of SUNDIALS
 *
 * Unknowns y = (q, v, z, L, Mu) with L' = lambda and Mu' = mu, one of each for an active row. */
#ifndef PM_IDA_H
#define PM_IDA_H

#include <ida/ida.h>

#include "state/workspace.h"

/* 1: vectors, matrix, linear solver and Jacobian (by differences) of the library, to measure what ours save.
 * The library's vectors have a fixed length: rows that are not active get the equations L' = 0, Mu' = 0. */
#ifndef PM_IDA_STOCK
#define PM_IDA_STOCK 0
#endif

typedef struct pm_ida_sparse pm_ida_sparse;

/* Blocks of dF/dy + cj dF/dy', row-major, and what solves with them. */
typedef struct pm_ida_jacobian {
    int nactive;
    double cj;
    double *g, *h;         /* [nrow][nq] rows and the directions of their forces */
    double *turn;          /* [nrow][nq] d(G v)/dq */
    double *stiffness;     /* [nq][nq] M^-1 d(f + H^T lambda)/dq */
    double *damping;       /* [nq][nq] M^-1 df/dv */
    double *ledger;        /* [nrow + 2 nq][nz] dz'/dlambda, dz'/dq, dz'/dv: by columns, as all that follow */
    double *schur;         /* [nactive][nactive] Cholesky factor of G M^-1 G^T */
    double *inverse_schur; /* [nactive][nactive] */
    double *share;         /* [nq][nactive] (G M^-1 G^T)^-1 G */
    double *spread;        /* [nactive][nq] M^-1 G^T (G M^-1 G^T)^-1 */
    double *project;       /* [nq][nq] 1 - M^-1 G^T (G M^-1 G^T)^-1 G */
    double *bend;          /* [nbend][nq + nactive] stiffness and -turn */
    double *system;        /* [nq + nactive][nq + nactive] the inverse in (v, L) */
    int *pivot;            /* [nq + nrow] */
    int *bending;          /* [nq] coordinates that `bend` is of */
    int nbend;
    double independence; /* least independent part of a row, of the row, at the last matrix */
    int known;           /* the factors are of this phase */
    int sparse;          /* there are many unknowns: ida_sparse.c */
    double *scale;       /* [nq + nrow] of the unknowns of `system` */
    double *work;        /* scratch of the differences and of a solution */
    int has_forces;      /* some force may depend on positions */
    int has_damping;     /* and some on velocities */
} pm_ida_jacobian;

typedef struct pm_ida {
    /* the phase */
    int n;      /* unknowns */
    int stride; /* places of L, and of Mu: the active rows (PM_IDA_STOCK: all rows) */
    /* SUNDIALS */
    SUNContext context;
    void *memory;
    N_Vector y, yp; /* solution as returned by the last step */
    N_Vector dense; /* values inside it */
    N_Vector id;    /* 1: under error control */
    SUNMatrix matrix;
    SUNLinearSolver solver;
    int most;           /* unknowns with all rows active */
    double tolerance;   /* of IDA */
    double *weight;     /* [most] reciprocal of the allowed errors, rounding left aside */
    double first, last; /* the step as integrated: dense output is known there */
    int status;         /* of the kernel inside a function that IDA called, or PM_OK */
    pm_ida_jacobian jacobian;
    pm_ida_sparse *sparse;
    struct pm_ida_roots *roots;
    void *block;
} pm_ida;

static inline int pm_ida_place_l(const pm_workspace *w) { return 2 * w->model->nq + w->model->nz; }
static inline int pm_ida_place_mu(const pm_workspace *w) { return pm_ida_place_l(w) + w->ida->stride; }

#endif
