/* contact_modes_joints.c - frictions of joints beside the modes of contacts: which give way, and in which way they slip.
 *
 * At a dead centre, and next to it, the joints give a slip that their friction cannot hold: it is zero because the mechanism
 * reverses.  What would hold it is rounding, however great, and so is its sign. */
#include "elements/joint_friction.h"
#include "elements/teeth.h"
#include "impact/contact_modes.h"

int pm_contact_modes_way_of(const pm_frame *frame, pm_constraint *c)
{
    pm_constraint_kind(c->kind)->evaluate(frame, c);
    return pm_constraint_times(frame, c, frame->a) - c->gamma > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
}

static int32_t way_of_joint(const pm_frame *frame, int k)
{
    pm_constraint slip;
    pm_joint_friction_constraint(frame, k, &slip);
    return pm_contact_modes_way_of(frame, &slip);
}

/* Friction k slips the way `mode`: in which way it accelerates then; PM_NONE where nothing tells the accelerations. */
static int32_t way_of_slip(pm_workspace *w, int k, int32_t mode)
{
    w->state.friction[k] = mode;
    return pm_contact_modes_accelerate(w) ? PM_NONE : way_of_joint(&w->frame, k);
}

/* Lets friction k slip, where that makes the accelerations known; 1 if it does. */
static int reverse(pm_workspace *w, int k)
{
    if (w->state.friction[k] != PM_STICK) return 0;
    const int32_t way = way_of_slip(w, k, PM_SLIDE_FORWARD);
    w->state.friction[k] = way == PM_NONE ? PM_STICK : way;
    return way != PM_NONE;
}

int pm_contact_modes_reverse_joint(pm_workspace *w)
{
    for (int k = 0; k < w->model->nfriction; k++)
        if (reverse(w, k)) return 1;
    return 0;
}

/* The way that is told, unless its slip accelerates in the other one alone. */
static void choose_way(pm_workspace *w, int k)
{
    const int32_t told = w->state.friction[k];
    const int32_t other = told == PM_SLIDE_FORWARD ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD;
    if (way_of_slip(w, k, told) != told && way_of_slip(w, k, other) != other) w->state.friction[k] = told;
}

int pm_contact_modes_joints_change(pm_workspace *w, double slack)
{
    const int k = pm_joint_friction_overcome(w, slack);
    if (k == PM_NONE) return pm_teeth_turn_pulling(w, slack);
    choose_way(w, k);
    return 1;
}
