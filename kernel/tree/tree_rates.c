/* tree_rates.c - velocities and accelerations outward along the tree, and its loop constraints.
 *
 * By tree_node.h velocities are linear in the rates; what the accelerations have beside the same form is, with r from
 * the mass centres to the marks (of the child r_c, of the parent r_p) and rho = P_a - p_b,
 *   -omega_p^2 r_p + omega_c^2 r_c   and   line      2 omega_b sdot k x t - omega_b^2 rho
 *                                    circles, link   -phidot^2 rho        (with the sign of P_a - p_b seen from p) */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

static const double *rates_of(const pm_tree *t, const double *v, int body)
{
    static const double zero[3] = {0, 0, 0};
    return body == t->model->nbody ? zero : v + 3 * body;
}

void pm_tree_spread(const pm_tree *t, const double *ydot, double *v)
{
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        pm_tree_move(x, rates_of(t, v, x->parent), ydot + x->first, v + 3 * x->body);
    }
}

/* Rates of the coordinates of a body that its parent carries, from the rates of both. */
static void read_own(const pm_tree_node *x, const double *parent, const double *to, double *own)
{
    if (pm_tree_shifts(x)) own[x->shift] = pm_tree_slide_rate(x, parent, to);
    if (!pm_tree_follows(x) && x->rotates && x->ncoordinate > 0) own[0] = to[2];
}

void pm_tree_read_rates(const pm_tree *t, const double *v, double *ydot)
{
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        const double *to = v + 3 * x->body;
        double *own = ydot + x->first;
        if (x->placement == FREE)
            memcpy(own, to, (size_t)x->ncoordinate * sizeof *own);
        else
            read_own(x, rates_of(t, v, x->parent), to, own);
    }
}

void pm_tree_spread_accelerations(const pm_tree *t, const pm_frame *frame, const double *yddot, double *a)
{
    for (int i = t->nfixed; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        double *to = a + 3 * x->body;
        pm_tree_move(x, rates_of(t, a, x->parent), yddot + x->first, to);
        if (x->placement != FREE)
            pm_tree_add_quadratic(x, frame->velocity + 3 * x->parent, frame->velocity + 3 * x->body, to);
    }
}

void pm_tree_read_accelerations(const pm_tree *t, const pm_frame *frame, const double *a, double *yddot)
{
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        const double *to = a + 3 * x->body;
        double *own = yddot + x->first;
        if (x->placement == FREE) {
            memcpy(own, to, (size_t)x->ncoordinate * sizeof *own);
        } else {
            double rest[3] = {to[0], to[1], to[2]}, quadratic[3] = {0, 0, 0};
            if (pm_tree_shifts(x))
                pm_tree_add_quadratic(x, frame->velocity + 3 * x->parent, frame->velocity + 3 * x->body,
                                      quadratic);
            for (int k = 0; k < 2; k++) rest[k] -= quadratic[k];
            read_own(x, rates_of(t, a, x->parent), rest, own);
        }
    }
}

void pm_tree_bias(const pm_tree *t, const pm_frame *frame, double *a)
{
    memset(t->rate, 0, (size_t)t->n * sizeof(double));
    pm_tree_spread_accelerations(t, frame, t->rate, a);
}

void pm_tree_influence(const pm_tree *t)
{
    static const double none[3] = {0, 0, 0}, unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        double *to = t->influence + 3 * x->list;
        const int inherited = x->nlist - x->ncoordinate;
        if (inherited > 0) {
            const double *from = t->influence + 3 * t->node[t->placed[x->parent] - 1].list;
            for (int k = 0; k < inherited; k++, to += 3, from += 3) pm_tree_move(x, from, none, to);
        }
        for (int k = x->ncoordinate; k-- > 0; to += 3) pm_tree_move(x, none, unit[k], to);
    }
}

/* ---- loop constraints ---- */
void pm_tree_evaluate_loops(const pm_tree *t, const pm_frame *frame)
{
    for (int i = 0; i < t->nloop; i++) {
        pm_constraint *c = &t->constraint[t->loop[i]];
        pm_constraint_kind(c->kind)->evaluate(frame, c);
    }
}

int pm_tree_singular_loop(pm_workspace *w, int loop)
{
    const pm_constraint *c = &w->active.constraint[w->tree->loop[loop]];
    w->tree->part.independence = 0;
    return c->joint != PM_NONE ? pm_fail(&w->result, PM_SINGULAR, PM_TABLE_JOINT, c->joint, 0, 0)
                               : pm_fail(&w->result, PM_SINGULAR, PM_TABLE_CONTACT, PM_NONE, 0, 0);
}

void pm_tree_loop_add(const pm_tree *t, const pm_constraint *c, double *on_coordinates)
{
    for (int side = 0; side < pm_constraint_bodies(c); side++) {
        if (c->body[side] == t->model->nbody) continue;
        const pm_tree_node *x = &t->node[t->placed[c->body[side]] - 1];
        const double *j = c->j + 3 * side;
        for (int k = x->list; k < x->list + x->nlist; k++) {
            const double *b = t->influence + 3 * k;
            on_coordinates[t->moved_by[k]] += j[0] * b[0] + j[1] * b[1] + j[2] * b[2];
        }
    }
}

void pm_tree_loops(const pm_tree *t, const pm_frame *frame, const pm_loops *x)
{
    pm_tree_influence(t);
    for (int i = 0; i < t->nloop; i++) {
        pm_constraint *constraint = &t->constraint[t->loop[i]];
        double *entry = x->entry + i * t->n;
        pm_constraint_kind(constraint->kind)->evaluate(frame, constraint);
        for (int c = x->low[i]; c <= x->high[i]; c++) entry[c] = 0;
        pm_tree_loop_ends(t, constraint, &x->low[i], &x->high[i]);
        pm_tree_loop_add(t, constraint, entry);
    }
}

void pm_tree_loops_unknown(const pm_tree *t, const pm_loops *x)
{
    for (int i = 0; i < t->nloop; i++) {
        x->low[i] = 0;
        x->high[i] = t->n - 1;
    }
}
