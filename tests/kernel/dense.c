/* Cholesky and LU on random systems: the residual is at rounding, a singular matrix is reported with its row. */
#include "numerics/dense.h"

#include <string.h>

#include "check.h"

#define MOST 24
#define SYSTEMS 200

/* max |A x - b| relative to |A| |x| */
static double residual(int n, const double *a, const double *x, const double *b)
{
    double worst = 0;
    for (int i = 0; i < n; i++) {
        double sum = -b[i], size = 1e-300;
        for (int k = 0; k < n; k++) {
            sum += a[i * n + k] * x[k];
            size += fabs(a[i * n + k] * x[k]);
        }
        worst = fmax(worst, fabs(sum) / size);
    }
    return worst;
}

static void random_matrix(int rows, int columns, double *a)
{
    for (int i = 0; i < rows * columns; i++) a[i] = check_random(-1, 1);
}

static void gram(int n, const double *g, double *a)
{
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            a[i * n + k] = 0;
            for (int j = 0; j < 2 * n; j++) a[i * n + k] += g[i * 2 * n + j] * g[k * 2 * n + j];
        }
}

static void cholesky(int n)
{
    double g[2 * MOST * MOST], a[MOST * MOST], f[MOST * MOST], b[MOST], x[MOST];
    random_matrix(n, 2 * n, g);
    gram(n, g, a);
    random_matrix(n, 1, b);
    memcpy(f, a, sizeof a);
    memcpy(x, b, sizeof b);
    for (int i = 0; i < n; i++) /* only the lower half is read */
        for (int k = i + 1; k < n; k++) f[i * n + k] = NAN;
    EQUAL(pm_dense_cholesky_factor(n, f), 0);
    pm_dense_cholesky_solve(n, f, x);
    NEAR(residual(n, a, x, b), 0, 1e-13);
    if (n < 2) return;
    for (int j = 0; j < 2 * n; j++)
        g[(n - 1) * 2 * n + j] = -0.5 * g[j]; /* the last row depends on the first */
    gram(n, g, a);
    EQUAL(pm_dense_cholesky_factor(n, a), n);
}

static void lu(int n)
{
    double a[MOST * MOST], f[MOST * MOST], b[MOST], x[MOST];
    int pivot[MOST];
    random_matrix(n, n, a);
    a[0] = 0; /* needs a row exchange */
    if (n == 1) a[0] = 2.385;
    random_matrix(n, 1, b);
    memcpy(f, a, sizeof a);
    memcpy(x, b, sizeof b);
    EQUAL(pm_dense_lu_factor(n, f, pivot), 0);
    pm_dense_lu_solve(n, f, pivot, x);
    NEAR(residual(n, a, x, b), 0, 1e-11);
    memcpy(f, a, sizeof a);
    EQUAL(pm_dense_lu_invert(n, f, pivot), 0);
    for (int i = 0; i < n; i++) {
        x[i] = 0;
        for (int k = 0; k < n; k++) x[i] += f[i * n + k] * b[k];
    }
    NEAR(residual(n, a, x, b), 0, 1e-10);
    memcpy(f, a, sizeof a);
    for (int i = 0; i < n; i++) f[i * n] = 0;
    EQUAL(pm_dense_lu_factor(n, f, pivot), 1);
    EQUAL(pm_dense_lu_invert(n, f, pivot), 1);
}

/* A random limit from j on that does not fall. */
static void random_limit(int n, int *limit)
{
    for (int j = 0; j < n; j++) {
        limit[j] = j + (int)check_random(0, 4);
        if (limit[j] >= n) limit[j] = n - 1;
        if (j > 0 && limit[j] < limit[j - 1]) limit[j] = limit[j - 1];
    }
}

/* What is outside the band is not looked at. */
static void band(int n)
{
    double a[MOST * MOST], f[MOST * MOST], transposed[MOST * MOST], b[MOST], x[MOST];
    int pivot[MOST], bottom[MOST], right[MOST];
    random_limit(n, bottom);
    random_limit(n, right);
    for (int j = 0; j < n; j++)
        if (right[j] < bottom[j]) right[j] = bottom[j]; /* the diagonal is there */
    for (int i = 0, left = 0; i < n;
         i++) { /* a row begins at `left` and ends as it says there, before it is filled */
        while (bottom[left] < i) left++;
        for (int k = 0; k < n; k++) {
            a[i * n + k] = k >= left && k <= right[left] ? check_random(-1, 1) : 0;
            f[i * n + k] = k >= left && k <= right[i] ? a[i * n + k] : NAN;
            transposed[k * n + i] = a[i * n + k];
        }
    }
    random_matrix(n, 1, b);
    memcpy(x, b, sizeof b);
    EQUAL(pm_dense_band_factor(n, bottom, right, f, pivot), 0);
    pm_dense_band_solve(n, bottom, right, f, pivot, x);
    NEAR(residual(n, a, x, b), 0, 1e-10);
    memcpy(x, b, sizeof b);
    pm_dense_band_solve_transposed(n, bottom, right, f, pivot, x);
    NEAR(residual(n, transposed, x, b), 0, 1e-10);
    for (int i = 0; i < n; i++) a[i * n] = 0;
    EQUAL(pm_dense_band_factor(n, bottom, right, a, pivot), 1);
}

int main(void)
{
    for (int i = 0; i < SYSTEMS; i++) {
        const int n = 1 + i % MOST;
        cholesky(n);
        lu(n);
        band(n);
    }
    double indefinite[] = {1, 0, 2, 1}; /* [1 2; 2 1] */
    EQUAL(pm_dense_cholesky_factor(2, indefinite), 2);
    return check_failures();
}
