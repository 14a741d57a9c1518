/* contact_modes.h - after an event: which contacts stay closed, stick or slide. */
#ifndef PM_CONTACT_MODES_H
#define PM_CONTACT_MODES_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* A contact that was let go at this instant: it is closed again if its pair would approach; or not, for its edge has
 * ended. */
enum pm_released { PM_HELD = 0, PM_LET_GO = 1, PM_FOR_GOOD = 2 };

/* Opens an instant: remembers the modes, applies what the located events say (a normal force vanished: open; the friction
 * is exceeded: slide; the slip vanished: stick; an edge has ended: its corner, or another edge, or nothing). */
int pm_contact_modes_begin(pm_workspace *w);
/* Fixes the modes and the active constraints of the next phase; on return w->state is projected and the frame DYNAMIC. */
int pm_contact_modes_settle(pm_workspace *w);
/* The accelerations and loads of the present modes; the state is projected on what these hold. */
int pm_contact_modes_accelerate(pm_workspace *w);
/* The mode in which the slip accelerates that a constraint held before. */
int pm_contact_modes_way_of(const pm_frame *frame, pm_constraint *c);
/* A friction of a joint, held by the joints alone, slips as it accelerates: 1 if one does. */
int pm_contact_modes_reverse_joint(pm_workspace *w);
/* A friction of a joint that needs more than its limit, and slack, slips, or teeth meet with their other flanks: 1 if they do. */
int pm_contact_modes_joints_change(pm_workspace *w, double slack);
/* As pm_contact_modes_settle; where several motions are allowed, with what stands open by a hair if there is one motion with it. */
int pm_contact_modes_settle_beside(pm_workspace *w);
/* The modes that the accelerations at the frame ask for, of all closed contacts and those let go now, instead of the present
 * ones; *changed: whether any differs.  PM_NOT_UNIQUE, PM_PAINLEVE, PM_ROUGH_IMPOSSIBLE: where = contact; detail = its
 * coefficient of friction, contacts that take part; the modes are then as they were. */
int pm_contact_modes_solve(pm_workspace *w, int *changed);
/* Whether other modes than the present ones might obey the laws, too: where something rubs. */
int pm_contact_modes_are_open_by_theory(const pm_workspace *w);
/* PM_NOT_UNIQUE if more than one motion obeys them.  The modes are as they were; the active set and the frame are not. */
int pm_contact_modes_check_one(pm_workspace *w);
/* The contact of a slot has come to the end of its edge, or its curve: what it goes on to. */
int pm_contact_modes_pass_end(pm_workspace *w, int slot);
/* A contact that depends on another of the same pair of bodies for this instant alone, and goes over the end of its edge, passes
 * it now; *left: whether one did.  The frame and the active set are those of the modes. */
int pm_contact_modes_leave_end(pm_workspace *w, int *left);
/* Marks the triggers of contacts that opened, slipped or stuck during the instant. */
void pm_contact_modes_mark(pm_workspace *w);
/* Closes `contact` with `member` in a free slot, in the mode that its friction and slip ask for. */
int pm_contact_modes_close(pm_workspace *w, int contact, int member, int *slot);
/* 1 if `contact` let go of `member` at this instant. */
int pm_contact_modes_released(const pm_model *model, const pm_instant *instant, int contact, int member);
/* The mode of a closed contact with its present slip. */
int pm_contact_modes_of_slip(const pm_frame *frame, int contact, int member);
/* A mode that slides, either way. */
int pm_contact_modes_slides(int mode);

/* The constraints of a slot's contact along the normal and the tangent, active or not, evaluated at the frame. */
pm_constraint pm_contact_modes_normal(const pm_frame *frame, const pm_state *state, int slot);
pm_constraint pm_contact_modes_tangent(const pm_frame *frame, const pm_state *state, int slot);

/* For forces and for impulses: load[] of the active constraints, of that size; decisions are noted at `site` (enum
 * pm_evidence_site).  The slot whose normal load pulls most, or PM_NONE if none does by more than rounding. */
int pm_contact_modes_pulling(pm_workspace *w, const double *load, int site, double size);
/* The first slot that sticks and whose tangential load is more than its friction can be, or PM_NONE. */
int pm_contact_modes_overcome(pm_workspace *w, const double *load, int site, double size);

/* The modes of all slots [nslot] as they were. */
void pm_contact_modes_restore(pm_state *s, const pm_model *m, const int32_t *before);

#endif
