/* tree_place.c - positions outward along the tree, and what its rates need of them.
 *
 * Placements of a body c on its parent p, with a, b the first and second partner of the constraints as in constraint_*.c:
 *   pin, weld   the marks coincide
 *   link        P_a = p_b + L (cos phi, sin phi):   phi is a coordinate, beside the angle of a body that rotates
 *   line        P_a = p_b + s t + R n:   rolling   s = anchor - R (angle_a - angle_b);   slider   s is the coordinate
 *   circles     P_a = p_b + L (cos phi, sin phi),   phi = (anchor + R_a angle_a + R_b angle_b) / L
 * Either partner may be the child.  With rho = P_a - p_b and k x the rotation by a right angle their rates are
 *   line        rhodot = omega_b k x rho + sdot t,     circles, link   rhodot = phidot k x rho. */
#include <math.h>
#include <string.h>

#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

static void rotated(const double *pose, const double mark[2], double r[2])
{
    r[0] = pose[3] * mark[0] - pose[4] * mark[1];
    r[1] = pose[4] * mark[0] + pose[3] * mark[1];
}

static const double *pose_of_b(const pm_frame *frame, const pm_tree_node *x)
{
    return frame->pose + 5 * (x->child_is_a ? x->parent : x->body);
}

static void place_free(const pm_tree_node *x, const double *own, double *at)
{
    at[0] = own[0];
    at[1] = own[1];
    at[2] = x->rotates ? own[2] : 0;
    at[3] = cos(at[2]);
    at[4] = sin(at[2]);
}

static void place_angle(const pm_tree_node *x, const double *own, const double *from, double *at)
{
    if (pm_tree_follows(x)) {
        at[2] = from[2] + x->angle;
        at[3] = from[3] * x->rotation[0] - from[4] * x->rotation[1];
        at[4] = from[4] * x->rotation[0] + from[3] * x->rotation[1];
    } else {
        at[2] = x->rotates ? own[0] : 0;
        at[3] = cos(at[2]);
        at[4] = sin(at[2]);
    }
}

/* P_a - p_b once both angles are known. */
static void distance_of_marks(const pm_frame *frame, const pm_tree_node *x, const pm_memory *memory,
                              const double *own, const double *from, const double *at, double rho[2])
{
    if (x->placement == LINK) {
        rho[0] = x->length * cos(own[x->shift]);
        rho[1] = x->length * sin(own[x->shift]);
    } else if (x->placement == SLIDER || x->placement == ROLL_LINE) {
        double t[2];
        rotated(pose_of_b(frame, x), x->line, t);
        const double s = x->placement == SLIDER
                             ? own[x->shift]
                             : memory[x->memory].anchor + x->roll_own * at[2] + x->roll_parent * from[2];
        rho[0] = s * t[0] - x->radius * t[1];
        rho[1] = s * t[1] + x->radius * t[0];
    } else if (x->placement == ROLL_CIRCLE && x->roll_own == 1 && x->roll_parent == 0) {
        rotated(at, x->touch, rho); /* on a point: pinned to it where they touch */
    } else if (x->placement == ROLL_CIRCLE && x->roll_own == 0 && x->roll_parent == 1) {
        rotated(from, x->touch, rho);
    } else if (x->placement == ROLL_CIRCLE) {
        const double phi =
            memory[x->memory].anchor / x->length + x->roll_own * at[2] + x->roll_parent * from[2];
        rho[0] = x->length * cos(phi);
        rho[1] = x->length * sin(phi);
    }
}

/* What the rates need, once r_mark, r_child and rho are known. */
static void couple(const pm_frame *frame, pm_tree_node *x)
{
    x->by_parent[0] = -x->r_mark[1];
    x->by_parent[1] = x->r_mark[0];
    x->by_own[0] = x->r_child[1];
    x->by_own[1] = -x->r_child[0];
    if (x->placement <= WELD) return;
    const double sign = x->child_is_a ? 1 : -1;
    if (x->placement == ROLL_CIRCLE || x->placement == LINK) {
        x->t[0] = -x->rho[1] / x->length;
        x->t[1] = x->rho[0] / x->length;
    }
    if (x->placement == LINK) {
        for (int k = 0; k < 2; k++) x->by_slide[k] = sign * x->length * x->t[k];
        return;
    }
    if (x->placement == ROLL_CIRCLE) {
        for (int k = 0; k < 2; k++) {
            x->by_parent[k] += sign * x->length * x->roll_parent * x->t[k];
            x->by_own[k] += sign * x->length * x->roll_own * x->t[k];
        }
        return;
    }
    const double across[2] = {-sign * x->rho[1], sign * x->rho[0]};
    double *by_b = x->child_is_a ? x->by_parent : x->by_own;
    rotated(pose_of_b(frame, x), x->line, x->t);
    for (int k = 0; k < 2; k++) {
        by_b[k] += across[k];
        x->by_slide[k] = sign * x->t[k];
        x->by_parent[k] += sign * x->roll_parent * x->t[k];
        x->by_own[k] += sign * x->roll_own * x->t[k];
    }
}

/* The same as below, for what most trees consist of. */
static void place_pinned(const pm_frame *frame, pm_tree_node *x, const double *y)
{
    const double *from = frame->pose + 5 * x->parent;
    double *at = frame->pose + 5 * x->body;
    at[2] = x->rotates ? y[x->first] : 0;
    at[3] = cos(at[2]);
    at[4] = sin(at[2]);
    rotated(from, x->mark, x->r_mark);
    rotated(at, x->child, x->r_child);
    for (int k = 0; k < 2; k++) at[k] = from[k] + x->r_mark[k] - x->r_child[k];
    x->by_parent[0] = -x->r_mark[1];
    x->by_parent[1] = x->r_mark[0];
    x->by_own[0] = x->r_child[1];
    x->by_own[1] = -x->r_child[0];
}

static void place_node(const pm_frame *frame, pm_tree_node *x, const pm_memory *memory, const double *y)
{
    const double *own = y + x->first, *from = frame->pose + 5 * x->parent;
    double *at = frame->pose + 5 * x->body;
    if (x->placement == FREE) {
        place_free(x, own, at);
        return;
    }
    if (x->placement == PIN) {
        place_pinned(frame, x, y);
        return;
    }
    place_angle(x, own, from, at);
    rotated(from, x->mark, x->r_mark);
    rotated(at, x->child, x->r_child);
    if (x->placement > WELD) distance_of_marks(frame, x, memory, own, from, at, x->rho);
    const double sign = x->child_is_a ? 1 : -1;
    for (int k = 0; k < 2; k++) {
        at[k] = from[k] + x->r_mark[k] - x->r_child[k];
        if (x->placement > WELD) at[k] += sign * x->rho[k];
    }
    couple(frame, x);
}

void pm_tree_place(const pm_tree *t, pm_frame *frame, const pm_memory *memory, const double *y, double *q)
{
    for (int i = 0; i < t->model->nbody; i++) {
        pm_tree_node *x = &t->node[i];
        place_node(frame, x, memory, y);
        memcpy(q + 3 * x->body, frame->pose + 5 * x->body, 3 * sizeof *q);
    }
}

static void look_at_marks(const pm_frame *frame, pm_tree_node *x)
{
    const double *at = frame->pose + 5 * x->body, *from = frame->pose + 5 * x->parent;
    const double sign = x->child_is_a ? 1 : -1;
    rotated(from, x->mark, x->r_mark);
    rotated(at, x->child, x->r_child);
    for (int k = 0; k < 2; k++) x->rho[k] = sign * (at[k] + x->r_child[k] - from[k] - x->r_mark[k]);
    couple(frame, x);
}

/* Within half a turn of x->angle. */
static double direction_of(const pm_tree_node *x)
{
    const double *r = x->rotation, *rho = x->rho;
    return x->angle + atan2(r[0] * rho[1] - r[1] * rho[0], r[0] * rho[0] + r[1] * rho[1]);
}

void pm_tree_read(const pm_tree *t, const pm_frame *frame, double *y)
{
    for (int i = 0; i < t->model->nbody; i++) {
        pm_tree_node *x = &t->node[i];
        const double *at = frame->pose + 5 * x->body;
        double *own = y + x->first;
        if (x->placement == FREE) {
            memcpy(own, at, (size_t)x->ncoordinate * sizeof *own);
            continue;
        }
        look_at_marks(frame, x);
        if (x->placement == SLIDER) {
            own[x->shift] = x->rho[0] * x->t[0] + x->rho[1] * x->t[1];
            continue;
        }
        if (x->placement == LINK) own[x->shift] = direction_of(x);
        if (x->rotates && x->ncoordinate > 0) own[0] = at[2];
    }
}

void pm_tree_marks(const pm_tree *t, const pm_frame *frame)
{
    for (int i = 0; i < t->model->nbody; i++)
        if (t->node[i].placement != FREE) look_at_marks(frame, &t->node[i]);
}

void pm_tree_look(pm_workspace *w, double t, const double *y, const double *ydot, const double *z)
{
    static const double zero[3] = {0, 0, 0};
    pm_tree *tree = w->tree;
    pm_frame *f = &w->frame;
    const int ground = w->model->nbody;
    f->t = t;
    f->q = tree->q;
    f->v = tree->v;
    f->z = z;
    f->memory = w->state.memory;
    f->level = PM_LEVEL_KINEMATIC;
    for (int i = w->tree->nfixed; i < ground; i++) {
        pm_tree_node *x = &tree->node[i];
        double *velocity = f->velocity + 3 * x->body;
        place_node(&w->frame, x, f->memory, y);
        pm_tree_move(x, x->parent == ground ? zero : f->velocity + 3 * x->parent, ydot + x->first, velocity);
        for (int k = 0; k < 3; k++) {
            tree->q[3 * x->body + k] = f->pose[5 * x->body + k];
            tree->v[3 * x->body + k] = velocity[k];
        }
    }
}
