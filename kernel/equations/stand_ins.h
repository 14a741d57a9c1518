/* stand_ins.h - bodies without mass, whose stand-ins are taken off round by round. */
#ifndef PM_STAND_INS_H
#define PM_STAND_INS_H

#include "equations/saddle.h"

/* How far the response x [nq] is from that of the round before (saddle->previous), relative to the greatest terms it is the sum of;
 * *worst: where most.  force [nq]: what acts, or NULL. */
double pm_stand_ins_change(const pm_saddle *saddle, const double *force, const double *x, int *worst);

#endif
