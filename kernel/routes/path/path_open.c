/* path_open.c - a place on the path of an open tree with one coordinate u: all that motion through it can need, in one pass
 * outward.
 *
 *   t = dq/du,  c = dt/du     velocities and accelerations at udot = 1, uddot = 0 (tree_node.h)
 *   mass = t . M t,  change = t . M c = (dmass/du) / 2,  force = t . f
 *
 * from which, at whatever T, accelerations and reactions follow by a few products:
 *
 *   udot^2 = 2T / mass,   uddot = (force - change udot^2) / mass,   a = t uddot + c udot^2 */
#include <math.h>
#include <string.h>

#include "elements/force.h"
#include "elements/turning_plane.h"
#include "equations/fixed_bodies.h"
#include "equations/ledger.h"
#include "numerics/lanes.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

static const double none[3] = {0, 0, 0};

/* Weights alone: they need no look. */
static int only_weights(const pm_model *m)
{
    return m->rows[PM_TABLE_FORCE] == 0 && m->nz_controlled == 0 && !pm_turning_plane_turns(m);
}

/* One body: its rates, and what stays of its node. */
static void measure_body(const pm_workspace *w, const pm_tree_node *x, pm_place *place)
{
    static const double one[3] = {1, 1, 1};
    const int b = x->body, on_ground = x->parent == w->model->nbody;
    const double *parent = on_ground ? none : place->tangent + 3 * x->parent;
    double *t = place->tangent + 3 * b, *c = place->bend + 3 * b, *arm = place->arm + PM_TREE_ARM * b;
    pm_tree_move(x, parent, one, t);
    pm_tree_move(x, on_ground ? none : place->bend + 3 * x->parent, none, c);
    pm_tree_add_quadratic(x, parent, t, c);
    memcpy(arm, x->arm, sizeof x->arm);
    const double m = w->numbers.mass[b], inertia = w->path->inertia[b];
    place->mass += m * (t[0] * t[0] + t[1] * t[1]) + inertia * t[2] * t[2];
    place->change += m * (t[0] * c[0] + t[1] * c[1]) + inertia * t[2] * c[2];
}

static void measure_fixed(const pm_tree_node *x, pm_place *place)
{
    memset(place->tangent + 3 * x->body, 0, sizeof none);
    memset(place->bend + 3 * x->body, 0, sizeof none);
}

static void add_weights(const pm_frame *frame, pm_place *place)
{
    for (int i = 0; i < frame->model->nbody; i++) {
        const double *t = place->tangent + 3 * i, *pose = place->pose + 5 * i, *f = frame->f + 3 * i;
        place->force += f[0] * t[0] + f[1] * t[1];
        place->potential -= f[0] * pose[0] + f[1] * pose[1];
    }
}

void pm_path_measure_forces(pm_workspace *w, pm_place *place)
{
    pm_frame_look_placed(&w->frame, &w->state, place->q, place->tangent);
    pm_force_all(w); /* powers and speeds at a unit rate, too */
    place->force = 0;
    for (int i = 0; i < w->model->nq; i++) place->force += w->frame.f[i] * place->tangent[i];
    if (w->model->nz_controlled > 0) pm_ledger_controlled_rates(w, place->rate);
    place->potential = pm_frame_weight_energy(&w->frame) + pm_force_potential(w) +
                       pm_turning_plane_kinetic(&w->frame, PM_NONE);
}

static void place_by_tree(pm_workspace *w, pm_place *place)
{
    pm_tree_place(w->tree, &w->frame, w->state.memory, place->y, place->q);
    place->mass = place->change = place->force = place->potential = 0;
    memcpy(place->pose, w->frame.pose, 5 * (size_t)w->model->nbody * sizeof *place->pose);
    for (int i = 0; i < w->fixed->n; i++) measure_fixed(&w->tree->node[i], place);
    for (int i = w->fixed->n; i < w->model->nbody; i++) measure_body(w, &w->tree->node[i], place);
    if (!w->path->rigid.weights_alone) {
        pm_path_measure_forces(w, place);
        return;
    }
    pm_frame_look_placed(&w->frame, &w->state, place->q, place->tangent);
    add_weights(&w->frame, place);
}

static void place_rigid(pm_workspace *w, pm_place *place)
{
    pm_path_rigid_place(w, place->y[0], place);
    if (w->path->rigid.weights_alone) return;
    pm_frame_take_poses(&w->frame, place->pose);
    pm_path_measure_forces(w, place);
}

void pm_path_open_begin(pm_workspace *w)
{
    for (int i = 0; i < w->model->nbody; i++) w->path->inertia[i] = pm_frame_inertia(&w->frame, i);
    w->path->rigid.weights_alone = only_weights(w->model);
    pm_path_rigid_build(w);
    pm_force_all(w); /* weights stay as they are */
}

void pm_path_open_place(pm_workspace *w, pm_place *place)
{
    place->slope[0] = 1;
    place->determined = 1;
    if (w->path->rigid.n > 0)
        place_rigid(w, place);
    else
        place_by_tree(w, place);
}

void pm_path_open_accelerate(pm_workspace *w, const pm_place *place)
{
    pm_frame *f = &w->frame;
    const double square = 2 * (place->kinetic > 0 ? place->kinetic : 0) / place->mass;
    const double own = (place->force - place->change * square) / place->mass;
    w->result.count[PM_COUNT_SOLVES]++;
    if (!w->path->rigid.weights_alone) pm_force_all(w);
    for (int i = w->fixed->n; i < w->model->nbody; i++) {
        const int b = w->tree->node[i].body, k = 3 * b;
        const double *t = place->tangent + k, *c = place->bend + k, *force = f->f + k;
        double *a = f->a + k, *wrench = w->tree->wrench + k;
        const pm_lanes way = pm_lanes_load(t) * own + pm_lanes_load(c) * square;
        const double alpha = t[2] * own + c[2] * square;
        pm_lanes_store_three(a, way, alpha);
        pm_lanes_store_three(wrench, w->numbers.mass[b] * way - pm_lanes_load(force),
                             w->path->inertia[b] * alpha - force[2]);
    }
    pm_tree_react_inward(w, place->arm);
}
