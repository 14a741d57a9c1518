/* teeth.h - which flanks of a pair of toothed wheels are loaded: those that push.  Without backlash one of both always does. */
#ifndef PM_TEETH_H
#define PM_TEETH_H

#include "elements/constraint.h"
#include "state/workspace.h"

/* The flank that is loaded.  1: the one that pushes a along the tangent; -1: the other one. */
static inline int pm_teeth_loaded(const pm_memory *memory) { return memory->direction < 0 ? -1 : 1; }

/* The same of a constraint: it may be of one flank alone. */
static inline double pm_teeth_flank(const pm_frame *frame, const pm_constraint *c)
{
    return c->flank != 0 ? c->flank : pm_teeth_loaded(&frame->memory[c->memory]);
}

/* Joint i is there, and has flanks. */
int pm_teeth_mesh(const pm_model *m, const pm_state *state, int joint);
/* Force of the loaded flank of a joint, N: negative where the other one should be. */
double pm_teeth_pressed(const pm_workspace *w, int joint);
/* The other flank is loaded from here on. */
void pm_teeth_turn(pm_workspace *w, int joint);
/* All that pull by more than `slack`; whether there were any. */
int pm_teeth_turn_pulling(pm_workspace *w, double slack);
/* The same by the impulses of the last blow; its flanks are noted. */
int pm_teeth_turn_struck(pm_workspace *w);

#endif
