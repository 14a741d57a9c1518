/* watched_samples.h - what triggers and asks watch, at the nodes of a step. */
#ifndef PM_WATCHED_SAMPLES_H
#define PM_WATCHED_SAMPLES_H

#include "elements/measure.h"
#include "expression/program.h"
#include "numerics/chebyshev_nodes.h"
#include "state/workspace.h"

/* Whose measures are read. */
enum { PM_SAMPLE_TRIGGERS = 1, PM_SAMPLE_ASKS = 2 };

typedef struct pm_watched_samples {
    int n;                     /* measures that any watched program reads */
    int *measure;              /* [n] */
    pm_measure_reader *reader; /* [n] of these */
    unsigned char *who;        /* [n] PM_SAMPLE_TRIGGERS, PM_SAMPLE_ASKS or both read it */
    int *place;                /* [measures] of each among these n */
    double *value;             /* [n][PM_NODES_MOST] at the nodes of the step (sizes with their signs) */
    double *here;              /* the same at the frame, the first of each */
    struct pm_waves *waves;    /* waves.h */
} pm_watched_samples;

/* Nothing is watched yet. */
int pm_watched_samples_create(pm_workspace *w);
/* The program is watched by `who` from now on: before any case. */
void pm_watched_samples_add(pm_workspace *w, int program, int who);

/* Reads the measures off the frame, which looks at this node of the step. */
void pm_watched_samples_read(pm_workspace *w, int node, int who);
/* A watched program at all nodes, each of which has been read: value[nodes], switches: or NULL. */
void pm_watched_samples_run(pm_workspace *w, int program, pm_switches *switches, double *value);
/* The same at the frame. */
double pm_watched_samples_here(pm_workspace *w, int program, pm_switches *switches);

#endif
