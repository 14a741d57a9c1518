/* grip.h - friction of joints: bearings, sliders and slots that rub. */
#ifndef PM_GRIP_H
#define PM_GRIP_H

#include "force.h"
#include "model.h"
#include "row.h"

/* How many frictions of joints the case has, and whether one that slides depends on the load of its joint. */
int pm_grip_any(const pm_model *m);
int pm_grip_by_load(const pm_workspace *w);
/* Whether one would, if it did slide. */
int pm_grip_any_by_load(const pm_workspace *w);

/* The joint whose friction grip k is. */
int pm_grip_joint(const pm_model *m, int k);
/* The row of the slip of grip k, whether it holds or not. */
void pm_grip_row(const pm_workspace *w, int k, pm_row *row);
/* Slip at the frame, m/s or rad/s; below this it is none. */
double pm_grip_slip(const pm_workspace *w, int k);
double pm_grip_still(const pm_workspace *w, int k);
/* Greatest friction, N or N m, with the reactions of the frame. */
double pm_grip_limit(const pm_workspace *w, int k);
/* What the friction of a joint does to its first partner, along its row; the frame is DYNAMIC.  0 where there is none. */
double pm_grip_of_joint(const pm_workspace *w, int joint, pm_row *row);
/* The force of sliding; nothing where the grip holds. */
void pm_grip_action(const pm_workspace *w, int force, pm_action *x);
/* It stays the same along a motion with constant accelerations. */
int pm_grip_steady(const pm_workspace *w, int force, const pm_steady *x);

/* Sliding friction that goes with the load takes up the reactions just found; 1 if it has changed. */
int pm_grip_update(pm_workspace *w);

/* No grip holds or slides (before a start, and in a blow). */
void pm_grip_release(pm_workspace *w);
/* Grips by their slip at the frame: what does not slip holds. */
void pm_grip_close(pm_workspace *w);
/* What the phase found: grip k of the function has begun to slide, or has stopped. */
void pm_grip_slides(pm_workspace *w, int k);
void pm_grip_stops(pm_workspace *w, int k);
/* The first holding grip that needs more than its limit begins to slide; 1 if there was one. */
int pm_grip_overcome(pm_workspace *w, double slack);
/* PM_UNSUPPORTED if a blow of active impulses w->rhs loads a joint whose friction goes with its load. */
int pm_grip_check_blow(pm_workspace *w);

#endif
