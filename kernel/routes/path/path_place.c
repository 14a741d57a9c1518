/* path_place.c - one place on the path: the configuration at a value of the driver, and the direction of motion there.
 *
 * With one degree of freedom one tree coordinate, the driver u, gives the whole configuration: what the tree does not
 * solve explicitly (loop constraints) is met by Newton's method with u kept (coordinate partitioning: Wehage and Haug, J.
 * Mech.  Des. 104, 1982).  The direction t = dy/du is the null vector of the loop constraints on the tree coordinates. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* What motion at a unit rate of the driver makes of masses and forces. */
static void measure_motion(pm_workspace *w, pm_place *place)
{
    const pm_model *m = w->model;
    pm_tree_spread(w->tree, place->slope, place->tangent);
    const double *t = place->tangent;
    place->mass = 0;
    for (int i = 0; i < m->nbody; i++)
        place->mass += w->numbers.mass[i] * (t[3 * i] * t[3 * i] + t[3 * i + 1] * t[3 * i + 1]) +
                       pm_frame_inertia(&w->frame, i) * t[3 * i + 2] * t[3 * i + 2];
    memcpy(place->pose, w->frame.pose, 5 * (size_t)m->nbody * sizeof *place->pose);
    pm_path_measure_forces(w, place);
}

/* The greatest distance of a joint from a mass centre: a long chain is large, its links are not. */
static double greatest_lever(const struct pm_tree *tree)
{
    double lever = 0;
    for (int i = 0; i < tree->model->nbody; i++) {
        const pm_tree_node *x = &tree->node[i];
        if (x->placement == FREE) continue;
        lever = pm_max(pm_length(x->child), lever);
        if (x->placement == LINK) lever = pm_max(x->length, lever);
        if (x->parent != tree->model->nbody) lever = pm_max(pm_length(x->mark), lever);
    }
    return lever;
}

/* What a loop constraint changes by when its coordinates do by their natural size. */
static double loop_size(const pm_workspace *w)
{
    const double lever = greatest_lever(w->tree),
                 size = lever > 0 ? fmin(w->numbers.size, PM_PATH_LINKS * lever) : w->numbers.size;
    for (int i = 0; i < w->tree->nloop; i++)
        if (w->active.constraint[w->tree->loop[i]].kind == PM_CONSTRAINT_ANGLE) return fmin(size, 1);
    return size;
}

/* Do the loop constraints determine the other coordinates well, going by the pivots of pm_tree_slope? */
static int is_determined(const pm_workspace *w)
{
    const int n = w->tree->nloop;
    const double weak = PM_PATH_WEAK * loop_size(w);
    for (int i = 0; i < n; i++) {
        const int column = w->tree->part.column[i];
        if (!(fabs(w->tree->jacobian[i * n + i]) * pm_tree_scale(w->tree, &w->numbers, column) > weak))
            return 0;
    }
    return 1;
}

/* Null vector of the loop constraints (one more column than rows) by elimination; 0 where the rank falls, or nearly so. */
static int null_vector(pm_workspace *w, double *t)
{
    pm_path *p = w->path;
    const int n = p->n, nloop = w->tree->nloop, *column = p->column;
    const double weak = PM_PATH_WEAK * loop_size(w);
    pm_elimination x = w->tree->elimination;
    x.low = p->loop.low;
    x.high = p->loop.high;
    pm_elimination_run(nloop, n, p->loop.entry, p->column, &x);
    t[column[n - 1]] = 1;
    for (int i = nloop - 1; i >= 0; i--) {
        const double *a = p->loop.entry + i * n, pivot = a[column[i]];
        if (!(fabs(pivot) * pm_tree_scale(w->tree, &w->numbers, column[i]) > weak)) return 0;
        double sum = 0;
        for (int c = x.low[i]; c <= x.high[i]; c++)
            if (x.place[c] > i) sum += a[c] * t[c];
        t[column[i]] = -sum / pivot;
    }
    return 1;
}

/* A place that the constraints do not determine well with the driver kept: on a bridge, if no other driver would do. */
static int place_on_bridge(pm_workspace *w, double u, pm_place *place, int status)
{
    pm_path *p = w->path;
    if (status && status != PM_SINGULAR) return status;
    return null_vector(w, p->bridge.y) ? status : pm_path_bridge_place(w, u, place);
}

int pm_path_place(pm_workspace *w, double u, pm_place *place)
{
    pm_path *p = w->path;
    place->y[p->driver] = u;
    if (w->tree->nloop == 0) {
        pm_path_open_place(w, place);
        return PM_OK;
    }
    pm_tree_hold(w->tree, p->driver);
    int status = pm_tree_close(w, place->y, place->q, &p->loop);
    if (!status) status = pm_tree_slope(w, &p->loop, place->slope);
    place->determined = !status && is_determined(w);
    if (!place->determined)
        status = place_on_bridge(w, u, place, status);
    else
        pm_path_bridge_determined(p, u, place);
    if (status) return status;
    measure_motion(w, place);
    return PM_OK;
}

int pm_path_look(pm_workspace *w, pm_place *place)
{
    pm_path *p = w->path;
    if (w->tree->nloop == 0) {
        pm_path_open_place(w, place);
        return PM_OK;
    }
    pm_tree_place(w->tree, &w->frame, w->state.memory, place->y, place->q);
    pm_tree_loops(w->tree, &w->frame, &p->loop);
    if (!null_vector(w, place->slope)) return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    place->determined = 1;
    measure_motion(w, place);
    return PM_OK;
}

/* The same motion, described by a unit rate of coordinate i. */
static void tell_by(const pm_model *m, const pm_path *path, pm_place *place, int i)
{
    const double factor = 1 / place->slope[i];
    for (int k = 0; k < path->n; k++) place->slope[k] *= factor;
    for (int k = 0; k < m->nq; k++) place->tangent[k] *= factor;
    for (int k = 0; k < m->nz_controlled; k++) place->rate[k] *= k < m->nz_work ? factor : fabs(factor);
    place->mass *= factor * factor;
    place->force *= factor;
}

int pm_path_drive(pm_workspace *w, pm_place *place)
{
    pm_path *p = w->path;
    double fastest = 0;
    int best = PM_NONE;
    for (int i = 0; i < p->n; i++) {
        const double rate = fabs(place->slope[i]) / pm_tree_scale(w->tree, &w->numbers, i);
        if (!(rate > fastest)) continue;
        fastest = rate;
        best = i;
    }
    if (best == PM_NONE) return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    if (p->driver != PM_NONE &&
        fabs(place->slope[p->driver]) / pm_tree_scale(w->tree, &w->numbers, p->driver) >=
            PM_PATH_KEEP * fastest)
        return PM_OK;
    if (place->slope[best] < 0) p->sense = -p->sense;
    p->driver = best;
    pm_path_bridge_forget(p);
    tell_by(w->model, w->path, place, best);
    return PM_OK;
}

int pm_path_meet(pm_workspace *w, pm_place *place)
{
    pm_path *p = w->path;
    pm_place *met = &p->spare;
    w->tree->part.open = w->tree->part.known = 0;
    if (w->tree->nloop == 0) return PM_OK;
    memcpy(met->y, place->y, (size_t)p->n * sizeof *met->y);
    pm_tree_hold(w->tree, p->driver);
    const int closed = !pm_tree_close(w, met->y, met->q, &p->loop) &&
                       !pm_tree_slope(w, &p->loop, met->slope) && is_determined(w);
    if (closed) memcpy(place->y, met->y, (size_t)p->n * sizeof *met->y);
    const int status = pm_path_look(w, place);
    if (!status) tell_by(w->model, p, place, p->driver);
    return status;
}
