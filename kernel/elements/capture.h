/* capture.h - contacts that capture: when a pair is caught, where it is held, and by which constraints. */
#ifndef PM_CAPTURE_H
#define PM_CAPTURE_H

#include "elements/constraint.h"

/* enum pm_capture of a contact. */
int pm_capture_kind(const pm_model *m, int contact);
/* The open contact may catch a pair of points: they meet, and no gap changes its sign there. */
int pm_capture_is_meeting(const pm_model *m, int contact);

/* Of two points that may meet, at the frame: how far they are apart; half the rate of its square, which goes through
 * zero, rising, where they are nearest. */
double pm_capture_distance(const pm_frame *frame, int contact);
double pm_capture_approach(const pm_frame *frame, int contact);
/* s that they need at their relative speed to come together, at the least; INFINITY: they have met. */
double pm_capture_soonest(const pm_frame *frame, const pm_state *state, int contact);
/* Points that are so far apart (INFINITY: they do not meet any more) are at one place. */
int pm_capture_meets(const pm_numbers *numbers, pm_evidence *evidence, int contact, double distance);

/* Keeps in the state where, and at which angle, the pair of a slot is caught at the frame. */
void pm_capture_keep(const pm_frame *frame, pm_state *s, int slot);
/* The constraints that hold the captured pair of a slot; returns how many. */
int pm_capture_constraints(const pm_frame *frame, const pm_state *state, int slot,
                           pm_constraint c[PM_JOINT_CONSTRAINTS]);
/* Greatest speed at the frame against which these constraints would hold, m/s. */
double pm_capture_speed(const pm_frame *frame, const pm_state *state, int slot);

/* Some slot holds a captured pair; some contact may yet catch a pair of points. */
int pm_capture_holds(const pm_model *model, const pm_state *state);
int pm_capture_awaits(const pm_frame *frame, const pm_state *state);

#endif
