/* orthonormal_rows.c - modified Gram-Schmidt on rows x_k sqrt(1/m_k); where much of a row has gone what is left is taken off once more
 * (twice is enough, by Kahan and Parlett). */
#include "equations/orthonormal_rows.h"

#include <math.h>
#include <string.h>

#include "state/workspace.h"

#define MUCH 0.5 /* of the square of a row: if that has not gone, rounding has not grown */

static double dot(int from, int to, const double *a, const double *b)
{
    double sum = 0;
    for (int i = from; i < to; i++) sum += a[i] * b[i];
    return sum;
}

/* Takes off a row, zero outside its range, what it has along the first n rows of the basis. */
static void take_off(const pm_workspace *w, int n, double *row, int *range)
{
    for (int b = 0; b < n; b++) {
        const double *e = w->saddle.basis + (size_t)b * (size_t)w->model->nq;
        const int *other = w->saddle.basis_range + 2 * b;
        const int from = other[0] > range[0] ? other[0] : range[0],
                  to = other[1] < range[1] ? other[1] : range[1];
        if (from >= to) continue;
        const double along = dot(from, to, e, row);
        if (along == 0) continue;
        for (int i = other[0]; i < other[1]; i++) row[i] -= along * e[i];
        if (other[0] < range[0]) range[0] = other[0];
        if (other[1] > range[1]) range[1] = other[1];
    }
}

/* Row n of the basis holds a scaled row, zero outside its range: makes it orthonormal to those before it, if it is
 * independent.  Rows that share no coordinate are orthogonal as they are. */
static int orthonormalise(pm_workspace *w, int n, pm_orthonormal_rest *rest)
{
    const int nq = w->model->nq;
    double *row = w->saddle.basis + (size_t)n * (size_t)nq;
    int *range = w->saddle.basis_range + 2 * n;
    double square = dot(range[0], range[1], row, row), before = INFINITY;
    rest->norm = sqrt(square);
    for (int pass = 0; pass < 2 && !(square > MUCH * before); pass++) {
        take_off(w, n, row, range);
        before = square;
        square = dot(range[0], range[1], row, row);
    }
    const double after = sqrt(square);
    rest->left = rest->norm > 0 ? after / rest->norm : 0;
    if (!(rest->left > PM_INDEPENDENT) || n >= nq) return n;
    for (int i = range[0]; i < range[1]; i++) row[i] /= after;
    return n + 1;
}

int pm_orthonormal_rows_add_dense(pm_workspace *w, int n, const double *x, pm_orthonormal_rest *rest)
{
    double *row = w->saddle.basis + (size_t)n * (size_t)w->model->nq;
    for (int i = 0; i < w->model->nq; i++) row[i] = x[i] * w->numbers.inverse_root[i];
    w->saddle.basis_range[2 * n] = 0;
    w->saddle.basis_range[2 * n + 1] = w->model->nq;
    return orthonormalise(w, n, rest);
}

int pm_orthonormal_rows_add(pm_workspace *w, int n, const double j[6], const int body[2],
                            pm_orthonormal_rest *rest)
{
    const int nq = w->model->nq, ground = w->model->nbody;
    double *row = w->saddle.basis + (size_t)n * (size_t)nq;
    int *range = w->saddle.basis_range + 2 * n;
    memset(row, 0, (size_t)nq * sizeof *row);
    range[0] = nq;
    range[1] = 0;
    for (int p = 0; p < 2; p++) {
        if (body[p] == ground) continue;
        if (3 * body[p] < range[0]) range[0] = 3 * body[p];
        if (3 * body[p] + 3 > range[1]) range[1] = 3 * body[p] + 3;
        for (int k = 0; k < 3; k++)
            row[3 * body[p] + k] += j[3 * p + k] * w->numbers.inverse_root[3 * body[p] + k];
    }
    return orthonormalise(w, n, rest);
}
