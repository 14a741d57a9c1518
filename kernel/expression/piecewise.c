/* piecewise.c - piecewise polynomials: the piece by bisection, its value by Horner's rule, bounds by Horner's rule of intervals
 * about the middle of the stretch. */
#include "expression/piecewise.h"

#include <math.h>

#include "expression/operation.h"
#include "numerics/tolerances.h"

pm_piecewise pm_piecewise_of(const pm_model *m, int row)
{
    const int32_t *e = pm_model_row(m, PM_TABLE_PIECEWISE, row, PM_PIECEWISE_COLUMNS);
    const double *knot = m->constant + e[PM_PIECEWISE_FIRST];
    return (pm_piecewise){.knot = knot,
                          .coefficient = knot + e[PM_PIECEWISE_KNOTS],
                          .pieces = e[PM_PIECEWISE_KNOTS] - 1,
                          .degree = e[PM_PIECEWISE_DEGREE_OF],
                          .beyond = e[PM_PIECEWISE_BEYOND]};
}

/* ---- pieces ---- */
static double period(const pm_piecewise *p) { return p->knot[p->pieces] - p->knot[0]; }

/* Laps before piece n, and its place among the pieces of one. */
static int place_in_lap(const pm_piecewise *p, double n, double *laps)
{
    *laps = floor(n / p->pieces);
    return (int)(n - *laps * p->pieces);
}

double pm_piecewise_begin(const pm_piecewise *p, double n)
{
    double laps = 0;
    if (isnan(n)) return NAN;
    if (p->beyond == PM_BEYOND_REPEAT) return p->knot[place_in_lap(p, n, &laps)] + laps * period(p);
    if (n < 0) return -PM_BEYOND_KNOTS;
    return n > p->pieces ? PM_BEYOND_KNOTS : p->knot[(int)n];
}

/* The last knot that is not above x, which is not below the first: by bisection. */
static int last_below(const pm_piecewise *p, double x)
{
    int low = 0, high = p->pieces;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (p->knot[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The laps may be one off by their rounding. */
static double number_repeated(const pm_piecewise *p, double x)
{
    const double laps = floor((x - p->knot[0]) / period(p));
    double n = laps * p->pieces + last_below(p, x - laps * period(p));
    for (int i = 0; i < 2 && x < pm_piecewise_begin(p, n); i++) n--;
    for (int i = 0; i < 2 && x >= pm_piecewise_begin(p, n + 1); i++) n++;
    return n;
}

double pm_piecewise_number(const pm_piecewise *p, double x)
{
    if (!isfinite(x)) return NAN;
    if (p->beyond == PM_BEYOND_REPEAT) return number_repeated(p, x);
    if (x < p->knot[0]) return -1;
    if (x == p->knot[p->pieces] && p->beyond == PM_BEYOND_NONE)
        return p->pieces - 1; /* its end belongs to it */
    return x >= p->knot[p->pieces] ? p->pieces : last_below(p, x);
}

double pm_piecewise_number_ahead(const pm_piecewise *p, double x, double way, double nothing, double present)
{
    const double n = pm_piecewise_number(p, x), low = pm_piecewise_begin(p, n),
                 high = pm_piecewise_begin(p, n + 1);
    const int on_low = x - low <= nothing, on_high = high - x <= nothing;
    if (way == 0) return (on_low && present == n - 1) || (on_high && present == n + 1) ? present : n;
    if (way > 0) return on_high ? n + 1 : n;
    return on_low ? n - 1 : n;
}

/* ---- values ---- */
/* The polynomial c at u, and its derivatives. */
static double polynomial(const double *c, int degree, double u, double *derivative)
{
    double value = 0, first = 0, second = 0, third = 0;
    for (int k = degree; k >= 0; k--) {
        third = third * u + 3 * second;
        second = second * u + 2 * first;
        first = first * u + value;
        value = value * u + c[k];
    }
    if (derivative) {
        derivative[0] = first;
        derivative[1] = second;
        derivative[2] = third;
    }
    return value;
}

static const double *coefficients(const pm_piecewise *p, int piece)
{
    return p->coefficient + (ptrdiff_t)piece * (p->degree + 1);
}

/* Beyond the knots: from the end at x = knot, with the value and slope there. */
static double beyond(const pm_piecewise *p, int above, double x, double *derivative)
{
    const int piece = above ? p->pieces - 1 : 0;
    const double end = p->knot[above ? p->pieces : 0];
    double at_end[3];
    const double value = polynomial(coefficients(p, piece), p->degree, end - p->knot[piece], at_end);
    const double slope = p->beyond == PM_BEYOND_EXTEND ? at_end[0] : 0, none = p->beyond == PM_BEYOND_NONE;
    if (derivative) {
        derivative[0] = none ? NAN : slope;
        derivative[1] = derivative[2] = none ? NAN : 0;
    }
    if (p->beyond == PM_BEYOND_ZERO) return 0;
    return none ? NAN : value + slope * (x - end);
}

double pm_piecewise_piece(const pm_piecewise *p, double n, double x, double *derivative)
{
    double laps;
    if (!isfinite(n) || !isfinite(x)) {
        for (int k = 0; derivative && k < 3; k++) derivative[k] = NAN;
        return NAN;
    }
    if (p->beyond != PM_BEYOND_REPEAT && (n < 0 || n >= p->pieces)) return beyond(p, n > 0, x, derivative);
    const int piece = place_in_lap(p, n, &laps);
    return polynomial(coefficients(p, piece), p->degree, x - pm_piecewise_begin(p, n), derivative);
}

double pm_piecewise_value(const pm_piecewise *p, double x)
{
    return pm_piecewise_piece(p, pm_piecewise_number(p, x), x, NULL);
}

int pm_piecewise_is_outside(const pm_piecewise *p, double x)
{
    return p->beyond == PM_BEYOND_NONE && (x < p->knot[0] || x > p->knot[p->pieces]);
}

/* ---- bounds ---- */
/* Derivative k of c at the middle of a stretch of half the width, as a polynomial of the distance from there: |u| <= half. */
static pm_interval about_middle(const double *c, int degree, int k, double middle, double half)
{
    double derivative[3];
    const double value = polynomial(c, degree, middle, derivative);
    const double all[4] = {value, derivative[0], derivative[1], derivative[2]};
    pm_interval sum = pm_interval_of(all[k]);
    double power = half;
    for (int i = k + 1; i <= 3; power *= half / (i - k + 1), i++)
        sum = pm_interval_sum(sum, pm_interval_product(pm_interval_of(all[i]), (pm_interval){-power, power}));
    const double rounding = PM_INTERVAL_ROUNDING * fmax(fabs(sum.lo), fabs(sum.hi));
    return (pm_interval){sum.lo - rounding, sum.hi + rounding};
}

pm_interval pm_piecewise_bounds_of(const pm_piecewise *p, double n, int k, pm_interval x)
{
    double laps, derivative[3];
    if (!isfinite(n) || !isfinite(x.lo) || !isfinite(x.hi)) return PM_INTERVAL_ALL;
    if (p->beyond != PM_BEYOND_REPEAT && (n < 0 || n >= p->pieces)) {
        if (p->beyond == PM_BEYOND_NONE) return PM_INTERVAL_ALL;
        const double a = beyond(p, n > 0, x.lo, derivative), b = beyond(p, n > 0, x.hi, NULL);
        return k == 0 ? (pm_interval){fmin(a, b), fmax(a, b)} : pm_interval_of(derivative[k - 1]);
    }
    const double begin = pm_piecewise_begin(p, n), middle = 0.5 * (x.lo + x.hi) - begin;
    return about_middle(coefficients(p, place_in_lap(p, n, &laps)), p->degree, k, middle,
                        0.5 * pm_interval_width(x));
}

pm_interval pm_piecewise_bounds(const pm_piecewise *p, int k, pm_interval x)
{
    const double first = pm_piecewise_number(p, x.lo), last = pm_piecewise_number(p, x.hi);
    if (!isfinite(first) || !isfinite(last)) return PM_INTERVAL_ALL;
    if (last - first > PM_PIECES_BOUNDED) return PM_INTERVAL_ALL;
    pm_interval all = {INFINITY, -INFINITY};
    for (double n = first; n <= last; n++) {
        const pm_interval part = {n == first ? x.lo : pm_piecewise_begin(p, n),
                                  n == last ? x.hi : pm_piecewise_begin(p, n + 1)};
        all = pm_interval_hull(all, pm_piecewise_bounds_of(p, n, k, part));
    }
    return all;
}

/* ---- operations ---- */
double pm_piecewise_operation(const pm_model *m, int op, int row, const double *a)
{
    const pm_piecewise p = pm_piecewise_of(m, row);
    if (op == PM_OP_KNOT) return pm_piecewise_begin(&p, round(a[0]));
    return op == PM_OP_PIECE ? pm_piecewise_piece(&p, round(a[1]), a[0], NULL) : pm_piecewise_value(&p, a[0]);
}

int pm_piecewise_check(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_PIECEWISE]; i++) {
        const int32_t *e = pm_model_row(m, PM_TABLE_PIECEWISE, i, PM_PIECEWISE_COLUMNS);
        const int64_t first = e[PM_PIECEWISE_FIRST], knots = e[PM_PIECEWISE_KNOTS];
        const int64_t end = first + knots + (knots - 1) * (e[PM_PIECEWISE_DEGREE_OF] + 1);
        if (first < 0 || end > m->nconstant)
            return pm_bad_table(where, PM_TABLE_PIECEWISE, i, (double)end, m->nconstant);
        for (int64_t k = first; k < end; k++)
            if (!isfinite(m->constant[k]))
                return pm_bad_table(where, PM_TABLE_PIECEWISE, i, m->constant[k], 0);
        for (int64_t k = first + 1; k < first + knots; k++)
            if (!(m->constant[k - 1] < m->constant[k]))
                return pm_bad_table(where, PM_TABLE_PIECEWISE, i, m->constant[k], m->constant[k - 1]);
    }
    return PM_OK;
}
