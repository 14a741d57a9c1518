/* constraint_distance.c - two points at a given distance: links, and the gap of two circles.
 *
 * d = p_a - p_b, D = |d|, n = d/D, t = k x n, u = v_a - v_b, s = sign (-1 where one circle is inside the other):
 *   C = s (D - L)    Cdot = s u.n    gamma = -s (quad.n + (u.t)^2 / D)
 * The length L may be prescribed (drive.c): then Cdot has -s dL/dt, and gamma s d2L/dt2.
 * For circles L = R_a + R_b with signed radii: a inside b has R_a < 0, b inside a has R_b < 0; the touching point is
 * p_a - R_a n. */
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "elements/drive.h"
#include "state/workspace.h"

static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const double distance = pm_length(x.d);
    const double n[2] = {x.d[0] / distance, x.d[1] / distance}, t[2] = {-n[1], n[0]};
    const double across = pm_dot(x.u, t);
    pm_constraint_along(c->j, &x, n, c->sign);
    c->g = c->sign * (distance - c->value);
    c->gamma = -c->sign * (pm_dot(x.quad, n) + across * across / distance);
    if (c->drive == PM_NONE) return;
    const pm_drive_motion length = pm_drive_of(frame, c);
    c->g = c->sign * (distance - length.place);
    c->gamma += c->sign * length.change;
    c->rate = c->sign * length.rate;
}

/* Of circles: their distance is not prescribed. */
static double gap(const pm_frame *frame, const pm_constraint *c, double *rate)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const double distance = pm_length(x.d);
    if (rate) {
        const double n[2] = {x.d[0] / distance, x.d[1] / distance};
        double j[6];
        pm_constraint_along(j, &x, n, c->sign);
        *rate = pm_constraint_pair_times(frame, c->body, j, frame->v);
    }
    return c->sign * (distance - c->value);
}

static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]);
    const pm_point b = pm_frame_point(frame, c->body[1], c->b[0], c->b[1]);
    const double d[2] = {a.p[0] - b.p[0], a.p[1] - b.p[1]}, distance = pm_length(d);
    x->couple[0] = x->couple[1] = 0;
    for (int k = 0; k < 2; k++) {
        x->direction[k] = c->sign * d[k] / distance;
        x->at[k] = a.p[k] - c->radius_a * d[k] / distance;
    }
}

/* C'' = s (d''.n + (d'.t)^2 / D): apart the last part only helps; one inside the other it counts against, as long as the
 * centres do not meet. */
static void bound(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                  pm_constraint_bounds *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_constraint_reach r = pm_constraint_reach_of(c, &m, a, h);
    const double hardest = pm_length(r.apart) + r.swing, nearest = pm_length(m.d) - r.rate * h;
    x->rate = r.rate;
    x->exact = 0;
    x->bend = -hardest;
    if (c->sign < 0) x->bend = nearest > 0 ? -(hardest + r.rate * r.rate / nearest) : -INFINITY;
}

/* A length that changes changes the distance vector. */
static int steady(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return pm_constant_motion_drive(frame, c, x) && pm_constant_motion_together(frame, c, x);
}

const pm_constraint_ops pm_constraint_distance = {
    .evaluate = evaluate, .gap = gap, .act = act, .steady = steady, .bound = bound};
