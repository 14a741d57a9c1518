/* path_bridge.c - the path at and next to a singular position, where the rank of the loop constraints falls: branches of
 * the path cross there, and neither Newton's method nor the null vector tells which one the motion is on.
 *
 * The branch itself is smooth.  It is followed past the position by places on both sides, far enough from it to be
 * determined, and what lies between is the polynomial through them: with nodes c_j = cos((2 j + 1) pi / 2 N) about the
 * position, reach R and x = (u - centre) / R,
 *
 *   y(u) = a_0 / 2 + sum a_m T_m(x)      a_m = 2/N sum_j y(centre + R c_j) cos(m (2 j + 1) pi / 2 N)
 *
 * (Chebyshev interpolation; T_m and its derivatives by their recurrences).  The polynomial must meet the loop constraints. */

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "tree/tree.h"

static double reach_of(const pm_workspace *w)
{
    return PM_BRIDGE_REACH * pm_tree_scale(w->tree, &w->numbers, w->path->driver);
}

static double cosine(int k) { return cos(k * M_PI / (2 * PM_BRIDGE_PLACES)); }

static double support(int j) { return cosine(2 * j + 1); }

/* From the place before (at *u, with its slope) to the next on the branch, by the tangent. */
static int walk(pm_workspace *w, double *u, double to, double *y, double *slope)
{
    pm_path *p = w->path;
    double *const q = w->tree->q;
    for (int i = 0; i < p->n; i++) y[i] += (to - *u) * slope[i];
    y[p->driver] = *u = to;
    const int status = pm_tree_close(w, y, q, &p->loop);
    return status ? status : pm_tree_slope(w, &p->loop, slope);
}

/* The coefficients of all coordinates, in place of the values at the supports. */
static void transform(pm_path *p)
{
    enum { TURN = 4 * PM_BRIDGE_PLACES };
    double value[PM_BRIDGE_PLACES], turn[TURN];
    for (int k = 0; k < TURN; k++) turn[k] = cosine(k);
    for (int i = 0; i < p->n; i++) {
        for (int j = 0; j < PM_BRIDGE_PLACES; j++) value[j] = p->bridge.c[j * p->n + i];
        for (int m = 0; m < PM_BRIDGE_PLACES; m++) {
            double sum = 0;
            for (int j = 0; j < PM_BRIDGE_PLACES; j++) sum += value[j] * turn[m * (2 * j + 1) % TURN];
            p->bridge.c[m * p->n + i] = 2 * sum / PM_BRIDGE_PLACES;
        }
    }
}

/* y, dy/du and d2y/du2 of the polynomial. */
static void read(const pm_path *p, double u, double *y, double *slope, double *bend)
{
    const pm_bridge *b = &p->bridge;
    const double x = (u - b->centre) / b->reach;
    double t0 = 1, t1 = x, d0 = 0, d1 = 1, e0 = 0, e1 = 0;
    for (int i = 0; i < p->n; i++) {
        y[i] = 0.5 * b->c[i] + x * b->c[p->n + i];
        slope[i] = b->c[p->n + i];
        bend[i] = 0;
    }
    for (int m = 2; m < PM_BRIDGE_PLACES; m++) {
        const double t = 2 * x * t1 - t0, d = 2 * t1 + 2 * x * d1 - d0, e = 4 * d1 + 2 * x * e1 - e0;
        t0 = t1, t1 = t, d0 = d1, d1 = d, e0 = e1, e1 = e;
        for (int i = 0; i < p->n; i++) {
            const double c = b->c[m * p->n + i];
            y[i] += c * t;
            slope[i] += c * d;
            bend[i] += c * e;
        }
    }
    for (int i = 0; i < p->n; i++) {
        slope[i] /= b->reach;
        bend[i] /= b->reach * b->reach;
    }
    y[p->driver] = u;
}

/* Follows the branch from the last place that was determined past the position at u. */
static int build(pm_workspace *w, double u)
{
    pm_path *p = w->path;
    pm_bridge *b = &p->bridge;
    double *const y = b->y, *const slope = b->slope;
    const double reach = reach_of(w), side = u > b->known ? -1 : 1; /* where the known place lies */
    const double way = u + side * reach * support(0) - b->known;
    const double strides = ceil(fabs(way) / (PM_BRIDGE_STRIDE * reach));
    double at = b->known;
    if (!(strides <= PM_BRIDGE_STRIDES)) return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    memcpy(y, b->known_y, (size_t)p->n * sizeof *y);
    memcpy(slope, b->known_slope, (size_t)p->n * sizeof *slope);
    for (int i = 1; i < strides; i++) {
        const int status = walk(w, &at, b->known + way * i / strides, y, slope);
        if (status) return status;
    }
    for (int i = 0; i < PM_BRIDGE_PLACES; i++) {
        const int j = side > 0 ? i : PM_BRIDGE_PLACES - 1 - i;
        const int status = walk(w, &at, u + reach * support(j), y, slope);
        if (status) return status;
        memcpy(b->c + j * p->n, y, (size_t)p->n * sizeof *y);
    }
    b->centre = u;
    b->reach = reach;
    transform(p);
    return PM_OK;
}

static int meets_loops(const pm_workspace *w)
{
    for (int i = 0; i < w->tree->nloop; i++)
        if (!(fabs(w->active.constraint[w->tree->loop[i]].g) <= PM_BRIDGE_MET * w->numbers.size)) return 0;
    return 1;
}

void pm_path_bridge_forget(pm_path *p)
{
    p->bridge.reach = 0;
    p->bridge.has_known = 0;
}

void pm_path_bridge_determined(pm_path *p, double u, const pm_place *place)
{
    pm_bridge *b = &p->bridge;
    b->known = u;
    b->has_known = 1;
    memcpy(b->known_y, place->y, (size_t)p->n * sizeof *b->known_y);
    memcpy(b->known_slope, place->slope, (size_t)p->n * sizeof *b->known_slope);
}

int pm_path_bridge_place(pm_workspace *w, double u, pm_place *place)
{
    pm_path *p = w->path;
    pm_bridge *b = &p->bridge;
    if (!b->has_known) return pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
    if (!(fabs(u - b->centre) < PM_BRIDGE_SERVES * b->reach)) {
        b->reach = 0;
        const int status = build(w, u);
        if (status) return status;
    }
    read(p, u, place->y, place->slope, b->bend);
    pm_tree_place(w->tree, &w->frame, w->state.memory, place->y, place->q);
    pm_tree_loops(w->tree, &w->frame, &p->loop);
    return meets_loops(w) ? PM_OK : pm_fail(&w->result, PM_SINGULAR, PM_NONE, PM_NONE, 0, 0);
}

int pm_path_bridge_accelerate(pm_workspace *w)
{
    pm_path *p = w->path;
    pm_bridge *b = &p->bridge;
    pm_frame *f = &w->frame;
    const int nq = w->model->nq;
    double *const tangent = w->tree->v, *const bend = w->tree->q;
    pm_tree_read(w->tree, &w->frame, b->y);
    const double u = b->y[p->driver];
    if (!(fabs(u - b->centre) < PM_BRIDGE_SERVES * b->reach)) return 0;
    read(p, u, b->y, b->slope, b->bend);
    pm_tree_spread(w->tree, b->slope, tangent);
    /* d(tangent)/du: the accelerations at a steady unit rate of the driver */
    memcpy(f->velocity, tangent, (size_t)nq * sizeof *tangent);
    pm_tree_spread_accelerations(w->tree, &w->frame, b->bend, bend);
    memcpy(f->velocity, f->v, (size_t)nq * sizeof *tangent);
    double mass = 0, momentum = 0, change = 0, force = 0;
    for (int i = 0; i < nq; i++) {
        const double m = i % 3 == 2 ? pm_frame_inertia(&w->frame, i / 3) : w->numbers.mass[i / 3];
        mass += m * tangent[i] * tangent[i];
        momentum += m * tangent[i] * f->v[i];
        change += m * tangent[i] * bend[i];
        force += f->f[i] * tangent[i];
    }
    const double rate = momentum / mass;
    const double own = (force - change * rate * rate) / mass;
    for (int i = 0; i < nq; i++) f->a[i] = tangent[i] * own + bend[i] * rate * rate;
    for (int i = 0; i < w->active.n; i++) f->lambda[i] = NAN;
    f->level = PM_LEVEL_DYNAMIC;
    return 1;
}
