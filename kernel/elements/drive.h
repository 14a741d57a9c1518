/* drive.h - what acts on the motion in time: programs of forces; prescribed rates, programs of the time alone (belts, hooks,
 * carts, motors).  Where they switch, they are as the side of the frame says (state/frame.h). */
#ifndef PM_DRIVE_H
#define PM_DRIVE_H

#include "state/workspace.h"

/* Value of the program of a force at the frame. */
double pm_drive_program(pm_workspace *w, int program);
/* Rate that `program` prescribes at the frame, and how fast it changes; 0 where program is PM_NONE. */
double pm_drive_rate(const pm_frame *frame, int program);
double pm_drive_change(const pm_frame *frame, int program);
/* Its integral from the memory's time to that of the frame. */
double pm_drive_way(const pm_frame *frame, int program, const pm_memory *memory);
/* Takes the way up to the frame into the anchor. */
void pm_drive_follow(const pm_frame *frame, int program, pm_memory *memory);

#endif
