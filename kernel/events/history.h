/* history.h - the record of one case over time: its start and end, both sides of every instant, and between them either the
 * times of a grid, or places inside each step of a route: its ends, its nodes, and what a straight line between would miss.
 * All are states of the route's own dense output, to the accuracy of the trajectory. */
#ifndef PM_HISTORY_H
#define PM_HISTORY_H

#include "state/workspace.h"

typedef struct pm_history {
    int64_t nprogram, cap, needed;
    const int32_t *program;
    const double *bend; /* [nprogram] what a chord between two rows may miss, in the unit of the program */
    double every;       /* distance of the times of the grid, s; 0: no grid */
    int64_t next;       /* the next time of the grid is next * every */
    double *history;    /* [cap][1 + nprogram] */
    int32_t *mark;      /* [cap] */
    double *row;        /* [PM_HISTORY_PARTINGS + 2][1 + nprogram] not yet recorded */
    double begin, length, inside; /* of the present step, in full; records are there up to this place */
} pm_history;

/* Memory of rows that are not yet recorded, owned by the workspace. */
int pm_history_create(pm_workspace *w, pm_history *history);
/* A pass of the case begins: nothing is recorded yet. */
void pm_history_reset(pm_history *history);
/* Records w->state (0: step, 1: before an event, 2: after it); does nothing without a trace, and on a grid nothing of a step. */
int pm_history_append(pm_workspace *w, int mark);
/* What the bodies do as the run begins, before anything has happened to them; the frame is DYNAMIC and stays so.  The row
 * is taken back where nothing jumps then. */
void pm_history_open(pm_workspace *w);
void pm_history_take_back(pm_history *history);
/* The run ends early, between instants, at w->state. */
int pm_history_end(pm_workspace *w);
/* A step has been made: w->step_begin to w->step_end. */
void pm_history_step(const pm_step *step, pm_record *record);
/* Records what is inside the present step up to place x and not there yet; w->probe and the frame's place are lost. */
int pm_history_inside(pm_workspace *w, double x);

#endif
