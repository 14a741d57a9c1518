/* trigger.h - firing of the scene's triggers, and the counts and times of its named events. */
#ifndef PM_TRIGGER_H
#define PM_TRIGGER_H

#include "state/workspace.h"

/* Counts of an event that has fired infinitely often, and of one that fires and is not seen to. */
#define PM_COUNTLESS (INT64_MAX / 2)
#define PM_UNCOUNTED (INT64_MIN / 2)

/* What stands in pm_firing.fired: a trigger fires at this instant, or has done so with an earlier blow of it; or it has come to its
 * zero and does not go beyond: it has not fired. */
enum pm_fired { PM_FIRED_NOT = 0, PM_FIRED_NOW = 1, PM_FIRED_EARLIER = 2, PM_FIRED_SHORT = 3 };

/* What stands in pm_firing.counted: an event's triggers have been counted at this instant, and it fired by that. */
enum pm_counted { PM_COUNTED_NOT = 0, PM_COUNTED_MARKED = 1, PM_COUNTED_FIRED = 2 };

/* A new case: counts and times are cleared. */
void pm_trigger_reset(const pm_model *model, pm_firing *x);
double pm_trigger_count(const pm_firing *firing, int event);
double pm_trigger_time(const pm_firing *firing, int event);
/* Value of the trigger's program at the frame. */
double pm_trigger_program(pm_workspace *w, int trigger);
/* The trigger's program depends on time alone, and linearly: it needs no watching. */
int pm_trigger_on_time(const pm_model *model, int trigger);
/* One of these has fired at this instant. */
int pm_trigger_time_is_due(const pm_workspace *w);
/* By s, of a program of the time alone, whose value is `here` where the frame looks: it is a straight line, of which values now and
 * one time unit later tell which way it goes. */
double pm_trigger_time_slope(pm_workspace *w, int program, double here);
/* Sides of the switches of forces (PM_EFFECT_SWITCH), and pieces of tables (PM_EFFECT_PIECE), by the frame: as the run begins;
 * after a jump, from the values in firing.before. */
void pm_trigger_take_sides(pm_workspace *w);
void pm_trigger_jump_sides(pm_workspace *w);
/* It tells where a force switches (PM_EFFECT_SWITCH). */
int pm_trigger_of_switch(const pm_model *model, int trigger);
/* It tells where the piece of a table ends (PM_EFFECT_PIECE). */
int pm_trigger_is_of_piece(const pm_model *model, int trigger);
/* At what a row of PM_TABLE_READING reads its table, by the frame. */
double pm_trigger_argument(pm_workspace *w, int reading);
/* When a trigger on time fires next after w->state.t, or INFINITY. */
double pm_trigger_due(pm_workspace *w, int trigger);

/* Instants: values of the triggers before the jump; then, after jump and modes, those fire that it made true: a comparison
 * that holds after it and did not before, zero being on neither side; an equality that holds after it and did not before, or
 * was passed.  What is rounding of the greatest value at an instant so far is zero. */
void pm_trigger_look_before(pm_workspace *w);
void pm_trigger_look_after(pm_workspace *w);
/* Marks the triggers of a contact's change: kind PM_TRIGGER_STRIKE, OPEN, SLIP or STICK. */
void pm_trigger_mark(const pm_model *model, pm_firing *firing, int kind, int contact);
/* Marks what fires at the start: triggers of it, and those on time that are due then. */
void pm_trigger_mark_start(pm_workspace *w);
/* What the event waits for has happened infinitely often until time t: so it has fired, or once if it fires at the nth time
 * alone; all events of a contact that is struck so (PM_COUNTLESS), or from now on with nobody to count it (PM_UNCOUNTED). */
void pm_trigger_countless(const pm_model *model, pm_firing *firing, int event, double t);
/* It has happened at t, before this instant, and nothing was asked of it there; or from now on nobody counts it. */
void pm_trigger_count_earlier(const pm_model *model, pm_firing *firing, int event, double t);
void pm_trigger_uncounted(const pm_model *model, pm_firing *firing, int event, double t);
void pm_trigger_lose_strikes(pm_workspace *w, int contact, int64_t count);
/* The next blow of the same instant: what has fired stays marked as such, and may fire again. */
void pm_trigger_next_blow(const pm_model *model, pm_firing *firing);
/* The event fires at this instant: one of its triggers is marked, for the time that counts. */
int pm_trigger_fires(const pm_model *model, const pm_firing *firing, int event);
/* Counts the events whose triggers are marked, each once at an instant, and stamps their times; 1 if there was any.  Which
 * of them fired stands in pm_firing.counted until the instant is over. */
int pm_trigger_count_marked(pm_workspace *w);
void pm_trigger_end_instant(const pm_model *model, pm_firing *firing);
/* 1 if the end of the run is reached. */
int pm_trigger_until(const pm_model *m, const pm_firing *firing);

#endif
