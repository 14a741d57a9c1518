/* tree_dynamics.c - motion in tree coordinates: v = B ydot, a = B yddot + c.
 *
 *   [ B^T M B  J^T ] [ yddot ]   [ B^T (f - M c)   ]
 *   [ J        0   ] [  -l   ] = [ gamma - G c     ]      J = G B of the loop constraints
 * by Cholesky: with B^T M B = L L^T and X = J L^-T the loops have S = X X^T.  What the solved constraints carry follows
 * inward from M a - f, body by body (d'Alembert): a parent gives each body what its mass and its children need. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/joint_friction.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "numerics/dense.h"
#include "numerics/lanes.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* The lower triangle of B^T M B, with stand-ins for what has no mass; pm_tree_influence has been called. */
static void fill_mass(const pm_frame *frame, pm_tree *t)
{
    const int n = t->n;
    for (int i = 0; i < n; i++)
        for (int k = t->first_coupled[i]; k <= i; k++) t->mass[i * n + k] = 0;
    for (int i = t->nfixed; i < frame->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        const double m = frame->numbers->mass[x->body] + frame->numbers->stand_in[3 * x->body],
                     inertia = pm_frame_inertia(frame, x->body) + frame->numbers->stand_in[3 * x->body + 2];
        const double *b = t->influence + 3 * x->list;
        const int *by = t->moved_by + x->list;
        for (int k = 0; k < x->nlist; k++, b += 3, by++) {
            const double p[3] = {m * b[0], m * b[1], inertia * b[2]};
            double *to = t->mass + by[0] * n;
            for (int l = 0; l < x->nlist - k; l++)
                to[by[l]] += p[0] * b[3 * l] + p[1] * b[3 * l + 1] + p[2] * b[3 * l + 2];
        }
    }
}

static int factor_mass(pm_result *result, pm_tree *t)
{
    result->count[PM_COUNT_SOLVES]++;
    return pm_dense_skyline_factor(t->n, t->first_coupled, t->mass)
               ? pm_fail(result, PM_SINGULAR, PM_TABLE_BODY, 0, 0, 0)
               : PM_OK;
}

/* X of the evaluated loop constraints, and the factor of S; row i of X is kept from t->from[i] to t->to[i]. */
static int factor_loops(pm_workspace *w)
{
    pm_tree *t = w->tree;
    const int n = t->n;
    for (int i = 0; i < t->nloop; i++) {
        double *x = t->reduced + i * n;
        const int from = t->from[i], to = t->to[i];
        for (int c = from; c < to; c++) x[c] = 0;
        pm_tree_loop_add(w->tree, &w->active.constraint[t->loop[i]], x);
        pm_dense_skyline_part(n, from, to, t->first_coupled, t->mass, x);
        for (int k = t->first_loop[i]; k <= i; k++) {
            const double *other = t->reduced + k * n;
            const int begin = from > t->from[k] ? from : t->from[k], end = to < t->to[k] ? to : t->to[k];
            double sum = 0;
            for (int c = begin; c < end; c++) sum += x[c] * other[c];
            t->schur[i * t->nloop + k] = sum;
        }
    }
    const int bad = pm_dense_skyline_factor(t->nloop, t->first_loop, t->schur);
    for (int i = 0; i < t->nloop && !bad;
         i++) { /* the factor holds the reciprocal of what is left of the row */
        const double left = t->schur[i * t->nloop + i];
        const double part =
            1 / (pm_constraint_square(&w->frame, &w->active.constraint[t->loop[i]]) * left * left);
        if (part < t->part.independence) t->part.independence = part;
    }
    return bad ? pm_tree_singular_loop(w, bad - 1) : PM_OK;
}

/* x += X^T l with S l = residual, in place. */
static void add_loops(const pm_tree *t, double *x)
{
    pm_dense_skyline_lower(t->nloop, t->first_loop, t->schur, t->residual);
    pm_dense_skyline_upper(t->nloop, t->first_loop, t->schur, t->residual);
    for (int i = 0; i < t->nloop; i++)
        for (int k = t->from[i]; k < t->to[i]; k++) x[k] += t->residual[i] * t->reduced[i * t->n + k];
}

/* x += B^T (f - M c); the frame has the forces.  Without `inertial` the part of c is in x already. */
static void add_forces(const pm_frame *frame, const pm_tree *t, int inertial, double *x)
{
    for (int i = t->nfixed; i < frame->model->nbody; i++) {
        const pm_tree_node *node = &t->node[i];
        const double *f = frame->f + 3 * node->body, *c = t->bias + 3 * node->body;
        double p[3] = {f[0], f[1], f[2]};
        if (inertial) {
            const double m = frame->numbers->mass[node->body];
            p[0] -= m * c[0];
            p[1] -= m * c[1];
            p[2] -= pm_frame_inertia(frame, node->body) * c[2];
        }
        for (int k = node->list; k < node->list + node->nlist; k++) {
            const double *b = t->influence + 3 * k;
            x[t->moved_by[k]] += b[0] * p[0] + b[1] * p[1] + b[2] * p[2];
        }
    }
}

/* The mass matrix, and B^T (f - M c) in x: body by body, or by the sums of the phase, whose directions are known. */
static void assemble(pm_workspace *w, double *x)
{
    pm_tree *t = w->tree;
    if (t->augmented.on) {
        pm_tree_augmented_equations(&w->numbers, w->tree, x);
        if (t->nloop > 0 || t->augmented.forced) pm_tree_augmented_influence(w->tree);
        if (!t->augmented.forced) return;
        pm_force_all(w);
        add_forces(&w->frame, w->tree, 0, x);
        return;
    }
    pm_force_all(w);
    memset(x, 0, (size_t)t->n * sizeof *x);
    pm_tree_spread_accelerations(w->tree, &w->frame, x, t->bias);
    pm_tree_influence(w->tree);
    fill_mass(&w->frame, w->tree);
    add_forces(&w->frame, w->tree, 1, x);
}

/* Where a contact or a joint slides its friction depends on reactions, and where there are many bodies: the whole system. */
static int accelerate_all(pm_workspace *w, double *yddot)
{
    const int status = pm_saddle_accelerate(w);
    if (!status) pm_tree_read_accelerations(w->tree, &w->frame, w->frame.a, yddot);
    return status;
}

/* The rates of the loop constraints in the right-hand side L^-1 x: x, and the reactions of the loops. */
static int close_loops(pm_workspace *w, double *x)
{
    pm_tree *t = w->tree;
    pm_tree_evaluate_loops(w->tree, &w->frame);
    const int status = factor_loops(w);
    if (status) return status;
    for (int i = 0; i < t->nloop; i++) {
        const pm_constraint *c = &w->active.constraint[t->loop[i]];
        t->residual[i] = c->gamma - pm_constraint_times(&w->frame, c, t->bias);
        for (int k = t->from[i]; k < t->to[i]; k++) t->residual[i] -= t->reduced[i * t->n + k] * x[k];
    }
    add_loops(t, x);
    for (int i = 0; i < t->nloop; i++) w->frame.lambda[t->loop[i]] = t->residual[i];
    return PM_OK;
}

static int solve(pm_workspace *w, double *yddot)
{
    pm_tree *t = w->tree;
    assemble(w, yddot);
    int status = factor_mass(&w->result, w->tree);
    if (status) return status;
    pm_dense_skyline_lower(t->n, t->first_coupled, t->mass, yddot);
    if (t->nloop > 0 && (status = close_loops(w, yddot))) return status;
    pm_dense_skyline_upper(t->n, t->first_coupled, t->mass, yddot);
    return PM_OK;
}

int pm_tree_accelerate(pm_workspace *w, double *yddot)
{
    if (w->tree->whole || w->active.asymmetric || w->numbers.massless ||
        pm_joint_friction_by_load(&w->frame, &w->state))
        return accelerate_all(w, yddot);
    if (w->tree->part.few) return pm_tree_accelerate_few(w, yddot);
    if (w->tree->augmented.on) pm_tree_augmented_read(&w->frame, w->tree);
    return solve(w, yddot);
}

int pm_tree_accelerate_at(pm_workspace *w, double time, const double *y, const double *ydot, const double *z,
                          double *yddot)
{
    const pm_tree *t = w->tree;
    if (t->augmented.on && !t->augmented.forced && t->nloop == 0) {
        pm_tree_augmented_set(w->tree, y, ydot);
        return solve(w, yddot);
    }
    pm_tree_look(w, time, y, ydot, z);
    return pm_tree_accelerate(w, yddot);
}

/* Reactions of the constraints of a node: force and couple about its mass centre that its parent gives. */
static void read_reactions(pm_frame *frame, const pm_active_set *active, const pm_tree_node *x,
                           const double *arm, const double *wrench)
{
    const double *r_child = arm, *rho = arm + 2, *t = arm + 4;
    const double sign = x->child_is_a ? 1 : -1, fx = sign * wrench[0], fy = sign * wrench[1];
    double *lambda = frame->lambda;
    if (x->placement == PIN || x->placement == WELD) {
        lambda[x->constraint[0]] = fx;
        lambda[x->constraint[1]] = fy;
        if (x->placement == WELD)
            lambda[x->constraint[2]] = sign * (wrench[2] - r_child[0] * wrench[1] + r_child[1] * wrench[0]);
    } else if (x->placement == ROLL_CIRCLE || x->placement == LINK) {
        const double inward = active->constraint[x->constraint[0]].sign;
        lambda[x->constraint[0]] = inward * (fx * t[1] - fy * t[0]);
        if (x->placement == ROLL_CIRCLE) lambda[x->constraint[1]] = fx * t[0] + fy * t[1];
    } else {
        const double normal = -fx * t[1] + fy * t[0];
        lambda[x->constraint[0]] = normal;
        if (x->placement == ROLL_LINE) {
            lambda[x->constraint[1]] = fx * t[0] + fy * t[1];
            return;
        }
        /* the normal force acts through P_a */
        double r[2] = {r_child[0], r_child[1]};
        for (int k = 0; k < 2 && !x->child_is_a; k++) r[k] += rho[k];
        const double moment = normal * (r[0] * t[0] + r[1] * t[1]);
        lambda[x->constraint[1]] = sign * wrench[2] - moment;
    }
}

/* What the loop constraints give is not the parent's to give. */
static void take_off_loops(const pm_workspace *w, double *wrench)
{
    const pm_tree *t = w->tree;
    for (int i = 0; i < t->nloop; i++) {
        const pm_constraint *c = &w->active.constraint[t->loop[i]];
        const double lambda = w->frame.lambda[t->loop[i]];
        for (int side = 0; side < pm_constraint_bodies(c); side++)
            for (int k = 0; k < 3 && c->body[side] != w->model->nbody; k++)
                wrench[3 * c->body[side] + k] -= lambda * c->j[3 * side + k];
    }
}

void pm_tree_react_inward(pm_workspace *w, const double *arm)
{
    const pm_tree *t = w->tree;
    pm_frame *f = &w->frame;
    const int ground = w->model->nbody;
    for (int i = ground - 1; i >= w->tree->nfixed; i--) {
        const pm_tree_node *x = &t->node[i];
        if (x->placement == FREE) continue;
        const double *wrench = t->wrench + 3 * x->body;
        read_reactions(&w->frame, &w->active, x, arm ? arm + PM_TREE_ARM * x->body : x->arm, wrench);
        if (w->numbers.fixed[x->parent]) continue;
        const double *child = f->pose + 5 * x->body, *parent = f->pose + 5 * x->parent;
        double *to = t->wrench + 3 * x->parent;
        pm_lanes_store(to, pm_lanes_load(to) + pm_lanes_load(wrench));
        to[2] += wrench[2] + (child[0] - parent[0]) * wrench[1] - (child[1] - parent[1]) * wrench[0];
    }
    f->level = PM_LEVEL_DYNAMIC;
}

void pm_tree_react(pm_workspace *w)
{
    const pm_tree *t = w->tree;
    pm_frame *f = &w->frame;
    const int ground = w->model->nbody;
    if (f->level == PM_LEVEL_DYNAMIC) return;
    for (int n = w->tree->nfixed; n < ground; n++) {
        const int i = t->node[n].body;
        const double inertia = pm_frame_inertia(&w->frame, i);
        for (int k = 0; k < 3; k++)
            t->wrench[3 * i + k] = (k < 2 ? w->numbers.mass[i] : inertia) * f->a[3 * i + k] - f->f[3 * i + k];
    }
    if (t->part.few) pm_tree_react_loops(&w->frame, w->tree);
    take_off_loops(w, t->wrench);
    pm_tree_react_inward(w, NULL);
}

void pm_tree_tell(pm_workspace *w, const double *yddot)
{
    const pm_tree *t = w->tree;
    if (w->frame.level == PM_LEVEL_DYNAMIC) return;
    if (t->augmented.on && !t->augmented.forced) pm_force_all(w);
    if (!t->part.few) pm_tree_spread_accelerations(w->tree, &w->frame, yddot, w->frame.a);
    pm_tree_react(w);
}

/* ---- back onto the loop constraints ---- */
static int factor(pm_workspace *w)
{
    if (w->tree->augmented.on) {
        pm_tree_augmented_read(&w->frame, w->tree);
        pm_tree_augmented_equations(&w->numbers, w->tree, w->tree->rate);
        pm_tree_augmented_influence(w->tree);
    } else {
        pm_tree_influence(w->tree);
        fill_mass(&w->frame, w->tree);
    }
    const int status = factor_mass(&w->result, w->tree);
    return status ? status : factor_loops(w);
}

/* J dy = residual with the least dy in the metric of M. */
static void correct(const pm_tree *t, double *y)
{
    memset(t->rate, 0, (size_t)t->n * sizeof *t->rate);
    add_loops(t, t->rate);
    pm_dense_skyline_upper(t->n, t->first_coupled, t->mass, t->rate);
    for (int k = 0; k < t->n; k++) y[k] += t->rate[k];
}

int pm_tree_project(pm_workspace *w, double time, double *y, double *ydot, const double *z)
{
    pm_tree *t = w->tree;
    double before = INFINITY;
    int status, factored = 0;
    if (t->part.few) return pm_tree_settle(w, time, y, ydot, z);
    if (pm_tree_small_applies(w)) {
        if ((status = pm_tree_small_project(w, y, ydot))) return status;
        pm_tree_look(w, time, y, ydot, z);
        return PM_OK;
    }
    pm_tree_look(w, time, y, ydot, z);
    for (int sweep = 0; t->nloop > 0; sweep++) {
        pm_tree_evaluate_loops(w->tree, &w->frame);
        const double worst = pm_constraint_openings(t->constraint, t->nloop, t->loop, t->residual);
        if (pm_projection_ends_exactly(&w->numbers, sweep, worst, before)) break;
        factored =
            worst <= PM_FACTORS_STAY * w->numbers.size; /* good enough for what is left, and for the rates */
        before = worst;
        if ((status = factor(w))) return status;
        correct(t, y);
        pm_tree_look(w, time, y, ydot, z);
    }
    const double worst = pm_constraint_slips(&w->frame, t->constraint, t->nloop, t->loop, t->v, t->residual);
    if (worst <= PM_MET * w->numbers.speed) return PM_OK;
    if (!(factored && worst <= PM_FACTORS_STAY * w->numbers.speed) && (status = factor(w))) return status;
    correct(t, ydot);
    pm_tree_look(w, time, y, ydot, z);
    return PM_OK;
}
