/* tree_partition.c - few freedoms: the loop constraints determine all coordinates but some independent ones (coordinate
 * partitioning: Wehage and Haug, J. Mech. Des. 104, 1982).
 *
 * With y = (u, v), u independent, v dependent, and J = (J_u, J_v) the loop constraints' Jacobian:
 *   g(u, v) = 0     J_v vdot = w - J_u udot     J_v vddot = gamma - G c - J_u uddot
 *   N^T M N uddot = N^T (f - M a_0)             N = B (1; -J_v^-1 J_u),  a_0 the accelerations at uddot = 0
 *   J_v^T l = (B^T (M a - f))_v
 * w what drives prescribe, B and c as in tree_dynamics.c.  Where the rank of J falls at one place (a dead centre, the flat
 * parallelogram) N stays bounded along the branch, and rounding is amplified by the distance only, not by its square. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "numerics/dense.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

void pm_tree_hold(pm_tree *t, int held)
{
    if (t->part.column[t->n - 1] == held) return;
    t->part.column[t->n - 1] = held;
    pm_tree_arrange(t);
}

/* Chooses the columns of the pivots. */
void pm_tree_partition(const pm_frame *frame, pm_tree *t)
{
    const int n = t->n;
    double *a = t->reduced;
    int *order = t->part.position;
    if (t->nloop == 0 || t->nloop >= n || n - t->nloop > PM_TREE_FEW) return;
    const pm_loops loops = {a, t->elimination.low, t->elimination.high};
    pm_tree_loops_unknown(t, &loops); /* other things have been kept there */
    pm_tree_loops(t, frame, &loops);
    for (int i = 0; i < t->nloop; i++)
        for (int k = loops.low[i]; k <= loops.high[i]; k++)
            a[i * n + k] *= pm_tree_scale(t, frame->numbers, k);
    if (pm_elimination_run(t->nloop, n, a, order, &t->elimination) > PM_LOOP_RANK) {
        memcpy(t->part.column + t->nloop, order + t->nloop, (size_t)(n - t->nloop) * sizeof *order);
        t->part.few = 1;
        t->part.steepest = 0;
    }
    if (t->part.few) pm_tree_arrange(t); /* singular here: what was chosen stays */
}

int pm_tree_is_steep(const pm_tree *tree) { return tree->part.few && tree->part.steepest > PM_LOOP_STEEP; }

int pm_tree_is_flat(const pm_tree *t)
{
    return !t->part.few && t->nloop > 0 && (t->part.independence < PM_LOOP_FLAT || t->nloop > PM_LOOPS_MANY);
}

/* y of the dependent coordinates += J_v^-1 residual. */
static void correct(const pm_tree *t, double *y)
{
    pm_tree_solve_dependent(t, t->residual);
    for (int c = 0; c < t->nloop; c++) y[t->part.column[c]] += t->residual[c];
}

/* Residuals of the evaluated loop constraints; the worst. */
static double read_residuals(const pm_tree *t)
{
    return pm_constraint_openings(t->constraint, t->nloop, t->loop, t->residual);
}

static double read_rate_residuals(const pm_frame *frame, const pm_tree *t)
{
    return pm_constraint_slips(frame, t->constraint, t->nloop, t->loop, t->v, t->residual);
}

/* ---- positions alone ---- */
/* Places the bodies and evaluates the loop constraints; their greatest residual. */
static double place(pm_workspace *w, const double *y, double *q, const pm_loops *loops)
{
    pm_tree_place(w->tree, &w->frame, w->state.memory, y, q);
    if (w->tree->nloop == 0) return 0;
    pm_tree_loops(w->tree, &w->frame, loops);
    return read_residuals(w->tree);
}

int pm_tree_close(pm_workspace *w, double *y, double *q, const pm_loops *loops)
{
    double worst = place(w, y, q, loops), before = INFINITY;
    for (int sweep = 0; sweep < PM_LOOP_SWEEPS; sweep++) {
        if (worst <= PM_MET * w->numbers.size ||
            (worst <= PM_LOOP_STALLED * w->numbers.size && worst > PM_LOOP_GAIN * before)) {
            w->tree->part.open = pm_max(worst, w->tree->part.open);
            return PM_OK;
        }
        const int status = pm_tree_factor_dependent(w, loops->entry);
        if (status) return status;
        correct(w->tree, y);
        before = worst;
        worst = place(w, y, q, loops);
    }
    return pm_fail(&w->result, PM_ASSEMBLY, PM_NONE, PM_NONE, worst, PM_LOOP_STALLED * w->numbers.size);
}

/* Rates of all coordinates at a unit rate of an independent one; the factors are there. */
static void slope_of(const pm_tree *t, int independent, const double *jacobian, double *slope)
{
    memset(slope, 0, (size_t)t->n * sizeof *slope);
    slope[independent] = 1;
    for (int i = 0; i < t->nloop; i++) t->residual[i] = -jacobian[i * t->n + independent];
    correct(t, slope);
}

int pm_tree_slope(pm_workspace *w, const pm_loops *loops, double *slope)
{
    const int status = pm_tree_factor_dependent(w, loops->entry);
    if (!status) slope_of(w->tree, w->tree->part.column[w->tree->nloop], loops->entry, slope);
    return status;
}

/* ---- motion ---- */
static double look(pm_workspace *w, double time, const double *y, const double *ydot, const double *z)
{
    pm_tree_look(w, time, y, ydot, z);
    pm_tree_evaluate_loops(w->tree, &w->frame);
    return read_residuals(w->tree);
}

/* The Jacobian of the evaluated loop constraints, and the factors of its dependent part. */
static int factor_here(pm_workspace *w)
{
    pm_tree *t = w->tree;
    pm_tree_influence(w->tree);
    for (int i = 0; i < t->nloop; i++) {
        const pm_constraint *c = &w->active.constraint[t->loop[i]];
        pm_tree_loop_zero(w->tree, c, t->part.jacobian + i * t->n);
        pm_tree_loop_add(w->tree, c, t->part.jacobian + i * t->n);
    }
    return pm_tree_factor_dependent(w, t->part.jacobian);
}

int pm_tree_settle(pm_workspace *w, double time, double *y, double *ydot, const double *z)
{
    const pm_tree *t = w->tree;
    double worst = look(w, time, y, ydot, z), before = INFINITY;
    for (int sweep = 0; sweep < PM_LOOP_SWEEPS; sweep++) {
        const int met = worst <= PM_LOOP_FINEST * w->numbers.size ||
                        (worst <= PM_LOOP_STALLED * w->numbers.size && worst > PM_LOOP_GAIN * before);
        if (met && read_rate_residuals(&w->frame, t) <= PM_LOOP_FINEST * w->numbers.speed) return PM_OK;
        if (met && sweep > 0 &&
            before <= PM_FACTORS_STAY * w->numbers.size) { /* the factors are those of this place */
            correct(t, ydot);
            look(w, time, y, ydot, z);
            return PM_OK;
        }
        const int status = factor_here(w);
        if (status) return status;
        read_residuals(w->tree);
        correct(t, y);
        read_rate_residuals(&w->frame, t);
        correct(t, ydot);
        before = worst;
        worst = look(w, time, y, ydot, z);
    }
    return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, worst,
                   PM_LOOP_STALLED * w->numbers.size); /* a shorter step may do */
}

/* J_v yddot_v = gamma - G a, a the accelerations at yddot as given. */
static void follow(pm_workspace *w, double *yddot, double *a)
{
    pm_tree *t = w->tree;
    pm_tree_spread_accelerations(w->tree, &w->frame, yddot, a);
    for (int i = 0; i < t->nloop; i++) {
        const pm_constraint *c = &w->active.constraint[t->loop[i]];
        t->residual[i] = c->gamma - pm_constraint_times(&w->frame, c, a);
    }
    correct(t, yddot);
    pm_tree_spread_accelerations(w->tree, &w->frame, yddot, a);
}

static double inertia_of(const pm_frame *frame, int i)
{
    return i % 3 < 2 ? frame->numbers->mass[i / 3] : pm_frame_inertia(frame, i / 3);
}

int pm_tree_accelerate_few(pm_workspace *w, double *yddot)
{
    pm_tree *t = w->tree;
    const int nq = w->model->nq, few = t->n - t->nloop;
    double mass[PM_TREE_FEW * PM_TREE_FEW], force[PM_TREE_FEW], *a = w->frame.a;
    int status = factor_here(w);
    if (status) return status;
    pm_force_all(w);
    memset(yddot, 0, (size_t)t->n * sizeof *yddot);
    follow(w, yddot, a);
    t->part.steepest = 0;
    for (int k = 0; k < few; k++) {
        double *v = t->part.motion + k * nq;
        const int own = t->part.column[t->nloop + k];
        slope_of(t, own, t->part.jacobian, t->rate);
        for (int c = 0; c < t->nloop; c++)
            t->part.steepest =
                fmax(t->part.steepest, fabs(t->rate[t->part.column[c]]) * pm_tree_scale(t, &w->numbers, own) /
                                           pm_tree_scale(t, &w->numbers, t->part.column[c]));
        pm_tree_spread(w->tree, t->rate, v);
        force[k] = 0;
        for (int i = 0; i < nq; i++) force[k] += v[i] * (w->frame.f[i] - inertia_of(&w->frame, i) * a[i]);
        for (int l = 0; l <= k; l++) {
            const double *other = t->part.motion + l * nq;
            double sum = 0;
            for (int i = 0; i < nq; i++) sum += v[i] * inertia_of(&w->frame, i) * other[i];
            mass[k * few + l] = sum;
        }
    }
    if (pm_dense_cholesky_factor(few, mass)) return pm_fail(&w->result, PM_SINGULAR, PM_TABLE_BODY, 0, 0, 0);
    pm_dense_cholesky_solve(few, mass, force);
    memset(yddot, 0, (size_t)t->n * sizeof *yddot);
    for (int k = 0; k < few; k++) yddot[t->part.column[t->nloop + k]] = force[k];
    follow(w, yddot, a);
    return PM_OK;
}

void pm_tree_react_loops(pm_frame *frame, pm_tree *t)
{
    memset(t->rate, 0, (size_t)t->n * sizeof *t->rate);
    for (int i = 0; i < frame->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        const double *needed = t->wrench + 3 * x->body;
        for (int k = x->list; k < x->list + x->nlist; k++) {
            const double *b = t->influence + 3 * k;
            t->rate[t->moved_by[k]] += b[0] * needed[0] + b[1] * needed[1] + b[2] * needed[2];
        }
    }
    for (int c = 0; c < t->nloop; c++) t->residual[c] = t->rate[t->part.column[c]];
    pm_tree_solve_dependent_transposed(t, t->residual);
    for (int i = 0; i < t->nloop; i++) frame->lambda[t->loop[i]] = t->residual[i];
}
