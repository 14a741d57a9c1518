/* ball_series.c - the arithmetic of taylor.c with numbers that are known but for so much, in the middle of bounds (balls). */
#include "numerics/ball_series.h"

#include <math.h>

#include "numerics/tolerances.h"

enum { TERMS = PM_BALL_TERMS };

/* ---- balls ---- */
static const pm_ball unknown = {0, INFINITY};

static pm_ball plus(pm_ball a, pm_ball b) { return (pm_ball){a.at + b.at, a.by + b.by}; }
static pm_ball scaled(double x, pm_ball a) { return (pm_ball){x * a.at, fabs(x) * a.by}; }

static pm_ball times(pm_ball a, pm_ball b)
{
    const double at = a.at * b.at;
    return (pm_ball){at, fabs(a.at) * b.by + a.by * (fabs(b.at) + b.by) + PM_INTERVAL_ROUNDING * fabs(at)};
}

static pm_ball ball_of(pm_interval x)
{
    if (!isfinite(x.lo) || !isfinite(x.hi)) return unknown;
    const double middle = 0.5 * (x.lo + x.hi);
    return (pm_ball){middle, fmax(x.hi - middle, middle - x.lo)};
}

static pm_ball inverse(pm_ball a)
{
    return ball_of(pm_interval_quotient(pm_interval_of(1), pm_ball_interval(a)));
}

/* ---- series ---- */
pm_ball_series pm_ball_series_number(double x) { return (pm_ball_series){{{x, 0}}}; }

pm_ball_series pm_ball_series_unknown(void)
{
    pm_ball_series y;
    for (int k = 0; k < TERMS; k++) y.c[k] = unknown;
    return y;
}

static pm_ball_series number(pm_ball x) { return (pm_ball_series){{x}}; }

static int is_steady(const pm_ball_series *a)
{
    for (int k = 1; k < TERMS; k++)
        if (a->c[k].at != 0 || a->c[k].by != 0) return 0;
    return 1;
}

static int is_number(const pm_ball_series *a, double x)
{
    return a->c[0].at == x && a->c[0].by == 0 && is_steady(a);
}

/* Clenshaw's recurrence with the argument x + w u, u^k by u^k, in the coefficients c[n] of the polynomial; returns n. */
static int expand(const pm_chebyshev_series *s, double x, double w, double *c)
{
    double b[PM_NODES_MOST] = {0}, after[PM_NODES_MOST] = {0};
    int n = s->n;
    while (n > 1 && s->value[n - 1] == 0) n--;
    for (int j = n - 1; j >= 0; j--) {
        const double factor = j > 0 ? 2 : 1;
        for (int k = n - 1; k >= 0; k--) {
            const double before = k > 0 ? b[k - 1] : 0;
            c[k] = factor * (x * b[k] + w * before) - after[k] + (k > 0 ? 0 : s->value[j]);
            after[k] = b[k];
            b[k] = c[k];
        }
    }
    return n;
}

/* How far coefficient k is from that at the middle, for |u| <= 1: by the sizes of the higher ones, about u = 1. */
static void widen(const double *c, int n, pm_ball_series *y)
{
    double sum[PM_NODES_MOST];
    for (int k = 0; k < n; k++) sum[k] = fabs(c[k]);
    for (int i = 0; i < n && i < TERMS; i++) {
        for (int k = n - 2; k >= i; k--) sum[k] += sum[k + 1];
        y->c[i].by += sum[i] - fabs(c[i]);
    }
}

pm_ball_series pm_ball_series_of(const pm_chebyshev_series *x, double middle, double half, int wide)
{
    double c[PM_NODES_MOST];
    const int n = expand(x, 2 * middle - 1, 2 * half, c);
    pm_ball_series y = pm_ball_series_number(0);
    for (int k = 0; k < n && k < TERMS; k++) y.c[k].at = c[k];
    y.c[0].by = PM_SERIES_ROUNDING * x->size;
    if (wide) widen(c, n, &y);
    return y;
}

pm_ball_series pm_ball_series_sum(const pm_ball_series *a, const pm_ball_series *b, double factor)
{
    pm_ball_series y;
    for (int k = 0; k < TERMS; k++) y.c[k] = plus(a->c[k], scaled(factor, b->c[k]));
    y.c[0].by += PM_INTERVAL_ROUNDING * fabs(y.c[0].at);
    return y;
}

static pm_ball_series multiple(const pm_ball_series *a, pm_ball x)
{
    pm_ball_series y;
    for (int k = 0; k < TERMS; k++) y.c[k] = times(a->c[k], x);
    return y;
}

pm_ball_series pm_ball_series_product(const pm_ball_series *a, const pm_ball_series *b)
{
    pm_ball_series y = pm_ball_series_number(0);
    if (is_number(a, 0) || is_number(b, 0)) return y; /* whatever the other one is */
    if (is_steady(a)) return multiple(b, a->c[0]);
    if (is_steady(b)) return multiple(a, b->c[0]);
    for (int k = 0; k < TERMS; k++)
        for (int j = 0; j <= k; j++) y.c[k] = plus(y.c[k], times(a->c[j], b->c[k - j]));
    return y;
}

pm_ball_series pm_ball_series_quotient(const pm_ball_series *a, const pm_ball_series *b)
{
    const pm_ball over = inverse(b->c[0]);
    if (is_number(a, 0)) return *a;
    if (is_steady(b)) return multiple(a, over);
    pm_ball_series y;
    for (int k = 0; k < TERMS; k++) {
        pm_ball rest = scaled(-1, a->c[k]);
        for (int j = 1; j <= k; j++) rest = plus(rest, times(b->c[j], y.c[k - j]));
        y.c[k] = scaled(-1, times(rest, over));
    }
    return y;
}

/* The next coefficient of y: y' = p a', with the coefficients of p that come before. */
static pm_ball next(int k, const pm_ball_series *a, const pm_ball_series *p)
{
    pm_ball sum = {0, 0};
    for (int j = 1; j <= k; j++) sum = plus(sum, scaled(j, times(a->c[j], p->c[k - j])));
    return scaled(1. / k, sum);
}

/* y from its value and p = dy/da. */
static pm_ball_series integral(pm_interval value, const pm_ball_series *a, const pm_ball_series *p)
{
    pm_ball_series y = number(ball_of(value));
    for (int k = 1; k < TERMS; k++) y.c[k] = next(k, a, p);
    return y;
}

/* y = a^e:  a y' = e y a' */
static pm_ball_series number_power(const pm_ball_series *a, double e)
{
    const pm_ball over = inverse(a->c[0]);
    pm_ball_series y = number(ball_of(pm_interval_power(pm_ball_interval(a->c[0]), e)));
    for (int k = 1; k < TERMS; k++) {
        pm_ball sum = {0, 0};
        for (int j = 1; j <= k; j++) sum = plus(sum, scaled(e * j - (k - j), times(a->c[j], y.c[k - j])));
        y.c[k] = scaled(1. / k, times(sum, over));
    }
    return y;
}

/* By squares: right at 0 and for negative numbers, too. */
static pm_ball_series whole_power(const pm_ball_series *a, unsigned n)
{
    pm_ball_series y = pm_ball_series_number(1), square = *a;
    for (unsigned left = n; left > 0; left /= 2) {
        if (left % 2) y = pm_ball_series_product(&y, &square);
        if (left > 1) square = pm_ball_series_product(&square, &square);
    }
    y.c[0] = ball_of(pm_interval_power(pm_ball_interval(a->c[0]), n)); /* an even one is not negative */
    return y;
}

pm_ball_series pm_ball_series_power(const pm_ball_series *a, const pm_ball_series *b)
{
    const double e = b->c[0].at, most = 64;
    if (is_number(b, e) && e == floor(e) && fabs(e) <= most) {
        const pm_ball_series one = pm_ball_series_number(1), y = whole_power(a, (unsigned)fabs(e));
        return e < 0 ? pm_ball_series_quotient(&one, &y) : y;
    }
    if (is_number(b, e)) return number_power(a, e);
    const pm_ball_series log_a = pm_ball_series_log(a), exponent = pm_ball_series_product(b, &log_a);
    return pm_ball_series_exp(&exponent);
}

pm_ball_series pm_ball_series_sqrt(const pm_ball_series *a) { return number_power(a, 0.5); }

static pm_ball_series sum_of_squares(const pm_ball_series *a, const pm_ball_series *b)
{
    const pm_ball_series aa = whole_power(a, 2), bb = whole_power(b, 2);
    return pm_ball_series_sum(&aa, &bb, 1);
}

pm_ball_series pm_ball_series_hypot(const pm_ball_series *a, const pm_ball_series *b)
{
    const pm_ball_series square = sum_of_squares(a, b);
    return pm_ball_series_sqrt(&square);
}

pm_ball_series pm_ball_series_exp(const pm_ball_series *a)
{
    const pm_interval x = pm_ball_interval(a->c[0]);
    pm_ball_series y =
        number(x.hi <= PM_EXPONENT_MOST ? ball_of(pm_interval_rising(exp, x, -INFINITY, INFINITY)) : unknown);
    for (int k = 1; k < TERMS; k++) y.c[k] = next(k, a, &y);
    return y;
}

pm_ball_series pm_ball_series_log(const pm_ball_series *a)
{
    const pm_interval x = pm_ball_interval(a->c[0]);
    const pm_ball_series one = pm_ball_series_number(1), slope = pm_ball_series_quotient(&one, a);
    if (!(x.lo > 0)) return pm_ball_series_unknown();
    return integral(pm_interval_rising(log, x, 0, INFINITY), a, &slope);
}

static void sine_and_cosine(const pm_ball_series *a, pm_ball_series *sine, pm_ball_series *minus_cosine)
{
    const pm_interval x = pm_ball_interval(a->c[0]);
    *sine = number(ball_of(pm_interval_sine(x)));
    *minus_cosine = number(scaled(-1, ball_of(pm_interval_cosine(x))));
    for (int k = 1; k < TERMS; k++) { /* s' = c a', (-c)' = s a' */
        sine->c[k] = scaled(-1, next(k, a, minus_cosine));
        minus_cosine->c[k] = next(k, a, sine);
    }
}

pm_ball_series pm_ball_series_sin(const pm_ball_series *a)
{
    pm_ball_series sine, minus_cosine;
    sine_and_cosine(a, &sine, &minus_cosine);
    return sine;
}

pm_ball_series pm_ball_series_cos(const pm_ball_series *a)
{
    pm_ball_series sine, minus_cosine;
    sine_and_cosine(a, &sine, &minus_cosine);
    return multiple(&minus_cosine, (pm_ball){-1, 0});
}

pm_ball_series pm_ball_series_tan(const pm_ball_series *a)
{
    const pm_ball_series sine = pm_ball_series_sin(a), cosine = pm_ball_series_cos(a);
    return pm_ball_series_quotient(&sine, &cosine);
}

/* 1 + sign a^2 */
static pm_ball_series one_and_square(const pm_ball_series *a, double sign)
{
    const pm_ball_series one = pm_ball_series_number(1), square = whole_power(a, 2);
    return pm_ball_series_sum(&one, &square, sign);
}

pm_ball_series pm_ball_series_asin(const pm_ball_series *a)
{
    const pm_ball_series left = one_and_square(a, -1), slope = number_power(&left, -0.5);
    return integral(pm_interval_rising(asin, pm_ball_interval(a->c[0]), -1, 1), a, &slope);
}

pm_ball_series pm_ball_series_acos(const pm_ball_series *a)
{
    const pm_ball_series quarter = pm_ball_series_number(0.5 * M_PI), sine = pm_ball_series_asin(a);
    return pm_ball_series_sum(&quarter, &sine, -1);
}

pm_ball_series pm_ball_series_atan(const pm_ball_series *a)
{
    const pm_ball_series one = pm_ball_series_number(1), below = one_and_square(a, 1),
                         slope = pm_ball_series_quotient(&one, &below);
    return integral(pm_interval_rising(atan, pm_ball_interval(a->c[0]), -INFINITY, INFINITY), a, &slope);
}

pm_ball_series pm_ball_series_tanh(const pm_ball_series *a)
{
    const pm_interval x = pm_ball_interval(a->c[0]);
    pm_ball_series y = number(ball_of(pm_interval_rising(tanh, x, -INFINITY, INFINITY))), slope;
    for (int k = 1; k < TERMS; k++) { /* p = 1 - y^2 */
        pm_ball square = {0, 0};
        for (int j = 0; j < k; j++) square = plus(square, times(y.c[j], y.c[k - 1 - j]));
        slope.c[k - 1] = plus((pm_ball){k == 1, 0}, scaled(-1, square));
        y.c[k] = next(k, a, &slope);
    }
    return y;
}

/* It leaps from pi to -pi where y changes sign and x is not above zero. */
static int may_leap(pm_interval y, pm_interval x) { return !(x.lo > 0) && !(y.lo > 0) && !(y.hi < 0); }

/* The angle's rate is (x y' - y x') / (x^2 + y^2). */
pm_ball_series pm_ball_series_atan2(const pm_ball_series *y, const pm_ball_series *x)
{
    const pm_interval up = pm_ball_interval(y->c[0]), along = pm_ball_interval(x->c[0]);
    const pm_ball_series square = sum_of_squares(x, y);
    const pm_ball over = inverse(square.c[0]);
    pm_ball_series angle = number(ball_of(pm_interval_angle(up, along)));
    if (may_leap(up, along)) return pm_ball_series_unknown();
    for (int k = 1; k < TERMS; k++) { /* square angle' = x y' - y x', by its coefficient k - 1 */
        pm_ball rest = {0, 0};
        for (int j = 1; j <= k; j++) {
            rest = plus(rest, scaled(j, times(x->c[k - j], y->c[j])));
            rest = plus(rest, scaled(-j, times(y->c[k - j], x->c[j])));
        }
        for (int j = 1; j < k; j++) rest = plus(rest, scaled(-j, times(angle.c[j], square.c[k - j])));
        angle.c[k] = scaled(1. / k, times(rest, over));
    }
    return angle;
}

/* By Taylor's formula: of the last term, what it is all over the part. */
pm_interval pm_ball_series_bend(const pm_ball_series *middle, const pm_ball_series *wide)
{
    const pm_ball first = scaled(2, middle->c[2]);
    double by = first.by;
    for (int k = 3; k < TERMS; k++) {
        const pm_ball c = k + 1 < TERMS ? middle->c[k] : wide->c[k];
        by += k * (k - 1) * (fabs(c.at) + c.by);
    }
    if (!isfinite(first.at) || !isfinite(by)) return PM_INTERVAL_ALL;
    return (pm_interval){first.at - by, first.at + by};
}
