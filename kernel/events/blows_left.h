/* blows_left.h - blows of a series that is no longer followed, as long as something waits for one of them. */
#ifndef PM_BLOWS_LEFT_H
#define PM_BLOWS_LEFT_H

#include "state/workspace.h"

int pm_blows_left_create(pm_workspace *w);
/* A run begins: none are left. */
void pm_blows_left_forget(const pm_workspace *w);
/* A blow has just closed a contact that would bounce on; velocities were `before`.  Its further blows are left. */
void pm_blows_left_hold(pm_workspace *w, int contact, const double *before);
/* The blows of this instant are done, and it is known how long the series goes on (pm_bounce_series_cut). */
void pm_blows_left_begin(pm_workspace *w);
/* The next time at which one that something waits for is due, s, or a firing in a flight; INFINITY: none is. */
double pm_blows_left_next(const pm_workspace *w);
/* 1 if some are due by now: their contacts are marked as struck, or are counted no more. */
int pm_blows_left_strike(pm_workspace *w);
/* Those that nothing waits for are counted up to this instant. */
void pm_blows_left_count(pm_workspace *w);
/* By how much a program at the frame, just before the blow or after it, is off because velocities and impulses of such a blow of this
 * instant are left out, or the flight that goes on at it. */
double pm_blows_left_error(pm_workspace *w, int program, int before);

#endif
