/* taylor.h - truncated Taylor series of a function of one variable: its value and its first three derivatives at a place.
 *
 *   f(s + h) = c[0] + c[1] h + c[2] h^2 + c[3] h^3 + ...
 *
 * Sums, products and elementary functions of such series are exact up to rounding: no differences are taken.  Outside its
 * domain a function is not a number. */
#ifndef PM_TAYLOR_H
#define PM_TAYLOR_H

enum { PM_TAYLOR_TERMS = 4 };

typedef struct pm_taylor {
    double c[PM_TAYLOR_TERMS];
} pm_taylor;

static inline pm_taylor pm_taylor_number(double x) { return (pm_taylor){{x, 0, 0, 0}}; }
static inline pm_taylor pm_taylor_variable(double x) { return (pm_taylor){{x, 1, 0, 0}}; }

pm_taylor pm_taylor_sum(const pm_taylor *a, const pm_taylor *b, double factor); /* a + factor b */
pm_taylor pm_taylor_product(const pm_taylor *a, const pm_taylor *b);
pm_taylor pm_taylor_quotient(const pm_taylor *a, const pm_taylor *b);
pm_taylor pm_taylor_power(const pm_taylor *a, const pm_taylor *b);
pm_taylor pm_taylor_hypot(const pm_taylor *a, const pm_taylor *b);
pm_taylor pm_taylor_atan2(const pm_taylor *y, const pm_taylor *x);
pm_taylor pm_taylor_sqrt(const pm_taylor *a);
pm_taylor pm_taylor_exp(const pm_taylor *a);
pm_taylor pm_taylor_log(const pm_taylor *a);
pm_taylor pm_taylor_sin(const pm_taylor *a);
pm_taylor pm_taylor_cos(const pm_taylor *a);
pm_taylor pm_taylor_tan(const pm_taylor *a);
pm_taylor pm_taylor_asin(const pm_taylor *a);
pm_taylor pm_taylor_acos(const pm_taylor *a);
pm_taylor pm_taylor_atan(const pm_taylor *a);
pm_taylor pm_taylor_tanh(const pm_taylor *a);

#endif
