/* switch_course.h - what the argument of a switch, or of a table, does at an instant: its value beside rounding, and its derivatives
 * by the time as the motion goes on from there. */
#ifndef PM_SWITCH_COURSE_H
#define PM_SWITCH_COURSE_H

#include "state/workspace.h"

typedef struct pm_switch_course {
    int program;
    double here;     /* its value */
    double scale;    /* what all of the places and velocities, and of what is natural, make of it */
    double rounding; /* what their rounding does */
} pm_switch_course;

/* The frame looks at w->state. */
pm_switch_course pm_switch_course_begin(pm_workspace *w, int program);
/* Which way it goes from there with the velocities and accelerations of the frame (DYNAMIC): 1, -1; 0: it stays.  Where it turns
 * back before it is beyond rounding that is the way back. */
int pm_switch_course_way(pm_workspace *w, const pm_switch_course *x);

#endif
