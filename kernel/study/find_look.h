/* find_look.h - a find and its looks: one run as a function of the varied parameters. */
#ifndef PM_FIND_LOOK_H
#define PM_FIND_LOOK_H

#include "state/workspace.h"
#include "study/natural_size.h"

#define PM_FIND_PLACES 5 /* beside what was found: see find_sides.c */

/* What one run says.  A reading is not a number where the run does not come to where it is read. */
typedef struct pm_look {
    double x[PM_FIND_MOST];
    int status; /* of the run */
    int holds;  /* it came to an outcome, and all conditions but the ZERO ones hold */
    double reading[PM_FIND_MOST_CONDITIONS];
    double goal;  /* what is to be greatest: the extreme ask, its negative for the least */
    int edge;     /* beyond it runs fail */
    int bisected; /* it is where an outcome changes */
    int side; /* 1: the conditions hold above it and not below, -1: the other way round, 0: it is no threshold */
    int loose;  /* it was run loosely: its readings tell signs and no more */
    double off; /* it is a bound: the root lies so far beyond it, of its size, within the errors of its run */
} pm_look;

typedef struct pm_find {
    int nvary, ncondition, nzero, goal, program, samples;
    int zero[PM_FIND_MOST]; /* the conditions ZERO */
    double low[PM_FIND_MOST], high[PM_FIND_MOST];
    double *param;  /* [nparam] of the case, with the varied ones in their places */
    pm_look *node;  /* [nodes] the samples */
    pm_look *found; /* [2 nodes] what was found, in ascending order of the first parameter */
    int nfound;
    int changes; /* of the outcome between samples, where the parameter itself is to be extreme */
    int64_t runs;
    double resolution;              /* relative: how well the threshold is known; 0 for roots and extremes */
    double *answer[PM_FIND_PLACES]; /* [nout] at places beside what was found */
    double *moved;                  /* [nout] by what a move to one side may change an answer */
    unsigned char *sided;           /* [nask] it differs on both sides */
    pm_natural_size size;           /* of the asks there */
    void *root, *minimum, *pair;    /* GSL's solvers */
} pm_find;

/* Runs the case with the varied parameters x.  Fails (returns a status) only if it is to be stopped. */
int pm_find_look(pm_workspace *w, const double *x, pm_look *look);
/* The number of a condition that alone keeps `no` from holding and can be read on both sides, or PM_NONE. */
int pm_find_margin(const pm_model *model, const pm_find *f, const pm_look *no, const pm_look *yes);

#endif
