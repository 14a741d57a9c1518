/* free_motion.c - the equations of motion next to a state in free coordinates.
 *
 * D are the natural sizes of the tree's coordinates y, N and R orthonormal bases of the null space and the row space of the
 * loops' Jacobian J at the state, in these sizes.  Next to it
 *   y = y0 + D N s,   y' = y0' + D (N s' + R m)   with m by J y' = what is prescribed:
 * the loops open by what is of second order in s, which no derivative sees, but the rates must meet them.  F(s, s') are the
 * accelerations of s.  Contacts and friction stay as they are: what sticks sticks, what slides slides on. */
#include "tree/free_motion.h"

#include <gsl/gsl_linalg.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/active_set.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/dense.h"
#include "state/arena.h"
#include "state/frame.h"

#define STENCIL 3 /* pairs of places of a difference */

static pm_loops loops_of(const pm_free_motion *x)
{
    return (pm_loops){.entry = x->entry, .low = x->low, .high = x->high};
}

static double natural(const pm_workspace *w, int coordinate)
{
    return pm_tree_scale(w->tree, &w->numbers, coordinate);
}

/* ---- free coordinates ---- */
/* R and N at the state, where the frame looks. */
static void find_basis(const pm_workspace *w, pm_free_motion *x)
{
    const int n = x->n, l = x->nloop;
    const pm_loops loops = loops_of(x);
    memset(x->entry, 0, (size_t)l * (size_t)n * sizeof *x->entry);
    pm_tree_loops_unknown(w->tree, &loops);
    pm_tree_loops(w->tree, &w->frame, &loops);
    gsl_matrix_view basis = gsl_matrix_view_array(x->basis, (size_t)n, (size_t)n);
    gsl_matrix_set_identity(&basis.matrix);
    if (l == 0) return;
    gsl_matrix_view rows = gsl_matrix_view_array(x->triangle, (size_t)n, (size_t)l);
    gsl_vector_view tau = gsl_vector_view_array(x->tau, (size_t)l);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < l; k++) x->triangle[i * l + k] = x->entry[k * n + i] * natural(w, i);
    gsl_linalg_QR_decomp(&rows.matrix, &tau.vector);
    for (int i = 0; i < n; i++) {
        gsl_vector_view column = gsl_matrix_column(&basis.matrix, (size_t)i);
        gsl_linalg_QR_Qvec(&rows.matrix, &tau.vector, &column.vector);
    }
}

/* y += D R x */
static void along_rows(const pm_workspace *w, const pm_free_motion *x, const double *part, double *y)
{
    for (int i = 0; i < x->n; i++) {
        double sum = 0;
        for (int k = 0; k < x->nloop; k++) sum += x->basis[i * x->n + k] * part[k];
        y[i] += natural(w, i) * sum;
    }
}

static void along_free(const pm_workspace *w, const pm_free_motion *x, const double *from, const double *s,
                       double *y)
{
    for (int i = 0; i < x->n; i++) {
        double sum = 0;
        for (int k = 0; k < x->nfree; k++) sum += x->basis[i * x->n + x->nloop + k] * s[k];
        y[i] = from[i] + natural(w, i) * sum;
    }
}

/* The factors of J D R at the frame, where the loop constraints are evaluated. */
static int factor_rows(const pm_workspace *w, pm_free_motion *x)
{
    const int n = x->n, l = x->nloop;
    const pm_loops loops = loops_of(x);
    pm_tree_loops(w->tree, &w->frame, &loops);
    for (int k = 0; k < l; k++)
        for (int j = 0; j < l; j++) {
            double sum = 0;
            for (int i = 0; i < n; i++) sum += x->entry[k * n + i] * natural(w, i) * x->basis[i * n + j];
            x->on_rows[k * l + j] = sum;
        }
    return pm_dense_lu_factor(l, x->on_rows, x->pivot);
}

/* The frame looks at coordinates x->y with rates x->rate that meet the loops there; 1 where none do. */
static int look(pm_workspace *w, pm_free_motion *x)
{
    const pm_tree *t = w->tree;
    pm_tree_look(w, w->state.t, x->y, x->rate, w->state.z);
    if (x->nloop == 0) return 0;
    if (factor_rows(w, x)) return 1;
    pm_constraint_slips(&w->frame, t->constraint, t->nloop, t->loop, t->v, x->off);
    pm_dense_lu_solve(x->nloop, x->on_rows, x->pivot, x->off);
    along_rows(w, x, x->off, x->rate);
    pm_tree_look(w, w->state.t, x->y, x->rate, w->state.z);
    return 0;
}

/* F at x->shift: s, then s'. */
int pm_free_motion_respond(pm_workspace *w, pm_free_motion *x)
{
    along_free(w, x, x->y0, x->shift, x->y);
    along_free(w, x, x->rate0, x->shift + x->nfree, x->rate);
    if (look(w, x) || pm_saddle_accelerate(w)) return 1;
    pm_tree_read_accelerations(w->tree, &w->frame, w->frame.a, x->acceleration);
    for (int k = 0; k < x->nfree; k++) {
        x->response[k] = 0;
        for (int i = 0; i < x->n; i++)
            x->response[k] += x->basis[i * x->n + x->nloop + k] * x->acceleration[i] / natural(w, i);
    }
    return 0;
}

/* The derivative of F by one of s and s', by differences of length h and of the sixth order. */
int pm_free_motion_differ(pm_workspace *w, pm_free_motion *x, int by, double h)
{
    static const double weight[STENCIL] = {45. / 60, -9. / 60, 1. / 60};
    memset(x->change, 0, (size_t)x->nfree * sizeof *x->change);
    for (int i = 0; i < 2 * STENCIL; i++) {
        const int pair = i / 2, sign = i % 2 ? -1 : 1;
        memset(x->shift, 0, 2 * (size_t)x->nfree * sizeof *x->shift);
        x->shift[by] = sign * (pair + 1) * h;
        if (pm_free_motion_respond(w, x)) return 1;
        for (int k = 0; k < x->nfree; k++) x->change[k] += sign * weight[pair] * x->response[k] / h;
    }
    return 0;
}

pm_tree *pm_free_motion_begin(pm_workspace *w, pm_free_motion *x)
{
    pm_tree *of_phase = w->tree;
    w->tree = x->tree;
    pm_tree_build(w);
    pm_frame_look_state(&w->frame, &w->state);
    x->n = w->tree->n;
    x->nloop = w->tree->nloop;
    x->nfree = x->n - x->nloop;
    pm_tree_read(w->tree, &w->frame, x->y0);
    pm_tree_read_rates(w->tree, w->state.v, x->rate0);
    find_basis(w, x);
    return of_phase;
}

int pm_free_motion_move(pm_workspace *w, pm_free_motion *x, const double *s)
{
    along_free(w, x, x->y0, s, x->y);
    pm_tree_look(w, w->state.t, x->y, x->rate0, w->state.z);
    memcpy(w->state.q, w->tree->q, (size_t)w->model->nq * sizeof *w->state.q);
    pm_active_set_find_feet(&w->frame, &w->state);
    const int status = pm_projection_apply(w, &w->state);
    if (!status) pm_active_set_follow(&w->frame, &w->active, &w->state);
    return status;
}

/* ---- memory ---- */
int pm_free_motion_create(pm_workspace *w, pm_free_motion *x)
{
    const int nq = w->model->nq, nrow = w->model->nconstraint;
    const size_t n = (size_t)nq, l = (size_t)nrow;
    const pm_array array[] = {
        PM_ARRAY(x->y0, nq),          PM_ARRAY(x->rate0, nq),        PM_ARRAY(x->y, nq),
        PM_ARRAY(x->rate, nq),        PM_ARRAY(x->acceleration, nq), PM_ARRAY(x->basis, n * n),
        PM_ARRAY(x->triangle, n * l), PM_ARRAY(x->tau, nrow),        PM_ARRAY(x->entry, l * n),
        PM_ARRAY(x->low, nrow),       PM_ARRAY(x->high, nrow),       PM_ARRAY(x->on_rows, l * l),
        PM_ARRAY(x->pivot, nrow),     PM_ARRAY(x->off, nrow),        PM_ARRAY(x->shift, 2 * nq),
        PM_ARRAY(x->response, nq),    PM_ARRAY(x->change, nq),
    };
    pm_tree *of_phase = w->tree;
    int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (!status) status = pm_tree_create(w);
    x->tree = w->tree;
    w->tree = of_phase;
    return status;
}
