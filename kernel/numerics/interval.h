/* interval.h - numbers known to lie between two bounds, and what functions make of them.
 *
 * Every result holds all values that the operation can take on its operands; bounds are widened by some roundings
 * (PM_INTERVAL_ROUNDING) in the place of directed rounding.  Where an operation has no value somewhere, or no bound, the
 * result is PM_INTERVAL_ALL.  R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (2009). */
#ifndef PM_INTERVAL_H
#define PM_INTERVAL_H

#include <math.h>

typedef struct pm_interval {
    double lo, hi;
} pm_interval;

#define PM_INTERVAL_ALL ((pm_interval){-INFINITY, INFINITY})

static inline pm_interval pm_interval_of(double x) { return (pm_interval){x, x}; }
static inline int pm_interval_holds(pm_interval a, double x) { return a.lo <= x && x <= a.hi; }
static inline int pm_interval_inside(pm_interval a, pm_interval b) { return a.lo >= b.lo && a.hi <= b.hi; }
static inline int pm_interval_is_number(pm_interval a, double x) { return a.lo == x && a.hi == x; }
static inline double pm_interval_width(pm_interval a) { return a.hi - a.lo; }
/* The greatest size of what lies in it. */
static inline double pm_interval_size(pm_interval a) { return fmax(-a.lo, a.hi); }
static inline pm_interval pm_interval_negative(pm_interval a) { return (pm_interval){-a.hi, -a.lo}; }
static inline pm_interval pm_interval_hull(pm_interval a, pm_interval b)
{
    return (pm_interval){fmin(a.lo, b.lo), fmax(a.hi, b.hi)};
}

pm_interval pm_interval_sum(pm_interval a, pm_interval b);
pm_interval pm_interval_product(pm_interval a, pm_interval b);
pm_interval pm_interval_scaled(double number, pm_interval a);
pm_interval pm_interval_square(pm_interval a);
pm_interval pm_interval_quotient(pm_interval a, pm_interval b);
static inline pm_interval pm_interval_difference(pm_interval a, pm_interval b)
{
    return pm_interval_sum(a, pm_interval_negative(b));
}

pm_interval pm_interval_size_of(pm_interval a); /* |a| */
pm_interval pm_interval_sine(pm_interval a);
pm_interval pm_interval_cosine(pm_interval a);
pm_interval pm_interval_tangent(pm_interval a);
/* Of a function that rises, defined on [from, to]. */
pm_interval pm_interval_rising(double (*f)(double), pm_interval a, double from, double to);
/* a^power, a number. */
pm_interval pm_interval_power(pm_interval a, double power);
/* The angle of (x, y). */
pm_interval pm_interval_angle(pm_interval y, pm_interval x);

#endif
