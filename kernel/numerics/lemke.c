/* lemke.c - Lemke's method on the tableau
 *
 *   I w - M z - d z0 = q,   d > 0
 *
 * z0 enters where q_i/d_i is least; from then on the complement of what left enters, until z0 leaves.  The columns of w hold the
 * inverse of the basis, whose rows order ties. */
#include "numerics/lemke.h"

#include <math.h>
#include <string.h>

#include "numerics/tolerances.h"

typedef struct pm_tableau {
    int m, width; /* columns: w, z, z0, q */
    double *row;  /* [m][width] */
    int *basis;   /* [m] column that is basic in each row */
} pm_tableau;

static double *entry(const pm_tableau *t, int i, int column)
{
    return t->row + (size_t)i * t->width + column;
}

/* Another covering vector for each try, between 1 and 2: multiples of the golden section, which never fall together. */
static double covering(int i, int try) { return 1 + fmod(0.6180339887498949 * try * (i + 1), 1); }

static void fill(pm_tableau *t, const double *matrix, const double *q, int try)
{
    const int m = t->m;
    memset(t->row, 0, (size_t)m * t->width * sizeof *t->row);
    for (int i = 0; i < m; i++) {
        *entry(t, i, i) = 1;
        for (int k = 0; k < m; k++) *entry(t, i, m + k) = -matrix[i * m + k];
        *entry(t, i, 2 * m) = -covering(i, try);
        *entry(t, i, 2 * m + 1) = q[i];
        t->basis[i] = i;
    }
}

static void pivot(pm_tableau *t, int row, int column)
{
    const double by = 1 / *entry(t, row, column);
    for (int k = 0; k < t->width; k++) *entry(t, row, k) *= by;
    for (int i = 0; i < t->m; i++) {
        const double factor = *entry(t, i, column);
        if (i == row || factor == 0) continue;
        for (int k = 0; k < t->width; k++) *entry(t, i, k) -= factor * *entry(t, row, k);
        *entry(t, i, column) = 0;
    }
    t->basis[row] = column;
}

/* Whether row i over its entry in the column is less than row k over its own, in the order q, then the inverse basis. */
static int is_before(const pm_tableau *t, int i, int k, int column)
{
    const double a = 1 / *entry(t, i, column), b = 1 / *entry(t, k, column);
    for (int n = -1; n < t->m; n++) {
        const int at = n < 0 ? 2 * t->m + 1 : n;
        const double less = a * *entry(t, i, at) - b * *entry(t, k, at);
        if (fabs(less) > PM_LEMKE_TIE) return less < 0;
    }
    return i < k;
}

/* The row that the column drives out first, z0 before others in a tie; -1 on a ray. */
static int leaving(const pm_tableau *t, int column)
{
    int best = -1;
    double largest = 1;
    for (int i = 0; i < t->m; i++) largest = fmax(largest, fabs(*entry(t, i, column)));
    for (int i = 0; i < t->m; i++) {
        if (*entry(t, i, column) <= PM_LEMKE_PIVOT * largest) continue;
        if (best < 0 || is_before(t, i, best, column)) best = i;
    }
    for (int i = 0; i < t->m && best >= 0; i++) {
        if (t->basis[i] != 2 * t->m || *entry(t, i, column) <= PM_LEMKE_PIVOT * largest) continue;
        const int q = 2 * t->m + 1;
        const double more =
            *entry(t, i, q) / *entry(t, i, column) - *entry(t, best, q) / *entry(t, best, column);
        if (more <= PM_LEMKE_TIE) best = i;
    }
    return best;
}

static double start_ratio(const pm_tableau *t, int i)
{
    return *entry(t, i, 2 * t->m + 1) / -*entry(t, i, 2 * t->m);
}

static int begin(const pm_tableau *t)
{
    int least = 0;
    for (int i = 1; i < t->m; i++)
        if (start_ratio(t, i) < start_ratio(t, least)) least = i;
    return least;
}

static void read_solution(const pm_tableau *t, double *z)
{
    memset(z, 0, (size_t)t->m * sizeof *z);
    for (int i = 0; i < t->m; i++)
        if (t->basis[i] >= t->m && t->basis[i] < 2 * t->m)
            z[t->basis[i] - t->m] = fmax(0, *entry(t, i, 2 * t->m + 1));
}

int pm_lemke_solve(int m, const double *matrix, const double *q, int try, double *scratch, int *basis,
                   double *z)
{
    pm_tableau t = {m, 2 * m + 2, scratch, basis};
    fill(&t, matrix, q, try);
    int row = begin(&t), column = 2 * m;
    if (*entry(&t, row, 2 * m + 1) >= 0) {
        memset(z, 0, (size_t)m * sizeof *z);
        return 1;
    }
    for (int i = 0; i < PM_LEMKE_PIVOTS * m; i++) {
        const int out = t.basis[row];
        pivot(&t, row, column);
        if (out == 2 * m) {
            read_solution(&t, z);
            return 1;
        }
        column = out < m ? out + m : out - m;
        if ((row = leaving(&t, column)) < 0) return 0;
    }
    return 0;
}
