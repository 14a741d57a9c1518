/* dense.c - Cholesky and LU for some tens of unknowns: plain loops, no library call overhead, the same bits everywhere. */
#include "numerics/dense.h"
#include "numerics/tolerances.h"

#include <math.h>

/* A pivot this much smaller than its diagonal has lost all figures: the rows depend on each other. */

int pm_dense_cholesky_factor(int n, double *a)
{
    for (int j = 0; j < n; j++) {
        double *aj = a + j * n;
        const double diagonal = aj[j];
        double sum = diagonal;
        for (int k = 0; k < j; k++) sum -= aj[k] * aj[k];
        if (!(sum > PM_PIVOT_LOSS * diagonal)) return j + 1;
        const double root = sqrt(sum), inverse = 1 / root;
        aj[j] = root;
        for (int i = j + 1; i < n; i++) {
            double *ai = a + i * n, s = ai[j];
            for (int k = 0; k < j; k++) s -= ai[k] * aj[k];
            ai[j] = s * inverse;
        }
    }
    return 0;
}

void pm_dense_cholesky_solve(int n, const double *a, double *x)
{
    for (int i = 0; i < n; i++) {
        double s = x[i];
        for (int k = 0; k < i; k++) s -= a[i * n + k] * x[k];
        x[i] = s / a[i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        double s = x[i];
        for (int k = i + 1; k < n; k++) s -= a[k * n + i] * x[k];
        x[i] = s / a[i * n + i];
    }
}

int pm_dense_skyline_factor(int n, const int *first, double *a)
{
    for (int i = 0; i < n; i++) {
        double *ai = a + i * n;
        const double diagonal = ai[i];
        for (int j = first[i]; j < i; j++) {
            const double *aj = a + j * n;
            double s = ai[j];
            for (int k = first[i] > first[j] ? first[i] : first[j]; k < j; k++) s -= ai[k] * aj[k];
            ai[j] = s * aj[j];
        }
        double sum = diagonal;
        for (int k = first[i]; k < i; k++) sum -= ai[k] * ai[k];
        if (!(sum > PM_PIVOT_LOSS * diagonal)) return i + 1;
        ai[i] = 1 / sqrt(sum); /* the reciprocal: solving needs no division */
    }
    return 0;
}

void pm_dense_skyline_part(int n, int from, int to, const int *first, const double *a, double *x)
{
    for (int i = from; i < to; i++) {
        const double *ai = a + i * n;
        double s = x[i];
        for (int k = first[i] > from ? first[i] : from; k < i; k++) s -= ai[k] * x[k];
        x[i] = s * ai[i];
    }
}

void pm_dense_skyline_lower(int n, const int *first, const double *a, double *x)
{
    pm_dense_skyline_part(n, 0, n, first, a, x);
}

void pm_dense_skyline_upper(int n, const int *first, const double *a, double *x)
{
    for (int i = n - 1; i >= 0; i--) {
        const double *ai = a + i * n, s = x[i] *= ai[i];
        for (int k = first[i]; k < i; k++) x[k] -= ai[k] * s;
    }
}

/* Exchanges row j for the one with the greatest entry in column j from there on; 0, or 1 + a column without one. */
static int bring_pivot(int n, double *a, int j, int *pivot)
{
    int best = j;
    for (int i = j + 1; i < n; i++)
        if (fabs(a[i * n + j]) > fabs(a[best * n + j])) best = i;
    pivot[j] = best;
    if (!(fabs(a[best * n + j]) > 0)) return j + 1;
    if (best != j)
        for (int k = 0; k < n; k++) {
            const double swap = a[j * n + k];
            a[j * n + k] = a[best * n + k];
            a[best * n + k] = swap;
        }
    return 0;
}

int pm_dense_lu_factor(int n, double *a, int *pivot)
{
    for (int j = 0; j < n; j++) {
        const int bad = bring_pivot(n, a, j, pivot);
        if (bad) return bad;
        const double inverse = 1 / a[j * n + j];
        for (int i = j + 1; i < n; i++) {
            const double factor = a[i * n + j] *= inverse;
            if (factor == 0) continue;
            for (int k = j + 1; k < n; k++) a[i * n + k] -= factor * a[j * n + k];
        }
    }
    return 0;
}

void pm_dense_lu_solve(int n, const double *a, const int *pivot, double *x)
{
    for (int i = 0; i < n; i++) {
        const double swap = x[pivot[i]];
        x[pivot[i]] = x[i];
        x[i] = swap;
        for (int k = 0; k < i; k++) x[i] -= a[i * n + k] * x[k];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
}

int pm_dense_band_factor(int n, const int *bottom, const int *right, double *a, int *pivot)
{
    for (int j = 0; j < n; j++) {
        const int end = bottom[j], last = right[j];
        double *top = a + j * n;
        int best = j;
        for (int i = j + 1; i <= end; i++)
            if (fabs(a[i * n + j]) > fabs(a[best * n + j])) best = i;
        pivot[j] = best;
        if (!(fabs(a[best * n + j]) > 0)) return j + 1;
        for (int k = j; k <= last && best != j; k++) {
            const double swap = top[k];
            top[k] = a[best * n + k];
            a[best * n + k] = swap;
        }
        const double inverse = 1 / top[j];
        for (int i = j + 1; i <= end; i++) {
            double *row = a + i * n;
            const double factor = row[j] *= inverse;
            if (factor == 0) continue;
            for (int k = j + 1; k <= last; k++) row[k] -= factor * top[k];
        }
    }
    return 0;
}

static void exchange(double *x, int i, int k)
{
    const double swap = x[k];
    x[k] = x[i];
    x[i] = swap;
}

void pm_dense_band_solve(int n, const int *bottom, const int *right, const double *a, const int *pivot,
                         double *x)
{
    for (int j = 0; j < n; j++) {
        exchange(x, j, pivot[j]);
        for (int i = j + 1; i <= bottom[j]; i++) x[i] -= a[i * n + j] * x[j];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k <= right[i]; k++) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
}

void pm_dense_band_solve_transposed(int n, const int *bottom, const int *right, const double *a,
                                    const int *pivot, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] /= a[i * n + i];
        for (int k = i + 1; k <= right[i]; k++) x[k] -= a[i * n + k] * x[i];
    }
    for (int j = n - 1; j >= 0; j--) {
        for (int i = j + 1; i <= bottom[j]; i++) x[j] -= a[i * n + j] * x[i];
        exchange(x, j, pivot[j]);
    }
}

/* ---- the inverse ---- */
/* Row `j`, whose pivot is in its place, eliminated from all others (Gauss, Jordan); its column becomes that of the
 * inverse. */
static void eliminate(int n, double *a, int j)
{
    double *const aj = a + j * n;
    const double inverse = 1 / aj[j];
    aj[j] = 1;
    for (int k = 0; k < n; k++) aj[k] *= inverse;
    for (int i = 0; i < n; i++) {
        double *const ai = a + i * n;
        const double factor = ai[j];
        if (i == j || factor == 0) continue;
        ai[j] = 0;
        for (int k = 0; k < n; k++) ai[k] -= factor * aj[k];
    }
}

int pm_dense_lu_invert(int n, double *a, int *pivot)
{
    for (int j = 0; j < n; j++) {
        const int bad = bring_pivot(n, a, j, pivot);
        if (bad) return bad;
        eliminate(n, a, j);
    }
    for (int j = n - 1; j >= 0; j--)
        for (int i = 0; i < n && pivot[j] != j; i++) {
            const double swap = a[i * n + j];
            a[i * n + j] = a[i * n + pivot[j]];
            a[i * n + pivot[j]] = swap;
        }
    return 0;
}
