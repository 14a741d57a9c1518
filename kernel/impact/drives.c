/* drives.c - an instant at which a prescribed place or rate has a corner or a jump.
 *
 * A prescribed place p(t) may have a corner there, and a prescribed rate w(t) a jump: the velocities before it meet the old
 * rate, those after it the new one. That is a blow with all joints held,
 *     M (v' - v) = H^T P,   G v' = w(t + 0)
 * in which contacts that rest take part as far as they push (impact.c). A place that jumps would need velocities without
 * bound: the run ends.
 *
 * The speed of a surface (a belt) may jump, too.  What is rough there is held, by a blow.  Friction mu has no impulse where no
 * blow presses, |T| <= mu N: the contact slips with the speed that the surface has gained on it, until it has caught up. */
#include "impact/drives.h"

#include <math.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/drive.h"
#include "elements/joint.h"
#include "impact/contact_modes.h"
#include "impact/impact.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

static double length_of(const pm_workspace *w, const pm_constraint *c)
{
    return pm_constraint_is_angle(c) ? w->numbers.size : 1;
}

/* *clashes: velocities do not meet a rate that is prescribed from here on. */
static int look_at(pm_workspace *w, int joint, int *clashes)
{
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    const int n = pm_joint_constraints(&w->frame, &w->state, joint, c);
    for (int k = 0; k < n; k++) {
        if (c[k].drive == PM_NONE) continue;
        const double length = length_of(w, &c[k]), jump = length * pm_drive_jump(&w->frame, &c[k]);
        pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
        if (fabs(jump) > PM_DRIVE_SAME * w->numbers.size)
            return pm_fail(&w->result, PM_DRIVE_JUMPS, PM_TABLE_JOINT, joint, jump / length, 0);
        const double off = pm_constraint_times(&w->frame, &c[k], w->state.v) - c[k].rate;
        *clashes |= fabs(off) * length > pm_contact_speed(&w->frame);
    }
    return PM_OK;
}

/* *clashes: it would have to be held. */
static void look_at_surface(const pm_workspace *w, int slot, int *clashes)
{
    pm_slot *s = &w->state.slot[slot];
    const int contact = pm_contact_of_slot(w->model, slot);
    if (s->mode == PM_OPEN || PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_SPEED] == PM_NONE) return;
    const double slip = pm_contact_member_slip(&w->frame, contact, s->member);
    if (fabs(slip) <= pm_contact_speed(&w->frame)) return;
    if (pm_contact_friction(w->model, contact) == PM_FRICTION_ROUGH)
        *clashes = 1;
    else
        s->mode = pm_contact_modes_of_slip(&w->frame, contact, s->member);
}

int pm_drives_strike(pm_workspace *w, int *jumped)
{
    int clashes = 0, status = PM_OK;
    *jumped = 0;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_JOINT]; i++)
        if (pm_joint_of(w->model, i)->programs > 0) status = look_at(w, i, &clashes);
    for (int i = 0; !status && i < w->model->nslot; i++) look_at_surface(w, i, &clashes);
    if (status || !clashes) return status;
    w->impulses.energy_lost = 0;
    *jumped = 1;
    return pm_impact_hold(w);
}
