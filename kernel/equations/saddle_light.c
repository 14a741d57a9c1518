/* saddle_light.c - light coordinates are unknowns beside the reactions:
 *
 *   [ G_h M_h^-1 H_h^T   G_l ] [  l  ]   [ c - G_h M_h^-1 f_h ]
 *   [      -H_l^T        M_l ] [ x_l ] = [        f_l         ]
 *
 * h: the others.  In S = G M^-1 H^T the terms of a small M_l, as of a point mass on a leg, leave nothing of those of M_h; here
 * M_l may be as small as it likes.  Rows and columns are scaled alike until the greatest entry of each is about one. */
#include "equations/saddle_light.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/orthonormal_rows.h"
#include "equations/saddle.h"
#include "numerics/dense.h"
#include "numerics/tolerances.h"

static double inverse_heavy(const pm_saddle *s, int at)
{
    return s->numbers->light[at] ? 0 : s->numbers->inverse_mass[at];
}

/* One entry of G_h M_h^-1 H_h^T. */
static double coupled(const pm_saddle *s, const pm_constraint *a, const pm_constraint *b)
{
    const double *h = pm_saddle_direction(s, b);
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(a); p++)
        for (int r = 0; r < pm_constraint_bodies(b) && a->body[p] != s->model->nbody; r++)
            for (int k = 0; k < 3 && a->body[p] == b->body[r]; k++)
                sum += a->j[3 * p + k] * h[3 * r + k] * inverse_heavy(s, 3 * a->body[p] + k);
    return sum;
}

/* What a row of G or H has at a coordinate. */
static double at_coordinate(const pm_saddle *s, const pm_constraint *c, const double *row, int at)
{
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        if (c->body[p] != s->model->nbody && c->body[p] == at / 3) sum += row[3 * p + at % 3];
    return sum;
}

/* Light coordinates that some active constraint moves. */
static void list(pm_saddle *s)
{
    s->light.n = 0;
    for (int at = 0; at < s->model->nq; at++) {
        int any = 0;
        for (int i = 0; i < s->active->n && s->numbers->light[at] && !any; i++)
            any = at_coordinate(s, &s->active->constraint[i], s->active->constraint[i].j, at) != 0;
        if (any) s->light.at[s->light.n++] = at;
    }
}

static void fill(pm_saddle *s)
{
    const int n = s->active->n, all = n + s->light.n;
    const pm_constraint *c = s->active->constraint;
    double *a = s->light.matrix;
    memset(a, 0, (size_t)all * (size_t)all * sizeof *a);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) a[i * all + k] = coupled(s, &c[i], &c[k]);
        for (int k = 0; k < s->light.n; k++) {
            a[i * all + n + k] = at_coordinate(s, &c[i], c[i].j, s->light.at[k]);
            a[(n + k) * all + i] = -at_coordinate(s, &c[i], pm_saddle_direction(s, &c[i]), s->light.at[k]);
        }
    }
    for (int k = 0; k < s->light.n; k++)
        a[(n + k) * all + n + k] = 1 / s->numbers->inverse_mass[s->light.at[k]];
}

/* [D. Ruiz, A scaling algorithm to equilibrate both rows and columns norms in matrices, RAL-TR-2001-034] */
static void scale(pm_saddle *s, int all)
{
    double *a = s->light.matrix, *by = s->light.scale;
    for (int i = 0; i < all; i++) by[i] = 1;
    for (int round = 0; round < PM_LIGHT_SCALINGS; round++)
        for (int i = 0; i < all; i++) {
            double most = 0;
            for (int k = 0; k < all; k++) {
                const double x = by[i] * by[k];
                most = fmax(most, x * fmax(fabs(a[i * all + k]), fabs(a[k * all + i])));
            }
            if (most > 0) by[i] /= sqrt(most);
        }
    for (int i = 0; i < all; i++)
        for (int k = 0; k < all; k++) a[i * all + k] *= by[i] * by[k];
}

int pm_saddle_light_factor(pm_saddle *s)
{
    const int n = s->active->n;
    list(s);
    fill(s);
    const int all = n + s->light.n;
    scale(s, all);
    int bad = pm_dense_lu_factor(all, s->light.matrix, s->light.pivot);
    for (int i = 0; i < all && !bad; i++)
        if (!(fabs(s->light.matrix[i * all + i]) > PM_PIVOT_LOSS)) bad = i + 1;
    return bad > n ? n : bad;
}

void pm_saddle_light_solve(pm_saddle *s, const double *force)
{
    const int n = s->active->n, all = n + s->light.n;
    double *x = s->light.unknown;
    const double *by = s->light.scale;
    for (int i = 0; i < n; i++) x[i] = by[i] * s->rhs[i];
    for (int k = 0; k < s->light.n; k++) x[n + k] = force ? by[n + k] * force[s->light.at[k]] : 0;
    pm_dense_lu_solve(all, s->light.matrix, s->light.pivot, x);
    for (int i = 0; i < n; i++) s->rhs[i] = by[i] * x[i];
    for (int k = 0; k < s->light.n; k++) s->light.response[s->light.at[k]] = by[n + k] * x[n + k];
}

double pm_saddle_light_independence(pm_saddle *s)
{
    pm_orthonormal_rest rest;
    double least = 1;
    for (int i = 0; i < s->active->n && least > 0; i++) {
        const int grows = pm_orthonormal_rows_add_constraint(s, i, &s->active->constraint[i], &rest) > i;
        least = grows ? fmin(least, rest.left) : 0;
    }
    return least;
}
