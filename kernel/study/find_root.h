/* find_root.h - brackets of one parameter closed to the rounding. */
#ifndef PM_FIND_ROOT_H
#define PM_FIND_ROOT_H

#include "study/find_look.h"

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

#endif
