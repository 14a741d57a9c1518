/* ask.h - answers: values at the end and at events, extremes over the run, values on a grid. */
#ifndef PM_ASK_H
#define PM_ASK_H

#include "elements/slope.h"
#include "numerics/chebyshev_nodes.h"
#include "state/workspace.h"

typedef struct pm_ask_set {
    int *observer; /* [nask] asks that watch the whole run: extremes and grids */
    int nobserver;
    int level;         /* highest level that they need */
    int instant_level; /* highest level that any ask needs */
    int fired_level;   /* that those need which events answer */
    double *sample;    /* [nask][PM_NODES_MOST] watched values in a step */
    double *best;      /* [nask] extreme so far, NaN before the first value */
    double *bound;     /* [nask] what it cannot exceed, skipped extremes included (minima: their negatives) */
    double *before;    /* [nask] values before the jump of the present instant */
    double *size;      /* [nask] of a grid: its greatest value, and of those watched at instants */
    unsigned char *undefined; /* [nask] an extreme met a not-a-number */
    unsigned char *shared;    /* [nask] some value of it was not unique (equations/shared_reading.h) */
    unsigned char *filled;    /* [nout] */
    unsigned char *sound;     /* [nout] filled when the ledgers last closed */
    int *switches; /* [nask] places where the watched program may change its branch, as far as known */
    int *dips;     /* [nask] whether it has no extremes there */
    struct pm_integral *integral;        /* [nask] (integral.h) */
    struct pm_integral_flights *flights; /* [ncontact][nask] (integral_series.h), if any is an integral */
    struct pm_percentile *percentile;    /* [nask] (percentile.h) */
    int fresh;                           /* something was filled since */
    pm_slope slope;                      /* derivatives of a program at the frame */
    void *solver;                        /* gsl_root_fsolver */
    void *quadrature;                    /* gsl_integration_workspace */
} pm_ask_set;

int pm_ask_create(pm_workspace *w);
void pm_ask_reset(pm_workspace *w);

/* The program that observer i (of nobserver) watches. */
int pm_ask_watched(const pm_model *model, const pm_ask_set *ask, int i);
/* Watched values at the nodes of a step, which have been read (watched_samples.h). */
void pm_ask_sample(pm_workspace *w);
/* What it took of an ask. */
static inline double *pm_ask_samples(const pm_workspace *w, int ask)
{
    return w->ask->sample + ask * PM_NODES_MOST;
}

/* All nodes of [w->step_begin, w->step_end] are sampled: extremes between nodes, grid values passed. */
int pm_ask_step(pm_workspace *w);
/* 1 if the samples of a step that was shortened since need not be taken again. */
int pm_ask_keeps_samples(const pm_step *step, const pm_ask_set *ask);
/* An instant outside a step (start, after a jump): the frame looks at w->state. */
void pm_ask_instant(pm_workspace *w);

/* ---- for ask_step.c and extremum*.c ---- */
static inline int pm_ask_greatest(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_MAX || e[PM_ASK_KIND] == PM_ASK_AT_MAX;
}
static inline int pm_ask_at_extreme(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_AT_MAX || e[PM_ASK_KIND] == PM_ASK_AT_MIN;
}
/* The program that an ask watches, and its value at the frame; that of any program. */
int pm_ask_program(const int32_t *e);
double pm_ask_run(pm_workspace *w, int ask);
double pm_ask_value(pm_workspace *w, int program);
/* Answers `column` of an ask with the value of a program at the frame, and with what the route knows of its error. */
void pm_ask_answer(pm_workspace *w, int ask, int column, int program, double value);
/* The frame looks at a place of the last step; exact: to the accuracy of the trajectory. */
int pm_ask_look(pm_workspace *w, double t, int exact);
/* Takes a value of a watched extreme, `above` more than it is at the frame. */
void pm_ask_offer(pm_workspace *w, int ask, double value, double above);
/* A program less a number along a step, or the rate of that by differences. */
typedef struct pm_ask_watch {
    int program;
    double minus;               /* value to take off: a grid value */
    double step;                /* > 0: the rate by differences instead of the value */
    struct pm_switches *branch; /* of the program; NULL: the one that is taken */
} pm_ask_watch;
double pm_ask_along(void *of, double t, void *watch);

/* ---- events ---- */
/* Keeps values before the jump; after it, answers the asks of events that have just fired. */
void pm_ask_look_before(pm_workspace *w);
void pm_ask_fired(pm_workspace *w, int event);
/* An event is due, and what it brings fails: answers what is asked before it. */
void pm_ask_fails(pm_workspace *w, int event);
/* Answers what is asked at the end, marks what was not reached. */
void pm_ask_end(pm_workspace *w);
/* What is answered so far is sound. */
void pm_ask_seal(const pm_model *model, pm_ask_set *ask);
/* A run did not come to its end: keeps the answers at instants that it reached, with `sound` only those up to where the
 * ledgers closed.  All other asks get the reason `others`. */
void pm_ask_keep(pm_workspace *w, int sound, int others);

#endif
