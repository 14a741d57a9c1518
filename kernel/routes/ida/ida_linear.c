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
 * The first and fourth give dq, with S = G W G^T (Cholesky), Y = S^-1 G and P = 1 - W Y^T G:
 *   dMu = Y (b1 + dv)/cj - S^-1 b4,   dq = P (b1 + dv)/cj + W Y^T b4 = d0 + P dv / cj,
 * which leaves one system of nq + nactive equations, scaled by the square roots of W and S:
 *   [1 - D/cj - K P/cj^2   -W H^T] [dv]   [(b2 + K d0)/cj]
 *   [G + N P/cj             0    ] [dL] = [b5 - N d0     ]
 * and then dz.  An eighth of the work of a dense LU on all unknowns, and less than that without z.
 *
 * Many systems are solved with one matrix: inverses are formed, and all matrices kept by columns, because a
 * sum of columns runs several rows at once where substitution waits for each number before the next. */
#include "routes/ida/ida.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

static void add_columns(int m, int n, const double *restrict a, const double *restrict x, double *restrict y)
{
    int k = 0;
    for (; k + 1 < n; k += 2) {
        const double *left = a + k * m, *right = left + m, p = x[k], q = x[k + 1];
        for (int i = 0; i < m; i++) y[i] += left[i] * p + right[i] * q;
    }
    if (k < n)
        for (int i = 0; i < m; i++) y[i] += a[k * m + i] * x[k];
}

void pm_ida_linear_scale(const pm_workspace *w, const double *square, int stride)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const double *im = w->numbers.inverse_mass;
    const int nq = w->model->nq;
    for (int i = 0; i < nq; i++) j->scale[i] = im[i] > 0 ? sqrt(im[i]) : 1;
    for (int r = 0; r < j->nactive; r++) j->scale[nq + r] = 1 / sqrt(square[r * stride]);
}

/* S, its inverse; the scale of L from the diagonal of S. */
static int invert_constraints(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive;
    double *const s = j->schur, *const unit = j->work;
    for (int r = 0; r < na; r++)
        for (int c = 0; c <= r; c++) {
            double sum = 0;
            for (int k = 0; k < nq; k++)
                sum += j->g[r * nq + k] * w->numbers.inverse_mass[k] * j->g[c * nq + k];
            s[r * na + c] = sum;
        }
    pm_ida_linear_scale(w, s, na + 1);
    const int bad = pm_dense_cholesky_factor(na, s);
    j->independence = 0;
    if (bad)
        return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_JOINT, w->active.constraint[bad - 1].joint, 0, 0);
    j->independence = 1;
    for (int r = 0; r < na; r++) j->independence = fmin(j->independence, s[r * na + r] * j->scale[nq + r]);
    for (int r = 0; r < na; r++) {
        memset(unit, 0, (size_t)na * sizeof *unit);
        unit[r] = 1;
        pm_dense_cholesky_solve(na, s, unit);
        memcpy(j->inverse_schur + r * na, unit, (size_t)na * sizeof *unit);
    }
    return PM_OK;
}

/* Y, W Y^T and P, each by columns. */
static void project_on_constraints(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive;
    memset(j->share, 0, (size_t)(nq * na) * sizeof *j->share);
    for (int k = 0; k < nq; k++)
        for (int r = 0; r < na; r++) {
            const double g = j->g[r * nq + k], *s = j->inverse_schur + r * na;
            for (int c = 0; c < na && g != 0; c++) j->share[k * na + c] += g * s[c];
        }
    for (int r = 0; r < na; r++)
        for (int k = 0; k < nq; k++)
            j->spread[r * nq + k] = w->numbers.inverse_mass[k] * j->share[k * na + r];
    for (int k = 0; k < nq; k++) {
        double *p = j->project + k * nq;
        memset(p, 0, (size_t)nq * sizeof *p);
        p[k] = 1;
        for (int r = 0; r < na; r++) {
            const double g = j->g[r * nq + k], *x = j->spread + r * nq;
            for (int i = 0; i < nq && g != 0; i++) p[i] -= g * x[i];
        }
    }
}

/* One row of a P into `out`: a has nq numbers, most of them 0. */
static void project_row(const pm_workspace *w, const double *a, double *out)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive;
    double *const sum = j->work;
    memcpy(out, a, (size_t)nq * sizeof *a);
    memset(sum, 0, (size_t)na * sizeof *sum);
    for (int k = 0; k < nq; k++) {
        const double weight = a[k] * w->numbers.inverse_mass[k], *y = j->share + k * na;
        for (int r = 0; r < na && weight != 0; r++) sum[r] += weight * y[r];
    }
    for (int r = 0; r < na; r++) {
        const double *g = j->g + r * nq;
        for (int k = 0; k < nq && sum[r] != 0; k++) out[k] -= sum[r] * g[k];
    }
}

/* The scaled system, transposed: its inverse is wanted by columns. */
static void fill_system(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive, n = nq + na;
    const double ic = 1 / j->cj, *im = w->numbers.inverse_mass;
    double *const s = j->scale, *const a = j->system, *const row = j->work + na;
    for (int i = 0; i < nq; i++) {
        project_row(w, j->stiffness + i * nq, row);
        for (int k = 0; k < nq; k++) {
            const double damping = j->has_damping ? j->damping[i * nq + k] : 0;
            a[k * n + i] = ((i == k) - ic * (damping + ic * row[k])) * s[k] / s[i];
        }
        for (int r = 0; r < na; r++) a[(nq + r) * n + i] = -im[i] * j->h[r * nq + i] * s[nq + r] / s[i];
    }
    for (int r = 0; r < na; r++) {
        project_row(w, j->gv_slope + r * nq, row);
        for (int k = 0; k < nq; k++) a[k * n + nq + r] = s[nq + r] * (j->g[r * nq + k] + ic * row[k]) * s[k];
        for (int c = 0; c < na; c++) a[(nq + c) * n + nq + r] = 0;
    }
}

/* Takes the scales off the inverse again, and 1/cj of the upper right-hand side into it. */
static void take_scales(const pm_model *model, const struct pm_ida *ida)
{
    const pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, n = nq + j->nactive;
    const double *s = j->scale;
    for (int k = 0; k < n; k++) {
        const double right = k < nq ? 1 / (j->cj * s[k]) : s[k];
        for (int i = 0; i < n; i++) j->system[k * n + i] *= right * s[i];
    }
}

/* (K; -N) by columns, those of zeros left out: what moves without a rotation bends nothing. */
static void pack_bends(const pm_model *model, struct pm_ida *ida)
{
    pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, na = j->nactive, n = nq + na;
    j->nbend = 0;
    for (int k = 0; k < nq; k++) {
        double *column = j->bend + j->nbend * n;
        int any = 0;
        for (int i = 0; i < nq; i++) any |= (column[i] = j->stiffness[i * nq + k]) != 0;
        for (int r = 0; r < na; r++) any |= (column[nq + r] = -j->gv_slope[r * nq + k]) != 0;
        if (any) j->bending[j->nbend++] = k;
    }
}

static int factor_dense(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int status = invert_constraints(w);
    if (status) return status;
    project_on_constraints(w);
    fill_system(w);
    if (pm_dense_lu_invert(w->model->nq + j->nactive, j->system, j->pivot)) return PM_SOLVER;
    take_scales(w->model, w->ida);
    pack_bends(w->model, w->ida);
    return PM_OK;
}

int pm_ida_linear_factor(pm_workspace *w)
{
    pm_ida_jacobian *j = &w->ida->jacobian;
    const int status = j->sparse ? pm_ida_sparse_factor(w) : factor_dense(w);
    w->result.count[PM_COUNT_SOLVES]++;
    j->known = !status;
    j->fresh = 1;
    return status;
}

/* As pm_ida_sparse_solve; work[3 nq + nactive]. */
static void solve_dense(const pm_model *model, const struct pm_ida *ida, const double *b, double *q,
                        double *vl, double *mu, double *work)
{
    const pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, na = j->nactive, n = nq + na;
    const double ic = 1 / j->cj, *b4 = b + pm_ida_place_l(model), *b5 = b + pm_ida_place_mu(model, ida);
    double *u = work, *bent = u + nq, *f = bent + nq;
    for (int i = 0; i < nq; i++) {
        u[i] = ic * b[i];
        q[i] = 0;
    }
    add_columns(nq, nq, j->project, u, q);
    add_columns(nq, na, j->spread, b4, q);
    memcpy(f, b + nq, (size_t)nq * sizeof *f);
    memcpy(f + nq, b5, (size_t)na * sizeof *f);
    for (int i = 0; i < j->nbend; i++) bent[i] = q[j->bending[i]];
    add_columns(n, j->nbend, j->bend, bent, f);
    memset(vl, 0, (size_t)n * sizeof *vl);
    add_columns(n, n, j->system, f, vl);
    for (int i = 0; i < nq; i++) f[i] = ic * vl[i];
    add_columns(nq, nq, j->project, f, q);
    for (int i = 0; i < nq; i++) u[i] += f[i];
    for (int r = 0; r < na; r++) f[r] = -b4[r];
    memset(mu, 0, (size_t)na * sizeof *mu);
    add_columns(na, na, j->inverse_schur, f, mu);
    add_columns(na, nq, j->share, u, mu);
}

/* z, in place of b3. */
static void solve_ledger(const pm_model *model, const struct pm_ida *ida, const double *q, const double *vl,
                         double *z)
{
    const pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, nz = model->nz, nactive = model->nconstraint;
    if (j->has_forces) add_columns(nz, nq, j->ledger + nz * nactive, q, z);
    if (j->has_damping) add_columns(nz, nq, j->ledger + nz * (nactive + nq), vl, z);
    for (int i = 0; i < nz; i++) z[i] /= j->cj;
    add_columns(nz, j->nactive, j->ledger, vl + nq, z);
}

void pm_ida_linear_solve(const pm_model *model, struct pm_ida *ida, const double *b, double *x)
{
    const pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, na = j->nactive;
    double *q = j->work, *vl = q + nq, *mu = vl + nq + na, *work = mu + na;
    if (j->sparse)
        pm_ida_sparse_solve(model, ida, b, q, vl, mu);
    else
        solve_dense(model, ida, b, q, vl, mu, work);
    memmove(x + 2 * nq, b + 2 * nq, (size_t)model->nz * sizeof *x);
    solve_ledger(model, ida, q, vl, x + 2 * nq);
    memcpy(x, q, (size_t)nq * sizeof *x);
    memcpy(x + nq, vl, (size_t)nq * sizeof *x);
    memcpy(x + pm_ida_place_l(model), vl + nq, (size_t)na * sizeof *x);
    memcpy(x + pm_ida_place_mu(model, ida), mu, (size_t)na * sizeof *x);
}

/* ---- back on the constraints ---- */
/* The greatest of what the constraints are missed by, in saddle.wanted: by positions, and by velocities. */
static double openings(pm_workspace *w)
{
    pm_saddle_evaluate(&w->active, &w->frame);
    return pm_constraint_openings(w->active.constraint, w->active.n, NULL, w->saddle.wanted);
}

static double slips(pm_workspace *w, const double *v)
{
    return pm_constraint_slips(&w->frame, w->active.constraint, w->active.n, NULL, v, w->saddle.wanted);
}

/* One correction each; whether that was enough. */
static int corrected(pm_workspace *w, pm_state *s)
{
    const double *spread = w->ida->jacobian.spread;
    const int nq = w->model->nq, na = w->active.n;
    pm_frame_look_state(&w->frame, s);
    double worst = openings(w);
    if (!(worst <= PM_IDA_SLIGHT * w->numbers.size)) return 0;
    if (worst > PM_IDA_CORRECTED * w->numbers.size) {
        add_columns(nq, na, spread, w->saddle.wanted, s->q);
        pm_frame_look_state(&w->frame, s);
        if (!(openings(w) <= PM_IDA_CORRECTED * w->numbers.size)) return 0;
    }
    worst = slips(w, s->v);
    if (worst <= PM_IDA_CORRECTED * w->numbers.speed) return 1;
    if (!(worst <= PM_IDA_SLIGHT * w->numbers.speed)) return 0;
    add_columns(nq, na, spread, w->saddle.wanted, s->v);
    if (!(slips(w, s->v) <= PM_IDA_CORRECTED * w->numbers.speed)) return 0;
    pm_frame_look_state(&w->frame, s);
    return 1;
}

int pm_ida_linear_project(pm_workspace *w, pm_state *s)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    return j->known && !j->sparse && corrected(w, s) ? PM_OK : pm_projection_apply(w, s);
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
    pm_workspace *w = workspace;
    pm_ida_jacobian_evaluate(w, pm_ida_clock_tried(w->ida, t), cj, N_VGetArrayPointer(y),
                             N_VGetArrayPointer(yp));
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

/* > 0: IDA may try a smaller step; < 0: that would not help. */
static int setup(SUNLinearSolver solver, SUNMatrix matrix)
{
    pm_workspace *w = solver->content;
    (void)matrix;
    const int status = pm_ida_linear_factor(w);
    if (status == PM_SINGULAR || status == PM_NO_MEMORY)
        w->ida->status = status; /* else it is IDA's to say what failed */
    if (!status) pm_ida_rounding_solve(w);
    return status == PM_NO_MEMORY ? -1 : status != PM_OK;
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, double tolerance)
{
    pm_workspace *w = solver->content;
    (void)matrix;
    (void)tolerance;
    pm_ida_linear_solve(w->model, w->ida, N_VGetArrayPointer(b), N_VGetArrayPointer(x));
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
