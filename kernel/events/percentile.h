/* percentile.h - the value below which an expression is for a part of the time of a run. */
#ifndef PM_PERCENTILE_H
#define PM_PERCENTILE_H

#include "state/workspace.h"

/* What an ask has gathered: pieces on which its value is a polynomial through nodes. */
typedef struct pm_percentile {
    struct pm_percentile_piece *piece; /* [room] */
    int n, room;
    double unseen; /* s, of flights that were passed at once: only their mean is known */
} pm_percentile;

/* Of each ask; PM_NO_MEMORY. */
int pm_percentile_create(pm_workspace *w);
void pm_percentile_reset(pm_workspace *w);
/* [from, to] of the step is added, in which no switch of the program changes; PM_NO_MEMORY. */
int pm_percentile_take(pm_workspace *w, int ask, double from, double to);
/* A time in which the value was about this one; likewise. */
int pm_percentile_pass(pm_workspace *w, int ask, double value, double time);
/* The answer at the end of the run, and by how much it may be off as far as the pieces tell. */
double pm_percentile_answer(const pm_workspace *w, int ask, double *error);

#endif
