/* drive.h - what acts on the motion in time: programs of forces; prescribed rates and places, programs of the time alone
 * (belts, hooks, carts, motors).  Where they switch, they are as the side of the frame says (state/frame.h). */
#ifndef PM_DRIVE_H
#define PM_DRIVE_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* Value of the program of a force at the frame. */
double pm_drive_program(pm_workspace *w, int program);
/* What a driven constraint prescribes at the frame of that which it drives, a length or an angle; of one that nothing drives
 * its anchor, if it has one, and no rates. */
typedef struct pm_drive_motion {
    double place, rate, change; /* m or rad, by s, by s^2 */
} pm_drive_motion;
pm_drive_motion pm_drive_of(const pm_frame *frame, const pm_constraint *c);
/* The rate alone. */
double pm_drive_rate(const pm_frame *frame, const pm_constraint *c);
/* By how much a prescribed place jumps at the frame, whose side begins there: from what it was up to then. */
double pm_drive_jump(const pm_frame *frame, const pm_constraint *c);
/* Integral of a prescribed rate from the memory's time to that of the frame. */
double pm_drive_way(const pm_frame *frame, int program, const pm_memory *memory);
/* Takes the way up to the frame into the anchor. */
void pm_drive_follow(const pm_frame *frame, int program, pm_memory *memory);

#endif
