/* interval.c - interval arithmetic, widened by some roundings of the result. */
#include "numerics/interval.h"

#include "numerics/tolerances.h"

/* A bound that is not a number tells nothing. */
static pm_interval widened(double lo, double hi)
{
    if (!(lo <= hi)) return PM_INTERVAL_ALL;
    return (pm_interval){lo - PM_INTERVAL_ROUNDING * fabs(lo), hi + PM_INTERVAL_ROUNDING * fabs(hi)};
}

pm_interval pm_interval_sum(pm_interval a, pm_interval b)
{
    if (pm_interval_is_number(a, 0)) return b;
    if (pm_interval_is_number(b, 0)) return a;
    return widened(a.lo + b.lo, a.hi + b.hi);
}

/* No bound is reached at infinity: 0 times it is 0. */
static double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

pm_interval pm_interval_product(pm_interval a, pm_interval b)
{
    if (pm_interval_is_number(a, 0) || pm_interval_is_number(b, 0)) return pm_interval_of(0);
    const double p = times(a.lo, b.lo), q = times(a.lo, b.hi), r = times(a.hi, b.lo), s = times(a.hi, b.hi);
    return widened(fmin(fmin(p, q), fmin(r, s)), fmax(fmax(p, q), fmax(r, s)));
}

pm_interval pm_interval_scaled(double number, pm_interval a)
{
    return pm_interval_product(pm_interval_of(number), a);
}

pm_interval pm_interval_size_of(pm_interval a)
{
    if (a.lo >= 0) return a;
    if (a.hi <= 0) return pm_interval_negative(a);
    return (pm_interval){0, pm_interval_size(a)};
}

pm_interval pm_interval_square(pm_interval a)
{
    const pm_interval x = pm_interval_size_of(a);
    return widened(x.lo * x.lo, x.hi * x.hi);
}

pm_interval pm_interval_quotient(pm_interval a, pm_interval b)
{
    if (pm_interval_is_number(a, 0) && !pm_interval_is_number(b, 0)) return a;
    if (pm_interval_holds(b, 0)) return PM_INTERVAL_ALL;
    return pm_interval_product(a, widened(1 / b.hi, 1 / b.lo));
}

/* Some x = peak + 2 M_PI k may lie in a. */
static int meets(pm_interval a, double peak)
{
    const double from = (a.lo - peak) / (2 * M_PI), to = (a.hi - peak) / (2 * M_PI);
    const double off = PM_INTERVAL_ROUNDING * (1 + fmax(fabs(from), fabs(to)));
    return floor(to + off) != floor(from - off);
}

/* Of a wave between -1 and 1 with its top there. */
static pm_interval wave(double (*f)(double), pm_interval a, double top)
{
    if (!(pm_interval_width(a) < 2 * M_PI)) return (pm_interval){-1, 1};
    const double p = f(a.lo), q = f(a.hi);
    pm_interval x = widened(fmin(p, q), fmax(p, q));
    if (meets(a, top) || x.hi > 1) x.hi = 1;
    if (meets(a, top + M_PI) || x.lo < -1) x.lo = -1;
    return x;
}

pm_interval pm_interval_sine(pm_interval a) { return wave(sin, a, 0.5 * M_PI); }
pm_interval pm_interval_cosine(pm_interval a) { return wave(cos, a, 0); }

pm_interval pm_interval_tangent(pm_interval a)
{
    if (!(pm_interval_width(a) < M_PI) || meets(a, 0.5 * M_PI) || meets(a, -0.5 * M_PI))
        return PM_INTERVAL_ALL;
    return widened(tan(a.lo), tan(a.hi));
}

pm_interval pm_interval_rising(double (*f)(double), pm_interval a, double from, double to)
{
    if (a.hi < from || a.lo > to) return PM_INTERVAL_ALL;
    return widened(f(fmax(a.lo, from)), f(fmin(a.hi, to)));
}

/* As a power of the size, where the base may have either sign. */
static pm_interval integer_power(pm_interval a, double power)
{
    if (power < 0)
        return pm_interval_holds(a, 0) ? PM_INTERVAL_ALL
                                       : pm_interval_quotient(pm_interval_of(1), integer_power(a, -power));
    if (fmod(power, 2) != 0) return widened(pow(a.lo, power), pow(a.hi, power));
    const pm_interval x = pm_interval_size_of(a);
    return widened(pow(x.lo, power), pow(x.hi, power));
}

pm_interval pm_interval_power(pm_interval a, double power)
{
    if (power == 0) return pm_interval_of(1);
    if (power == 1) return a;
    if (power == floor(power)) return integer_power(a, power);
    if (a.lo < 0) return PM_INTERVAL_ALL;
    const double p = pow(a.lo, power), q = pow(a.hi, power);
    return widened(fmin(p, q), fmax(p, q));
}

pm_interval pm_interval_angle(pm_interval y, pm_interval x)
{
    if (x.lo > 0) return pm_interval_rising(atan, pm_interval_quotient(y, x), -INFINITY, INFINITY);
    if (pm_interval_holds(y, 0)) return widened(-M_PI, M_PI);
    const pm_interval from_axis = pm_interval_rising(atan, pm_interval_quotient(x, y), -INFINITY, INFINITY);
    return pm_interval_difference(pm_interval_of(y.lo > 0 ? 0.5 * M_PI : -0.5 * M_PI), from_axis);
}
