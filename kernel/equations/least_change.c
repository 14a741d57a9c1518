/* least_change.c - equations one after the other, the first of many as one block. */
#include "equations/least_change.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "equations/saddle.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static double norm_of(const pm_model *model, const pm_numbers *numbers, const double *row)
{
    double sum = 0;
    for (int i = 0; i < model->nq; i++) sum += row[i] * row[i] * numbers->inverse_mass[i];
    return sqrt(sum);
}

/* Adds the gradient of a constraint, times a factor, to a dense row. */
static void add_sparse(const pm_model *model, const pm_constraint *c, double factor, double *dense)
{
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != model->nbody; k++)
            dense[3 * c->body[p] + k] += factor * c->j[3 * p + k];
}

static void spread_out(const pm_model *model, const pm_constraint *c, double *dense)
{
    memset(dense, 0, (size_t)model->nq * sizeof *dense);
    add_sparse(model, c, 1, dense);
}

/* G M^-1 d of one constraint of the block. */
static double along(const pm_model *model, const pm_numbers *numbers, const pm_constraint *c, const double *d)
{
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++)
        for (int k = 0; k < 3 && c->body[p] != model->nbody; k++)
            sum += c->j[3 * p + k] * numbers->inverse_mass[3 * c->body[p] + k] * d[3 * c->body[p] + k];
    return sum;
}

int pm_least_change_add(const pm_active_set *active, pm_saddle *saddle, const pm_least_change *s,
                        const double *row, pm_orthonormal_rest *rest)
{
    if (!s->block) return pm_orthonormal_rows_add_dense(saddle, s->n, row, rest);
    memcpy(s->across, row, (size_t)saddle->model->nq * sizeof *row);
    for (int pass = 0; pass < PM_BLOCK_PASSES; pass++) {
        for (int i = 0; i < active->n; i++)
            saddle->rhs[i] = -along(saddle->model, saddle->numbers, &active->constraint[i], s->across);
        pm_saddle_solve(saddle);
        for (int i = 0; i < active->n; i++)
            add_sparse(saddle->model, &active->constraint[i], saddle->rhs[i], s->across);
    }
    const double all = norm_of(saddle->model, saddle->numbers, row),
                 part = norm_of(saddle->model, saddle->numbers, s->across);
    *rest = (pm_orthonormal_rest){0, all};
    if (!(part > PM_INDEPENDENT * all)) return s->n;
    const int n = pm_orthonormal_rows_add_dense(saddle, s->n, s->across, rest);
    rest->left *= rest->norm / all;
    rest->norm = all;
    return n;
}

int pm_least_change_block(pm_workspace *w, pm_least_change *s, int level)
{
    const pm_model *m = w->model;
    if (m->njoint_constraint < PM_BLOCK_OF_ROWS || !w->numbers.compared_by_mass) return 0;
    w->active.n = 0;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint constraint[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, w->active.joint_order[i], constraint);
        for (int k = 0; k < n; k++) {
            if (level == PM_START_POSITION && constraint[k].memory != PM_NONE) continue;
            pm_constraint *c = &w->active.constraint[w->active.n];
            *c = constraint[k];
            pm_constraint_kind(c->kind)->evaluate(&w->frame, c);
            w->saddle.wanted[w->active.n++] = level == PM_START_POSITION ? -c->g : c->rate;
        }
    }
    if (w->active.n < PM_BLOCK_OF_ROWS ||
        !(pm_saddle_independence_by_mass(&w->saddle) > PM_CLEARLY_INDEPENDENT))
        return 0;
    for (int pass = 0; pass < PM_BLOCK_PASSES; pass++) {
        for (int i = 0; i < w->active.n; i++)
            w->saddle.rhs[i] =
                w->saddle.wanted[i] - pm_constraint_times(&w->frame, &w->active.constraint[i], s->x);
        pm_saddle_solve(&w->saddle);
        pm_saddle_spread(&w->saddle, 0, s->x);
    }
    s->block = w->active.n;
    return 1;
}

/* A row of which the solution misses so much has been added to the basis, which has n rows now; 1 if it is a new one. */
static int meet(const pm_saddle *saddle, pm_least_change *s, int n, const pm_orthonormal_rest *rest,
                double *miss)
{
    if (n == s->n) return 0;
    const double *e = saddle->basis + (size_t)s->n * (size_t)saddle->model->nq,
                 component = *miss / (rest->left * rest->norm);
    const int *range = saddle->basis_range + 2 * s->n;
    for (int i = range[0]; i < range[1]; i++) s->x[i] += component * e[i] * saddle->numbers->inverse_root[i];
    s->n = n;
    *miss = 0;
    return 1;
}

int pm_least_change_take(const pm_active_set *active, pm_saddle *saddle, pm_least_change *s,
                         const double *row, double rhs, double *miss)
{
    pm_orthonormal_rest rest;
    double now = 0;
    for (int i = 0; i < saddle->model->nq; i++) now += row[i] * s->x[i];
    *miss = rhs - now;
    return meet(saddle, s, pm_least_change_add(active, saddle, s, row, &rest), &rest, miss);
}

int pm_least_change_take_constraint(pm_workspace *w, pm_least_change *s, const pm_constraint *c, double rhs,
                                    double *dense, double *miss)
{
    pm_orthonormal_rest rest;
    if (s->block) {
        spread_out(w->model, c, dense);
        return pm_least_change_take(&w->active, &w->saddle, s, dense, rhs, miss);
    }
    *miss = rhs - pm_constraint_times(&w->frame, c, s->x);
    return meet(&w->saddle, s, pm_orthonormal_rows_add_constraint(&w->saddle, s->n, c, &rest), &rest, miss);
}
