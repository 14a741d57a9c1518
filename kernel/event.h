/* event.h - what ends a phase: triggers of the scene, gaps that close, contact forces that vanish, slip that starts or
 * stops; found in each step and located to the accuracy of the trajectory. */
#ifndef PM_EVENT_H
#define PM_EVENT_H

#include "model.h"

#define PM_NODES 5 /* places in a step where functions are sampled, its ends included */

typedef struct pm_event_function {
    int kind;         /* enum in event.c */
    int index;        /* trigger, contact or slot */
    int direction;    /* 0: either way, 1: rising, -1: falling */
    int level;        /* enum pm_level it needs */
    int held;         /* zero when the phase began: must first be left */
    double slack;     /* a held function counts as crossed only below -slack */
    double low, high; /* `every`: the multiples below and above */
} pm_event_function;

typedef struct pm_event_set {
    pm_event_function *function;
    int nfunction;
    int level;            /* highest level of all */
    double *value;        /* [PM_NODES][most functions] */
    int *hit;             /* [most functions] fired at this instant */
    int *root;            /* [most functions] roots that the route itself found, or 0 */
    unsigned char *fired; /* [ntrigger] at this instant */
    unsigned char *spent; /* [ncontact] left its zero by less than rounding: the bounce is over */
    double *before;       /* [ntrigger] program values before the jump */
    int64_t *count;       /* [nevent] */
    double *time;         /* [nevent] */
    void *solver;         /* gsl_root_fsolver */
    int first_step;       /* of the phase */
    int most;             /* size of the function array */
    void *block;
} pm_event_set;

int pm_event_create(pm_workspace *w);
void pm_event_free(pm_workspace *w);
/* A new case: counts and times are cleared. */
void pm_event_reset(pm_workspace *w);

double pm_event_count(const pm_workspace *w, int event);
double pm_event_time(const pm_workspace *w, int event);

/* The phase's functions, from triggers, contacts and modes; the frame looks at w->state (DYNAMIC). */
void pm_event_begin(pm_workspace *w);
/* Values of all functions of the phase at the frame (level as pm_event_set.level says). */
void pm_event_values(pm_workspace *w, double *value);
/* Steps until something happens or a limit is met.  On an event w->state is at it (before the jump), the phase's rows
 * still hold, w->event->hit and ->fired tell what; *happened = 1. */
int pm_event_advance(pm_workspace *w, int *happened);

/* Instants: `before` values of the triggers; then, after jump and modes, those that a jump carried through zero. */
void pm_event_look_before(pm_workspace *w);
void pm_event_look_after(pm_workspace *w);
/* Marks the triggers of a contact's change: kind PM_TRIGGER_STRIKE, OPEN, SLIP or STICK. */
void pm_event_mark(pm_workspace *w, int kind, int contact);
/* What a located function means for its contact (function.index is then a slot): PM_TRIGGER_OPEN, SLIP, STICK, or
 * PM_NONE. */
int pm_event_contact_change(const pm_workspace *w, int function);
/* Counts the events whose triggers are marked (each once), stamps their time; returns how many. */
int pm_event_commit(pm_workspace *w);
/* 1 if the end of the run is reached. */
int pm_event_until(const pm_workspace *w);

#endif
