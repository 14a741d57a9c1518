/* elimination.c - elimination of rows that have few entries, near each other; they determine all columns but some.
 *
 * Columns are exchanged, rows are not: with them in an order in which those that share columns are near, their entries stay
 * near each other.  It is the partial pivoting of the transposed matrix, and as stable. */
#include "numerics/elimination.h"

#include <math.h>

static int lesser(int a, int b) { return a < b ? a : b; }

static int greater(int a, int b) { return a > b ? a : b; }

static void begin(pm_elimination *x, int rows, int n, int *column)
{
    for (int k = 0; k < n; k++) column[k] = x->place[k] = k;
    for (int r = rows - 1; r >= 0; r--) {
        const int end = r == rows - 1;
        x->first[r] = end ? x->low[r] : lesser(x->low[r], x->first[r + 1]);
        x->last[r] = end ? x->high[r] : greater(x->high[r], x->last[r + 1]);
    }
}

/* The column of the row's greatest entry, of those that are no pivots', becomes column[i]. */
static void choose(pm_elimination *x, int i, const double *row, int *column)
{
    int best = column[i];
    for (int c = x->low[i]; c <= x->high[i]; c++)
        if (x->place[c] >= i && fabs(row[c]) > fabs(row[best])) best = c;
    const int other = column[i];
    column[x->place[best]] = other;
    x->place[other] = x->place[best];
    column[i] = best;
    x->place[best] = i;
}

/* The columns of row i right of its pivot; how many. */
static int list_filled(pm_elimination *x, int i, const double *row)
{
    int n = 0;
    for (int c = x->low[i]; c <= x->high[i]; c++)
        if (x->place[c] > i && row[c] != 0) x->filled[n++] = c;
    return n;
}

/* Takes row i, with its pivot in column `at`, off those after it. */
static void take_off(pm_elimination *x, int rows, int n, int i, int at, double *a)
{
    const double *top = a + i * n;
    const int nfilled = list_filled(x, i, top);
    int end = i; /* the last row that it was taken off */
    for (int r = i + 1; r < rows && at >= x->first[r] && at <= x->last[r]; r++) {
        double *row = a + r * n;
        if (at < x->low[r] || at > x->high[r] || row[at] == 0) continue;
        const double factor = row[at] / top[at];
        for (int k = 0; k < nfilled; k++) row[x->filled[k]] -= factor * top[x->filled[k]];
        x->low[r] = lesser(x->low[r], x->low[i]);
        x->high[r] = greater(x->high[r], x->high[i]);
        end = r;
    }
    for (int r = i + 1; r <= end; r++) {
        x->first[r] = lesser(x->first[r], x->low[i]);
        x->last[r] = greater(x->last[r], x->high[i]);
    }
}

double pm_elimination_run(int rows, int n, double *a, int *column, pm_elimination *x)
{
    double least = INFINITY, greatest = 0;
    begin(x, rows, n, column);
    for (int i = 0; i < rows; i++) {
        choose(x, i, a + i * n, column);
        const double pivot = fabs(a[i * n + column[i]]);
        least = fmin(least, pivot);
        greatest = fmax(greatest, pivot);
        if (pivot > 0) take_off(x, rows, n, i, column[i], a);
    }
    return least > 0 ? least / greatest : 0;
}
