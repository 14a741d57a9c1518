/* find_look.h - a whole run as a function of the varied parameters; what the parts of a find share. */
#ifndef PM_FIND_LOOK_H
#define PM_FIND_LOOK_H

#include "state/workspace.h"

/* What one run says.  A reading is not a number where the run does not come to where it is read. */
typedef struct pm_look {
    double x[PM_FIND_MOST];
    int status; /* of the run */
    int holds;  /* it came to an outcome, and all conditions but the ZERO ones hold */
    double reading[PM_FIND_MOST_CONDITIONS];
    double goal;  /* what is to be greatest: the extreme ask, its negative for the least */
    int edge;     /* beyond it runs fail */
    int bisected; /* it is where an outcome changes */
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
    double
        resolution; /* relative: how well the threshold of an outcome can be known; 0 for roots and extremes */
    void *root, *minimum, *pair; /* GSL's solvers */
} pm_find;

/* Runs the case with the varied parameters x.  Fails (returns a status) only if it is to be stopped. */
int pm_find_look(pm_workspace *w, const double *x, pm_look *look);
/* The number of a condition that alone keeps `no` from holding and can be read on both sides, or PM_NONE. */
int pm_find_margin(const pm_workspace *w, const pm_look *no, const pm_look *yes);

#endif
