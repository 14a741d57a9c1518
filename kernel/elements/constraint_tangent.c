/* constraint_tangent.c - no slip between two circles (a point is a circle of radius 0; signed radii as in constraint_distance.c).
 *
 * phi is the direction of d = p_a - p_b, D = |d|, L = R_a + R_b, u = v_a - v_b, n = d/D, t = k x n.  The touching points
 * slip at  L phidot - R_a omega_a - R_b omega_b,  so that
 *   C = L phi - R_a angle_a - R_b angle_b - anchor
 * with phi unwrapped to where C is nearest to zero: a step may turn the centres by any angle.
 *   gamma = -L ((quad.t) - 2 (u.n) phidot) / D,   phidot = u.t / D. */
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "state/workspace.h"

static double rolled(const pm_frame *frame, const pm_constraint *c, const double d[2])
{
    const double *pose = frame->pose;
    return c->value * atan2(d[1], d[0]) - c->radius_a * pose[5 * c->body[0] + 2] -
           c->radius_b * pose[5 * c->body[1] + 2];
}

static double unwrapped(const pm_constraint *constraint, double c)
{
    const double rotation = 2 * M_PI * constraint->value;
    return c - rotation * round(c / rotation);
}

static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const double distance = pm_length(x.d);
    const double n[2] = {x.d[0] / distance, x.d[1] / distance}, t[2] = {-n[1], n[0]};
    const double factor = c->value / distance, spin = pm_dot(x.u, t) / distance;
    pm_constraint_along(c->j, &x, t, factor);
    c->j[2] -= c->radius_a;
    c->j[5] -= c->radius_b;
    c->g = unwrapped(c, rolled(frame, c, x.d) - frame->memory[c->memory].anchor);
    c->gamma = -factor * (pm_dot(x.quad, t) - 2 * pm_dot(x.u, n) * spin);
}

static void remember(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    if (!anchor_too) return;
    const pm_marks x = pm_constraint_marks(frame, c);
    memory->anchor = rolled(frame, c, x.d);
}

static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_marks y = pm_constraint_marks(frame, c);
    const double distance = pm_length(y.d);
    const double n[2] = {y.d[0] / distance, y.d[1] / distance};
    for (int k = 0; k < 2; k++) x->at[k] = y.a.p[k] - c->radius_a * n[k];
    x->direction[0] = -n[1];
    x->direction[1] = n[0];
    x->couple[0] = x->couple[1] = 0;
}

const pm_constraint_ops pm_constraint_circle_tangent = {
    .evaluate = evaluate, .act = act, .remember = remember, .steady = pm_constant_motion_together};
