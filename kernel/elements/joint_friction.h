/* joint_friction.h - friction of joints: bearings, sliders, slots and belts that have it. */
#ifndef PM_JOINT_FRICTION_H
#define PM_JOINT_FRICTION_H

#include "elements/constraint.h"
#include "elements/force.h"
#include "state/workspace.h"

/* How many frictions of joints the case has, and whether one that slides depends on the load of its joint. */
int pm_joint_friction_any(const pm_model *m);
int pm_joint_friction_by_load(const pm_frame *frame, const pm_state *state);

/* The joint of friction k. */
int pm_joint_friction_joint(const pm_model *m, int k);
/* The constraint of the slip of friction k, whether it holds or not. */
void pm_joint_friction_constraint(const pm_frame *frame, int k, pm_constraint *c);
/* The friction of a joint and its constraint; PM_NONE where it has none. */
int pm_joint_friction_find(const pm_frame *frame, int joint, pm_constraint *c);
/* Slip at the frame, m/s or rad/s; below this it is none. */
double pm_joint_friction_slip(const pm_frame *frame, int k);
double pm_joint_friction_no_slip(const pm_frame *frame, int k);
/* Greatest friction, N or N m, with the reactions of the frame. */
double pm_joint_friction_limit(const pm_workspace *w, int k);
/* What the friction of a joint does to its first partner, along its constraint; the frame is DYNAMIC.  0 where there is
 * none. */
double pm_joint_friction_of_joint(const pm_workspace *w, int joint, pm_constraint *c);
/* The same of the impulse of its friction in the last blow. */
double pm_joint_friction_impulse(const pm_workspace *w, int joint, pm_constraint *c);
/* Size of friction k along its constraint while it slides, with the load that it has taken up; 0: it does not slide. */
double pm_joint_friction_sliding(const pm_workspace *w, int k);
/* The force of sliding; nothing where it holds. */
void pm_joint_friction_action(const pm_workspace *w, int force, pm_action *x);
/* It stays the same along a motion with constant accelerations. */
int pm_joint_friction_steady(const pm_frame *frame, int force, const pm_constant_motion *x);

/* Sliding friction that goes with the load takes up the reactions just found; how much the loads have changed, of the greatest
 * reaction. */
double pm_joint_friction_update(pm_workspace *w);

/* No friction holds or slides (before a start, and in a blow). */
void pm_joint_friction_release(pm_workspace *w);
/* Frictions by their slip at the frame: what does not slip holds. */
void pm_joint_friction_close(const pm_frame *frame, pm_state *state);
/* What the phase found: friction k has begun to slide, or has stopped. */
void pm_joint_friction_slides(pm_workspace *w, int k);
void pm_joint_friction_stops(const pm_frame *frame, pm_state *state, int k);
/* The first friction that holds and that needs more than its limit begins to slide: its number, or PM_NONE. */
int pm_joint_friction_overcome(pm_workspace *w, double slack);
/* What the friction of a joint is of its load: a number, or m; 0: it does not go with it. */
double pm_joint_friction_coefficient(const pm_frame *frame, int k);
/* The components of the reaction by which it goes, of reactions x[active constraint]: 1, and load[1] = 0, or 2; their places. */
int pm_joint_friction_loads(const pm_workspace *w, int k, const double *x, double load[2]);
int pm_joint_friction_places(const pm_workspace *w, int k, int place[2]);
/* PM_UNSUPPORTED if a blow of active impulses w->rhs loads a joint whose friction goes with its load. */
int pm_joint_friction_check_blow(pm_workspace *w);

#endif
