/* ida_system.h - the differential-algebraic system of a phase. */
#ifndef PM_IDA_SYSTEM_H
#define PM_IDA_SYSTEM_H

#include "routes/ida/ida.h"

#define PM_IDA_TIGHTER 1e-2   /* of the tolerance: IDA's errors are far above what it is asked for */
#define PM_IDA_TIGHTEST 1e-12 /* below it steps follow rounding */

/* The length of the phase's unknowns, from the active rows. */
void pm_ida_system_layout(pm_workspace *w);
/* Consistent y, y' at w->state; the frame becomes DYNAMIC there. */
int pm_ida_system_start(pm_workspace *w, double *y, double *yp);
/* Looks at (t, y) with accelerations and reactions from y': a DYNAMIC frame, and no linear system solved. */
void pm_ida_system_look(pm_workspace *w, double t, const double *y, const double *yp);
/* r = F(t, y, y'). */
void pm_ida_system_residual(pm_workspace *w, double t, const double *y, const double *yp, double *r);
/* Tolerance and the reciprocal of what each unknown may err by, from the scales of the case; the rows must
 * be evaluated. */
void pm_ida_system_scale(pm_workspace *w);
/* Error weights at y. */
void pm_ida_system_weights(const pm_workspace *w, const double *y, double *weight);

#endif
