/* left_out.h - what a closing blow has taken away, and how far answers are off by it while its series goes on. */
#ifndef PM_LEFT_OUT_H
#define PM_LEFT_OUT_H

#include "state/workspace.h"

int pm_left_out_create(pm_workspace *w);
/* A run begins: nothing is known. */
void pm_left_out_forget(const pm_workspace *w);
/* A blow has just closed a contact that would bounce on; velocities were `before`. */
void pm_left_out_hold(const pm_workspace *w, int contact, const double *before);
/* [nq] by which it changed the velocities; NULL: too many others have been closed since. */
const double *pm_left_out_change(const pm_workspace *w, int contact);
/* By how much a program at the frame is off within a flight: its contact stands closed until the series is over, and its flights
 * shrink by `ratio`. */
double pm_left_out_error(pm_workspace *w, int contact, double over, double ratio, int program);

#endif
