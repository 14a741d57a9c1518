/* tree_rates.c - velocities and accelerations outward along the tree, and its loop rows.
 *
 * With rho = P_a - p_b (see tree.c), k x the turn by a right angle:
 *   pin, weld   v_Pa = v_pb
 *   line        v_Pa = v_pb + w_b k x rho + sdot t,      a_Pa = a_pb + alpha_b k x rho - w_b^2 rho + 2 w_b sdot k x t + sddot t
 *   circles     v_Pa = v_pb + phidot k x rho,            a_Pa = a_pb + phiddot k x rho - phidot^2 rho
 * and for the mass centre at -r from its mark  v = v_P - w k x r,  a = a_P - alpha k x r + w^2 r. */
#include <math.h>
#include <string.h>

#include "body.h"
#include "dense.h"
#include "row.h"
#include "tree.h"
#include "tree_node.h"

#define SWEEPS 20
#define ROUNDING 4e-15 /* of the scene's size: loop rows are met */
#define STALLED 1e-12  /* of the scene's size: met, as far as far-off coordinates allow */

typedef struct pm_mark {
    double p[2], v[2], a[2];
} pm_mark;

/* A mark of a placed body at the frame's pose, with velocities (and accelerations) from v and a [nq + 3]. */
static pm_mark mark_of(const pm_workspace *w, int body, const double mark[2], const double *v,
                       const double *a)
{
    static const double still[3] = {0, 0, 0};
    const double *pose = w->frame.pose + 5 * body;
    const double *velocity = body == w->model->nbody ? still : v + 3 * body;
    const double r[2] = {pose[3] * mark[0] - pose[4] * mark[1], pose[4] * mark[0] + pose[3] * mark[1]};
    pm_mark x = {.p = {pose[0] + r[0], pose[1] + r[1]}};
    x.v[0] = velocity[0] - velocity[2] * r[1];
    x.v[1] = velocity[1] + velocity[2] * r[0];
    if (!a) return x;
    const double *acceleration = body == w->model->nbody ? still : a + 3 * body;
    const double square = velocity[2] * velocity[2];
    x.a[0] = acceleration[0] - acceleration[2] * r[1] - square * r[0];
    x.a[1] = acceleration[1] + acceleration[2] * r[0] - square * r[1];
    return x;
}

static double turning_of(const pm_workspace *w, const double *x, int body)
{
    return body == w->model->nbody ? 0 : x[3 * body + 2];
}

/* P_a - p_b, and its rates, for placements other than pin and weld. */
static void along(const pm_workspace *w, const pm_tree_node *x, double rate, const double *v, const double *a,
                  const pm_mark *parent, pm_mark *d)
{
    const int body_a = x->child_is_a ? x->body : x->parent, body_b = x->child_is_a ? x->parent : x->body;
    const double wa = turning_of(w, v, body_a), wb = turning_of(w, v, body_b);
    const double aa = a ? turning_of(w, a, body_a) : 0, ab = a ? turning_of(w, a, body_b) : 0;
    const double *child = w->frame.pose + 5 * x->body;
    double rho[2];
    for (int k = 0; k < 2; k++) {
        const double turned = k == 0 ? child[3] * x->child[0] - child[4] * x->child[1]
                                     : child[4] * x->child[0] + child[3] * x->child[1];
        rho[k] = child[k] + turned - parent->p[k];
        if (!x->child_is_a) rho[k] = -rho[k];
    }
    double spin, spin_rate = 0, slide = 0, slide_rate = 0, t[2] = {0, 0};
    if (x->placement == ROLL_CIRCLE) {
        spin = (x->radius_a * wa + x->radius_b * wb) / x->length;
        spin_rate = (x->radius_a * aa + x->radius_b * ab) / x->length;
    } else {
        const double phi = w->frame.pose[5 * body_b + 2] + x->line;
        t[0] = cos(phi);
        t[1] = sin(phi);
        spin = wb;
        spin_rate = ab;
        slide = x->placement == SLIDER ? rate : -x->radius_a * (wa - wb);
        slide_rate = x->placement == SLIDER ? 0 : -x->radius_a * (aa - ab);
    }
    d->v[0] = -spin * rho[1] + slide * t[0];
    d->v[1] = spin * rho[0] + slide * t[1];
    d->a[0] = -spin_rate * rho[1] - spin * spin * rho[0] - 2 * spin * slide * t[1] + slide_rate * t[0];
    d->a[1] = spin_rate * rho[0] - spin * spin * rho[1] + 2 * spin * slide * t[0] + slide_rate * t[1];
}

/* Velocities from rates; with `a`, the velocities are given and accelerations at yddot = 0 come out. */
static void move_node(const pm_workspace *w, const pm_tree_node *x, const double *ydot, double *v, double *a)
{
    double *to = v + 3 * x->body, *acceleration = a ? a + 3 * x->body : NULL;
    const double *own = ydot ? ydot + x->first : NULL;
    const double sign = x->child_is_a ? 1 : -1;
    if (x->placement == FREE) {
        for (int k = 0; k < 3 && own; k++) to[k] = k < 2 || x->turns ? own[k] : 0;
        for (int k = 0; k < 3 && a; k++) acceleration[k] = 0;
        return;
    }
    const int follows = x->placement == WELD || x->placement == SLIDER;
    if (own) to[2] = follows ? turning_of(w, v, x->parent) : x->turns ? own[0] : 0;
    if (a) acceleration[2] = follows ? turning_of(w, a, x->parent) : 0;
    pm_mark parent = mark_of(w, x->parent, x->mark, v, a), d = {.v = {0, 0}};
    const double *pose = w->frame.pose + 5 * x->body;
    const double r[2] = {pose[3] * x->child[0] - pose[4] * x->child[1],
                         pose[4] * x->child[0] + pose[3] * x->child[1]};
    if (x->placement > WELD) {
        double rate = own ? own[0] : 0;
        if (!own && x->placement == SLIDER) { /* the rate along the line, from the velocities */
            const int body_b = x->child_is_a ? x->parent : x->body;
            const double phi = w->frame.pose[5 * body_b + 2] + x->line, t[2] = {cos(phi), sin(phi)};
            const double u[2] = {to[0] - to[2] * r[1] - parent.v[0], to[1] + to[2] * r[0] - parent.v[1]};
            const double wb = turning_of(w, v, body_b);
            const double rho[2] = {pose[0] + r[0] - parent.p[0], pose[1] + r[1] - parent.p[1]};
            rate = sign * ((u[0] + wb * rho[1]) * t[0] + (u[1] - wb * rho[0]) * t[1]);
        }
        along(w, x, rate, v, a, &parent, &d);
    }
    if (own) {
        to[0] = parent.v[0] + sign * d.v[0] + to[2] * r[1];
        to[1] = parent.v[1] + sign * d.v[1] - to[2] * r[0];
    }
    if (!a) return;
    acceleration[0] = parent.a[0] + sign * d.a[0] + acceleration[2] * r[1] + to[2] * to[2] * r[0];
    acceleration[1] = parent.a[1] + sign * d.a[1] - acceleration[2] * r[0] + to[2] * to[2] * r[1];
}

void pm_tree_spread(const pm_workspace *w, const double *ydot, double *v)
{
    for (int i = 0; i < w->model->nbody; i++) move_node(w, &w->tree->node[i], ydot, v, NULL);
}

void pm_tree_bias(const pm_workspace *w, double *a)
{
    for (int i = 0; i < w->model->nbody; i++) move_node(w, &w->tree->node[i], NULL, w->frame.velocity, a);
}

void pm_tree_basis(pm_workspace *w, double *basis)
{
    pm_tree *t = w->tree;
    const int n = t->n, nq = w->model->nq;
    for (int k = 0; k < n; k++) {
        memset(t->unit, 0, (size_t)n * sizeof *t->unit);
        t->unit[k] = 1;
        pm_tree_spread(w, t->unit, t->column);
        for (int i = 0; i < nq; i++) basis[i * n + k] = t->column[i];
    }
}

void pm_tree_loops(pm_workspace *w, const double *basis, double *jacobian)
{
    const pm_tree *t = w->tree;
    const int n = t->n, ground = w->model->nbody;
    for (int i = 0; i < t->nloop; i++) {
        pm_row *row = &w->row[t->loop[i]];
        pm_row_kind(row->kind)->evaluate(w, row);
        for (int k = 0; k < n; k++) {
            double sum = 0;
            for (int side = 0; side < 2; side++) {
                if (row->body[side] == ground) continue;
                const double *column = basis + 3 * row->body[side] * n + k, *j = row->j + 3 * side;
                sum += j[0] * column[0] + j[1] * column[n] + j[2] * column[2 * n];
            }
            jacobian[i * n + k] = sum;
        }
    }
}

/* Places the bodies and evaluates the loop rows; their greatest residual. */
static double look(pm_workspace *w, const double *y, double *q, double *basis, double *jacobian)
{
    const pm_tree *t = w->tree;
    double worst = 0;
    pm_tree_place(w, w->state.memory, y, q);
    if (t->nloop == 0) return 0;
    pm_tree_basis(w, basis);
    pm_tree_loops(w, basis, jacobian);
    for (int i = 0; i < t->nloop; i++) {
        t->residual[i] = -w->row[t->loop[i]].g;
        worst = fmax(worst, fabs(t->residual[i]));
    }
    return worst;
}

int pm_tree_close(pm_workspace *w, double *y, int held, double *q, double *basis, double *jacobian)
{
    pm_tree *t = w->tree;
    const int n = t->nloop;
    double worst = look(w, y, q, basis, jacobian), before = INFINITY;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        if (worst <= ROUNDING * w->size || (worst <= STALLED * w->size && worst > 0.25 * before))
            return PM_OK;
        for (int i = 0; i < n; i++) /* without the column that is held */
            for (int k = 0, c = 0; k < t->n; k++)
                if (k != held) t->jacobian[i * n + c++] = jacobian[i * t->n + k];
        if (pm_lu_factor(n, t->jacobian, t->pivot)) return pm_fail(w, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
        pm_lu_solve(n, t->jacobian, t->pivot, t->residual);
        for (int k = 0, c = 0; k < t->n; k++)
            if (k != held) y[k] += t->residual[c++];
        before = worst;
        worst = look(w, y, q, basis, jacobian);
    }
    return pm_fail(w, PM_ASSEMBLY, PM_NONE, PM_NONE, worst, STALLED * w->size);
}
