/* tree_small.c - accelerations of trees of a few coordinates in a few hundred instructions: no body is looked at, no row
 * evaluated.
 *
 * By tree_augmented.c a mark P of body b is at  P = const + sum_k (e_k y_k + R_k d_k),  where d_k is the arm of b, and of
 * the coordinate that rotates b the way on to the mark, too.  A constraint along a direction n that stays - a pin, a line
 * of the ground - or between two angles is then, of both its marks,
 *     g = const + sum_k (E_k y_k + A_k cos y_k + B_k sin y_k),     A = n . d, B = n . (k x d), E = n . e,
 *     J_k = E_k - A_k sin y_k + B_k cos y_k,     gamma = sum_k ydot_k^2 (A_k cos y_k + B_k sin y_k)
 * and the equations of tree_dynamics.c are some dozens of products:  with B^T M B = L D L^T, X = L^-1 J^T,
 *     S = X^T D^-1 X,    S l = gamma - X^T D^-1 L^-1 f,    yddot = L^-T D^-1 (L^-1 f + X l).
 * For each number of coordinates and loop constraints the compiler writes the code without loops.
 *
 * Cosine and sine of y + x, x small, are those of y rotated by x, whose own are short series. */
#include "tree/tree.h"

#include <math.h>
#include <string.h>

#include "equations/projection.h"
#include "numerics/lanes.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

#define MOST PM_TREE_SMALL_MOST
#define INLINE static inline __attribute__((always_inline))

/* ---- directions ---- */
/* Cosine and sine of a body's direction. */
typedef struct pm_tree_small_direction {
    double c, s;
} pm_tree_small_direction;

/* Of two coordinates, y from x->y at k, which are close to those. */
INLINE void rotate_by(const pm_tree_small *x, int k, pm_lanes by, pm_tree_small_direction *to)
{
    const pm_lanes z = by * by, z2 = z * z, z4 = z2 * z2, c = pm_lanes_load(x->cosine + k),
                   s = pm_lanes_load(x->sine + k);
    const pm_lanes sine = by + by * z *
                                   (-1. / 6 + z * (1. / 120) + z2 * (-1. / 5040 + z * (1. / 362880)) +
                                    z4 * (-1. / 39916800 + z * (1. / 6227020800)));
    const pm_lanes drop = z * (-1. / 2 + z * (1. / 24) + z2 * (-1. / 720 + z * (1. / 40320)) +
                               z4 * (-1. / 3628800 + z * (1. / 479001600) - z2 * (1. / 87178291200)));
    const pm_lanes cosine = c + (c * drop - s * sine), with = s + (s * drop + c * sine);
    for (int i = 0; i < 2; i++) to[k + i] = (pm_tree_small_direction){cosine[i], with[i]};
}

/* Of all coordinates y, and of what follows them up to the next even number. */
INLINE void direct(const pm_tree_small *x, int n, const double *y, pm_tree_small_direction *to)
{
    for (int k = 0; k < n; k += 2) {
        const pm_lanes by = (pm_lanes_load(y + k) - pm_lanes_load(x->y + k)) * pm_lanes_load(x->rotates + k);
        if (by[0] < PM_SERIES_REACH && by[0] > -PM_SERIES_REACH &&
            (k + 1 == n || (by[1] < PM_SERIES_REACH && by[1] > -PM_SERIES_REACH))) {
            rotate_by(x, k, by, to);
            continue;
        }
        for (int i = k; i < k + 2 && i < n; i++)
            to[i] = x->owner[i] == PM_NONE ? (pm_tree_small_direction){1, 0}
                                           : (pm_tree_small_direction){cos(y[i]), sin(y[i])};
    }
}

/* ---- the equations, written out for each n and nloop ---- */
typedef struct pm_tree_small_place {
    pm_tree_small_direction direction[MOST];
    double mass[MOST][MOST];    /* its lower triangle; factored L, the diagonal of D^-1 */
    double reduced[MOST][MOST]; /* X */
    double schur[MOST][MOST];   /* like mass */
} pm_tree_small_place;

/* How a wave changes with its angle. */
INLINE double slope(const pm_tree_small_wave *x, pm_tree_small_direction at)
{
    return x->b * at.c - x->a * at.s;
}

INLINE double height(const pm_tree_small_wave *x, pm_tree_small_direction at)
{
    return x->a * at.c + x->b * at.s;
}

/* J_k */
INLINE double jacobian(const pm_tree_small_loop *loop, int k, const pm_tree_small_place *p)
{
    return loop->shift[k] + slope(&loop->wave[k], p->direction[k]);
}

/* The mass matrix, and with `square` (of the rates) the forces f. */
INLINE void equations(const pm_tree_small *x, int n, const double *square, pm_tree_small_place *p, double *f)
{
    for (int i = 0; i < n; i++) {
        if (square) f[i] = x->weight[i] + height(&x->rotated_weight[i], p->direction[i]);
        p->mass[i][i] = x->level[i][i] + x->same[i][i];
    }
    for (int i = 1; i < n; i++)
        for (int k = 0; k < i; k++) {
            const pm_tree_small_direction r = p->direction[i], u = p->direction[k];
            const double c = r.c * u.c + r.s * u.s, s = r.s * u.c - r.c * u.s;
            p->mass[i][k] = x->level[i][k] + x->same[i][k] * c + x->cross[i][k] * s;
            if (!square) continue;
            const double beside = x->cross[i][k] * c - x->same[i][k] * s;
            f[i] += square[k] * beside;
            f[k] -= square[i] * beside;
        }
    if (!x->shifts) return;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            const double more = slope(&x->fixed[i][k], p->direction[k]);
            if (i == k)
                p->mass[i][i] += 2 * more;
            else
                p->mass[i > k ? i : k][i > k ? k : i] += more;
            if (square) f[i] += square[k] * height(&x->fixed[i][k], p->direction[k]);
        }
}

/* The lower triangle of a = L D L^T in place; 0, or 1 + the index of a pivot that has lost its figures. */
INLINE int factor(int n, double a[MOST][MOST])
{
    for (int j = 0; j < n; j++) {
        double scaled[MOST], pivot = a[j][j];
        for (int k = 0; k < j; k++) {
            scaled[k] = a[j][k]; /* L D */
            a[j][k] *= a[k][k];
            pivot -= a[j][k] * scaled[k];
        }
        if (!(pivot > PM_PIVOT_LOSS * a[j][j])) return j + 1;
        a[j][j] = 1 / pivot;
        for (int i = j + 1; i < n; i++)
            for (int k = 0; k < j; k++) a[i][j] -= a[i][k] * a[j][k];
    }
    return 0;
}

/* L x = b in place. */
INLINE void lower(int n, double a[MOST][MOST], double *b)
{
    for (int i = 1; i < n; i++)
        for (int k = 0; k < i; k++) b[i] -= a[i][k] * b[k];
}

/* L^T x = D^-1 b in place. */
INLINE void upper(int n, double a[MOST][MOST], double *b)
{
    for (int i = 0; i < n; i++) b[i] *= a[i][i];
    for (int i = n - 1; i > 0; i--)
        for (int k = 0; k < i; k++) b[k] -= a[i][k] * b[i];
}

/* Of a constraint as in tree_dynamics.c: left / all is what those before leave of it. */
INLINE void watch_independence(struct pm_tree *tree, const pm_tree_small_loop *loop,
                               const pm_tree_small_place *p, double left, double all)
{
    double square = loop->square * all;
    for (int side = 0; side < 2; side++) {
        if (loop->rotates[side] == PM_NONE) continue;
        const double lever = slope(&loop->lever[side], p->direction[loop->rotates[side]]);
        square += lever * lever * loop->inverse_inertia[side] * all;
    }
    if (tree->part.independence * square > left) tree->part.independence = left / square;
}

INLINE int factor_all(pm_workspace *w, const pm_tree_small *x, int n, int nloop, pm_tree_small_place *p)
{
    w->result.count[PM_COUNT_SOLVES]++;
    if (factor(n, p->mass)) return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_BODY, 0, 0, 0);
    for (int i = 0; i < nloop; i++) {
        for (int k = 0; k < n; k++) p->reduced[i][k] = jacobian(&x->loop[i], k, p);
        lower(n, p->mass, p->reduced[i]);
        for (int l = 0; l <= i; l++) {
            p->schur[i][l] = 0;
            for (int k = 0; k < n; k++) p->schur[i][l] += p->reduced[i][k] * p->reduced[l][k] * p->mass[k][k];
        }
    }
    const int bad = factor(nloop, p->schur);
    if (bad) return pm_tree_singular_loop(w, bad - 1);
    for (int i = 0; i < nloop; i++) watch_independence(w->tree, &x->loop[i], p, 1, p->schur[i][i]);
    return PM_OK;
}

/* yddot from the forces f, in place, with J yddot = rate. */
INLINE void solve(int n, int nloop, pm_tree_small_place *p, double *rate, double *f)
{
    lower(n, p->mass, f);
    for (int i = 0; i < nloop; i++)
        for (int k = 0; k < n; k++) rate[i] -= p->reduced[i][k] * p->mass[k][k] * f[k];
    lower(nloop, p->schur, rate);
    upper(nloop, p->schur, rate);
    for (int i = 0; i < nloop; i++)
        for (int k = 0; k < n; k++) f[k] += p->reduced[i][k] * rate[i];
    upper(n, p->mass, f);
}

/* ---- one freedom ---- */
INLINE double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

INLINE void cross(const double *a, const double *b, double *c)
{
    for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* a M b, of the mass matrix or its adjugate, which is det M times the inverse */
INLINE double between(int n, double m[MOST][MOST], const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        sum += m[i][i] * a[i] * b[i];
        for (int k = 0; k < i; k++) sum += m[i][k] * (a[i] * b[k] + a[k] * b[i]);
    }
    return sum;
}

INLINE double adjugate(double m[MOST][MOST], double to[MOST][MOST])
{
    to[0][0] = m[1][1] * m[2][2] - m[2][1] * m[2][1];
    to[1][0] = m[2][1] * m[2][0] - m[1][0] * m[2][2];
    to[1][1] = m[0][0] * m[2][2] - m[2][0] * m[2][0];
    to[2][0] = m[1][0] * m[2][1] - m[1][1] * m[2][0];
    to[2][1] = m[1][0] * m[2][0] - m[0][0] * m[2][1];
    to[2][2] = m[0][0] * m[1][1] - m[1][0] * m[1][0];
    return m[0][0] * to[0][0] + m[1][0] * to[1][0] + m[2][0] * to[2][0];
}

/* The independence of the constraints, `along` the square of the way that they leave, in the metric of M. */
INLINE void watch_constraints(struct pm_tree *tree, int n, double row[2][MOST], pm_tree_small_place *p,
                              double along)
{
    const pm_tree_small *x = &tree->small;
    if (n == 2) {
        const double whole = p->mass[0][0] * p->mass[1][1] - p->mass[1][0] * p->mass[1][0];
        watch_independence(tree, &x->loop[0], p, along, whole);
    } else if (n == 3) {
        double inverse[MOST][MOST];
        const double whole = adjugate(p->mass, inverse), first = between(3, inverse, row[0], row[0]);
        watch_independence(tree, &x->loop[0], p, first, whole);
        watch_independence(tree, &x->loop[1], p, along, first);
    }
}

/* The constraints leave one way, along N, the vector product of their rows of J:  yddot = a + s N  with any a of J a =
 * rate; s = N . (f - M a) / (N . M N).  What the constraints hold at rest stays so to the last figure. */
INLINE int solve_along(pm_workspace *w, int n, pm_tree_small_place *p, const double *rate, const double *f,
                       double *yddot)
{
    const pm_tree_small *x = &w->tree->small;
    double row[2][MOST], way[MOST] = {1}, a[MOST] = {0};
    w->result.count[PM_COUNT_SOLVES]++;
    for (int i = 0; i < n - 1; i++)
        for (int k = 0; k < n; k++) row[i][k] = jacobian(&x->loop[i], k, p);
    if (n == 2) {
        way[0] = -row[0][1];
        way[1] = row[0][0];
        const double factor = rate[0] / dot(2, way, way);
        for (int k = 0; k < 2; k++) a[k] = factor * row[0][k];
    } else if (n == 3) {
        double first[3], second[3];
        cross(row[0], row[1], way);
        const double square = dot(3, way, way), inverse = 1 / square;
        if (!(square > PM_PIVOT_LOSS * dot(3, row[0], row[0]) * dot(3, row[1], row[1])))
            return pm_tree_singular_loop(w, 1);
        cross(row[1], way, first);
        cross(way, row[0], second);
        for (int k = 0; k < 3; k++) a[k] = (rate[0] * first[k] + rate[1] * second[k]) * inverse;
    }
    const double along = between(n, p->mass, way, way);
    if (!(along > 0))
        return n > 1 ? pm_tree_singular_loop(w, n - 2)
                     : pm_fail(&w->result, PM_SINGULAR, PM_TABLE_BODY, 0, 0, 0);
    const double s = (dot(n, way, f) - between(n, p->mass, way, a)) / along;
    for (int k = 0; k < n; k++) yddot[k] = a[k] + s * way[k];
    watch_constraints(w->tree, n, row, p, along);
    return PM_OK;
}

INLINE int derivative(pm_workspace *w, int n, int nloop, const double *y, double *rate)
{
    const pm_tree_small *x = &w->tree->small;
    pm_tree_small_place p;
    double square[MOST], gamma[MOST], f[MOST];
    direct(x, n, y, p.direction);
    for (int k = 0; k < n; k++) {
        rate[k] = y[n + k];
        square[k] = x->rotates[k] * y[n + k] * y[n + k];
    }
    equations(x, n, square, &p, f);
    for (int i = 0; i < nloop; i++) {
        gamma[i] = 0;
        for (int k = 0; k < n; k++) gamma[i] += square[k] * height(&x->loop[i].wave[k], p.direction[k]);
    }
    if (n <= 3 && nloop == n - 1) return solve_along(w, n, &p, gamma, f, rate + n);
    const int status = factor_all(w, x, n, nloop, &p);
    if (status) return status;
    solve(n, nloop, &p, gamma, f);
    for (int k = 0; k < n; k++) rate[n + k] = f[k];
    return PM_OK;
}

/* ---- back onto the loop constraints ---- */
/* -g at the place; the worst. */
INLINE double openings(const pm_tree_small *x, int n, int nloop, const double *y,
                       const pm_tree_small_place *p, double *opening)
{
    double worst = 0;
    for (int i = 0; i < nloop; i++) {
        double g = x->loop[i].constant;
        for (int k = 0; k < n; k++)
            g += x->loop[i].shift[k] * y[k] + height(&x->loop[i].wave[k], p->direction[k]);
        opening[i] = -g;
        if (fabs(g) > worst) worst = fabs(g);
    }
    return worst;
}

/* y moves by the least way that closes the openings. */
INLINE void close(int n, int nloop, pm_tree_small_place *p, double *opening, double *y)
{
    double by[MOST] = {0};
    solve(n, nloop, p, opening, by);
    for (int k = 0; k < n; k++) y[k] += by[k];
}

INLINE int factor_here(pm_workspace *w, int n, int nloop, pm_tree_small_place *p)
{
    equations(&w->tree->small, n, NULL, p, NULL);
    return factor_all(w, &w->tree->small, n, nloop, p);
}

INLINE int project(pm_workspace *w, int n, int nloop, double *y, double *ydot)
{
    const pm_tree_small *x = &w->tree->small;
    pm_tree_small_place p;
    double opening[MOST], before = INFINITY, worst = 0;
    int status, factored = 0;
    for (int sweep = 0;; sweep++) {
        direct(x, n, y, p.direction);
        worst = openings(x, n, nloop, y, &p, opening);
        if (pm_projection_ends_exactly(&w->numbers, sweep, worst, before)) break;
        factored = worst <= PM_FACTORS_STAY * w->numbers.size;
        before = worst;
        if ((status = factor_here(w, n, nloop, &p))) return status;
        close(n, nloop, &p, opening, y);
    }
    worst = 0;
    for (int i = 0; i < nloop; i++) {
        opening[i] = 0;
        for (int k = 0; k < n; k++) opening[i] -= jacobian(&x->loop[i], k, &p) * ydot[k];
        if (fabs(opening[i]) > worst) worst = fabs(opening[i]);
    }
    if (worst <= PM_MET * w->numbers.speed) return PM_OK;
    if (!(factored && worst <= PM_FACTORS_STAY * w->numbers.speed) && (status = factor_here(w, n, nloop, &p)))
        return status;
    close(n, nloop, &p, opening, ydot);
    return PM_OK;
}

/* ---- for each n and nloop ---- */
#define EACH(CALL)                                                \
    switch (w->tree->small.n * MOST + w->tree->small.nloop) {     \
    case 1 * MOST: return CALL(1, 0);                             \
    case 2 * MOST: return CALL(2, 0);                             \
    case 2 * MOST + 1: return CALL(2, 1);                         \
    case 3 * MOST: return CALL(3, 0);                             \
    case 3 * MOST + 1: return CALL(3, 1);                         \
    case 3 * MOST + 2: return CALL(3, 2);                         \
    default: return CALL(w->tree->small.n, w->tree->small.nloop); \
    }

int pm_tree_small_derivative(pm_workspace *w, const double *y, double *rate)
{
#define CALL(N, NLOOP) derivative(w, N, NLOOP, y, rate)
    EACH(CALL)
#undef CALL
}

int pm_tree_small_project(pm_workspace *w, double *y, double *ydot)
{
    if (w->tree->small.nloop == 0) return PM_OK;
#define CALL(N, NLOOP) project(w, N, NLOOP, y, ydot)
    EACH(CALL)
#undef CALL
}
