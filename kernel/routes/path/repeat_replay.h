/* repeat_replay.h - a leg that repeats the last one at other speeds, told by the places of that one. */
#ifndef PM_REPEAT_REPLAY_H
#define PM_REPEAT_REPLAY_H

#include "state/workspace.h"

/* What is known of the leg that the last one, computed in one step, is to tell. */
typedef struct pm_replay {
    double end;               /* x at which the last leg ended */
    double kinetic, kinetic1; /* T at the begin and the end of the leg that is told */
    double lowest;            /* least T on its way if that is at neither end; else INFINITY */
    double error;             /* of T at its begin */
} pm_replay;

/* w->state is at the begin of the leg after the last one, which pm_route_path has been prepared for.  Its step is filled and
 * sampled at the speed that goes with r->kinetic; *clear = 1: no force of a contact comes near to zero in it. */
int pm_repeat_replay(pm_workspace *w, const pm_replay *r, int *clear);
/* Extremes that are asked see that step, up to where the leg ends; *told = 0 if it does not end as it should.  w->state
 * stays as it is. */
int pm_repeat_replay_watch(pm_workspace *w, const pm_replay *r, int *told);

#endif
