/* switches.h - on which sides of their switches forces are.
 *
 * A force may switch by the motion (PM_EFFECT_SWITCH): at v = 0, where a place is passed.  Its side holds for a phase.  Where a
 * switch is on zero the motion that begins there tells the side: it must lead there by the force that this side gives. */
#ifndef PM_SWITCHES_H
#define PM_SWITCHES_H

#include "state/workspace.h"

/* The run begins at w->state; the frame looks at it. */
void pm_switches_begin(pm_workspace *w);
/* All return PM_ALTERNATES, where = event.  At an instant: a force has switched to and fro again and again while no time
 * passed. */
int pm_switches_check(pm_workspace *w);
/* Sides of the switches that were found on zero in the last step, before anything jumps; as pm_switches_settle. */
int pm_switches_reach(pm_workspace *w);
/* Sides of the switches that are on zero, by the motion that begins there; the frame looks at w->state (DYNAMIC), also
 * afterwards.  A force pushes back to its switch from either side.  Pieces of tables likewise; the last
 * piece is left where the motion goes on from here. */
int pm_switches_settle(pm_workspace *w, int goes_on);

#endif
