/* ball_series.h - truncated Taylor series whose coefficients are known but for so much.
 *
 *   f(middle + half u) = c[0] + c[1] u + c[2] u^2 + ..    -1 <= u <= 1
 *
 * With the coefficients at the middle alone these are those of f there; with what they are all over the part, the last one
 * bounds what a series of the others about the middle leaves out (Moore, Kearfott and Cloud 2009, 9.3).  Such bounds come near
 * with a high power of the part's length, those of intervals (interval.h) with the length itself.  What is not bounded is by
 * infinity, or not a number. */
#ifndef PM_BALL_SERIES_H
#define PM_BALL_SERIES_H

#include "numerics/chebyshev_series.h"
#include "numerics/interval.h"

enum { PM_BALL_TERMS = 8 };

/* A number within `by` of `at`. */
typedef struct pm_ball {
    double at, by;
} pm_ball;

typedef struct pm_ball_series {
    pm_ball c[PM_BALL_TERMS];
} pm_ball_series;

static inline pm_interval pm_ball_interval(pm_ball x) { return (pm_interval){x.at - x.by, x.at + x.by}; }

pm_ball_series pm_ball_series_number(double x);
pm_ball_series pm_ball_series_unknown(void); /* whatever it is, it is not bounded */
/* The polynomial of a step: its coefficients at the middle, or (wide) all over the part. */
pm_ball_series pm_ball_series_of(const pm_chebyshev_series *x, double middle, double half, int wide);

pm_ball_series pm_ball_series_sum(const pm_ball_series *a, const pm_ball_series *b,
                                  double factor); /* a + factor b */
pm_ball_series pm_ball_series_product(const pm_ball_series *a, const pm_ball_series *b);
pm_ball_series pm_ball_series_quotient(const pm_ball_series *a, const pm_ball_series *b);
pm_ball_series pm_ball_series_power(const pm_ball_series *a, const pm_ball_series *b);
pm_ball_series pm_ball_series_hypot(const pm_ball_series *a, const pm_ball_series *b);
pm_ball_series pm_ball_series_atan2(const pm_ball_series *y, const pm_ball_series *x);
pm_ball_series pm_ball_series_sqrt(const pm_ball_series *a);
pm_ball_series pm_ball_series_exp(const pm_ball_series *a);
pm_ball_series pm_ball_series_log(const pm_ball_series *a);
pm_ball_series pm_ball_series_sin(const pm_ball_series *a);
pm_ball_series pm_ball_series_cos(const pm_ball_series *a);
pm_ball_series pm_ball_series_tan(const pm_ball_series *a);
pm_ball_series pm_ball_series_asin(const pm_ball_series *a);
pm_ball_series pm_ball_series_acos(const pm_ball_series *a);
pm_ball_series pm_ball_series_atan(const pm_ball_series *a);
pm_ball_series pm_ball_series_tanh(const pm_ball_series *a);

/* Bounds of the second derivative by u: of the series at the middle, and of the same all over the part. */
pm_interval pm_ball_series_bend(const pm_ball_series *middle, const pm_ball_series *wide);

#endif
