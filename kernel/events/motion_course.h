/* motion_course.h - what forces that read the motion do along a step.
 *
 * A force may change over a way that is short beside a step: exp(-((x - 1 m)/(1 mm))^2).  A step whose samples do not show the
 * force is taken once more, shortened to what they show, and the next ones are as short. */
#ifndef PM_MOTION_COURSE_H
#define PM_MOTION_COURSE_H

#include "state/workspace.h"

/* After the watched programs are known (waves.h). */
int pm_motion_course_create(pm_workspace *w);
/* A case begins. */
void pm_motion_course_begin(pm_workspace *w);
/* The greatest length of the next step, in the coordinate of the route. */
double pm_motion_course_limit(const pm_workspace *w);
/* Whether steps of the phase are to be looked at. */
int pm_motion_course_is_needed(const pm_workspace *w);
/* 1 if the samples of the step from `begin` to w->state show the forces; else it is to be taken anew, up to *end. */
int pm_motion_course_shown(pm_workspace *w, const pm_state *begin, double *end);

#endif
