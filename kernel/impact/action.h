/* action.h - what events do when they fire: elements come and go, impulses are applied. */
#ifndef PM_ACTION_H
#define PM_ACTION_H

#include "state/workspace.h"

/* Whether the event does something. */
int pm_action_of(const pm_model *m, int event);
/* A new instant: nothing is done yet. */
void pm_action_instant(const pm_model *model, struct pm_event_set *event);
/* Carries out the actions of the events that fire and have not yet acted at this instant; *acted = 1 if there were any.
 * Velocities are those after the impulses, active constraints and reactions are old. */
int pm_action_carry_out(pm_workspace *w, int *acted);

#endif
