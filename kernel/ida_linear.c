/* ida_linear.c - block elimination of dF/dy + cj dF/dy'.
 *
 * With W = M^-1, K = W d(f + H^T lambda)/dq, D = W df/dv, N = d(G v)/dq and Z = dz'/d(lambda, q, v):
 *
 *   cj dq - dv + cj W G^T dMu = b1
 *   cj dv - K dq - D dv - cj W H^T dL = b2
 *   cj dz - Z (cj dL, dq, dv) = b3
 *   G dq = b4
 *   N dq + G dv = b5
 *
 * The first and fourth give dq, with S = G W G^T (Cholesky), X = W G^T S^-1 and u = (b1 + dv)/cj:
 *   dMu = S^-1 (G u - b4),   dq = u - X (G u - b4) = d0 + (1 - X G) dv / cj,
 * which leaves one system of nq + nactive equations (LU), scaled by the square roots of W and S:
 *   [1 - D/cj - K (1 - X G)/cj^2   -W H^T] [dv]   [(b2 + K d0)/cj]
 *   [G + N (1 - X G)/cj             0    ] [dL] = [b5 - N d0     ]
 * and then dz.  An eighth of the work of a dense LU on all unknowns, and less than that without z. */
#include "ida_linear.h"

#include <math.h>
#include <string.h>

#include "dense.h"
#include "ida_jacobian.h"

/* y = a x or y -= a x for a matrix of m rows and n columns, leading dimension `ld`. */
static void times(int m, int n, int ld, const double *a, const double *x, double *y)
{
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += a[i * ld + k] * x[k];
        y[i] = sum;
    }
}

static void take_away(int m, int n, int ld, const double *a, const double *x, double *y)
{
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += a[i * ld + k] * x[k];
        y[i] -= sum;
    }
}

/* S, its Cholesky factor, X; the scale of L from the diagonal of S. */
static int factor_rows(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, nrow = w->model->nrow, na = j->nactive;
    for (int r = 0; r < na; r++)
        for (int c = 0; c <= r; c++) {
            double sum = 0;
            for (int k = 0; k < nq; k++) sum += j->g[r * nq + k] * w->inverse_mass[k] * j->g[c * nq + k];
            j->schur[r * na + c] = sum;
        }
    for (int r = 0; r < na; r++) j->scale[nq + r] = 1 / sqrt(j->schur[r * na + r]);
    const int bad = pm_cholesky_factor(na, j->schur);
    if (bad) return pm_fail(w, PM_SINGULAR, PM_TABLE_JOINT, w->row[bad - 1].joint, 0, 0);
    for (int k = 0; k < nq; k++) {
        double *x = j->spread + k * nrow;
        for (int r = 0; r < na; r++) x[r] = w->inverse_mass[k] * j->g[r * nq + k];
        pm_cholesky_solve(na, j->schur, x);
    }
    return PM_OK;
}

/* One row of a (1 - X G) into `out`: a has nq numbers. */
static void on_rows(const pm_workspace *w, const double *a, double *out)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, nrow = w->model->nrow, na = j->nactive;
    memcpy(out, a, (size_t)nq * sizeof *a);
    for (int r = 0; r < na; r++) {
        double sum = 0;
        for (int k = 0; k < nq; k++) sum += a[k] * j->spread[k * nrow + r];
        for (int k = 0; k < nq; k++) out[k] -= sum * j->g[r * nq + k];
    }
}

int pm_ida_linear_factor(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive, n = nq + na;
    const double ic = 1 / j->cj, *im = w->inverse_mass;
    const int status = factor_rows(w);
    if (status) return status;
    double *s = j->scale;
    for (int i = 0; i < nq; i++) s[i] = im[i] > 0 ? sqrt(im[i]) : 1;
    for (int i = 0; i < nq; i++) {
        double *row = j->system + i * n;
        on_rows(w, j->stiffness + i * nq, row);
        for (int k = 0; k < nq; k++) {
            const double damping = j->has_damping ? j->damping[i * nq + k] : 0;
            row[k] = ((i == k) - ic * (damping + ic * row[k])) * s[k] / s[i];
        }
        for (int r = 0; r < na; r++) row[nq + r] = -im[i] * j->h[r * nq + i] * s[nq + r] / s[i];
    }
    for (int r = 0; r < na; r++) {
        double *row = j->system + (nq + r) * n;
        on_rows(w, j->turn + r * nq, row);
        for (int k = 0; k < nq; k++) row[k] = s[nq + r] * (j->g[r * nq + k] + ic * row[k]) * s[k];
        memset(row + nq, 0, (size_t)na * sizeof *row);
    }
    w->count[PM_COUNT_SOLVES]++;
    return pm_lu_factor(n, j->system, j->pivot) ? PM_SOLVER : PM_OK;
}

void pm_ida_linear_solve(pm_workspace *w, const double *b, double *x)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, nz = w->model->nz, nrow = w->model->nrow, na = j->nactive, n = nq + na;
    const int l = pm_ida_place_l(w), mu = pm_ida_place_mu(w);
    const double ic = 1 / j->cj, *s = j->scale;
    double *u = j->work, *d0 = u + nq, *e = d0 + nq, *f = e + nrow;
    for (int i = 0; i < nq; i++) u[i] = d0[i] = ic * b[i];
    times(na, nq, nq, j->g, u, e);
    for (int r = 0; r < na; r++) e[r] -= b[l + r];
    take_away(nq, na, nrow, j->spread, e, d0);
    times(nq, nq, nq, j->stiffness, d0, f);
    times(na, nq, nq, j->turn, d0, f + nq);
    for (int i = 0; i < nq; i++) f[i] = ic * (b[nq + i] + f[i]) / s[i];
    for (int r = 0; r < na; r++) f[nq + r] = (b[mu + r] - f[nq + r]) * s[nq + r];
    pm_lu_solve(n, j->system, j->pivot, f);
    for (int i = 0; i < n; i++) f[i] *= s[i];
    for (int i = 0; i < nq; i++) u[i] += ic * f[i];
    times(na, nq, nq, j->g, u, e);
    for (int r = 0; r < na; r++) e[r] -= b[l + r];
    take_away(nq, na, nrow, j->spread, e, u);
    pm_cholesky_solve(na, j->schur, e);
    for (int i = 0; i < nz; i++) {
        const double *z = j->ledger + i * (nrow + 2 * nq), *zq = z + nrow, *zv = zq + nq;
        double sum = b[2 * nq + i], by_reactions = 0;
        for (int k = 0; k < nq && j->has_forces; k++) sum += zq[k] * u[k];
        for (int k = 0; k < nq && j->has_damping; k++) sum += zv[k] * f[k];
        for (int r = 0; r < na; r++) by_reactions += z[r] * f[nq + r];
        x[2 * nq + i] = ic * sum + by_reactions;
    }
    memcpy(x, u, (size_t)nq * sizeof *x);
    memcpy(x + nq, f, (size_t)nq * sizeof *x);
    memcpy(x + l, f + nq, (size_t)na * sizeof *x);
    memcpy(x + mu, e, (size_t)na * sizeof *x);
}

/* ---- objects of SUNDIALS: the blocks are the matrix ---- */
static SUNMatrix_ID matrix_id(SUNMatrix matrix)
{
    (void)matrix;
    return SUNMATRIX_CUSTOM;
}

static int nothing_to_clear(SUNMatrix matrix)
{
    (void)matrix;
    return 0;
}

SUNMatrix pm_ida_linear_matrix(SUNContext context)
{
    SUNMatrix matrix = SUNMatNewEmpty(context);
    if (!matrix) return NULL;
    matrix->content = NULL;
    matrix->ops->getid = matrix_id;
    matrix->ops->zero = nothing_to_clear;
    return matrix;
}

int pm_ida_linear_jacobian(double t, double cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix,
                           void *workspace, N_Vector a, N_Vector b, N_Vector c)
{
    (void)r;
    (void)matrix;
    (void)a;
    (void)b;
    (void)c;
    pm_ida_jacobian_evaluate(workspace, t, cj, N_VGetArrayPointer(y), N_VGetArrayPointer(yp));
    return 0;
}

static SUNLinearSolver_Type solver_type(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_DIRECT;
}

static SUNLinearSolver_ID solver_id(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_CUSTOM;
}

/* > 0: IDA may try a smaller step. */
static int setup(SUNLinearSolver solver, SUNMatrix matrix)
{
    pm_workspace *w = solver->content;
    (void)matrix;
    const int status = pm_ida_linear_factor(w);
    if (status == PM_SINGULAR) w->ida->status = status; /* else it is IDA's to say what failed */
    return status ? 1 : 0;
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, double tolerance)
{
    (void)matrix;
    (void)tolerance;
    pm_ida_linear_solve(solver->content, N_VGetArrayPointer(b), N_VGetArrayPointer(x));
    return 0;
}

SUNLinearSolver pm_ida_linear_solver(pm_workspace *w, SUNContext context)
{
    SUNLinearSolver solver = SUNLinSolNewEmpty(context);
    if (!solver) return NULL;
    solver->content = w;
    solver->ops->gettype = solver_type;
    solver->ops->getid = solver_id;
    solver->ops->setup = setup;
    solver->ops->solve = solve;
    return solver;
}

void pm_ida_linear_free(SUNMatrix matrix, SUNLinearSolver solver)
{
    if (matrix) SUNMatFreeEmpty(matrix);
    if (solver) {
        solver->content = NULL; /* the workspace is not its own */
        SUNLinSolFreeEmpty(solver);
    }
}
