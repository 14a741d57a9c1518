/* trigger.h - firing of the scene's triggers, and the counts and times of its named events. */
#ifndef PM_TRIGGER_H
#define PM_TRIGGER_H

#include "state/workspace.h"

#define PM_COUNTLESS (INT64_MAX / 2) /* count of an event that has fired infinitely often */

/* What stands in pm_firing.fired: a trigger fires at this instant, or has done so with an earlier blow of it. */
enum pm_fired { PM_FIRED_NOT = 0, PM_FIRED_NOW = 1, PM_FIRED_EARLIER = 2 };

/* A new case: counts and times are cleared. */
void pm_trigger_reset(const pm_model *model, pm_firing *x);
double pm_trigger_count(const pm_firing *firing, int event);
double pm_trigger_time(const pm_firing *firing, int event);
/* Value of the trigger's program at the frame. */
double pm_trigger_program(pm_workspace *w, int trigger);
/* The trigger's program depends on time alone, and linearly: it needs no watching. */
int pm_trigger_on_time(const pm_model *model, int trigger);
/* When a trigger on time fires next after w->state.t, or INFINITY. */
double pm_trigger_due(pm_workspace *w, int trigger);

/* Instants: values of the triggers before the jump; then, after jump and modes, those that a jump carried through
 * zero fire. */
void pm_trigger_look_before(pm_workspace *w);
void pm_trigger_look_after(pm_workspace *w);
/* Marks the triggers of a contact's change: kind PM_TRIGGER_STRIKE, OPEN, SLIP or STICK. */
void pm_trigger_mark(const pm_model *model, pm_firing *firing, int kind, int contact);
/* Marks what fires at the start: triggers of it, and those on time that are due then. */
void pm_trigger_mark_start(pm_workspace *w);
/* A contact has been struck infinitely often until now. */
void pm_trigger_countless(pm_workspace *w, int contact);
/* The next blow of the same instant: what has fired stays marked as such, and may fire again. */
void pm_trigger_next_blow(const pm_model *model, pm_firing *firing);
/* The event fires at this instant: one of its triggers is marked, for the time that counts. */
int pm_trigger_fires(const pm_model *model, const pm_firing *firing, int event);
/* Counts the event if its triggers are marked (once), stamps its time; 1 if it fires: then asks of it are answered. */
int pm_trigger_commit(pm_workspace *w, int event);
/* 1 if the end of the run is reached. */
int pm_trigger_until(const pm_model *m, const pm_firing *firing);

#endif
