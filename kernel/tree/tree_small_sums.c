/* tree_small_sums.c - what stays the same in the equations of tree_small.c, once a phase: the sums of tree_augmented.c by
 * numbers of coordinates, and of each loop constraint the waves by which its marks move. */
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/joint_friction.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

#define MOST PM_TREE_SMALL_MOST

/* The wave of n . R_k d from what it is now, lever = R_k d. */
static pm_tree_small_wave wave_of(const double n[2], const double lever[2], const double direction[2])
{
    const double d[2] = {direction[0] * lever[0] + direction[1] * lever[1],
                         direction[0] * lever[1] - direction[1] * lever[0]};
    return (pm_tree_small_wave){n[0] * d[0] + n[1] * d[1], n[1] * d[0] - n[0] * d[1]};
}

static void add_wave(pm_tree_small_wave *to, double sign, pm_tree_small_wave x)
{
    to->a += sign * x.a;
    to->b += sign * x.b;
}

static double value_of(pm_tree_small_wave x, const double direction[2])
{
    return x.a * direction[0] + x.b * direction[1];
}

/* The direction of a constraint that stays; 0 if it does not. */
static int direction_of(const pm_model *model, const pm_constraint *c, double n[2])
{
    n[0] = n[1] = 0;
    if (c->drive != PM_NONE) return 0;
    switch (c->kind) {
    case PM_CONSTRAINT_ANGLE: return 1;
    case PM_CONSTRAINT_POINT_X: n[0] = 1; return 1;
    case PM_CONSTRAINT_POINT_Y: n[1] = 1; return 1;
    case PM_CONSTRAINT_LINE_NORMAL:
        n[0] = -c->axis[1];
        n[1] = c->axis[0];
        return c->body[1] == model->nbody;
    default: return 0;
    }
}

/* What moves one of a constraint's marks. */
static void add_side(const pm_frame *frame, const pm_tree *t, const pm_constraint *c, int side,
                     const double n[2], pm_tree_small_loop *x)
{
    const pm_tree_augmented *a = &t->augmented;
    const int body = c->body[side];
    const double sign = side == 0 ? 1 : -1, *mark = side == 0 ? c->a : c->b;
    x->rotates[side] = PM_NONE;
    if (body == frame->model->nbody) return;
    const double *im = frame->numbers->inverse_mass + 3 * body;
    const pm_tree_node *node = &t->node[t->placed[body] - 1];
    const pm_point p = pm_frame_point(frame, body, mark[0], mark[1]);
    x->square += n[0] * n[0] * im[0] + n[1] * n[1] * im[1];
    for (int i = node->list; i < node->list + node->nlist; i++) {
        const int k = t->moved_by[i], rotates = t->influence[3 * i + 2] != 0;
        const double *e = a->fixed + 2 * k, *b = t->influence + 3 * i, *direction = a->direction + 2 * k;
        double lever[2] = {b[1] - e[1], e[0] - b[0]};
        x->shift[k] += sign * (n[0] * e[0] + n[1] * e[1]);
        if (rotates) {
            lever[0] += p.r[0];
            lever[1] += p.r[1];
            x->rotates[side] = k;
            x->lever[side] = wave_of(n, p.r, direction);
            x->inverse_inertia[side] = im[2];
            if (c->kind == PM_CONSTRAINT_ANGLE) x->shift[k] += sign;
        }
        add_wave(&x->wave[k], sign, wave_of(n, lever, direction));
    }
    if (c->kind == PM_CONSTRAINT_ANGLE) x->square += im[2];
}

static int read_loop(const pm_frame *frame, const pm_tree *tree, const double *y, pm_constraint *c,
                     pm_tree_small_loop *x)
{
    double n[2];
    if (!direction_of(frame->model, c, n)) return 0;
    pm_constraint_kind(c->kind)->evaluate(frame, c);
    memset(x, 0, sizeof *x);
    for (int side = 0; side < 2; side++) add_side(frame, tree, c, side, n, x);
    x->constant = c->g;
    for (int k = 0; k < tree->n; k++)
        x->constant -= x->shift[k] * y[k] + value_of(x->wave[k], tree->augmented.direction + 2 * k);
    return 1;
}

static void read_sums(const pm_numbers *numbers, const pm_tree *tree, pm_tree_small *x)
{
    const pm_tree_augmented *a = &tree->augmented;
    const int n = tree->n;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            const int at = i * n + k;
            const double *e = a->fixed + 2 * i, *f = a->fixed + 2 * k, *p = a->lower + 2 * at,
                         *q = a->upper + 2 * at;
            x->same[i][k] = a->same[at];
            x->cross[i][k] = a->cross[at];
            x->level[i][k] = a->level[at];
            x->fixed[k][i] = (pm_tree_small_wave){f[0] * q[0] + f[1] * q[1], f[1] * q[0] - f[0] * q[1]};
            x->fixed[i][k] = (pm_tree_small_wave){e[0] * p[0] + e[1] * p[1], e[1] * p[0] - e[0] * p[1]};
        }
    for (int i = 0; i < MOST; i++) {
        x->owner[i] = PM_NONE;
        x->rotates[i] = 0;
    }
    for (int i = 0; i < n; i++) {
        const double *p = a->upper + 2 * (i * n + i);
        x->weight[i] = a->weight[i];
        x->rotated_weight[i].a = numbers->gravity[1] * p[0] - numbers->gravity[0] * p[1];
        x->rotated_weight[i].b = -numbers->gravity[1] * p[1] - numbers->gravity[0] * p[0];
        x->owner[i] = a->owner[i];
        x->rotates[i] = a->owner[i] != PM_NONE;
    }
    x->shifts = a->shifts;
}

int pm_tree_small_applies(const pm_workspace *w)
{
    return w->tree->small.on && !w->tree->part.few && !w->active.asymmetric && !w->numbers.massless &&
           !pm_joint_friction_by_load(&w->frame, &w->state);
}

void pm_tree_small_refer(const pm_frame *frame, pm_tree *tree, const double *y)
{
    pm_tree_small *x = &tree->small;
    for (int k = 0; k < x->n; k++) {
        if (x->y[k] == y[k]) continue;
        const double *pose = frame->pose + 5 * x->owner[k];
        const int there = x->owner[k] != PM_NONE && pose[2] == y[k];
        x->y[k] = y[k];
        x->cosine[k] = x->owner[k] == PM_NONE ? 1 : there ? pose[3] : cos(y[k]);
        x->sine[k] = x->owner[k] == PM_NONE ? 0 : there ? pose[4] : sin(y[k]);
    }
}

void pm_tree_small_sum_up(pm_workspace *w)
{
    pm_tree *t = w->tree;
    pm_tree_small *x = &t->small;
    x->n = t->n;
    x->nloop = t->nloop;
    x->on = t->augmented.on && !t->augmented.forced && t->n > 0 && t->n <= MOST && t->nloop < t->n;
    if (!x->on) return;
    double y[MOST];
    pm_tree_read(w->tree, &w->frame, y);
    pm_tree_influence(w->tree);
    for (int i = 0; i < t->nloop && x->on; i++)
        x->on = read_loop(&w->frame, w->tree, y, &w->active.constraint[t->loop[i]], &x->loop[i]);
    if (!x->on) return;
    read_sums(&w->numbers, w->tree, x);
    for (int k = 0; k < MOST; k++) x->y[k] = NAN;
    pm_tree_small_refer(&w->frame, w->tree, y);
}
