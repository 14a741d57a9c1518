/* constraint_point.c - two points coincide (pin): p_a - p_b = 0, one constraint for each axis of the scene.
 *
 * With n the axis:  C = n.(p_a - p_b),  Cdot = n.(v_a - v_b),
 * gamma = -n.(-omega_a^2 r_a + omega_b^2 r_b). */
#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "state/workspace.h"

static const double axis_x[2] = {1, 0}, axis_y[2] = {0, 1};

/* The way from a body's mass centre to its mark; the ground rotates nothing. */
static inline void lever_of(const pm_frame *frame, int body, const double mark[2], double r[2])
{
    const double *pose = frame->pose + 5 * body;
    r[0] = pose[3] * mark[0] - pose[4] * mark[1];
    r[1] = pose[4] * mark[0] + pose[3] * mark[1];
}

/* Written out for each axis, k = 0 or 1: these are the constraints of all pins. */
static inline void evaluate(const pm_frame *frame, pm_constraint *c, int k)
{
    const pm_frame *f = frame;
    const double omega_a = f->velocity[3 * c->body[0] + 2], omega_b = f->velocity[3 * c->body[1] + 2];
    double a[2], b[2];
    lever_of(frame, c->body[0], c->a, a);
    lever_of(frame, c->body[1], c->b, b);
    c->j[k] = 1;
    c->j[1 - k] = 0;
    c->j[2] = k ? a[0] : -a[1];
    c->j[3 + k] = -1;
    c->j[4 - k] = 0;
    c->j[5] = k ? -b[0] : b[1];
    c->g = (f->pose[5 * c->body[0] + k] + a[k]) - (f->pose[5 * c->body[1] + k] + b[k]);
    c->gamma = omega_a * omega_a * a[k] - omega_b * omega_b * b[k];
}

static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x, const double n[2])
{
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]);
    *x = (pm_line_of_action){.at = {a.p[0], a.p[1]}, .direction = {n[0], n[1]}};
}

static void evaluate_x(const pm_frame *frame, pm_constraint *c) { evaluate(frame, c, 0); }
static void evaluate_y(const pm_frame *frame, pm_constraint *c) { evaluate(frame, c, 1); }
static void act_x(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act(frame, c, x, axis_x);
}
static void act_y(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    act(frame, c, x, axis_y);
}

static void bend(const pm_frame *frame, const pm_constraint *c,
                 double out[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], int k)
{
    double a[2], b[2];
    lever_of(frame, c->body[0], c->a, a);
    lever_of(frame, c->body[1], c->b, b);
    out[2][2] = -a[k];
    out[5][5] = b[k];
}

static void bend_x(const pm_frame *frame, const pm_constraint *c,
                   double out[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    bend(frame, c, out, 0);
}
static void bend_y(const pm_frame *frame, const pm_constraint *c,
                   double out[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    bend(frame, c, out, 1);
}

/* The levers stay where neither mark goes round. */
const pm_constraint_ops pm_constraint_point_x = {
    .evaluate = evaluate_x, .act = act_x, .steady = pm_constant_motion_marks, .bend = bend_x};
const pm_constraint_ops pm_constraint_point_y = {
    .evaluate = evaluate_y, .act = act_y, .steady = pm_constant_motion_marks, .bend = bend_y};
