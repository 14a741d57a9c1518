/* The least of quadratic and linear functions under linear conditions, beside all sets of conditions that may bound it. */
#include <string.h>

#include "check.h"
#include "numerics/dense.h"
#include "numerics/quadratic_program.h"

enum { K = 3, N = 6 };

typedef struct problem {
    double matrix[K * K], c[K], a[N * K], b[N];
} problem;

static double value_of(const problem *x, const double *s)
{
    double sum = 0;
    for (int i = 0; i < K; i++) {
        sum += x->c[i] * s[i];
        for (int k = 0; k < K; k++) sum += 0.5 * s[i] * x->matrix[i * K + k] * s[k];
    }
    return sum;
}

static double worst_of(const problem *x, const double *s)
{
    double worst = INFINITY;
    for (int r = 0; r < N; r++) {
        double room = x->b[r];
        for (int k = 0; k < K; k++) room += x->a[r * K + k] * s[k];
        worst = fmin(worst, room);
    }
    return worst;
}

/* The stationary point with the conditions of a set as equations; 0 if there is none, or more than one. */
static int stationary(const problem *x, int set, double *s)
{
    double system[(K + N) * (K + N)] = {0}, right[K + N] = {0};
    int m = K, pivot[K + N], row[N];
    for (int r = 0; r < N; r++)
        if (set & (1 << r)) row[m++ - K] = r;
    if (m > 2 * K) return 0;
    for (int i = 0; i < K; i++) {
        right[i] = -x->c[i];
        for (int k = 0; k < K; k++) system[i * m + k] = x->matrix[i * K + k];
        for (int r = K; r < m; r++) system[i * m + r] = -x->a[row[r - K] * K + i];
        for (int r = K; r < m; r++) system[r * m + i] = x->a[row[r - K] * K + i];
    }
    for (int r = K; r < m; r++) right[r] = -x->b[row[r - K]];
    if (pm_dense_lu_factor(m, system, pivot)) return 0;
    pm_dense_lu_solve(m, system, pivot, right);
    memcpy(s, right, K * sizeof *s);
    return 1;
}

/* The least value by all sets; infinite where nothing meets the conditions. */
static double least_of(const problem *x)
{
    double least = INFINITY, s[K];
    for (int set = 0; set < 1 << N; set++)
        if (stationary(x, set, s) && worst_of(x, s) > -1e-9) least = fmin(least, value_of(x, s));
    return least;
}

/* Bounded by a box, so that linear ones have a least value. */
static problem random_problem(int linear)
{
    problem x = {.c = {0}};
    double root[K * K];
    for (int i = 0; i < K * K; i++) root[i] = check_random(-1, 1);
    for (int i = 0; i < K * K && !linear; i++)
        for (int k = 0; k < K; k++) x.matrix[i] += root[i / K * K + k] * root[i % K * K + k];
    for (int i = 0; i < K; i++) x.c[i] = check_random(-1, 1);
    for (int r = 0; r < N; r++) {
        x.b[r] = check_random(linear ? 0.1 : -0.3, 1);
        for (int k = 0; k < K; k++)
            x.a[r * K + k] = linear ? (k == r % K) * (r < K ? 1 : -1) : check_random(-1, 1);
        if (linear && r >= K) x.a[r * K + (r + 1) % K] = check_random(-0.5, 0.5);
    }
    return x;
}

static void random_problems(int linear)
{
    enum { SIZE = PM_QUADRATIC_SCRATCH(K, N), ORDER = PM_QUADRATIC_ORDER(K, N) };
    static double scratch[SIZE];
    static int basis[ORDER];
    int solved = 0;
    for (int i = 0; i < 3000; i++) {
        const problem x = random_problem(linear);
        double s[K], bound[N];
        const pm_quadratic_program p = {K,       N,    linear ? NULL : x.matrix, x.c, x.a, x.b, s, bound,
                                        scratch, basis};
        const double least = least_of(&x);
        const int found = pm_quadratic_program_solve(&p);
        if (!found) continue;
        solved++;
        CHECK(worst_of(&x, s) > -1e-7);
        NEAR(value_of(&x, s), least, 1e-6 * fmax(1, fabs(least)));
        for (int r = 0; r < N; r++) CHECK(bound[r] >= 0);
    }
    CHECK(solved > 2500);
}

int main(void)
{
    random_problems(0);
    random_problems(1);
    return check_failures();
}
