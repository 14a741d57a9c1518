/* small_motion.c - the equations of motion next to a state, linearised in free coordinates (free_motion.c); their eigenvalues.
 *
 * Small motion is s'' = K s + C s', K and C the derivatives of the accelerations F(s, s'), and its eigenvalues are those of
 * [0 1; K C] (Meirovitch, Fundamentals of Vibrations, 7.13). */
#include "tree/small_motion.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/modes.h"
#include "tree/free_motion.h"

#define TRIALS 3 /* lengths of differences */

typedef struct pm_small_motion {
    pm_free_motion free;
    double *matrix;            /* [2 nq][2 nq] */
    gsl_complex *root[TRIALS]; /* [2 nq] */
} pm_small_motion;

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
    const int f = x->free.nfree, n = 2 * f;
    const double rate = w->numbers.speed / w->numbers.size;
    memset(x->matrix, 0, (size_t)n * (size_t)n * sizeof *x->matrix);
    for (int k = 0; k < f; k++) x->matrix[k * n + f + k] = 1;
    for (int by = 0; by < n; by++) {
        if (pm_free_motion_differ(w, &x->free, by, by < f ? h : h * rate)) return 1;
        for (int k = 0; k < f; k++) x->matrix[(f + k) * n + by] = x->free.change[k];
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
            usable[i] && usable[i + 1] ? apart(x->root[i], x->root[i + 1], 2 * x->free.nfree) : INFINITY;
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

static void find(pm_workspace *w)
{
    pm_modes *m = w->frame.modes;
    pm_small_motion *x = m->motion;
    const int level = w->frame.level;
    const pm_where where = w->result.where;
    m->n = 0;
    m->growth = NAN;
    pm_tree *of_phase = pm_free_motion_begin(w, &x->free);
    const gsl_complex *root = x->free.nfree > 0 ? best_roots(w, x) : NULL;
    if (root) take(m, root, 2 * x->free.nfree);
    w->tree = of_phase;
    w->result.where = where;
    pm_frame_look_state(&w->frame, &w->state);
    if (level == PM_LEVEL_DYNAMIC) pm_saddle_accelerate(w);
}

/* ---- memory ---- */
static int is_asked(const pm_model *m)
{
    if (PM_SETTING(m, PM_SETTING_EQUILIBRIUM)) return 1; /* is it stable? */
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int kind = PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND];
        if (kind >= PM_MEASURE_MODE_OMEGA && kind <= PM_MEASURE_MODES_GROWTH) return 1;
    }
    return 0;
}

static int create_arrays(pm_workspace *w, pm_modes *m, pm_small_motion *x)
{
    const int nq = w->model->nq;
    const size_t n = (size_t)nq;
    const pm_array array[] = {
        PM_ARRAY(m->omega, 2 * nq),   PM_ARRAY(m->damping, 2 * nq),   PM_ARRAY(m->q, nq),
        PM_ARRAY(m->v, nq),           PM_ARRAY(x->matrix, 4 * n * n), PM_ARRAY(x->root[0], 2 * nq),
        PM_ARRAY(x->root[1], 2 * nq), PM_ARRAY(x->root[2], 2 * nq),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

int pm_small_motion_create(pm_workspace *w)
{
    if (!is_asked(w->model)) return PM_OK;
    pm_modes *m;
    pm_small_motion *x;
    if (PM_ARENA_NEW(&w->memory, m) || PM_ARENA_NEW(&w->memory, x)) return PM_NO_MEMORY;
    int status = create_arrays(w, m, x);
    if (!status) status = pm_free_motion_create(w, &x->free);
    m->motion = x;
    m->find = find;
    w->frame.modes = m;
    return status;
}
