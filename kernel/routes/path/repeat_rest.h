/* repeat_rest.h - swings from rest to rest that repeat. */
#ifndef PM_REPEAT_REST_H
#define PM_REPEAT_REST_H

#include "routes/path/repeat.h"

/* A place of rest from which the motion began, and what had been until then. */
typedef struct pm_rest {
    pm_repeat period; /* begin and counts; known = 0: there is no such place */
    int seen, most;   /* places of rest since then; so many are compared with it */
    int driver;       /* of the path */
    double place;     /* its value there */
} pm_rest;

/* Memory of it, w->repeat->rest; PM_NO_MEMORY. */
int pm_repeat_rest_create(pm_workspace *w);
/* A new case, or a phase on another route: no such place is known. */
void pm_repeat_rest_forget(pm_rest *rest);
/* A path phase begins at w->state, as in pm_repeat_begin.  If it is at rest and has begun there before, what lay between is a
 * period; the next ones that nobody asks about are passed over, and *passed = 1. */
int pm_repeat_rest_begin(pm_workspace *w, int *passed);

#endif
