/* orthonormal_rows.c - modified Gram-Schmidt on rows x_k sqrt(1/m_k); where little of a row is left it is orthogonalised once
 * more (twice is enough, by Kahan and Parlett). */
#include "equations/orthonormal_rows.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "numerics/tolerances.h"

static double dot(int from, int to, const double *a, const double *b)
{
    double sum = 0;
    for (int i = from; i < to; i++) sum += a[i] * b[i];
    return sum;
}

/* Takes off a row, zero outside its range, what it has along the first n rows of the basis; whether that is anything. */
static int take_off(const pm_orthonormal *x, int n, double *row, int *range)
{
    int any = 0;
    for (int b = 0; b < n; b++) {
        const double *e = x->row + (size_t)b * (size_t)x->wide;
        const int *other = x->range + 2 * b;
        const int from = other[0] > range[0] ? other[0] : range[0],
                  to = other[1] < range[1] ? other[1] : range[1];
        if (from >= to) continue;
        const double along = dot(from, to, e, row);
        if (along == 0) continue;
        any = 1;
        for (int i = other[0]; i < other[1]; i++) row[i] -= along * e[i];
        if (other[0] < range[0]) range[0] = other[0];
        if (other[1] > range[1]) range[1] = other[1];
    }
    return any;
}

int pm_orthonormal_rows_add(const pm_orthonormal *x, int n, pm_orthonormal_rest *rest)
{
    double *row = x->row + (size_t)n * (size_t)x->wide;
    int *range = x->range + 2 * n;
    double square = dot(range[0], range[1], row, row), before = INFINITY;
    rest->norm = sqrt(square);
    for (int pass = 0; pass < 2 && !(square > PM_TAKEN_OFF_ENOUGH * before); pass++) {
        if (!take_off(x, n, row, range)) break;
        before = square;
        square = dot(range[0], range[1], row, row);
    }
    const double after = sqrt(square);
    rest->left = rest->norm > 0 ? after / rest->norm : 0;
    if (!(rest->left > x->independent) || n >= x->wide) return n;
    for (int i = range[0]; i < range[1]; i++) row[i] /= after;
    return n + 1;
}

static pm_orthonormal basis_of(const pm_saddle *s)
{
    return (pm_orthonormal){s->basis, s->basis_range, s->model->nq, PM_INDEPENDENT};
}

int pm_orthonormal_rows_add_dense(pm_saddle *s, int n, const double *row, pm_orthonormal_rest *rest)
{
    const pm_orthonormal x = basis_of(s);
    double *to = x.row + (size_t)n * (size_t)x.wide;
    for (int i = 0; i < x.wide; i++) to[i] = row[i] * s->numbers->inverse_root[i];
    x.range[2 * n] = 0;
    x.range[2 * n + 1] = x.wide;
    return pm_orthonormal_rows_add(&x, n, rest);
}

int pm_orthonormal_rows_add_constraint(pm_saddle *s, int n, const pm_constraint *c, pm_orthonormal_rest *rest)
{
    const pm_orthonormal x = basis_of(s);
    double *to = x.row + (size_t)n * (size_t)x.wide;
    int *range = x.range + 2 * n;
    memset(to, 0, (size_t)x.wide * sizeof *to);
    range[0] = x.wide;
    range[1] = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++) {
        const int first = 3 * c->body[p];
        if (c->body[p] == s->model->nbody) continue;
        if (first < range[0]) range[0] = first;
        if (first + 3 > range[1]) range[1] = first + 3;
        for (int k = 0; k < 3; k++) to[first + k] += c->j[3 * p + k] * s->numbers->inverse_root[first + k];
    }
    return pm_orthonormal_rows_add(&x, n, rest);
}
