/* find.h - a case that looks for one or two of its parameters by whole runs; what the files of a find share beside find_look.h.
 *
 *   find.c           samples, brackets, what is taken of all that was found
 *   find_sample.c    samples between the bounds
 *   find_root.c      roots of readings, thresholds of outcomes
 *   find_extremum.c  the greatest goal between two parameters
 *   find_pair.c      two conditions met by two parameters */
#ifndef PM_FIND_H
#define PM_FIND_H

#include "study/find_look.h"

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
