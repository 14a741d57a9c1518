/* switches.h - on which sides of their switches forces are.
 *
 * A force may switch by the motion (PM_EFFECT_SWITCH): at v = 0, where a place is passed.  Its side holds for a phase.  Where a
 * switch is on zero the motion that begins there tells the side: it must lead there by the force that this side gives. */
#ifndef PM_SWITCHES_H
#define PM_SWITCHES_H

#include "state/workspace.h"

/* The run begins at w->state; the frame looks at it. */
void pm_switches_begin(pm_workspace *w);
/* At an instant: sides by the triggers that have fired; by the motion that begins there, of switches on zero.  The frame looks
 * at w->state (DYNAMIC), also afterwards.  PM_ALTERNATES, where = event: the force switches to and fro while no time passes, or
 * pushes back to its switch from either side. */
int pm_switches_turn(pm_workspace *w);
int pm_switches_settle(pm_workspace *w);

#endif
