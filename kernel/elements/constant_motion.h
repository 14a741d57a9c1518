/* constant_motion.h - what stays the same along a motion with constant accelerations.
 *
 * Suppose that from now on q = q0 + v t + a t^2/2 with a constant a.  If along that curve every active constraint keeps
 * its Jacobian, every applied force its generalised forces, and M its value, then the accelerations stay a, and the curve
 * *is* the motion: a solution of the equations of motion is unique.  Whether a constraint or force stays the same is a
 * rule of its kind (pm_constraint_ops.steady, pm_force_ops.steady), judged by what moves along the curve: a body rotates
 * or not, two marks keep their distance vector or not.
 *
 * A body whose angle is held by angle constraints alone (a slider or weld that does not rotate, up to the ground) cannot
 * rotate whatever moments act on it: levers on it may change.  Its angle drops out of the equations, and with it the
 * couples that hold it: they alone are then not constant. */
#ifndef PM_CONSTANT_MOTION_H
#define PM_CONSTANT_MOTION_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* The curve; v and a have exact zeros where only rounding was. */
struct pm_constant_motion {
    const double *v, *a;          /* [nq + 3]: the ground's follow, 0 */
    const unsigned char *rotates; /* [nbody + 1] the angle changes */
    unsigned char *locked; /* [nbody + 1] the angle is held by angle constraints alone, from the ground on */
    int levers;            /* some body but the ground is locked: the couples that hold it may change */
    double speed, acceleration; /* below these there is none */
};

/* Copies v and a with rounding set to zero and fills x->rotates (also `rotates`) and x->locked; v, a: [nq + 3]. */
void pm_constant_motion_curve(const pm_workspace *w, double *v, double *a, unsigned char *rotates,
                              unsigned char *locked, pm_constant_motion *x);

/* The mark keeps its place relative to its body's mass centre as seen in the scene: the body does not rotate, or the mark
 * is the mass centre. */
int pm_constant_motion_mark(const pm_frame *frame, const pm_constant_motion *x, int body, const double at[2]);
/* The same of point `index` of the point table. */
int pm_constant_motion_point(const pm_frame *frame, const pm_constant_motion *x, int index);
/* Rules of constraints: both marks are steady; */
int pm_constant_motion_marks(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x);
/* they keep their distance vector, too; */
int pm_constant_motion_together(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x);
/* what drives the constraint, if anything, prescribes a constant rate. */
int pm_constant_motion_drive(const pm_frame *frame, const pm_constraint *c, const pm_constant_motion *x);

#endif
