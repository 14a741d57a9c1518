/* constraint_line.c - a circle (or a point: radius 0) and a straight line of another body.
 *
 * Line: through p_b at angle phi = angle_b + value, t = (cos phi, sin phi), n = k x t its free side; d = p_a - p_b,
 * u = v_a - v_b, w = omega_b, R the radius.  With k x n = -t and quad the velocity-quadratic part of a_a - a_b:
 *   normal    C = d.n - R                      Cdot = u.n - w d.t
 *             gamma = -(quad.n - 2 w u.t - w^2 d.n)
 *   tangent   slip = u.t + w d.n + R (omega_a - w): the relative velocity of the touching points along t
 *             C = d.t + R (angle_a - angle_b) - anchor      gamma = -(quad.t + 2 w u.n - w^2 d.t)
 * The surface of b may itself run along t (a belt): its way is taken off the residual, see drive.c. */
#include <math.h>

#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "elements/drive.h"
#include "state/workspace.h"

typedef struct pm_line_frame {
    double t[2], n[2];
} pm_line_frame;

static pm_line_frame line_frame(const pm_frame *frame, const pm_constraint *constraint)
{
    const double *pose = frame->pose + 5 * constraint->body[1], *axis = constraint->axis;
    const double c = pose[3] * axis[0] - pose[4] * axis[1], s = pose[4] * axis[0] + pose[3] * axis[1];
    return (pm_line_frame){.t = {c, s}, .n = {-s, c}};
}

static void evaluate_normal(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const pm_line_frame l = line_frame(frame, c);
    pm_constraint_along(c->j, &x, l.n, 1);
    c->j[5] -= pm_dot(x.d, l.t);
    c->g = pm_dot(x.d, l.n) - c->radius_a;
    c->gamma =
        -(pm_dot(x.quad, l.n) - 2 * x.omega_b * pm_dot(x.u, l.t) - x.omega_b * x.omega_b * pm_dot(x.d, l.n));
}

static double gap(const pm_frame *frame, const pm_constraint *c, double *rate)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const pm_line_frame l = line_frame(frame, c);
    if (rate) {
        double j[6];
        pm_constraint_along(j, &x, l.n, 1);
        j[5] -= pm_dot(x.d, l.t);
        *rate = pm_constraint_pair_times(frame, c->body, j, frame->v);
    }
    return pm_dot(x.d, l.n) - c->radius_a;
}

static double rolled(const pm_frame *frame, const pm_constraint *c, const pm_marks *x, const pm_line_frame *l)
{
    const double rotation = frame->pose[5 * c->body[0] + 2] - frame->pose[5 * c->body[1] + 2];
    return pm_dot(x->d, l->t) + c->radius_a * rotation;
}

static void evaluate_tangent(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    const pm_line_frame l = line_frame(frame, c);
    pm_constraint_along(c->j, &x, l.t, 1);
    c->j[2] += c->radius_a;
    c->j[5] += pm_dot(x.d, l.n) - c->radius_a;
    const pm_drive_motion drive = pm_drive_of(frame, c);
    c->g = rolled(frame, c, &x, &l) - drive.place;
    c->gamma = drive.change - (pm_dot(x.quad, l.t) + 2 * x.omega_b * pm_dot(x.u, l.n) -
                               x.omega_b * x.omega_b * pm_dot(x.d, l.t));
    c->rate = drive.rate;
}

static void remember(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    if (!anchor_too) {
        pm_drive_follow(frame, c->drive, memory);
        return;
    }
    const pm_marks x = pm_constraint_marks(frame, c);
    const pm_line_frame l = line_frame(frame, c);
    memory->anchor = rolled(frame, c, &x, &l);
    memory->time = frame->t;
}

static void touch(const pm_frame *frame, const pm_constraint *c, const pm_line_frame *l, pm_line_of_action *x)
{
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]);
    for (int k = 0; k < 2; k++) x->at[k] = a.p[k] - c->radius_a * l->n[k];
    x->couple[0] = x->couple[1] = 0;
}

static void act_normal(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_line_frame l = line_frame(frame, c);
    touch(frame, c, &l, x);
    for (int k = 0; k < 2; k++) x->direction[k] = l.n[k];
}

static void act_tangent(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_line_frame l = line_frame(frame, c);
    touch(frame, c, &l, x);
    for (int k = 0; k < 2; k++) x->direction[k] = l.t[k];
}

/* The line keeps its direction.  Where the point runs along it its lever on the line's body changes: that is felt unless
 * the body cannot rotate at all. */
static int steady_normal(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    const int b = c->body[1];
    if (x->rotates[b] || !pm_constant_motion_marks(frame, c, x)) return 0;
    return x->locked[b] || frame->numbers->inverse_mass[3 * b + 2] == 0 ||
           pm_constant_motion_together(frame, c, x);
}

/* While the circle stays on the line (its normal constraint) the lever of the tangent on the line's body stays. */
static int steady_tangent(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return !x->rotates[c->body[1]] && pm_constant_motion_marks(frame, c, x) &&
           pm_constant_motion_drive(frame, c, x);
}

/* C'' = d''.n + 2 d'.n' + d.n'' with n' = -w_b t: exact where the line does not rotate and the point does not go round. */
static void bound(const pm_frame *frame, const pm_constraint *c, const double *a, double h,
                  pm_constraint_bounds *x)
{
    const pm_marks m = pm_constraint_marks(frame, c);
    const pm_constraint_reach r = pm_constraint_reach_of(c, &m, a, h);
    const pm_line_frame l = line_frame(frame, c);
    x->rate = r.rate + r.omega * r.distance;
    x->exact = r.spin == 0 && r.swing == 0;
    x->bend = r.spin == 0 ? pm_dot(r.apart, l.n) - r.swing
                          : -(pm_length(r.apart) + r.swing + 2 * r.omega * r.rate + r.spin * r.distance);
}

const pm_constraint_ops pm_constraint_line_normal = {
    .evaluate = evaluate_normal, .gap = gap, .act = act_normal, .steady = steady_normal, .bound = bound};
const pm_constraint_ops pm_constraint_line_tangent = {
    .evaluate = evaluate_tangent, .act = act_tangent, .remember = remember, .steady = steady_tangent};
