/* flight_firings.h - what fires in each flight of a contact that bounces. */
#ifndef PM_FLIGHT_FIRINGS_H
#define PM_FLIGHT_FIRINGS_H

#include "state/workspace.h"

#define PM_FIRINGS_MOST 16 /* of one flight */

/* A trigger fires in each flight, or as each begins. */
typedef struct pm_flight_firing {
    int trigger;
    double phase; /* of the flight that has passed by then; 0: it begins */
} pm_flight_firing;

int pm_flight_firings_create(pm_workspace *w);
/* A run begins. */
void pm_flight_firings_forget(const pm_workspace *w);
/* What has fired at this instant is noted. */
void pm_flight_firings_note(const pm_workspace *w);
/* The contact is struck now.  What has fired in each of its last flights at the same part of it, in that order; how many, PM_FIRINGS_MOST at the most. */
int pm_flight_firings_find(const pm_workspace *w, int contact, pm_flight_firing *found);
/* 1 if it does so however small the flights are: where the frame looks, which is the end of all, its program is on zero. */
int pm_flight_firings_last(pm_workspace *w, int trigger);

#endif
