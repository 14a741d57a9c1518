/* chebyshev_series.h - the polynomial through samples as a series, and what bounds it over a part of the step. */
#ifndef PM_CHEBYSHEV_SERIES_H
#define PM_CHEBYSHEV_SERIES_H

#include "numerics/chebyshev_nodes.h"
#include "numerics/interval.h"

/* p(s), s from 0 to 1; derivatives are by s. */
typedef struct pm_chebyshev_series {
    int n;
    double value[PM_NODES_MOST], rate[PM_NODES_MOST], bend[PM_NODES_MOST]; /* coefficients */
    double size;  /* of the coefficients of the value, summed up */
    double high;  /* greater one of the two highest coefficients */
    double third; /* bound of p''' */
    int resolved; /* the highest coefficients are small beside what changes, or beside rounding; of few nodes: rather small */
    int scatters; /* the coefficients do not fall off: samples of noise */
} pm_chebyshev_series;

/* Through sample[nodes->n], at nodes of any kind (chebyshev_nodes.h). */
void pm_chebyshev_series_of(pm_chebyshev_series *series, const pm_chebyshev_nodes *nodes,
                            const double *sample);

/* The highest coefficients are such a part of what changes, or rounding, or less. */
int pm_chebyshev_series_resolved(const pm_chebyshev_series *series, double tail);

/* The same, its derivatives left open; the size of its rate, or of its bend, is at least so much everywhere, if that is above
 * zero.  (A bend has the sign of value[2] then.) */
void pm_chebyshev_series_begin(pm_chebyshev_series *series, const pm_chebyshev_nodes *nodes,
                               const double *sample);
double pm_chebyshev_series_least_rate(const pm_chebyshev_series *series);
double pm_chebyshev_series_least_bend(const pm_chebyshev_series *series);

/* Without the highest coefficients up to this part of what changes, or up to rounding: bends make both 1000 times larger.  What
 * does not change then counts as an exact number. */
void pm_chebyshev_series_cut(pm_chebyshev_series *series, double part);

typedef struct pm_chebyshev_part {
    double at[3]; /* values at the beginning, in the middle, at the end */
    pm_interval value, rate, bend;
} pm_chebyshev_part;

/* Over the part [from, to] of [0, 1]. */
pm_chebyshev_part pm_chebyshev_series_over(const pm_chebyshev_series *series, double from, double to);

/* The derivatives of a series that has begun; its bends as a series of their own, too; and narrower bounds by these, for parts
 * that are halved until their bends are known. */
void pm_chebyshev_series_bends(pm_chebyshev_series *series, pm_chebyshev_series *bends);
pm_chebyshev_part pm_chebyshev_series_narrow(const pm_chebyshev_series *series,
                                             const pm_chebyshev_series *bends, double from, double to);

#endif
