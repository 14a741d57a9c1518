/* basis.c - modified Gram-Schmidt on rows x_k sqrt(1/m_k), each taken off twice (enough, by Kahan and Parlett). */
#include "basis.h"

#include <math.h>
#include <string.h>

static double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Row n of the basis holds a scaled row: makes it orthonormal to those before it, if it is independent. */
static int orthonormalise(pm_workspace *w, int n, pm_basis_rest *rest)
{
    const int nq = w->model->nq;
    double *row = w->basis + (size_t)n * (size_t)nq;
    rest->norm = sqrt(dot(nq, row, row));
    for (int pass = 0; pass < 2; pass++)
        for (int b = 0; b < n; b++) {
            const double *e = w->basis + (size_t)b * (size_t)nq, along = dot(nq, e, row);
            for (int i = 0; i < nq; i++) row[i] -= along * e[i];
        }
    const double after = sqrt(dot(nq, row, row));
    rest->left = rest->norm > 0 ? after / rest->norm : 0;
    if (!(rest->left > PM_INDEPENDENT) || n >= nq) return n;
    for (int i = 0; i < nq; i++) row[i] /= after;
    return n + 1;
}

int pm_basis_add_dense(pm_workspace *w, int n, const double *x, pm_basis_rest *rest)
{
    double *row = w->basis + (size_t)n * (size_t)w->model->nq;
    for (int i = 0; i < w->model->nq; i++) row[i] = x[i] * sqrt(w->inverse_mass[i]);
    return orthonormalise(w, n, rest);
}

int pm_basis_add(pm_workspace *w, int n, const double j[6], const int body[2], pm_basis_rest *rest)
{
    const int nq = w->model->nq, ground = w->model->nbody;
    double *row = w->basis + (size_t)n * (size_t)nq;
    memset(row, 0, (size_t)nq * sizeof *row);
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3 && body[p] != ground; k++)
            row[3 * body[p] + k] += j[3 * p + k] * sqrt(w->inverse_mass[3 * body[p] + k]);
    return orthonormalise(w, n, rest);
}
