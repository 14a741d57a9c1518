/* constraint_angle.c - the relative angle of two bodies is held: C = angle_a - angle_b - value, gamma = 0. */
#include "elements/constraint.h"
#include "state/workspace.h"

static void evaluate(const pm_frame *frame, pm_constraint *row)
{
    for (int k = 0; k < 6; k++) row->j[k] = 0;
    row->j[2] = 1;
    row->j[5] = -1;
    row->g = frame->pose[5 * row->body[0] + 2] - frame->pose[5 * row->body[1] + 2] - row->value;
    row->gamma = 0;
}

static void act(const pm_frame *frame, const pm_constraint *row, pm_line_of_action *x)
{
    (void)frame;
    (void)row;
    *x = (pm_line_of_action){.couple = {1, -1}};
}

static int steady(const pm_frame *frame, const pm_constraint *row, const pm_constant_motion *x)
{
    (void)frame;
    (void)row;
    (void)x;
    return 1;
}

const pm_constraint_ops pm_constraint_angle = {.evaluate = evaluate, .act = act, .steady = steady};
