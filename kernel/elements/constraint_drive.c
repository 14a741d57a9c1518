/* constraint_drive.c - prescribed motion: the velocity of a point, along an axis e of the scene (row.axis), or the spin of a body, relative to
 * another body, is a given w(t).
 *
 *   point   C = e.(p_a - p_b) - anchor - W(t)     Cdot = e.(v_a - v_b) - w       gamma = -e.quad + dw/dt
 *   spin    C = angle_a - r angle_b - anchor - W  Cdot = omega_a - r omega_b - w gamma = dw/dt
 * W is the integral of w (drive.c), nothing where nothing is prescribed.  The couples on the bodies are as 1 to -r: what is
 * left over is held by the ground. */
#include "elements/constant_motion.h"
#include "elements/constraint.h"
#include "elements/drive.h"
#include "state/workspace.h"

/* What all driven rows share: the residual is `place` less what is prescribed. */
static void prescribe(const pm_frame *frame, pm_constraint *row, double place)
{
    const pm_memory *memory = &frame->memory[row->memory];
    row->g = place - memory->anchor - pm_drive_way(frame, row->drive, memory);
    row->gamma += pm_drive_change(frame, row->drive);
    row->rate = pm_drive_rate(frame, row->drive);
}

static void keep(const pm_frame *frame, const pm_constraint *row, double place, pm_memory *memory,
                 int anchor_too)
{
    if (anchor_too) {
        memory->anchor = place;
        memory->time = frame->t;
    } else {
        pm_drive_follow(frame, row->drive, memory);
    }
}

static void evaluate_point(const pm_frame *frame, pm_constraint *row)
{
    const pm_marks x = pm_constraint_marks(frame, row);
    pm_constraint_along(row, &x, row->axis, 1);
    row->gamma = -pm_dot(x.quad, row->axis);
    prescribe(frame, row, pm_dot(x.d, row->axis));
}

static void act_point(const pm_frame *frame, const pm_constraint *row, pm_line_of_action *x)
{
    const pm_point a = pm_frame_point(frame, row->body[0], row->a[0], row->a[1]);
    *x = (pm_line_of_action){.at = {a.p[0], a.p[1]}, .direction = {row->axis[0], row->axis[1]}};
}

static void remember_point(const pm_frame *frame, const pm_constraint *row, pm_memory *memory, int anchor_too)
{
    const pm_marks x = pm_constraint_marks(frame, row);
    keep(frame, row, pm_dot(x.d, row->axis), memory, anchor_too);
}

static int steady_point(const pm_frame *frame, const pm_constraint *row, const pm_constant_motion *x)
{
    return pm_constant_motion_drive(frame, row, x) && pm_constant_motion_marks(frame, row, x);
}

static double turned(const pm_frame *frame, const pm_constraint *row)
{
    return frame->pose[5 * row->body[0] + 2] - row->ratio * frame->pose[5 * row->body[1] + 2];
}

static void evaluate_turn(const pm_frame *frame, pm_constraint *row)
{
    for (int k = 0; k < 6; k++) row->j[k] = 0;
    row->j[2] = 1;
    row->j[5] = -row->ratio;
    row->gamma = 0;
    prescribe(frame, row, turned(frame, row));
}

static void act_turn(const pm_frame *frame, const pm_constraint *row, pm_line_of_action *x)
{
    (void)frame;
    *x = (pm_line_of_action){.couple = {1, -row->ratio}};
}

static void remember_turn(const pm_frame *frame, const pm_constraint *row, pm_memory *memory, int anchor_too)
{
    keep(frame, row, turned(frame, row), memory, anchor_too);
}

const pm_constraint_ops pm_constraint_drive = {
    .evaluate = evaluate_point, .act = act_point, .remember = remember_point, .steady = steady_point};
const pm_constraint_ops pm_constraint_ratio = {.evaluate = evaluate_turn,
                                               .act = act_turn,
                                               .remember = remember_turn,
                                               .steady = pm_constant_motion_drive};
