/* constraint_drive.c - prescribed motion: where a point is, along an axis e of the scene (constraint.axis), or the angle of a
 * body, relative to another body, is a given P(t).
 *
 *   point   C = e.(p_a - p_b) - P      Cdot = e.(v_a - v_b) - w       gamma = -e.quad + dw/dt       w = dP/dt
 *   spin    C = angle_a - r angle_b - P  Cdot = omega_a - r omega_b - w gamma = dw/dt
 * Where w is given, P is the anchor and the integral of w (drive.c); the anchor alone where nothing is prescribed.  The couples
 * on the bodies are as 1 to -r; the ground takes the rest. */
#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "elements/drive.h"
#include "state/workspace.h"

/* What all driven constraints share: the residual is `place` less what is prescribed. */
static void prescribe(const pm_frame *frame, pm_constraint *c, double place)
{
    const pm_drive_motion drive = pm_drive_of(frame, c);
    c->g = place - drive.place;
    c->gamma += drive.change;
    c->rate = drive.rate;
}

static void keep(const pm_frame *frame, const pm_constraint *c, double place, pm_memory *memory,
                 int anchor_too)
{
    if (anchor_too) {
        memory->anchor = place;
        memory->time = frame->t;
    } else {
        pm_drive_follow(frame, c->drive, memory);
    }
}

static void evaluate_point(const pm_frame *frame, pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    pm_constraint_along(c->j, &x, c->axis, 1);
    c->gamma = -pm_dot(x.quad, c->axis);
    prescribe(frame, c, pm_dot(x.d, c->axis));
}

static void act_point(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    const pm_point a = pm_frame_point(frame, c->body[0], c->a[0], c->a[1]);
    *x = (pm_line_of_action){.at = {a.p[0], a.p[1]}, .direction = {c->axis[0], c->axis[1]}};
}

static void remember_point(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    keep(frame, c, pm_dot(x.d, c->axis), memory, anchor_too);
}

static int steady_point(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    return pm_constant_motion_drive(frame, c, x) && pm_constant_motion_marks(frame, c, x);
}

static double relative_angle(const pm_frame *frame, const pm_constraint *c)
{
    return frame->pose[5 * c->body[0] + 2] - c->ratio * frame->pose[5 * c->body[1] + 2];
}

static void evaluate_ratio(const pm_frame *frame, pm_constraint *c)
{
    for (int k = 0; k < 6; k++) c->j[k] = 0;
    c->j[2] = 1;
    c->j[5] = -c->ratio;
    c->gamma = 0;
    prescribe(frame, c, relative_angle(frame, c));
}

static void act_ratio(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    (void)frame;
    *x = (pm_line_of_action){.couple = {1, -c->ratio}};
}

static void remember_ratio(const pm_frame *frame, const pm_constraint *c, pm_memory *memory, int anchor_too)
{
    keep(frame, c, relative_angle(frame, c), memory, anchor_too);
}

const pm_constraint_ops pm_constraint_drive = {
    .evaluate = evaluate_point, .act = act_point, .remember = remember_point, .steady = steady_point};
const pm_constraint_ops pm_constraint_ratio = {.evaluate = evaluate_ratio,
                                               .act = act_ratio,
                                               .remember = remember_ratio,
                                               .steady = pm_constant_motion_drive,
                                               .bend = pm_constraint_straight};
