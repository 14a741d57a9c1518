/* time_course.h - what forces and drives do in time: when they switch, and how far ahead samples show them.
 *
 * Programs of forces, drives and the turning plane may switch at some instants (t > 3 s): there a phase ends and another
 * begins.  Between them they are smooth, and a step goes no farther than its stages can tell what they do. */
#ifndef PM_TIME_COURSE_H
#define PM_TIME_COURSE_H

#include "state/workspace.h"

int pm_time_course_create(pm_workspace *w);
/* Whether anything follows the time otherwise than at a constant rate. */
int pm_time_course_is_any(const pm_workspace *w);
/* A case begins, at w->state.t: its numbers are known. */
void pm_time_course_begin(pm_workspace *w);
/* The time to which a step from w->state may go that was as long as `length` the last time (0: not known). */
double pm_time_course_limit(pm_workspace *w, double length);
/* 1 if some program switches at w->state.t: from here on it is as after that. */
int pm_time_course_switch(pm_workspace *w);
/* How much of a pulse, at the most, rounding its times has made in the last coarse run: that does not go with the tolerance. */
double pm_time_course_rounded(const pm_workspace *w);

#endif
