/* repeat.h - what a path phase has shown once is used again: for the next period of a row, for the next turn of a closed
 * path. */
#ifndef PM_REPEAT_H
#define PM_REPEAT_H

#include "state/workspace.h"

/* A new case, or a phase on another route: nothing is known. */
void pm_repeat_forget(pm_workspace *w);
/* A path phase begins at w->state (the frame looks at it, the rows are built): if it repeats the last leg, as many legs
 * as nobody asks about are passed over; *passed = 1: w->state is the begin of a later leg and the rows are built for it. */
int pm_repeat_begin(pm_workspace *w, int *passed);
/* Before the blows of the instant that ends the leg. */
void pm_repeat_end(pm_workspace *w);
/* The path may have closed: a lap ends at w->state. */
void pm_repeat_lap(pm_workspace *w);
/* 1 if a trigger that is hit inside the step speaks against the legs passed over: the step must end there. */
int pm_repeat_doubts(const pm_workspace *w);
/* 1 if the instant is not the one that legs passed over were to end with: then they are given back, and the run goes on
 * from the begin of the first of them. */
int pm_repeat_refuted(pm_workspace *w);

#endif
