/* find.h - a case that looks for one or two of its parameters by whole runs; what the files of a find share.
 *
 *   find.c           samples, brackets, what is taken of all that was found
 *   find_sample.c    samples between the bounds
 *   find_look.c      one run as a function of the varied parameters
 *   find_root.c      roots of readings, thresholds of outcomes
 *   find_extremum.c  the greatest goal between two parameters
 *   find_pair.c      two conditions met by two parameters */
#ifndef PM_FIND_H
#define PM_FIND_H

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
    int loose;    /* it was run loosely: its readings tell signs and no more */
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
    double resolution;           /* relative: how well the threshold is known; 0 for roots and extremes */
    void *root, *minimum, *pair; /* GSL's solvers */
} pm_find;

/* ---- find.c ---- */
int pm_find_create(pm_workspace *w);

/* Runs a case: as pm_run where nothing is sought; else finds the varied parameters, gives them in found
 * [PM_FOUND_COLUMNS] and leaves the run with them as the case's results. */
int pm_find_run(pm_workspace *w, const double *param, double *found);

/* Relative: how well the last find can know its parameters, where they bound an outcome; else 0. */
double pm_find_resolution(const pm_find *find);

/* ---- find_sample.c ---- */
/* Fills find->node.  Fails (returns a status) only if it is to be stopped. */
int pm_find_sample(pm_workspace *w);

/* ---- find_look.c ---- */
/* Runs the case with the varied parameters x.  Fails (returns a status) only if it is to be stopped. */
int pm_find_look(pm_workspace *w, const double *x, pm_look *look);
/* The number of a condition that alone keeps `no` from holding and can be read on both sides, or PM_NONE. */
int pm_find_margin(const pm_model *model, const pm_find *f, const pm_look *no, const pm_look *yes);

/* ---- find_root.c ---- */
/* A function of the parameter; not a number where it has no value.  Fails only if the find is to be stopped. */
typedef int pm_of_parameter(pm_workspace *w, double x, void *context, double *value);

typedef struct pm_find_root_place {
    double x;                /* the root, or where the function jumps over zero */
    double below, above;     /* nearest arguments that were taken with a value < 0 and > 0 (or = 0) */
    double f_below, f_above; /* the function there */
    int jumps;               /* it is no root: the function jumps over zero, or has no value there */
} pm_find_root_place;

/* The root in [a, b] of a function with values fa, fb of different sign, by GSL's Brent method. */
int pm_find_root(pm_workspace *w, pm_of_parameter *f, void *context, double a, double fa, double b, double fb,
                 pm_find_root_place *place);
/* Closes in on where the conditions change between two looks: `yes` ends as the last look that holds. */
int pm_find_threshold(pm_workspace *w, const pm_look *no, pm_look *yes);
/* The reading of a condition. */
int pm_find_reading(pm_workspace *w, double x, void *condition, double *value);

/* ---- find_extremum.c ---- */
/* The greatest goal between a and b, where `best` lies between them and is greater than both; it is replaced. */
int pm_find_extremum(pm_workspace *w, double a, double b, pm_look *best);

/* ---- find_pair.c ---- */
void *pm_find_pair_create(void);
void pm_find_pair_free(void *solver);

/* Fills find->found with the places within the bounds where both conditions ZERO are met. */
int pm_find_pair(pm_workspace *w);

#endif
