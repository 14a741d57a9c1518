/* tree.c - chooses parents and placements of the bodies. */
#include "tree/tree.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree_node.h"

/* most: coordinates that move a body, over all bodies; summed: coordinates of which sums are kept. */
static int create_sums(pm_workspace *w, size_t most, size_t summed)
{
    const size_t nq = (size_t)w->model->nq, nrow = (size_t)w->model->nconstraint, square = summed * summed;
    pm_tree_augmented *a = &w->tree->augmented;
    pm_elimination *e = &w->tree->elimination;
    const pm_array array[] = {
        PM_ARRAY(a->same, square),
        PM_ARRAY(a->cross, square),
        PM_ARRAY(a->level, square),
        PM_ARRAY(a->lower, 2 * square),
        PM_ARRAY(a->upper, 2 * square),
        PM_ARRAY(a->fixed, 2 * summed),
        PM_ARRAY(a->direction, 2 * summed),
        PM_ARRAY(a->square, summed),
        PM_ARRAY(a->weight, 2 * summed),
        PM_ARRAY(a->arm, 2 * most),
        PM_ARRAY(a->owner, nq),
        PM_ARRAY(e->low, nrow),
        PM_ARRAY(e->high, nrow),
        PM_ARRAY(e->first, nrow),
        PM_ARRAY(e->last, nrow),
        PM_ARRAY(e->place, nq),
        PM_ARRAY(e->filled, nq),
    };
    a->most = (int)summed;
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

int pm_tree_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t nq = (size_t)m->nq, nrow = (size_t)m->nconstraint, nbody = (size_t)m->nbody,
                 most = nbody * nq, summed = nq < PM_TREE_SUMMED ? nq : PM_TREE_SUMMED;
    if (PM_ARENA_NEW(&w->memory, w->tree)) return PM_NO_MEMORY;
    pm_tree *t = w->tree;
    t->model = m;
    t->constraint = w->active.constraint;
    const pm_array array[] = {
        PM_ARRAY(t->jacobian, nrow * nq),
        PM_ARRAY(t->mass, nq * nq),
        PM_ARRAY(t->reduced, nrow * nq),
        PM_ARRAY(t->schur, nrow * nrow),
        PM_ARRAY(t->influence, 3 * most),
        PM_ARRAY(t->residual, 2 * nrow),
        PM_ARRAY(t->force, nq),
        PM_ARRAY(t->bias, nq),
        PM_ARRAY(t->wrench, nq),
        PM_ARRAY(t->q, nq),
        PM_ARRAY(t->v, nq),
        PM_ARRAY(t->rate, nq),
        PM_ARRAY(t->part.motion, PM_TREE_FEW * nq),
        PM_ARRAY(t->part.jacobian, nrow * nq),
        PM_ARRAY(t->node, nbody),
        PM_ARRAY(t->loop, nrow),
        PM_ARRAY(t->kind, nq),
        PM_ARRAY(t->pivot, nq + nrow),
        PM_ARRAY(t->first_coupled, nq),
        PM_ARRAY(t->placed, nbody),
        PM_ARRAY(t->moved_by, most),
        PM_ARRAY(t->from, nrow),
        PM_ARRAY(t->to, nrow),
        PM_ARRAY(t->first_loop, nrow),
        PM_ARRAY(t->part.column, nq),
        PM_ARRAY(t->part.position, nq),
        PM_ARRAY(t->part.left, nrow),
        PM_ARRAY(t->part.bottom, nrow),
        PM_ARRAY(t->part.right, nrow),
        PM_ARRAY(t->weight, nbody),
        PM_ARRAY(t->top, nbody),
        PM_ARRAY(t->used, nrow),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    return status ? status : create_sums(w, most, summed);
}

/* ---- choice ---- */
/* Active constraints that belong to one joint, contact or captured pair. */
typedef struct pm_group {
    int constraint[PM_JOINT_CONSTRAINTS];
    int n;
} pm_group;

static int constraints_are(const pm_active_set *active, const pm_group *g, int first, int second, int third)
{
    const int wanted[] = {first, second, third};
    int n = 0;
    while (n < 3 && wanted[n] >= 0) n++;
    if (g->n != n) return 0;
    for (int i = 0; i < n; i++)
        if (active->constraint[g->constraint[i]].kind != wanted[i]) return 0;
    return 1;
}

static int placement_of(const pm_active_set *active, const pm_group *g)
{
    if (constraints_are(active, g, PM_CONSTRAINT_POINT_X, PM_CONSTRAINT_POINT_Y, -1)) return PIN;
    if (constraints_are(active, g, PM_CONSTRAINT_POINT_X, PM_CONSTRAINT_POINT_Y, PM_CONSTRAINT_ANGLE))
        return WELD;
    if (constraints_are(active, g, PM_CONSTRAINT_LINE_NORMAL, PM_CONSTRAINT_ANGLE, -1)) return SLIDER;
    if (constraints_are(active, g, PM_CONSTRAINT_LINE_NORMAL, PM_CONSTRAINT_LINE_TANGENT, -1))
        return ROLL_LINE;
    if (constraints_are(active, g, PM_CONSTRAINT_DISTANCE, PM_CONSTRAINT_CIRCLE_TANGENT, -1) &&
        active->constraint[g->constraint[0]].value > 0)
        return ROLL_CIRCLE;
    if (constraints_are(active, g, PM_CONSTRAINT_DISTANCE, -1, -1) &&
        active->constraint[g->constraint[0]].value > 0)
        return LINK;
    return FREE;
}

static int rotates(const pm_numbers *numbers, int body) { return numbers->inverse_mass[3 * body + 2] > 0; }

/* Directions of links turn back to where they were over the side to which weights point: nothing rests at the other one. */
static void set_middle(const double gravity[2], pm_tree_node *x)
{
    const double size = hypot(gravity[0], gravity[1]);
    x->angle = size > 0 ? atan2(gravity[1], gravity[0]) : 0;
    x->rotation[0] = size > 0 ? gravity[0] / size : 1;
    x->rotation[1] = size > 0 ? gravity[1] / size : 0;
}

static void place(pm_workspace *w, int *nplaced, int body, int placement, const pm_group *g, int child_is_a)
{
    pm_tree *t = w->tree;
    pm_tree_node *x = &t->node[*nplaced];
    *x = (pm_tree_node){.body = body, .parent = w->model->nbody, .placement = placement, .first = t->n};
    x->rotates = rotates(&w->numbers, body);
    x->ncoordinate = placement == FREE     ? 2 + x->rotates
                     : placement == WELD   ? 0
                     : placement == SLIDER ? 1
                     : placement == LINK   ? 1 + x->rotates
                                           : x->rotates;
    x->shift = placement == LINK ? x->rotates : 0;
    t->n += x->ncoordinate;
    t->placed[body] = ++*nplaced;
    if (placement == FREE) return;
    const pm_constraint *c = &w->active.constraint[g->constraint[0]],
                        *last = &w->active.constraint[g->constraint[g->n - 1]];
    const double sign = child_is_a ? 1 : -1;
    x->parent = c->body[child_is_a ? 1 : 0];
    x->child_is_a = child_is_a;
    memcpy(x->child, child_is_a ? c->a : c->b, sizeof x->child);
    memcpy(x->mark, child_is_a ? c->b : c->a, sizeof x->mark);
    if (pm_tree_follows(x)) {
        x->angle = sign * last->value;
        x->rotation[0] = cos(x->angle);
        x->rotation[1] = sin(x->angle);
    }
    if (placement == LINK) set_middle(w->numbers.gravity, x);
    memcpy(x->line, c->axis, sizeof x->line);
    x->radius = c->radius_a;
    x->length = c->value;
    x->memory = last->memory;
    x->nconstraint = g->n;
    memcpy(x->constraint, g->constraint, sizeof x->constraint);
    if (placement == ROLL_LINE) {
        x->roll_own = -sign * c->radius_a;
        x->roll_parent = sign * c->radius_a;
    } else if (placement == ROLL_CIRCLE) {
        x->roll_own = (child_is_a ? c->radius_a : c->radius_b) / x->length;
        x->roll_parent = (child_is_a ? c->radius_b : c->radius_a) / x->length;
        const double direction = w->state.memory[x->memory].anchor / x->length;
        x->touch[0] = x->length * cos(direction);
        x->touch[1] = x->length * sin(direction);
    }
    for (int i = 0; i < g->n; i++) t->used[g->constraint[i]] = 1;
}

static int is_placed(const pm_tree *tree, int body)
{
    return body == tree->model->nbody || tree->placed[body];
}

/* Driven constraints are not solved: they depend on the time. */
static int is_driven(const pm_active_set *active, const pm_group *g)
{
    for (int i = 0; i < g->n; i++)
        if (active->constraint[g->constraint[i]].drive != PM_NONE) return 1;
    return 0;
}

/* Places a body by the group, if just one of its two is placed. */
static int place_by(pm_workspace *w, const pm_group *g, int *nplaced)
{
    if (g->n == 0 || w->tree->used[g->constraint[0]] || is_driven(&w->active, g)) return 0;
    const pm_constraint *c = &w->active.constraint[g->constraint[0]];
    const int a = is_placed(w->tree, c->body[0]), b = is_placed(w->tree, c->body[1]);
    if (a == b) return 0;
    const int placement = placement_of(&w->active, g), body = c->body[a ? 1 : 0];
    if (placement == FREE || (!rotates(&w->numbers, body) && placement != PIN && placement != LINK)) return 0;
    place(w, nplaced, body, placement, g, !a);
    return 1;
}

/* Without what is driven: that is not solved, since it depends on the time. */
static pm_group joint_group(const pm_model *m, const pm_active_set *active, int joint)
{
    const int first = m->joint_constraint[joint];
    const int end =
        joint + 1 < m->rows[PM_TABLE_JOINT] ? m->joint_constraint[joint + 1] : m->njoint_constraint;
    pm_group g = {.n = 0};
    for (int i = first; i < end && g.n < PM_JOINT_CONSTRAINTS; i++)
        if (active->of_joint[i] >= 0 && active->constraint[active->of_joint[i]].drive == PM_NONE)
            g.constraint[g.n++] = active->of_joint[i];
    return g;
}

static pm_group slot_group(const pm_active_set *active, int slot)
{
    pm_group g = {.n = 0};
    for (int i = PM_JOINT_CONSTRAINTS * slot; i < PM_JOINT_CONSTRAINTS * (slot + 1); i++)
        if (active->slot_held[i] >= 0) g.constraint[g.n++] = active->slot_held[i];
    if (active->slot_normal[slot] >= 0) g.constraint[g.n++] = active->slot_normal[slot];
    if (active->slot_tangent[slot] >= 0) g.constraint[g.n++] = active->slot_tangent[slot];
    return g;
}

/* Fixed bodies come first, as welded to the ground where they are. */
static void place_fixed(pm_workspace *w, int *nplaced)
{
    for (int i = 0; i < w->model->nbody; i++) {
        if (!w->numbers.fixed[i]) continue;
        const double *pose = w->frame.pose + 5 * i;
        w->tree->node[*nplaced] = (pm_tree_node){.body = i,
                                                 .parent = w->model->nbody,
                                                 .placement = WELD,
                                                 .child_is_a = 1,
                                                 .first = w->tree->n,
                                                 .rotates = rotates(&w->numbers, i),
                                                 .mark = {pose[0], pose[1]},
                                                 .angle = pose[2],
                                                 .rotation = {pose[3], pose[4]}};
        w->tree->placed[i] = ++*nplaced;
        for (int k = 3 * i; k < 3 * i + 3; k++) {
            w->tree->q[k] = w->state.q[k];
            w->tree->v[k] = w->tree->bias[k] = w->frame.a[k] = 0;
        }
    }
}

/* It will place nothing any more: it cannot, or both of its bodies are placed. */
static int is_spent(const pm_active_set *active, const pm_tree *tree, const pm_group *g)
{
    if (g->n == 0) return 1;
    const pm_constraint *c = &active->constraint[g->constraint[0]];
    return is_placed(tree, c->body[0]) && is_placed(tree, c->body[1]);
}

/* By a joint that is one constraint (a link), or by one that is several.  *spent: joints, from the first on, that will place
 * nothing any more. */
static int place_by_joint(pm_workspace *w, int single, int *nplaced, int *spent)
{
    for (int i = *spent; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        const pm_group g = joint_group(w->model, &w->active, i);
        if ((g.n == 1) == single && place_by(w, &g, nplaced)) return 1;
        if (i == *spent && is_spent(&w->active, w->tree, &g)) ++*spent;
    }
    return 0;
}

/* What leaves a body fewer coordinates comes first; links only if `linked`. */
static int place_next(pm_workspace *w, int linked, int *nplaced, int *spent)
{
    if (place_by_joint(w, 0, nplaced, spent)) return 1;
    for (int i = 0; i < w->model->nslot; i++) {
        const pm_group g = slot_group(&w->active, i);
        if (g.n > 1 && place_by(w, &g, nplaced)) return 1;
    }
    if (linked && place_by_joint(w, 1, nplaced, spent)) return 1;
    for (int i = 0; i < w->model->nbody; i++)
        if (!w->tree->placed[i]) {
            place(w, nplaced, i, FREE, NULL, 0);
            return 1;
        }
    return 0;
}

static void place_all(pm_workspace *w, int linked)
{
    pm_tree *t = w->tree;
    int nplaced = 0, spent = 0;
    t->n = t->nloop = 0;
    memset(t->used, 0, (size_t)w->model->nconstraint);
    memset(t->placed, 0, (size_t)w->model->nbody * sizeof *t->placed);
    place_fixed(w, &nplaced);
    t->nfixed = nplaced;
    while (nplaced < w->model->nbody) place_next(w, linked, &nplaced, &spent);
    pm_tree_order(&w->active, t);
}

/* Many coordinates move one body, and links are among them: as loop constraints, each between neighbours, they cost less. */
static int is_long(const pm_tree *t)
{
    int most = 0, linked = 0;
    for (int i = 0; i < t->model->nbody; i++) {
        most = t->node[i].nlist > most ? t->node[i].nlist : most;
        linked |= t->node[i].placement == LINK;
    }
    return linked && most > PM_TREE_LINKED;
}

void pm_tree_build(pm_workspace *w)
{
    pm_tree *t = w->tree;
    t->part.few = t->augmented.on = t->small.on = 0;
    place_all(w, 1);
    if (is_long(t)) place_all(w, 0);
    t->whole = pm_tree_is_whole(w);
    if (t->n > 0) t->part.column[t->n - 1] = PM_NONE; /* none is chosen */
}

int pm_tree_is_angle(const pm_tree *t, int coordinate) { return t->kind[coordinate] >= PM_TREE_ANGLE; }
