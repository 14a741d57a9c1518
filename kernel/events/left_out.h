/* left_out.h - what a closing blow has taken away, and how far answers are off by it while its series goes on. */
#ifndef PM_LEFT_OUT_H
#define PM_LEFT_OUT_H

#include "state/workspace.h"

/* What the last closing blows have taken away. */
typedef struct pm_left_out pm_left_out;

int pm_left_out_create(pm_workspace *w, pm_left_out **x);
/* A run begins: nothing is known. */
void pm_left_out_forget(pm_left_out *x);
/* A blow has just closed a contact that would bounce on; velocities were `before`. */
void pm_left_out_hold(pm_left_out *x, const pm_state *after, int contact, const double *before);
/* [nq] by which it changed the velocities; NULL: too many others have been closed since. */
const double *pm_left_out_change(const pm_left_out *x, int contact);
/* By how much a program at the frame is off within a flight: its contact stands closed until the series is over, and its flights
 * shrink by `ratio`. */
double pm_left_out_error(pm_workspace *w, const pm_left_out *x, int contact, double over, double ratio,
                         int program);

#endif
