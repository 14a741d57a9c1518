/* tree.c - chooses parents and placements, and solves positions outward.
 *
 * Placements of a body c on its parent p, with a, b the first and second partner of the rows as in row_*.c:
 *   pin, weld   the marks coincide
 *   line        P_a = p_b + s t + R n:   rolling   s = anchor - R (angle_a - angle_b);   slider   s is the coordinate
 *   circles     P_a = p_b + L (cos phi, sin phi),   phi = (anchor + R_a angle_a + R_b angle_b) / L
 * Either partner may be the child. */
#include "tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "row.h"
#include "tree_node.h"

int pm_tree_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t nq = (size_t)m->nq, nrow = (size_t)m->nrow, nbody = (size_t)m->nbody;
    pm_tree *t = w->tree = calloc(1, sizeof *t);
    if (!t) return PM_NO_MEMORY;
    const size_t doubles = nq * nq + 3 * nq, ints = nrow + 2 * nq + nbody;
    double *p = t->block = calloc(doubles * sizeof *p + ints * sizeof(int) + nrow + 1, 1);
    t->node = calloc(nbody + 1, sizeof *t->node);
    if (!p || !t->node) return PM_NO_MEMORY;
    t->jacobian = p;
    t->residual = t->jacobian + nq * nq;
    t->unit = t->residual + nq;
    t->column = t->unit + nq;
    t->loop = (int *)(void *)(p + doubles);
    t->kind = t->loop + nrow;
    t->pivot = t->kind + nq;
    t->placed = t->pivot + nq;
    t->used = (unsigned char *)(t->placed + nbody);
    return PM_OK;
}

void pm_tree_free(pm_workspace *w)
{
    if (!w->tree) return;
    free(w->tree->node);
    free(w->tree->block);
    free(w->tree);
    w->tree = NULL;
}

/* ---- choice ---- */
/* Active rows that belong to one joint or contact. */
typedef struct pm_group {
    int row[PM_JOINT_ROWS];
    int n;
} pm_group;

static int rows_are(const pm_workspace *w, const pm_group *g, int first, int second, int third)
{
    const int wanted[] = {first, second, third};
    int n = 0;
    while (n < 3 && wanted[n] >= 0) n++;
    if (g->n != n) return 0;
    for (int i = 0; i < n; i++)
        if (w->row[g->row[i]].kind != wanted[i]) return 0;
    return 1;
}

static int placement_of(const pm_workspace *w, const pm_group *g)
{
    if (rows_are(w, g, PM_ROW_POINT_X, PM_ROW_POINT_Y, -1)) return PIN;
    if (rows_are(w, g, PM_ROW_POINT_X, PM_ROW_POINT_Y, PM_ROW_ANGLE)) return WELD;
    if (rows_are(w, g, PM_ROW_LINE_NORMAL, PM_ROW_ANGLE, -1)) return SLIDER;
    if (rows_are(w, g, PM_ROW_LINE_NORMAL, PM_ROW_LINE_TANGENT, -1)) return ROLL_LINE;
    if (rows_are(w, g, PM_ROW_DISTANCE, PM_ROW_CIRCLE_TANGENT, -1)) return ROLL_CIRCLE;
    return FREE;
}

static int turns(const pm_workspace *w, int body) { return w->inverse_mass[3 * body + 2] > 0; }

static void add_coordinates(pm_tree *t, int n, const int *kind)
{
    for (int i = 0; i < n; i++) t->kind[t->n++] = kind[i];
}

static void place(pm_workspace *w, int *nplaced, int body, int placement, const pm_group *g, int child_is_a)
{
    static const int length[] = {0}, angle[] = {2}, plane[] = {0, 1, 2};
    pm_tree *t = w->tree;
    pm_tree_node *x = &t->node[*nplaced];
    *x = (pm_tree_node){.body = body, .parent = w->model->nbody, .placement = placement, .first = t->n};
    x->turns = turns(w, body);
    t->placed[body] = 1;
    ++*nplaced;
    if (placement == FREE) {
        add_coordinates(t, x->turns ? 3 : 2, plane);
        return;
    }
    const pm_row *row = &w->row[g->row[0]], *last = &w->row[g->row[g->n - 1]];
    x->parent = row->body[child_is_a ? 1 : 0];
    x->child_is_a = child_is_a;
    memcpy(x->child, child_is_a ? row->a : row->b, sizeof x->child);
    memcpy(x->mark, child_is_a ? row->b : row->a, sizeof x->mark);
    x->line = row->value;
    x->angle = last->value;
    x->radius_a = row->radius_a;
    x->radius_b = row->radius_b;
    x->length = row->value;
    x->memory = last->memory;
    for (int i = 0; i < g->n; i++) t->used[g->row[i]] = 1;
    if (placement == SLIDER) add_coordinates(t, 1, length);
    if (placement != SLIDER && placement != WELD && x->turns) add_coordinates(t, 1, angle);
}

static int is_placed(const pm_workspace *w, int body)
{
    return body == w->model->nbody || w->tree->placed[body];
}

/* Places a body by the group, if just one of its two is placed. */
static int place_by(pm_workspace *w, const pm_group *g, int *nplaced)
{
    if (g->n < 2 || w->tree->used[g->row[0]]) return 0;
    const pm_row *row = &w->row[g->row[0]];
    const int a = is_placed(w, row->body[0]), b = is_placed(w, row->body[1]);
    if (a == b) return 0;
    const int placement = placement_of(w, g), body = row->body[a ? 1 : 0];
    if (placement == FREE || (!turns(w, body) && placement != PIN)) return 0;
    place(w, nplaced, body, placement, g, !a);
    return 1;
}

static pm_group joint_group(const pm_workspace *w, int joint)
{
    const pm_model *m = w->model;
    const int first = m->joint_row[joint];
    const int end = joint + 1 < m->rows[PM_TABLE_JOINT] ? m->joint_row[joint + 1] : m->njoint_row;
    pm_group g = {.n = 0};
    for (int i = first; i < end && g.n < PM_JOINT_ROWS; i++)
        if (w->joint_active[i] != PM_NONE) g.row[g.n++] = w->joint_active[i];
    return g;
}

static pm_group slot_group(const pm_workspace *w, int slot)
{
    pm_group g = {.n = 0};
    if (w->slot_normal[slot] != PM_NONE) g.row[g.n++] = w->slot_normal[slot];
    if (w->slot_tangent[slot] != PM_NONE) g.row[g.n++] = w->slot_tangent[slot];
    return g;
}

static int place_next(pm_workspace *w, int *nplaced)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        const pm_group g = joint_group(w, i);
        if (place_by(w, &g, nplaced)) return 1;
    }
    for (int i = 0; i < w->model->nslot; i++) {
        const pm_group g = slot_group(w, i);
        if (place_by(w, &g, nplaced)) return 1;
    }
    for (int i = 0; i < w->model->nbody; i++)
        if (!w->tree->placed[i]) {
            place(w, nplaced, i, FREE, NULL, 0);
            return 1;
        }
    return 0;
}

void pm_tree_build(pm_workspace *w)
{
    pm_tree *t = w->tree;
    int nplaced = 0;
    t->n = t->nloop = 0;
    memset(t->used, 0, (size_t)w->model->nrow);
    memset(t->placed, 0, (size_t)w->model->nbody * sizeof *t->placed);
    while (nplaced < w->model->nbody) place_next(w, &nplaced);
    for (int i = 0; i < w->nactive; i++)
        if (!t->used[i]) t->loop[t->nloop++] = i;
}

int pm_tree_is_angle(const pm_workspace *w, int coordinate) { return w->tree->kind[coordinate] == 2; }

/* ---- positions ---- */
typedef struct pm_pose {
    double p[2], angle, c, s;
} pm_pose;

static void mark_at(const pm_pose *x, const double mark[2], double p[2])
{
    p[0] = x->p[0] + x->c * mark[0] - x->s * mark[1];
    p[1] = x->p[1] + x->s * mark[0] + x->c * mark[1];
}

/* Where the child's mark is: `known` the parent's mark, phi the angle of body b, turn the angle of a minus that of b. */
static void other_mark(const pm_tree_node *x, const double *anchor, double s, double angle_a, double angle_b,
                       const double known[2], double p[2])
{
    double d[2] = {0, 0}; /* P_a - p_b */
    if (x->placement == SLIDER || x->placement == ROLL_LINE) {
        const double phi = angle_b + x->line, c = cos(phi), n = sin(phi);
        const double along = x->placement == SLIDER ? s : *anchor - x->radius_a * (angle_a - angle_b);
        d[0] = along * c - x->radius_a * n;
        d[1] = along * n + x->radius_a * c;
    } else if (x->placement == ROLL_CIRCLE) {
        const double phi = (*anchor + x->radius_a * angle_a + x->radius_b * angle_b) / x->length;
        d[0] = x->length * cos(phi);
        d[1] = x->length * sin(phi);
    }
    for (int k = 0; k < 2; k++) p[k] = known[k] + (x->child_is_a ? d[k] : -d[k]);
}

void pm_tree_place(const pm_workspace *w, const pm_memory *memory, const double *y, double *q)
{
    const pm_tree *t = w->tree;
    double *pose = w->frame.pose;
    for (int i = 0; i < w->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        double *to = q + 3 * x->body, *at = pose + 5 * x->body;
        const double *own = y + x->first;
        if (x->placement == FREE) {
            to[0] = own[0];
            to[1] = own[1];
            to[2] = x->turns ? own[2] : 0;
            at[2] = to[2];
            at[3] = cos(to[2]);
            at[4] = sin(to[2]);
        } else {
            const double *from = pose + 5 * x->parent, sign = x->child_is_a ? 1 : -1;
            const pm_pose parent = {{from[0], from[1]}, from[2], from[3], from[4]};
            double angle = 0, known[2], p[2];
            if (x->placement == WELD || x->placement == SLIDER)
                angle = parent.angle + sign * x->angle;
            else if (x->turns)
                angle = own[0];
            at[2] = to[2] = angle;
            at[3] = cos(angle);
            at[4] = sin(angle);
            mark_at(&parent, x->mark, known);
            other_mark(x, x->memory == PM_NONE ? NULL : &memory[x->memory].anchor, own[0],
                       x->child_is_a ? angle : parent.angle, x->child_is_a ? parent.angle : angle, known, p);
            to[0] = p[0] - (at[3] * x->child[0] - at[4] * x->child[1]);
            to[1] = p[1] - (at[4] * x->child[0] + at[3] * x->child[1]);
        }
        at[0] = to[0];
        at[1] = to[1];
    }
}

void pm_tree_read(const pm_workspace *w, double *y)
{
    const double *pose = w->frame.pose;
    for (int i = 0; i < w->model->nbody; i++) {
        const pm_tree_node *x = &w->tree->node[i];
        const double *at = pose + 5 * x->body;
        double *own = y + x->first;
        if (x->placement == FREE) {
            own[0] = at[0];
            own[1] = at[1];
            if (x->turns) own[2] = at[2];
        } else if (x->placement == SLIDER) {
            const int a = x->child_is_a ? x->body : x->parent, b = x->child_is_a ? x->parent : x->body;
            const double *mark_a = x->child_is_a ? x->child : x->mark,
                         *mark_b = x->child_is_a ? x->mark : x->child;
            const pm_point pa = pm_point_at(w, a, mark_a[0], mark_a[1]),
                           pb = pm_point_at(w, b, mark_b[0], mark_b[1]);
            const double phi = pose[5 * b + 2] + x->line;
            own[0] = (pa.p[0] - pb.p[0]) * cos(phi) + (pa.p[1] - pb.p[1]) * sin(phi);
        } else if (x->placement != WELD && x->turns) {
            own[0] = at[2];
        }
    }
}
