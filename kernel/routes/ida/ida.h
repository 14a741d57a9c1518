/* ida.h - what the files of the ida route share.
 *
 *   route_ida.c     the route: begin, step, at, exact
 *   ida_clock.c     the time that IDA's steps sum up to
 *   ida_system.c    unknowns, residual, error weights
 *   ida_jacobian.c  the blocks of the Newton matrix
 *   ida_slopes.c    derivatives of forces, and of what is integrated along
 *   ida_linear.c    their elimination, as a linear solver of SUNDIALS
 *   ida_sparse.c    the same for many unknowns
 *   ida_rounding.c  rounding of the unknowns
 *   ida_newton.c    the end of Newton's iteration
 *   ida_vector.c    vector operations
 *   ida_library.c   versions of SUNDIALS
 *
 * Unknowns y = (q, v, z, L, Mu) with L' = lambda and Mu' = mu, one of each for an active constraint. */
#ifndef PM_IDA_H
#define PM_IDA_H

#include <ida/ida.h>

#include "numerics/tolerances.h"
#include "state/workspace.h"

/* 1: vectors, matrix, linear solver and Jacobian (by differences) of the library, to measure what ours save.
 * The library's vectors have a fixed length: constraints that are not active get the equations L' = 0, Mu' = 0. */
#ifndef PM_IDA_STOCK
#define PM_IDA_STOCK 0
#endif

typedef struct pm_ida_sparse pm_ida_sparse;
typedef struct pm_action_slope pm_action_slope;

/* Blocks of dF/dy + cj dF/dy', row-major, and what solves with them. */
typedef struct pm_ida_jacobian {
    int nactive;
    double cj;
    double *g, *h;    /* [nconstraint][nq] gradients of the constraints, and the directions of their forces */
    double *gv_slope; /* [nconstraint][nq] d(G v)/dq */
    double *stiffness; /* [nq][nq] M^-1 d(f + H^T lambda)/dq */
    double *damping;   /* [nq][nq] M^-1 df/dv */
    double *ledger; /* [nconstraint + 2 nq][nz] dz'/dlambda, dz'/dq, dz'/dv: by columns, as all that follow */
    double *schur;  /* [nactive][nactive] Cholesky factor of G M^-1 G^T */
    double *inverse_schur; /* [nactive][nactive] */
    double *share;         /* [nq][nactive] (G M^-1 G^T)^-1 G */
    double *spread;        /* [nactive][nq] M^-1 G^T (G M^-1 G^T)^-1 */
    double *project;       /* [nq][nq] 1 - M^-1 G^T (G M^-1 G^T)^-1 G */
    double *bend;          /* [nbend][nq + nactive] stiffness and -gv_slope */
    double *system;        /* [nq + nactive][nq + nactive] the inverse in (v, L) */
    int *pivot;            /* [nq + nconstraint] */
    int *bending;          /* [nq] coordinates that `bend` is of */
    int nbend;
    double independence;    /* least independent part of a row of G, of that row, at the last matrix */
    int known;              /* the factors are of this phase */
    int fresh;              /* nothing is known of how well they serve */
    int sparse;             /* there are many unknowns: ida_sparse.c */
    double *scale;          /* [nq + nconstraint] of the unknowns of `system` */
    double *work;           /* scratch of a solution */
    double *force;          /* [nq] f + H^T lambda but for inner reactions */
    pm_action_slope *slope; /* scratch of ida_slopes.c */
    int has_forces;         /* some force may depend on positions */
    int has_damping;        /* and some on velocities */
} pm_ida_jacobian;

/* How far rounding moves each unknown. */
typedef struct pm_ida_rounding {
    double *all;      /* [n] */
    double *own;      /* [n] of the numbers themselves */
    double *residual; /* [n] of what is left of the equations */
    double *timed;    /* [nq + nz_controlled] of v' and z', by that of the time at which forces are taken */
    double *shift;    /* [n] scratch */
    double *
        driven; /* [nconstraint][2] greatest rate that was prescribed in the phase, and greatest rate of it */
} pm_ida_rounding;

/* IDA's clock. */
typedef struct pm_ida_clock {
    double now;   /* what it shows after the last step, s */
    double ahead; /* of the time that the steps sum up to, s; 0 where nothing follows the time */
    int matters;  /* something does */
} pm_ida_clock;

typedef struct pm_ida {
    /* the phase */
    int n;      /* unknowns */
    int stride; /* places of L, and of Mu: the active constraints (PM_IDA_STOCK: all constraints) */
    /* SUNDIALS */
    SUNContext context;
    void *memory;
    N_Vector y, yp; /* solution as returned by the last step */
    N_Vector dense; /* values inside it */
    N_Vector id;    /* 1: under error control */
    SUNMatrix matrix;
    SUNLinearSolver solver;
    SUNNonlinearSolver newton;
    double first_change; /* of Newton's iteration in this step, in error weights */
    double left_over;    /* of a change: what it is believed to leave */
    pm_ida_rounding rounding;
    int most;         /* unknowns with all constraints active */
    double tolerance; /* of IDA */
    double *weight;   /* [most] reciprocal of the allowed errors, rounding left aside */
    pm_ida_clock clock;
    double first, last; /* the step as integrated: dense output is known there */
    int status;         /* of the kernel inside a function that IDA called, or PM_OK */
    pm_ida_jacobian jacobian;
    pm_ida_sparse *sparse;
} pm_ida;

static inline int pm_ida_place_l(const pm_model *model) { return 2 * model->nq + model->nz; }
static inline int pm_ida_place_mu(const pm_model *model, const pm_ida *ida)
{
    return pm_ida_place_l(model) + ida->stride;
}

/* ---- ida_clock.c ---- */
/* A phase begins at the time t, in which something follows the time, or nothing does. */
void pm_ida_clock_begin(pm_ida *ida, double t, int matters);
/* IDA has made a step, or none; returns its code. */
int pm_ida_clock_follow(pm_ida *ida);
/* The time of what IDA asks for at `shown`, while it tries a step. */
double pm_ida_clock_tried(const pm_ida *ida, double shown);
/* From where the clock shows `shown` until the time t, without rounding. */
double pm_ida_clock_until(const pm_ida *ida, double shown, double t);
/* What the clock shows at the time t of the last step. */
static inline double pm_ida_clock_at(const pm_ida *ida, double t) { return t + ida->clock.ahead; }

/* ---- ida_system.c ---- */
void pm_ida_system_layout(pm_workspace *w);
/* Consistent y, y' at w->state; the frame becomes DYNAMIC there. */
int pm_ida_system_start(pm_workspace *w, double *y, double *yp);
/* Looks at (t, y) with accelerations and reactions from y': a DYNAMIC frame, and no linear system solved. */
void pm_ida_system_look(pm_workspace *w, double t, const double *y, const double *yp);
/* r = F(t, y, y'); 0 where some of it is not finite. */
int pm_ida_system_residual(pm_workspace *w, double t, const double *y, const double *yp, double *r);
/* Tolerance and the reciprocal of what each unknown may err by, from the scales of the case; the constraints must
 * be evaluated. */
void pm_ida_system_scale(pm_workspace *w);
/* Error weights at y. */
void pm_ida_system_weights(const pm_model *model, const pm_ida *r, const double *y, double *weight);

/* ---- ida_jacobian.c ---- */
/* Memory for the most active constraints that the scene can have. */
int pm_ida_jacobian_create(pm_arena *arena, pm_ida_jacobian *x, const pm_model *m);
/* All blocks at (t, y, y'). */
void pm_ida_jacobian_evaluate(pm_workspace *w, double t, double cj, const double *y, const double *yp);

/* ---- ida_slopes.c ---- */
/* d f/dq and d f/dv at the frame, added to stiffness and damping (not yet times M^-1), and the columns of `ledger` for the
 * work of forces, paths and the turning plane. */
void pm_ida_slopes_forces(pm_workspace *w);
/* The derivatives of the work of sliding contacts, drives and the turning plane by reactions. */
void pm_ida_slopes_power(pm_workspace *w);
/* What a force of `size` along an evaluated constraint makes of the integral z of its power; turn: how the rate of the
 * constraint changes with positions. */
void pm_ida_slopes_rub(pm_workspace *w, int z, const pm_constraint *c, const double *turn, double size);
/* The columns for the momentum of the scene, from all that is in h, force, stiffness and damping before these are times M^-1. */
void pm_ida_slopes_momentum(pm_workspace *w);

/* ---- ida_linear.c ---- */
/* Inverts the blocks of w->ida->jacobian; PM_SINGULAR if the constraints depend on each other, PM_SOLVER if the
 * rest has no pivot. */
int pm_ida_linear_factor(pm_workspace *w);
/* Scales of the unknowns (v, L): the square roots of M^-1 and the reciprocal ones of square[nactive], which is the diagonal of
 * G M^-1 G^T, each entry `stride` places after the last. */
void pm_ida_linear_scale(const pm_workspace *w, const double *square, int stride);
/* J x = b for all unknowns of the phase; x may be b. */
void pm_ida_linear_solve(const pm_model *model, pm_ida *ida, const double *b, double *x);

/* pm_projection_apply by the constraints of the last matrix, if it is of this phase and what they are missed by is slight. */
int pm_ida_linear_project(pm_workspace *w, pm_state *s);

/* The same as objects of SUNDIALS; NULL: out of memory.  The workspace must outlive them. */
SUNMatrix pm_ida_linear_matrix(SUNContext context);
SUNLinearSolver pm_ida_linear_solver(pm_workspace *w, SUNContext context);
void pm_ida_linear_free(SUNMatrix matrix, SUNLinearSolver solver);
/* Jacobian function for IDA: evaluates the blocks. */
int pm_ida_linear_jacobian(double t, double cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix,
                           void *workspace, N_Vector a, N_Vector b, N_Vector c);

/* ---- ida_sparse.c ---- */
/* Is the phase one of many unknowns? */
int pm_ida_sparse_serves(const pm_model *model, const pm_active_set *active);
/* Memory for the most active constraints that the scene can have. */
int pm_ida_sparse_create(pm_workspace *w);
/* Factors the blocks of w->ida->jacobian; PM_SINGULAR if the constraints depend on each other, PM_SOLVER if the rest has
 * no pivot, PM_NO_MEMORY. */
int pm_ida_sparse_factor(pm_workspace *w);
/* Of b, all unknowns of the phase: q[nq], vl[nq + nactive] = (v, L) and mu[nactive]. */
void pm_ida_sparse_solve(const pm_model *model, pm_ida *ida, const double *b, double *q, double *vl,
                         double *mu);

/* ---- ida_rounding.c ---- */
int pm_ida_rounding_create(pm_arena *arena, pm_ida_rounding *x, const pm_model *m, int most);
/* Of all unknowns at y, where the constraints are evaluated; slope: d(G v)/dq, or NULL where it is not known. */
void pm_ida_rounding_find(pm_workspace *w, const double *y, const double *slope);
/* The same where the last matrix, which has just been factored, makes more of it. */
void pm_ida_rounding_solve(pm_workspace *w);
/* Of unknown i at a value that has grown since. */
static inline double pm_ida_rounding_at(const pm_ida_rounding *x, int i, double y)
{
    const double now = PM_EPSILON * (y < 0 ? -y : y);
    return x->all[i] > now ? x->all[i] : now;
}

/* ---- ida_newton.c ---- */
int pm_ida_newton_create(pm_workspace *w);

/* ---- ida_vector.c ---- */
/* A vector with room for `most` numbers, all 0, of which *length count at any time; `length` must outlive
 * it and all its clones.  NULL: out of memory. */
N_Vector pm_ida_vector_create(SUNContext context, const int *length, int most);

/* ---- ida_library.c ---- */
/* A context of its own for each thread; *context = NULL on failure.  Returns SUNDIALS' code. */
int pm_ida_library_open(SUNContext *context);
/* Nothing that IDA has to say is printed: what went wrong comes back as a code. */
int pm_ida_library_silence(void *memory);

#endif
