/* small_motion.c - the equations of motion next to a state, linearised in free coordinates; their eigenvalues.
 *
 * D are the natural sizes of the tree's coordinates y, N and R orthonormal bases of the null space and the row space of the
 * loops' Jacobian J at the state, in these sizes.  Next to it
 *   y = y0 + D N s,   y' = y0' + D (N s' + R m)   with m by J y' = what is prescribed:
 * the loops open by what is of second order in s, which no derivative sees, but the rates must meet them.  With the
 * accelerations F(s, s') of s small motion is s'' = K s + C s', K and C the derivatives of F, and its eigenvalues are those of
 * [0 1; K C] (Meirovitch, Fundamentals of Vibrations, 7.13).  Contacts and friction stay as they are: what sticks sticks, what
 * slides slides on. */
#include "tree/small_motion.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/saddle.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/modes.h"
#include "tree/tree.h"

#define STENCIL 3 /* pairs of places of a difference */
#define TRIALS 3  /* lengths of differences */

typedef struct pm_small_motion {
    pm_tree *tree; /* its own: that of a phase goes on */
    int n, nloop, nfree;
    double *y0, *rate0;              /* [nq] at the state */
    double *y, *rate, *acceleration; /* [nq] */
    double *basis;                   /* [n][n] columns R, then N */
    double *triangle, *tau;          /* [nq][nconstraint], [nconstraint] of the factorisation that gives it */
    double *entry;                   /* [nconstraint][nq] */
    int *low, *high;                 /* [nconstraint] */
    double *on_rows;                 /* [nconstraint][nconstraint] J D R */
    int *pivot;                      /* [nconstraint] */
    double *off;                     /* [nconstraint] */
    double *shift, *response, *change; /* [2 nq] s and s'; [nq] F; [nq] */
    double *matrix;                    /* [2 nq][2 nq] */
    gsl_complex *root[TRIALS];         /* [2 nq] */
} pm_small_motion;

static pm_loops loops_of(const pm_small_motion *x)
{
    return (pm_loops){.entry = x->entry, .low = x->low, .high = x->high};
}

static double natural(const pm_workspace *w, int coordinate)
{
    return pm_tree_scale(w->tree, &w->numbers, coordinate);
}

/* ---- free coordinates ---- */
/* R and N at the state, where the frame looks. */
static void find_basis(const pm_workspace *w, pm_small_motion *x)
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
static void along_rows(const pm_workspace *w, const pm_small_motion *x, const double *part, double *y)
{
    for (int i = 0; i < x->n; i++) {
        double sum = 0;
        for (int k = 0; k < x->nloop; k++) sum += x->basis[i * x->n + k] * part[k];
        y[i] += natural(w, i) * sum;
    }
}

static void along_free(const pm_workspace *w, const pm_small_motion *x, const double *from, const double *s,
                       double *y)
{
    for (int i = 0; i < x->n; i++) {
        double sum = 0;
        for (int k = 0; k < x->nfree; k++) sum += x->basis[i * x->n + x->nloop + k] * s[k];
        y[i] = from[i] + natural(w, i) * sum;
    }
}

/* The factors of J D R at the frame, where the loop constraints are evaluated. */
static int factor_rows(const pm_workspace *w, pm_small_motion *x)
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
static int look(pm_workspace *w, pm_small_motion *x)
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
static int respond(pm_workspace *w, pm_small_motion *x)
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
static int differ(pm_workspace *w, pm_small_motion *x, int by, double h)
{
    static const double weight[STENCIL] = {45. / 60, -9. / 60, 1. / 60};
    memset(x->change, 0, (size_t)x->nfree * sizeof *x->change);
    for (int i = 0; i < 2 * STENCIL; i++) {
        const int pair = i / 2, sign = i % 2 ? -1 : 1;
        memset(x->shift, 0, 2 * (size_t)x->nfree * sizeof *x->shift);
        x->shift[by] = sign * (pair + 1) * h;
        if (respond(w, x)) return 1;
        for (int k = 0; k < x->nfree; k++) x->change[k] += sign * weight[pair] * x->response[k] / h;
    }
    return 0;
}

/* ---- eigenvalues ---- */
static double size_of(gsl_complex x) { return hypot(GSL_REAL(x), GSL_IMAG(x)); }

/* Of equal ones, to what differences tell, those that die away come first. */
static int by_size(const void *a, const void *b)
{
    const gsl_complex *x = a, *y = b;
    const double one = size_of(*x), other = size_of(*y);
    if (fabs(one - other) > PM_MODE_SAME * (one + other)) return one < other ? -1 : 1;
    if (GSL_REAL(*x) != GSL_REAL(*y)) return GSL_REAL(*x) < GSL_REAL(*y) ? -1 : 1;
    return GSL_IMAG(*x) > GSL_IMAG(*y) ? -1 : GSL_IMAG(*x) < GSL_IMAG(*y);
}

/* What differences cannot tell from zero is zero: of a square of an eigenvalue, and of a real part. */
static void clean(gsl_complex *root, int n, double slowest)
{
    double greatest = slowest;
    for (int i = 0; i < n; i++) greatest = fmax(greatest, size_of(root[i]));
    for (int i = 0; i < n; i++) {
        const double size = size_of(root[i]);
        if (size * size <= PM_MODE_NOTHING * greatest * greatest) GSL_SET_COMPLEX(&root[i], 0, 0);
        if (fabs(GSL_REAL(root[i])) <= PM_MODE_NOTHING * greatest) GSL_SET_REAL(&root[i], 0);
    }
    qsort(root, (size_t)n, sizeof *root, by_size);
}

static int eigenvalues(double *matrix, int n, gsl_complex *root)
{
    gsl_eigen_nonsymm_workspace *space = gsl_eigen_nonsymm_alloc((size_t)n);
    if (!space) return 1;
    gsl_matrix_view a = gsl_matrix_view_array(matrix, (size_t)n, (size_t)n);
    gsl_vector_complex_view found = gsl_vector_complex_view_array((double *)root, (size_t)n);
    gsl_eigen_nonsymm_params(0, 1, space);
    const int failed = gsl_eigen_nonsymm(&a.matrix, &found.vector, space);
    gsl_eigen_nonsymm_free(space);
    return failed;
}

/* Eigenvalues by differences of length h. */
static int find_roots(pm_workspace *w, pm_small_motion *x, double h, gsl_complex *root)
{
    const int f = x->nfree, n = 2 * f;
    const double rate = w->numbers.speed / w->numbers.size;
    memset(x->matrix, 0, (size_t)n * (size_t)n * sizeof *x->matrix);
    for (int k = 0; k < f; k++) x->matrix[k * n + f + k] = 1;
    for (int by = 0; by < n; by++) {
        if (differ(w, x, by, by < f ? h : h * rate)) return 1;
        for (int k = 0; k < f; k++) x->matrix[(f + k) * n + by] = x->change[k];
    }
    if (eigenvalues(x->matrix, n, root)) return 1;
    clean(root, n, rate);
    return 0;
}

/* How far the eigenvalues of one list are from the nearest ones of the other, of the greatest. */
static double apart(const gsl_complex *a, const gsl_complex *b, int n)
{
    double greatest = 0, worst = 0;
    for (int i = 0; i < n; i++) {
        double nearest = INFINITY;
        for (int k = 0; k < n; k++)
            nearest = fmin(nearest, hypot(GSL_REAL(a[i]) - GSL_REAL(b[k]), GSL_IMAG(a[i]) - GSL_IMAG(b[k])));
        worst = fmax(worst, nearest);
        greatest = fmax(greatest, size_of(a[i]));
    }
    return greatest > 0 ? worst / greatest : 0;
}

/* Long differences are the more accurate ones where the scene is smooth over them: those that the next shorter ones confirm
 * best are taken.  A coarse run takes others, so that what they err by is seen. */
static const gsl_complex *best_roots(pm_workspace *w, pm_small_motion *x)
{
    static const double length[TRIALS] = {1. / 64, 1. / 512, 1. / 4096};
    const double factor = pm_evidence_is_coarse(&w->evidence) ? 0.7 : 1;
    int usable[TRIALS], best = PM_NONE;
    double least = INFINITY;
    for (int i = 0; i < TRIALS; i++) usable[i] = !find_roots(w, x, factor * length[i], x->root[i]);
    for (int i = 0; i + 1 < TRIALS; i++) {
        const double off =
            usable[i] && usable[i + 1] ? apart(x->root[i], x->root[i + 1], 2 * x->nfree) : INFINITY;
        if (off < least) least = off, best = i;
    }
    return least < PM_MODE_CONFIRMED ? x->root[best] : NULL;
}

/* ---- modes ---- */
static void take(pm_modes *m, const gsl_complex *root, int n)
{
    int at_rest = 0;
    m->n = 0;
    m->growth = -INFINITY;
    for (int i = 0; i < n; i++) {
        const double size = size_of(root[i]);
        m->growth = fmax(m->growth, GSL_REAL(root[i]));
        if (GSL_IMAG(root[i]) < 0) continue;      /* the other one of a pair */
        if (size == 0 && at_rest++ % 2) continue; /* a freedom that nothing draws back has two */
        m->omega[m->n] = size;
        m->damping[m->n++] = size > 0 ? 0 - GSL_REAL(root[i]) / size : 0; /* not -0 */
    }
}

static void begin(pm_workspace *w, pm_small_motion *x)
{
    pm_tree_build(w);
    pm_frame_look_state(&w->frame, &w->state);
    x->n = w->tree->n;
    x->nloop = w->tree->nloop;
    x->nfree = x->n - x->nloop;
    pm_tree_read(w->tree, &w->frame, x->y0);
    pm_tree_read_rates(w->tree, w->state.v, x->rate0);
    find_basis(w, x);
}

static void find(pm_workspace *w)
{
    pm_modes *m = w->frame.modes;
    pm_small_motion *x = m->motion;
    pm_tree *of_phase = w->tree;
    const int level = w->frame.level;
    const pm_where where = w->result.where;
    m->n = 0;
    m->growth = NAN;
    w->tree = x->tree;
    begin(w, x);
    const gsl_complex *root = x->nfree > 0 ? best_roots(w, x) : NULL;
    if (root) take(m, root, 2 * x->nfree);
    w->tree = of_phase;
    w->result.where = where;
    pm_frame_look_state(&w->frame, &w->state);
    if (level == PM_LEVEL_DYNAMIC) pm_saddle_accelerate(w);
}

/* ---- memory ---- */
static int is_asked(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int kind = PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND];
        if (kind >= PM_MEASURE_MODE_OMEGA && kind <= PM_MEASURE_MODES_GROWTH) return 1;
    }
    return 0;
}

static int create_arrays(pm_workspace *w, pm_modes *m, pm_small_motion *x)
{
    const int nq = w->model->nq, nrow = w->model->nconstraint;
    const size_t n = (size_t)nq, l = (size_t)nrow;
    const pm_array array[] = {
        PM_ARRAY(m->omega, 2 * nq),
        PM_ARRAY(m->damping, 2 * nq),
        PM_ARRAY(m->q, nq),
        PM_ARRAY(m->v, nq),
        PM_ARRAY(x->y0, nq),
        PM_ARRAY(x->rate0, nq),
        PM_ARRAY(x->y, nq),
        PM_ARRAY(x->rate, nq),
        PM_ARRAY(x->acceleration, nq),
        PM_ARRAY(x->basis, n * n),
        PM_ARRAY(x->triangle, n * l),
        PM_ARRAY(x->tau, nrow),
        PM_ARRAY(x->entry, l * n),
        PM_ARRAY(x->low, nrow),
        PM_ARRAY(x->high, nrow),
        PM_ARRAY(x->on_rows, l * l),
        PM_ARRAY(x->pivot, nrow),
        PM_ARRAY(x->off, nrow),
        PM_ARRAY(x->shift, 2 * nq),
        PM_ARRAY(x->response, nq),
        PM_ARRAY(x->change, nq),
        PM_ARRAY(x->matrix, 4 * n * n),
        PM_ARRAY(x->root[0], 2 * nq),
        PM_ARRAY(x->root[1], 2 * nq),
        PM_ARRAY(x->root[2], 2 * nq),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

int pm_small_motion_create(pm_workspace *w)
{
    if (!is_asked(w->model)) return PM_OK;
    pm_modes *m;
    pm_small_motion *x;
    if (PM_ARENA_NEW(&w->memory, m) || PM_ARENA_NEW(&w->memory, x)) return PM_NO_MEMORY;
    pm_tree *of_phase = w->tree;
    int status = create_arrays(w, m, x);
    if (!status) status = pm_tree_create(w);
    x->tree = w->tree;
    w->tree = of_phase;
    m->motion = x;
    m->find = find;
    w->frame.modes = m;
    return status;
}
