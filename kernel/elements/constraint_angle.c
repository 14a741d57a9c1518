/* constraint_angle.c - the relative angle of two bodies is held: C = angle_a - angle_b - value, gamma = 0. */
#include "elements/constraint.h"
#include "state/workspace.h"

static void evaluate(const pm_frame *frame, pm_constraint *c)
{
    for (int k = 0; k < 6; k++) c->j[k] = 0;
    c->j[2] = 1;
    c->j[5] = -1;
    c->g = frame->pose[5 * c->body[0] + 2] - frame->pose[5 * c->body[1] + 2] - c->value;
    c->gamma = 0;
}

static void act(const pm_frame *frame, const pm_constraint *c, pm_line_of_action *x)
{
    (void)frame;
    (void)c;
    *x = (pm_line_of_action){.couple = {1, -1}};
}

static int steady(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x)
{
    (void)frame;
    (void)c;
    (void)x;
    return 1;
}

const pm_constraint_ops pm_constraint_angle = {
    .evaluate = evaluate, .act = act, .steady = steady, .bend = pm_constraint_straight};
