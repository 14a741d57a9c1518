/* tree_band.c - the loop constraints' Jacobian on the dependent coordinates, J_v of tree_partition.c: which of its
 * entries may differ from zero, and its factors.
 *
 * A loop constraint is moved by the coordinates of two bodies and of what carries them.  Numbered by the tree (tree.c)
 * these are neighbours in a chain of loops: J_v is banded, and the work grows with the number of loops.  Where it is not
 * nothing is lost. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "numerics/dense.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* The node of a constraint's partner; NULL for the ground. */
static const pm_tree_node *node_of(const pm_tree *t, const pm_constraint *c, int side)
{
    return c->body[side] == t->model->nbody ? NULL : &t->node[t->placed[c->body[side]] - 1];
}

void pm_tree_loop_zero(const pm_tree *t, const pm_constraint *constraint, double *on_coordinates)
{
    for (int side = 0; side < pm_constraint_bodies(constraint); side++) {
        const pm_tree_node *x = node_of(t, constraint, side);
        for (int k = 0; x && k < x->nlist; k++) on_coordinates[t->moved_by[x->list + k]] = 0;
    }
    for (int c = t->nloop; c < t->n; c++) on_coordinates[t->part.column[c]] = 0;
}

/* Dependent coordinates in falling order, as bodies were placed. */
static void sort_dependent(pm_tree *t)
{
    for (int k = 0; k < t->n; k++) t->part.position[k] = 0;
    for (int c = t->nloop; c < t->n; c++) t->part.position[t->part.column[c]] = 1;
    for (int k = t->n, c = 0; k-- > 0;)
        if (!t->part.position[k]) t->part.column[c++] = k;
    for (int c = 0; c < t->n; c++) t->part.position[t->part.column[c]] = c;
}

/* First and last place of the dependent coordinates that move loop constraint i; none: from its diagonal to it. */
static void span_of(const pm_tree *t, int i, int *first, int *last)
{
    const pm_constraint *c = &t->constraint[t->loop[i]];
    *first = *last = i;
    for (int side = 0, any = 0; side < pm_constraint_bodies(c); side++) {
        const pm_tree_node *x = node_of(t, c, side);
        for (int k = 0; x && k < x->nlist; k++) {
            const int at = t->part.position[t->moved_by[x->list + k]];
            if (at >= t->nloop) continue;
            if (!any || at < *first) *first = at;
            if (!any || at > *last) *last = at;
            any = 1;
        }
    }
}

void pm_tree_arrange(pm_tree *t)
{
    const int n = t->nloop;
    sort_dependent(t);
    for (int j = 0; j < n; j++) t->part.bottom[j] = t->part.right[j] = j;
    for (int i = 0; i < n; i++) {
        int first, last;
        span_of(t, i, &first, &last);
        if (first < i) t->part.bottom[first] = i; /* i rises */
    }
    for (int j = 1; j < n; j++)
        if (t->part.bottom[j] < t->part.bottom[j - 1]) t->part.bottom[j] = t->part.bottom[j - 1];
    for (int i = 0, j = 0; i < n; i++) { /* column j is the first that elimination may fill in row i */
        int first, last;
        while (t->part.bottom[j] < i) j++;
        t->part.left[i] = j;
        span_of(t, i, &first, &last);
        if (last > t->part.right[j]) t->part.right[j] = last;
    }
    for (int j = 1; j < n; j++)
        if (t->part.right[j] < t->part.right[j - 1]) t->part.right[j] = t->part.right[j - 1];
}

void pm_tree_forget_regular(pm_tree *t)
{
    t->part.least_regular = INFINITY;
    t->part.most_regular = 0;
}

/* How far the factors are from those of a singular position. */
static void rate_pivots(pm_tree *t)
{
    const int n = t->nloop;
    double least = INFINITY, most = 0;
    for (int j = 0; j < n; j++) {
        const double pivot = fabs(t->jacobian[j * n + j]);
        least = fmin(least, pivot);
        most = fmax(most, pivot);
    }
    t->part.least_regular = fmin(t->part.least_regular, least / most);
    t->part.most_regular = fmax(t->part.most_regular, least / most);
}

int pm_tree_factor_dependent(pm_workspace *w, const double *jacobian)
{
    pm_tree *t = w->tree;
    const int n = t->nloop;
    for (int i = 0; i < n; i++) {
        double *row = t->jacobian + i * n;
        for (int c = t->part.left[i]; c <= t->part.right[i]; c++) row[c] = 0;
        for (int side = 0; side < 2; side++) {
            const pm_tree_node *x = node_of(w->tree, &w->active.constraint[t->loop[i]], side);
            for (int k = 0; x && k < x->nlist; k++) {
                const int coordinate = t->moved_by[x->list + k], at = t->part.position[coordinate];
                if (at < n) row[at] = jacobian[i * t->n + coordinate];
            }
        }
    }
    if (pm_dense_band_factor(n, t->part.bottom, t->part.right, t->jacobian, t->pivot)) {
        t->part.least_regular = 0;
        return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    }
    rate_pivots(t);
    return PM_OK;
}

void pm_tree_solve_dependent(const pm_tree *t, double *x)
{
    pm_dense_band_solve(t->nloop, t->part.bottom, t->part.right, t->jacobian, t->pivot, x);
}

void pm_tree_solve_dependent_transposed(const pm_tree *t, double *x)
{
    pm_dense_band_solve_transposed(t->nloop, t->part.bottom, t->part.right, t->jacobian, t->pivot, x);
}
