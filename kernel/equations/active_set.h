/* active_set.h - which constraints hold now: independent constraints of joints and captured pairs, normals of closed
 * contacts, tangents of sticking ones. */
#ifndef PM_ACTIVE_SET_H
#define PM_ACTIVE_SET_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* Fills w->active.constraint from the joints and the modes of the slots in w->state; the frame must look at w->state. */
int pm_active_set_build(pm_workspace *w);
/* Which constraints of joints are left out is chosen at one place.  Where bodies have turned so far since that those kept nearly
 * depend on each other the set is built anew, at w->state, where the frame looks; *renewed: it was. */
int pm_active_set_renew(pm_workspace *w, int *renewed);
/* The normal of a sliding slot carries its tangent with this ratio of impulses, whatever its law says. */
void pm_active_set_carry(pm_workspace *w, int slot, double ratio);
/* Makes redundant what depends on other constraints at this place alone.  The constraints are evaluated before; joints stay, and
 * of those of contacts the ones that add most to the rest are kept first.  Returns how many became redundant: if any did, the
 * saddle is to be evaluated again. */
int pm_active_set_let_loose(pm_workspace *w);
/* Anchors the no-slip constraints of slot (just closed, stuck or captured) at the frame. */
void pm_active_set_anchor(const pm_frame *frame, pm_state *s, int slot);
/* Anchors the constraints with memory of a joint at the frame. */
void pm_active_set_anchor_joint(const pm_frame *frame, const pm_state *state, pm_state *s, int joint);
/* Anchors all joints with memory at the frame and measures the cords (once, after the assembly). */
/* Of joints on curves: their feet in s, wherever the points are at the frame. */
void pm_active_set_find_feet(const pm_frame *frame, pm_state *s);
void pm_active_set_anchor_start(const pm_frame *frame, const pm_state *state, pm_state *s);
/* After an accepted step: unwrapped directions follow. */
void pm_active_set_follow(const pm_frame *frame, const pm_active_set *active, pm_state *s);
/* Nothing is active: another set from now on. */
void pm_active_set_clear(pm_active_set *active, const pm_model *model);
/* Whether all partners of a constraint are fixed for good (fixed_bodies.h): it holds nothing that moves. */
static inline int pm_active_set_is_idle(const pm_numbers *numbers, const pm_constraint *c)
{
    return numbers->fixed[c->body[0]] && numbers->fixed[c->body[1]] &&
           (!c->over || numbers->fixed[c->body[2]]);
}
/* Whether a drive prescribes the rate of some constraint. */
static inline int pm_active_set_is_driven(const pm_active_set *active)
{
    for (int i = 0; i < active->n; i++)
        if (active->constraint[i].drive != PM_NONE) return 1;
    return 0;
}

#endif
