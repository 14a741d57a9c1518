/* taylor.c - arithmetic of truncated Taylor series.
 *
 * A function y of a series a obeys a differential equation y' = p a', p itself a series of a and y; its coefficients
 * follow one from the other (Griewank and Walther, Evaluating Derivatives, 13.2):
 *   k y_k = sum over j = 1 .. k of  j a_j p_(k-j)
 * sqrt: p = 1/(2 y), exp: p = y, log: p = 1/a, tan: p = 1 + y^2, atan: p = 1/(1 + a^2), and so on. */
#include "numerics/taylor.h"

#include <math.h>

enum { TERMS = PM_TAYLOR_TERMS };

pm_taylor pm_taylor_sum(const pm_taylor *a, const pm_taylor *b, double factor)
{
    pm_taylor y;
    for (int k = 0; k < TERMS; k++) y.c[k] = a->c[k] + factor * b->c[k];
    return y;
}

pm_taylor pm_taylor_product(const pm_taylor *a, const pm_taylor *b)
{
    pm_taylor y;
    for (int k = 0; k < TERMS; k++) {
        y.c[k] = 0;
        for (int j = 0; j <= k; j++) y.c[k] += a->c[j] * b->c[k - j];
    }
    return y;
}

pm_taylor pm_taylor_quotient(const pm_taylor *a, const pm_taylor *b)
{
    pm_taylor y;
    for (int k = 0; k < TERMS; k++) {
        double rest = a->c[k];
        for (int j = 1; j <= k; j++) rest -= b->c[j] * y.c[k - j];
        y.c[k] = rest / b->c[0];
    }
    return y;
}

/* The next coefficient of y: y' = p a', with the coefficients of p that come before. */
static double next(int k, const pm_taylor *a, const pm_taylor *p)
{
    double sum = 0;
    for (int j = 1; j <= k; j++) sum += j * a->c[j] * p->c[k - j];
    return sum / k;
}

/* y from its value and p = dy/da. */
static pm_taylor integral(double value, const pm_taylor *a, const pm_taylor *p)
{
    pm_taylor y = pm_taylor_number(value);
    for (int k = 1; k < TERMS; k++) y.c[k] = next(k, a, p);
    return y;
}

pm_taylor pm_taylor_sqrt(const pm_taylor *a)
{
    pm_taylor y = pm_taylor_number(sqrt(a->c[0]));
    for (int k = 1; k < TERMS; k++) {
        double rest = a->c[k];
        for (int j = 1; j < k; j++) rest -= y.c[j] * y.c[k - j];
        y.c[k] = rest / (2 * y.c[0]);
    }
    return y;
}

pm_taylor pm_taylor_exp(const pm_taylor *a)
{
    pm_taylor y = pm_taylor_number(exp(a->c[0]));
    for (int k = 1; k < TERMS; k++) y.c[k] = next(k, a, &y);
    return y;
}

pm_taylor pm_taylor_log(const pm_taylor *a)
{
    const pm_taylor one = pm_taylor_number(1), slope = pm_taylor_quotient(&one, a);
    return integral(log(a->c[0]), a, &slope);
}

static void sine_and_cosine(const pm_taylor *a, pm_taylor *sine, pm_taylor *minus_cosine)
{
    *sine = pm_taylor_number(sin(a->c[0]));
    *minus_cosine = pm_taylor_number(-cos(a->c[0]));
    for (int k = 1; k < TERMS; k++) { /* s' = c a', (-c)' = s a' */
        sine->c[k] = -next(k, a, minus_cosine);
        minus_cosine->c[k] = next(k, a, sine);
    }
}

pm_taylor pm_taylor_sin(const pm_taylor *a)
{
    pm_taylor sine, minus_cosine;
    sine_and_cosine(a, &sine, &minus_cosine);
    return sine;
}

pm_taylor pm_taylor_cos(const pm_taylor *a)
{
    pm_taylor sine, minus_cosine;
    const pm_taylor none = pm_taylor_number(0);
    sine_and_cosine(a, &sine, &minus_cosine);
    return pm_taylor_sum(&none, &minus_cosine, -1);
}

pm_taylor pm_taylor_tan(const pm_taylor *a)
{
    const pm_taylor sine = pm_taylor_sin(a), cosine = pm_taylor_cos(a);
    return pm_taylor_quotient(&sine, &cosine);
}

/* 1 / (1 + sign a^2) */
static pm_taylor one_over_square(const pm_taylor *a, double sign)
{
    const pm_taylor one = pm_taylor_number(1), square = pm_taylor_product(a, a),
                    below = pm_taylor_sum(&one, &square, sign);
    return pm_taylor_quotient(&one, &below);
}

pm_taylor pm_taylor_asin(const pm_taylor *a)
{
    const pm_taylor square = one_over_square(a, -1), slope = pm_taylor_sqrt(&square);
    return integral(asin(a->c[0]), a, &slope);
}

pm_taylor pm_taylor_acos(const pm_taylor *a)
{
    pm_taylor y = pm_taylor_asin(a);
    for (int k = 1; k < TERMS; k++) y.c[k] = -y.c[k];
    y.c[0] = acos(a->c[0]);
    return y;
}

pm_taylor pm_taylor_atan(const pm_taylor *a)
{
    const pm_taylor slope = one_over_square(a, 1);
    return integral(atan(a->c[0]), a, &slope);
}

pm_taylor pm_taylor_tanh(const pm_taylor *a)
{
    pm_taylor y = pm_taylor_number(tanh(a->c[0])), slope = pm_taylor_number(1 - y.c[0] * y.c[0]);
    for (int k = 1; k < TERMS; k++) { /* p = 1 - y^2 */
        y.c[k] = next(k, a, &slope);
        for (int j = 0; j <= k; j++) slope.c[k] -= y.c[j] * y.c[k - j];
    }
    return y;
}

pm_taylor pm_taylor_hypot(const pm_taylor *a, const pm_taylor *b)
{
    const pm_taylor aa = pm_taylor_product(a, a), bb = pm_taylor_product(b, b),
                    sum = pm_taylor_sum(&aa, &bb, 1);
    return pm_taylor_sqrt(&sum);
}

/* The angle's rate is (x y' - y x') / (x^2 + y^2). */
pm_taylor pm_taylor_atan2(const pm_taylor *y, const pm_taylor *x)
{
    const double size = hypot(y->c[0], x->c[0]);
    const pm_taylor yy = pm_taylor_product(y, y), xx = pm_taylor_product(x, x),
                    square = pm_taylor_sum(&yy, &xx, 1);
    pm_taylor angle = pm_taylor_number(size > 0 ? atan2(y->c[0], x->c[0]) : NAN);
    for (int k = 1; k < TERMS; k++) { /* square angle' = x y' - y x', by its coefficient k - 1 */
        double rest = 0;
        for (int j = 1; j <= k; j++) rest += j * (x->c[k - j] * y->c[j] - y->c[k - j] * x->c[j]);
        for (int j = 1; j < k; j++) rest -= j * angle.c[j] * square.c[k - j];
        angle.c[k] = rest / (k * square.c[0]);
    }
    return angle;
}

/* By squares: right at 0 and for negative numbers, too. */
static pm_taylor whole_power(const pm_taylor *a, unsigned n)
{
    pm_taylor y = pm_taylor_number(1), square = *a;
    for (; n > 0; n /= 2) {
        if (n % 2) y = pm_taylor_product(&y, &square);
        square = pm_taylor_product(&square, &square);
    }
    return y;
}

static int is_number(const pm_taylor *a) { return a->c[1] == 0 && a->c[2] == 0 && a->c[3] == 0; }

/* y = a^e:  a y' = e y a' */
static pm_taylor number_power(const pm_taylor *a, double e)
{
    pm_taylor y = pm_taylor_number(pow(a->c[0], e));
    for (int k = 1; k < TERMS; k++) {
        double sum = 0;
        for (int j = 1; j <= k; j++) sum += (e * j - (k - j)) * a->c[j] * y.c[k - j];
        y.c[k] = sum / (k * a->c[0]);
    }
    return y;
}

pm_taylor pm_taylor_power(const pm_taylor *a, const pm_taylor *b)
{
    const double e = b->c[0], most = 64;
    if (is_number(b) && e == floor(e) && fabs(e) <= most) {
        const pm_taylor one = pm_taylor_number(1), y = whole_power(a, (unsigned)fabs(e));
        return e < 0 ? pm_taylor_quotient(&one, &y) : y;
    }
    if (is_number(b)) return number_power(a, e);
    const pm_taylor log_a = pm_taylor_log(a), exponent = pm_taylor_product(b, &log_a);
    return pm_taylor_exp(&exponent);
}
