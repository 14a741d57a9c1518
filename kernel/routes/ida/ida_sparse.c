/* ida_sparse.c - dF/dy + cj dF/dy' where there are many unknowns: the sparse system as it stands, by KLU.
 *
 * The blocks are those of ida_linear.c.  With s = sqrt(W), the unknowns q = s q~/cj, v = s v~, L = e L~, Mu = e Mu~/cj and
 * e = 1/sqrt(diagonal of G W G^T) all weigh alike, whatever the step and the masses:
 *
 *   q~ - v~ + s G^T e Mu~ = b1/s
 *   v~ - 1/s (K s/cj^2 q~ + D s/cj v~) - s H^T e L~ = b2/(cj s)
 *   e G s q~ = cj e b4
 *   e N s/cj q~ + e G s v~ = e b5
 *
 * (T. A. Davis and E. Palamadai Natarajan, Algorithm 907: KLU, ACM Trans. Math. Softw. 37, 2010.) */
#include "routes/ida/ida.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <suitesparse/klu.h>

#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/workspace.h"

#define GROWTH 2      /* of the room for entries, when there is none left */
#define FIRST_ROOM 16 /* entries for each unknown */

struct pm_ida_sparse {
    klu_common common;
    klu_symbolic *symbolic;
    klu_numeric *numeric;
    int n;          /* unknowns that the order of elimination is of */
    int most, room; /* unknowns, and entries, that there is memory for */
    int lost;       /* there was no memory for an entry */
    int *start;     /* [n + 1] of each column in */
    int *row;       /* [room] */
    int *old_start; /* the same at the last factors */
    int *old_row;
    double *entry; /* [room] */
    double *x;     /* [n] */
    double *left;  /* [n] what a solution leaves of the right-hand side */
};

int pm_ida_sparse_serves(const pm_model *model, const pm_active_set *active)
{
    return model->nq + active->n > PM_IDA_MANY;
}

/* ---- memory ---- */
static int grow(pm_ida_sparse *s, int room)
{
    int *row = realloc(s->row, (size_t)room * sizeof *row);
    if (row) s->row = row;
    int *old_row = realloc(s->old_row, (size_t)room * sizeof *old_row);
    if (old_row) s->old_row = old_row;
    double *entry = realloc(s->entry, (size_t)room * sizeof *entry);
    if (entry) s->entry = entry;
    if (!row || !old_row || !entry) return 0;
    s->room = room;
    return 1;
}

/* What is no array of fixed length: of a struct pm_ida_sparse. */
static void destroy(void *sparse)
{
    pm_ida_sparse *s = sparse;
    if (s->numeric) klu_free_numeric(&s->numeric, &s->common);
    if (s->symbolic) klu_free_symbolic(&s->symbolic, &s->common);
    free(s->row);
    free(s->old_row);
    free(s->entry);
}

int pm_ida_sparse_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (m->nq + m->nconstraint <= PM_IDA_MANY) return PM_OK;
    if (PM_ARENA_NEW(&w->memory, w->ida->sparse) || pm_arena_keep(&w->memory, w->ida->sparse, destroy))
        return PM_NO_MEMORY;
    pm_ida_sparse *s = w->ida->sparse;
    s->most = 2 * (m->nq + m->nconstraint);
    const pm_array array[] = {
        PM_ARRAY(s->start, s->most + 1),
        PM_ARRAY(s->old_start, s->most + 1),
        PM_ARRAY(s->x, s->most),
        PM_ARRAY(s->left, s->most),
    };
    klu_defaults(&s->common);
    s->common.tol = PM_IDA_PIVOT;
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    return !status && grow(s, FIRST_ROOM * s->most) ? PM_OK : PM_NO_MEMORY;
}

/* ---- the matrix ---- */
/* The next entry of column k. */
static void put(pm_ida_sparse *s, int k, int row, double value)
{
    const int at = s->start[k + 1];
    if (value == 0) return;
    if (at == s->room && !grow(s, GROWTH * s->room)) {
        s->lost = 1;
        return;
    }
    s->row[at] = row;
    s->entry[at] = value;
    s->start[k + 1]++;
}

/* The diagonal of S, in s->x. */
static void set_scale(pm_workspace *w)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq;
    double *const square = w->ida->sparse->x;
    for (int r = 0; r < j->nactive; r++) {
        square[r] = 0;
        for (int k = 0; k < nq; k++)
            square[r] += j->g[r * nq + k] * j->g[r * nq + k] * w->numbers.inverse_mass[k];
    }
    pm_ida_linear_scale(w, square, 1);
}

static void begin_column(pm_ida_sparse *s, int k) { s->start[k + 1] = s->start[k]; }

static void put_position(pm_ida_sparse *s, const pm_ida_jacobian *j, int nq, int k)
{
    const int na = j->nactive;
    const double *u = j->scale, *e = u + nq, ic = 1 / j->cj;
    begin_column(s, k);
    put(s, k, k, 1);
    for (int i = 0; i < nq; i++) put(s, k, nq + i, -ic * ic * j->stiffness[i * nq + k] * u[k] / u[i]);
    for (int r = 0; r < na; r++) put(s, k, 2 * nq + r, e[r] * j->g[r * nq + k] * u[k]);
    for (int r = 0; r < na; r++) put(s, k, 2 * nq + na + r, ic * e[r] * j->gv_slope[r * nq + k] * u[k]);
}

static void put_velocity(pm_ida_sparse *s, const pm_ida_jacobian *j, int nq, int k)
{
    const int na = j->nactive, column = nq + k;
    const double *u = j->scale, *e = u + nq, ic = 1 / j->cj;
    begin_column(s, column);
    put(s, column, k, -1);
    for (int i = 0; i < nq; i++) {
        const double damping = j->has_damping ? j->damping[i * nq + k] : 0;
        put(s, column, nq + i, (i == k) - ic * damping * u[k] / u[i]);
    }
    for (int r = 0; r < na; r++) put(s, column, 2 * nq + na + r, e[r] * j->g[r * nq + k] * u[k]);
}

/* Column k, of what a reaction, or the displacement that keeps a constraint, makes: by the direction of the constraint,
 * in block `block`. */
static void put_reaction(const pm_workspace *w, pm_ida_sparse *s, int k, int block, int r,
                         const double *direction, double sign)
{
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq;
    const double e = sign * j->scale[nq + r];
    begin_column(s, k);
    for (int i = 0; i < nq; i++)
        put(s, k, block * nq + i, w->numbers.inverse_mass[i] * direction[r * nq + i] * e / j->scale[i]);
}

static void fill(pm_workspace *w)
{
    pm_ida_sparse *s = w->ida->sparse;
    const pm_ida_jacobian *j = &w->ida->jacobian;
    const int nq = w->model->nq, na = j->nactive;
    s->lost = 0;
    for (int k = 0; k < nq; k++) put_position(s, j, nq, k);
    for (int k = 0; k < nq; k++) put_velocity(s, j, nq, k);
    for (int r = 0; r < na; r++) put_reaction(w, s, 2 * nq + r, 1, r, j->h, -1);
    for (int r = 0; r < na; r++) put_reaction(w, s, 2 * nq + na + r, 0, r, j->g, 1);
}

/* ---- its factors ---- */
static int same_pattern(const pm_ida_sparse *s, int n)
{
    return s->symbolic && s->n == n &&
           memcmp(s->start, s->old_start, ((size_t)n + 1) * sizeof *s->start) == 0 &&
           memcmp(s->row, s->old_row, (size_t)s->start[n] * sizeof *s->row) == 0;
}

/* The order of elimination, which the pattern of entries gives. */
static int order(pm_ida_sparse *s, int n)
{
    if (same_pattern(s, n)) return PM_OK;
    if (s->symbolic) klu_free_symbolic(&s->symbolic, &s->common);
    s->n = n;
    memcpy(s->old_start, s->start, ((size_t)n + 1) * sizeof *s->start);
    memcpy(s->old_row, s->row, (size_t)s->start[n] * sizeof *s->row);
    s->symbolic = klu_analyze(n, s->start, s->row, &s->common);
    return s->symbolic ? PM_OK : PM_NO_MEMORY;
}

int pm_ida_sparse_factor(pm_workspace *w)
{
    pm_ida_sparse *s = w->ida->sparse;
    const pm_ida_jacobian *j = &w->ida->jacobian;
    if (!(j->independence > 0)) return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    if (s->numeric) klu_free_numeric(&s->numeric, &s->common);
    set_scale(w);
    fill(w);
    if (s->lost) return PM_NO_MEMORY;
    const int status = order(s, 2 * (w->model->nq + j->nactive));
    if (status) return status;
    s->numeric = klu_factor(s->start, s->row, s->entry, s->symbolic, &s->common);
    if (s->numeric) return PM_OK;
    return s->common.status == KLU_OUT_OF_MEMORY ? PM_NO_MEMORY : PM_SOLVER;
}

/* s->x, in place.  Near a singular position the unknowns are large beside what they make together: what rounding leaves of
 * the equations is solved for once more (iterative refinement). */
static void solve(pm_ida_sparse *s)
{
    memcpy(s->left, s->x, (size_t)s->n * sizeof *s->x);
    klu_solve(s->symbolic, s->numeric, s->n, 1, s->x, &s->common);
    for (int k = 0; k < s->n; k++)
        for (int i = s->start[k]; i < s->start[k + 1]; i++) s->left[s->row[i]] -= s->entry[i] * s->x[k];
    klu_solve(s->symbolic, s->numeric, s->n, 1, s->left, &s->common);
    for (int k = 0; k < s->n; k++) s->x[k] += s->left[k];
}

void pm_ida_sparse_solve(const pm_model *model, struct pm_ida *ida, const double *b, double *q, double *vl,
                         double *mu)
{
    pm_ida_sparse *s = ida->sparse;
    const pm_ida_jacobian *j = &ida->jacobian;
    const int nq = model->nq, na = j->nactive, l = pm_ida_place_l(model), m = pm_ida_place_mu(model, ida);
    const double *u = j->scale, *e = u + nq, cj = j->cj;
    double *const x = s->x;
    for (int i = 0; i < nq; i++) {
        x[i] = b[i] / u[i];
        x[nq + i] = b[nq + i] / (cj * u[i]);
    }
    for (int r = 0; r < na; r++) {
        x[2 * nq + r] = cj * e[r] * b[l + r];
        x[2 * nq + na + r] = e[r] * b[m + r];
    }
    solve(s);
    for (int i = 0; i < nq; i++) {
        q[i] = u[i] * x[i] / cj;
        vl[i] = u[i] * x[nq + i];
    }
    for (int r = 0; r < na; r++) {
        vl[nq + r] = e[r] * x[2 * nq + r];
        mu[r] = e[r] * x[2 * nq + na + r] / cj;
    }
}
