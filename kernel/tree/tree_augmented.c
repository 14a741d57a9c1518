/* tree_augmented.c - the equations of a tree whose parts rotate about each other, with what stays the same summed up once.
 *
 * Where all directions rotate with single coordinates - pins, links, welds, rolling and sliding on lines of the ground - a unit
 * rate of coordinate k moves body b with the velocity
 *     b_bk = e_k + k x R_k d_bk,        R_k the rotation by y_k; e_k and the arm d_bk stay the same,
 * so that with D = y_k - y_l, c_b = -sum_k ydot_k^2 R_k d_bk and sums over the bodies that both k and l move
 *     (B^T M B)_kl = C_kl cos D + S_kl sin D + T_kl + e_k . k x R_l P_kl + e_l . k x R_k Q_kl
 *     (B^T M c)_k  = -sum_l ydot_l^2 (S_kl cos D - C_kl sin D + e_k . R_l P_kl)
 *     C = sum m d_k . d_l,  S = sum m d_k x d_l,  T = sum I + m e_k . e_l,  P = sum m d_l,  Q = sum m d_k
 * (augmented bodies: Wittenburg, Dynamics of Systems of Rigid Bodies, 5.2).  Per solve no body is looked at. */
#include "tree/tree.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/turning_plane.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree_node.h"

/* ---- once a phase ---- */
/* A direction that rotates with one coordinate, or not at all. */
static int rotates_simply(const pm_model *model, const pm_tree_node *x)
{
    const int on_ground = x->parent == model->nbody;
    if (x->placement == SLIDER) return on_ground;
    if (x->placement == ROLL_LINE) return on_ground && x->child_is_a;
    return x->placement != ROLL_CIRCLE;
}

/* e_k of a node's own coordinates. */
static void read_fixed(const pm_tree_node *x, double *fixed)
{
    const double sign = x->child_is_a ? 1 : -1;
    for (int k = 0; k < x->ncoordinate; k++) {
        double *e = fixed + 2 * (x->first + k);
        e[0] = e[1] = 0;
        if (x->placement == FREE && k < 2) e[k] = 1;
        for (int c = 0; c < 2 && x->placement == SLIDER; c++) e[c] = x->by_slide[c];
        for (int c = 0; c < 2 && x->placement == ROLL_LINE; c++) e[c] = sign * x->roll_own * x->t[c];
    }
}

/* d_bk from the influences where the frame looks: R_k^-1 of (b_bk - e_k) rotated back by a right angle. */
static void read_arms(const pm_tree *t)
{
    const pm_tree_augmented *a = &t->augmented;
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        for (int k = x->list; k < x->list + x->nlist; k++) {
            const int by = t->moved_by[k];
            const double *e = a->fixed + 2 * by, *r = a->direction + 2 * by, *b = t->influence + 3 * k;
            const double arm[2] = {b[1] - e[1], e[0] - b[0]};
            a->arm[2 * k] = r[0] * arm[0] + r[1] * arm[1];
            a->arm[2 * k + 1] = r[0] * arm[1] - r[1] * arm[0];
        }
    }
}

/* What a body adds to the sums of two coordinates that move it: entries k, l of moved_by. */
static void add_pair(const pm_frame *frame, const pm_tree *t, const pm_tree_node *x, int k, int l)
{
    const pm_tree_augmented *a = &t->augmented;
    const int i = t->moved_by[k], j = t->moved_by[l], at = i * t->n + j;
    const double m = frame->numbers->mass[x->body], *p = a->arm + 2 * k, *q = a->arm + 2 * l,
                 *e = a->fixed + 2 * i, *f = a->fixed + 2 * j;
    a->same[at] += m * (p[0] * q[0] + p[1] * q[1]);
    a->cross[at] += m * (p[0] * q[1] - p[1] * q[0]);
    a->level[at] += pm_frame_inertia(frame, x->body) * t->influence[3 * k + 2] * t->influence[3 * l + 2] +
                    m * (e[0] * f[0] + e[1] * f[1]);
    for (int c = 0; c < 2; c++) {
        a->lower[2 * at + c] += m * q[c];
        a->upper[2 * at + c] += m * p[c];
    }
}

static void sum_up(const pm_frame *frame, const pm_tree *t)
{
    const pm_tree_augmented *a = &t->augmented;
    const size_t n = (size_t)t->n, bytes = n * n * sizeof(double);
    memset(a->same, 0, bytes);
    memset(a->cross, 0, bytes);
    memset(a->level, 0, bytes);
    memset(a->lower, 0, 2 * bytes);
    memset(a->upper, 0, 2 * bytes);
    memset(a->weight, 0, 2 * n * sizeof(double));
    for (int i = 0; i < frame->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        for (int k = x->list; k < x->list + x->nlist; k++) {
            const int by = t->moved_by[k];
            for (int c = 0; c < 2; c++)
                a->weight[by] +=
                    frame->numbers->mass[x->body] * frame->numbers->gravity[c] * a->fixed[2 * by + c];
            for (int l = k; l < x->list + x->nlist; l++)
                add_pair(frame, t, x, k, l); /* l moves less: i >= j */
        }
    }
}

/* The bodies that are looked at in a solve: all where there are forces, else those of the loop constraints. */
static void list_needed(const pm_active_set *active, pm_tree *t)
{
    for (int i = 0; i < t->model->nbody; i++) t->node[i].needed = t->augmented.forced;
    for (int i = 0; i < t->nloop; i++)
        for (int p = 0; p < pm_constraint_bodies(&active->constraint[t->loop[i]]); p++) {
            const int body = active->constraint[t->loop[i]].body[p];
            if (body != t->model->nbody) t->node[t->placed[body] - 1].needed = 1;
        }
}

void pm_tree_sum_up(pm_workspace *w)
{
    pm_tree *t = w->tree;
    pm_tree_augmented *a = &t->augmented;
    a->on = t->n <= a->most && !w->numbers.massless && !w->active.asymmetric;
    for (int i = 0; i < w->model->nbody; i++) a->on = a->on && rotates_simply(w->model, &t->node[i]);
    if (!a->on) return;
    a->forced = w->model->rows[PM_TABLE_FORCE] > 0 || pm_turning_plane_turns(w->model);
    a->shifts = 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        read_fixed(x, a->fixed);
        for (int k = x->first; k < x->first + x->ncoordinate; k++) {
            a->owner[k] = pm_tree_is_angle(t, k) ? x->body : PM_NONE;
            a->shifts |= a->fixed[2 * k] != 0 || a->fixed[2 * k + 1] != 0;
        }
    }
    pm_tree_influence(w->tree);
    pm_tree_augmented_read(&w->frame, w->tree);
    read_arms(w->tree);
    sum_up(&w->frame, w->tree);
    list_needed(&w->active, w->tree);
}

/* ---- at every solve ---- */
static void read_link(const pm_frame *frame, const pm_tree_node *x, double *direction, double *square)
{
    static const double zero[3] = {0, 0, 0};
    const double *parent = x->parent == frame->model->nbody ? zero : frame->velocity + 3 * x->parent;
    const double rate = pm_tree_slide_rate(x, parent, frame->velocity + 3 * x->body);
    direction[0] = x->rho[0] / x->length;
    direction[1] = x->rho[1] / x->length;
    *square = rate * rate;
}

void pm_tree_augmented_read(const pm_frame *frame, const pm_tree *t)
{
    const pm_tree_augmented *a = &t->augmented;
    for (int k = 0; k < t->n; k++) {
        const int body = a->owner[k];
        if (t->kind[k] == PM_TREE_DIRECTION) {
            read_link(frame, &t->node[t->placed[body] - 1], a->direction + 2 * k, a->square + k);
            continue;
        }
        const double *pose = frame->pose + 5 * body, *velocity = frame->velocity + 3 * body;
        a->direction[2 * k] = body == PM_NONE ? 1 : pose[3];
        a->direction[2 * k + 1] = body == PM_NONE ? 0 : pose[4];
        a->square[k] = body == PM_NONE ? 0 : velocity[2] * velocity[2];
    }
}

void pm_tree_augmented_set(const pm_tree *t, const double *y, const double *ydot)
{
    const pm_tree_augmented *a = &t->augmented;
    for (int k = 0; k < t->n; k++) {
        if (a->owner[k] == PM_NONE) continue; /* as pm_tree_augmented_read has left it */
        a->direction[2 * k] = cos(y[k]);
        a->direction[2 * k + 1] = sin(y[k]);
        a->square[k] = ydot[k] * ydot[k];
    }
}

/* v = R d */
static void rotated(const double *r, const double *d, double *v)
{
    v[0] = r[0] * d[0] - r[1] * d[1];
    v[1] = r[1] * d[0] + r[0] * d[1];
}

/* What shifting adds for coordinates i >= k. */
static void add_shifts(const pm_tree_augmented *a, int n, int i, int k, double *mass, double *x)
{
    const double *e = a->fixed + 2 * i, *f = a->fixed + 2 * k;
    double p[2], q[2];
    rotated(a->direction + 2 * k, a->lower + 2 * (i * n + k), p);
    rotated(a->direction + 2 * i, a->upper + 2 * (i * n + k), q);
    *mass += e[1] * p[0] - e[0] * p[1] + f[1] * q[0] - f[0] * q[1];
    x[i] += a->square[k] * (e[0] * p[0] + e[1] * p[1]);
    if (i != k) x[k] += a->square[i] * (f[0] * q[0] + f[1] * q[1]);
}

/* Of the weights on coordinate i. */
static double weight_on(const pm_numbers *numbers, const pm_tree *tree, int i)
{
    const pm_tree_augmented *a = &tree->augmented;
    double p[2];
    rotated(a->direction + 2 * i, a->upper + 2 * (i * tree->n + i), p);
    return a->weight[i] + numbers->gravity[1] * p[0] - numbers->gravity[0] * p[1];
}

void pm_tree_augmented_equations(const pm_numbers *numbers, pm_tree *t, double *x)
{
    const pm_tree_augmented *a = &t->augmented;
    const int n = t->n;
    for (int i = 0; i < n; i++) {
        const double *r = a->direction + 2 * i;
        double *mass = t->mass + i * n;
        x[i] = a->forced ? 0 : weight_on(numbers, t, i);
        for (int k = t->first_coupled[i]; k < i; k++) {
            const double *u = a->direction + 2 * k, same = a->same[i * n + k], cross = a->cross[i * n + k];
            const double c = r[0] * u[0] + r[1] * u[1], s = r[1] * u[0] - r[0] * u[1];
            const double beside = cross * c - same * s;
            mass[k] = a->level[i * n + k] + same * c + cross * s;
            x[i] += a->square[k] * beside;
            x[k] -= a->square[i] * beside;
            if (a->shifts) add_shifts(a, n, i, k, &mass[k], x);
        }
        mass[i] = a->level[i * n + i] + a->same[i * n + i];
        if (a->shifts) add_shifts(a, n, i, i, &mass[i], x);
    }
}

void pm_tree_augmented_influence(pm_tree *t)
{
    const pm_tree_augmented *a = &t->augmented;
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        double *c = t->bias + 3 * x->body;
        if (!x->needed) continue;
        c[0] = c[1] = c[2] = 0;
        for (int k = x->list; k < x->list + x->nlist; k++) {
            const int by = t->moved_by[k];
            double *b = t->influence + 3 * k, arm[2]; /* b[2] stays from pm_tree_sum_up */
            rotated(a->direction + 2 * by, a->arm + 2 * k, arm);
            b[0] = a->fixed[2 * by] - arm[1];
            b[1] = a->fixed[2 * by + 1] + arm[0];
            c[0] -= a->square[by] * arm[0];
            c[1] -= a->square[by] * arm[1];
        }
    }
}
