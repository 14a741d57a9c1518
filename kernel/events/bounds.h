/* bounds.h - what a value that is watched cannot leave over a part of a step.
 *
 * Two things bound it: its law, that is, what its program makes of the measures that it reads (waves.h); or the polynomial through
 * its samples, where these show it.  What looks for a first zero (event_bound.c) and what looks for extremes (extremum_bound.c)
 * halve a step until its parts tell what they want to know. */
#ifndef PM_BOUNDS_H
#define PM_BOUNDS_H

#include "numerics/chebyshev_series.h"
#include "state/workspace.h"

typedef struct pm_bounds {
    const pm_workspace *w;
    double sign;                /* of the value in g, which is bounded */
    int program;                /* whose law tells it; PM_NONE: a polynomial */
    int narrow;                 /* that is bounded by its bends, too */
    pm_chebyshev_series series; /* that, of the value */
    pm_chebyshev_series bends;  /* of these, if so */
} pm_bounds;

/* What is known of g over a part. */
typedef struct pm_bound {
    double most;
    pm_interval rate, bend; /* by the fraction of the step */
    double at[3];           /* at its beginning, in its middle, at its end */
    int smooth;             /* nothing switches in it, and g is a number everywhere */
} pm_bound;

/* Over the part [from, to] of the step that was sampled, 0 <= from <= to <= 1. */
pm_bound pm_bounds_over(const pm_bounds *x, double from, double to);
/* What g has at s at the least, whatever rounding makes of it. */
double pm_bounds_least(const pm_bounds *x, double s);
/* It only rises, or only falls. */
int pm_bounds_is_monotonic(const pm_bound *part);

#endif
