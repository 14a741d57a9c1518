/* repeat_match.h - whether a phase begins like the last leg. */
#ifndef PM_REPEAT_MATCH_H
#define PM_REPEAT_MATCH_H

#include "state/workspace.h"

/* 1 if it does at w->state, where T = kinetic: then w->leg->by, turn, member lead there from the begin of that leg. */
int pm_repeat_match(pm_workspace *w, double kinetic);

#endif
