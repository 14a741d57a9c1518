/* enclosure_rules.c - jets of smooth operations, by the chain rule to the second order:
 *
 *   f(a)' = f' a',    f(a)'' = f'' a'^2 + f' a''
 */
#include <string.h>

#include "expression/enclosure.h"
#include "expression/operation.h"
#include "numerics/tolerances.h"

#define SUM pm_interval_sum
#define LESS pm_interval_difference
#define TIMES pm_interval_product
#define OVER pm_interval_quotient

typedef struct pm_slopes {
    pm_interval value, first, second;
} pm_slopes;

static const pm_interval zero = {0, 0}, one = {1, 1};

static pm_slopes of_arc(pm_interval a, int is_sine)
{
    const pm_interval f = is_sine ? pm_interval_rising(asin, a, -1, 1)
                                  : pm_interval_negative(pm_interval_rising(asin, a, -1, 1));
    const pm_interval left = LESS(one, pm_interval_square(a)), sign = pm_interval_of(is_sine ? 1 : -1);
    const pm_interval first = left.lo > 0 ? OVER(sign, pm_interval_power(left, 0.5)) : PM_INTERVAL_ALL;
    const pm_interval quarter = pm_interval_of(0.5 * M_PI);
    return (pm_slopes){is_sine ? f : SUM(quarter, f), first, OVER(TIMES(a, first), left)};
}

static pm_slopes of_root(pm_interval a)
{
    const pm_interval f = pm_interval_rising(sqrt, a, 0, INFINITY);
    const pm_interval first = a.lo > 0 ? OVER(pm_interval_of(0.5), f) : PM_INTERVAL_ALL;
    return (pm_slopes){f, first, a.lo > 0 ? OVER(pm_interval_scaled(-0.5, first), a) : PM_INTERVAL_ALL};
}

static pm_slopes of_logarithm(pm_interval a)
{
    if (!(a.lo > 0)) return (pm_slopes){PM_INTERVAL_ALL, PM_INTERVAL_ALL, PM_INTERVAL_ALL};
    const pm_interval first = OVER(one, a);
    return (pm_slopes){pm_interval_rising(log, a, 0, INFINITY), first,
                       pm_interval_negative(pm_interval_square(first))};
}

static pm_slopes of_arc_tangent(pm_interval a)
{
    const pm_interval first = OVER(one, SUM(one, pm_interval_square(a)));
    return (pm_slopes){pm_interval_rising(atan, a, -INFINITY, INFINITY), first,
                       TIMES(pm_interval_scaled(-2, a), pm_interval_square(first))};
}

/* (tanh)' = 1 / cosh^2 falls off on both sides of 0, and keeps its figures where 1 - tanh^2 has none. */
static double slope_of_hyperbolic(double x)
{
    const double e = exp(-2 * fabs(x)), sum = 1 + e;
    return 4 * e / (sum * sum);
}

static pm_slopes of_hyperbolic_tangent(pm_interval a)
{
    const pm_interval f = pm_interval_rising(tanh, a, -INFINITY, INFINITY);
    const pm_interval far = pm_interval_size_of(a), less = pm_interval_negative(far);
    const pm_interval first = pm_interval_rising(slope_of_hyperbolic, less, -INFINITY, 0);
    return (pm_slopes){f, first, TIMES(pm_interval_scaled(-2, f), first)};
}

static pm_slopes of_tangent(pm_interval a)
{
    const pm_interval f = pm_interval_tangent(a), first = SUM(one, pm_interval_square(f));
    return (pm_slopes){f, first, TIMES(pm_interval_scaled(2, f), first)};
}

/* ---- switches ---- */
/* Whether an operation stands alike where its operand is x and y: x < 0 is told from x = 0 only where it does so. */
static int stands_alike(int op, double x, double y)
{
    switch (op) {
    case PM_OP_LE:
    case PM_OP_GT: return (x > 0) == (y > 0);
    case PM_OP_LT:
    case PM_OP_GE:
    case PM_OP_ABS:
    case PM_OP_MIN:
    case PM_OP_MAX: return (x < 0) == (y < 0);
    case PM_OP_FLOOR: return floor(x) == floor(y);
    default: return (x != 0) == (y != 0);
    }
}

/* Comparisons with what is no number are false: where numbers end is a switch, too. */
int pm_jet_changes(int op, const pm_jet *x)
{
    return isnan(x->at[0]) != isnan(x->at[2]) || !stands_alike(op, x->at[0], x->at[2]);
}

int pm_jet_keeps_side(int op, const pm_jet *x)
{
    if (x->value.lo == x->value.hi && !x->gaps) return 1;
    if (x->gaps) return x->gaps == PM_GAPS_EVERYWHERE;
    if (op == PM_OP_FLOOR ? floor(x->value.lo) == floor(x->value.hi) : !pm_interval_holds(x->value, 0))
        return 1;
    const int monotonic = x->rate.lo >= 0 || x->rate.hi <= 0, no_pole = isfinite(pm_interval_size(x->value));
    return monotonic && no_pole && !pm_jet_changes(op, x);
}

static pm_slopes of_size(const pm_jet *a)
{
    const double sign = a->at[1] < 0 ? -1 : 1;
    const pm_interval first = pm_jet_keeps_side(PM_OP_ABS, a) ? pm_interval_of(sign) : (pm_interval){-1, 1};
    return (pm_slopes){pm_interval_size_of(a->value), first, zero};
}

static double exponential(double x) { return exp(x > PM_EXPONENT_MOST ? PM_EXPONENT_MOST : x); }

static pm_slopes of_exponential(pm_interval x)
{
    const pm_interval f = pm_interval_rising(exponential, x, -INFINITY, INFINITY);
    const pm_interval slope = x.hi <= PM_EXPONENT_MOST   ? f
                              : x.lo >= PM_EXPONENT_MOST ? zero
                                                         : pm_interval_hull(zero, f);
    return (pm_slopes){f, slope, slope};
}

static pm_slopes slopes(int op, const pm_jet *a)
{
    const pm_interval x = a->value;
    switch (op) {
    case PM_OP_NEG: return (pm_slopes){pm_interval_negative(x), pm_interval_of(-1), zero};
    case PM_OP_SIN: {
        const pm_interval sine = pm_interval_sine(x);
        return (pm_slopes){sine, pm_interval_cosine(x), pm_interval_negative(sine)};
    }
    case PM_OP_COS: {
        const pm_interval cosine = pm_interval_cosine(x);
        return (pm_slopes){cosine, pm_interval_negative(pm_interval_sine(x)), pm_interval_negative(cosine)};
    }
    case PM_OP_TAN: return of_tangent(x);
    case PM_OP_ASIN: return of_arc(x, 1);
    case PM_OP_ACOS: return of_arc(x, 0);
    case PM_OP_ATAN: return of_arc_tangent(x);
    case PM_OP_TANH: return of_hyperbolic_tangent(x);
    case PM_OP_SQRT: return of_root(x);
    case PM_OP_ABS: return of_size(a);
    case PM_OP_EXP: return of_exponential(x);
    case PM_OP_LOG: return of_logarithm(x);
    case PM_OP_FLOOR: return (pm_slopes){pm_interval_rising(floor, x, -INFINITY, INFINITY), zero, zero};
    default: /* not */
        return (pm_slopes){pm_jet_keeps_side(op, a) ? pm_interval_of(a->at[1] == 0) : (pm_interval){0, 1},
                           zero, zero};
    }
}

/* ---- where there is no number ---- */
static int beyond(pm_interval a, double from, double to)
{
    const double rounding = PM_INTERVAL_ROUNDING * fmin(fabs(from), fabs(to));
    if (a.hi < from - rounding || a.lo > to + rounding) return PM_GAPS_EVERYWHERE;
    return a.lo < from - rounding || a.hi > to + rounding ? PM_GAPS_SOMEWHERE : PM_GAPS_NONE;
}

/* Of the function of one operand, where that is a number. */
static int gaps_of(int op, pm_interval a)
{
    switch (op) {
    case PM_OP_ASIN:
    case PM_OP_ACOS: return beyond(a, -1, 1);
    case PM_OP_SQRT:
    case PM_OP_LOG: return beyond(a, 0, INFINITY);
    default: return PM_GAPS_NONE;
    }
}

static int gaps_of_power(const pm_jet *a, const pm_jet *b)
{
    const double n = b->value.lo;
    if (n == b->value.hi && n == floor(n)) return PM_GAPS_NONE;
    return a->value.lo < 0 ? PM_GAPS_SOMEWHERE : PM_GAPS_NONE;
}

static int more_gaps(int x, int y) { return x > y ? x : y; }

pm_jet pm_jet_of_one(int op, const pm_jet *a)
{
    pm_jet f = {.motion = a->motion, .gaps = op == PM_OP_NOT ? 0 : more_gaps(a->gaps, gaps_of(op, a->value))};
    for (int k = 0; k < 3; k++)
        f.at[k] = op == PM_OP_EXP ? exponential(a->at[k]) : pm_operations[op].one(a->at[k]);
    const pm_slopes s = slopes(op, a);
    f.value = s.value;
    f.rate = TIMES(s.first, a->rate);
    f.bend = SUM(TIMES(s.second, pm_interval_square(a->rate)), TIMES(s.first, a->bend));
    return f;
}

/* ---- two operands ---- */
static void multiply(const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    f->value = TIMES(a->value, b->value);
    f->rate = SUM(TIMES(a->rate, b->value), TIMES(a->value, b->rate));
    f->bend = SUM(SUM(TIMES(a->bend, b->value), TIMES(a->value, b->bend)),
                  pm_interval_scaled(2, TIMES(a->rate, b->rate)));
}

static void divide(const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    f->value = OVER(a->value, b->value);
    f->rate = OVER(LESS(a->rate, TIMES(f->value, b->rate)), b->value);
    f->bend =
        OVER(LESS(LESS(a->bend, pm_interval_scaled(2, TIMES(f->rate, b->rate))), TIMES(f->value, b->bend)),
             b->value);
}

static int is_constant(const pm_jet *a)
{
    return a->value.lo == a->value.hi && pm_interval_is_number(a->rate, 0) &&
           pm_interval_is_number(a->bend, 0);
}

/* a^n for a number n; else exp(b log a). */
static void raise(const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    const double n = b->value.lo;
    if (is_constant(b)) {
        const pm_interval first = pm_interval_scaled(n, pm_interval_power(a->value, n - 1)),
                          second = pm_interval_scaled(n * (n - 1), pm_interval_power(a->value, n - 2));
        f->value = pm_interval_power(a->value, n);
        f->rate = TIMES(first, a->rate);
        f->bend = SUM(TIMES(second, pm_interval_square(a->rate)), TIMES(first, a->bend));
        return;
    }
    if (!(a->value.lo > 0)) {
        f->value = f->rate = f->bend = PM_INTERVAL_ALL;
        return;
    }
    const pm_jet logarithm = pm_jet_of_one(PM_OP_LOG, a), exponent = pm_jet_of_two(PM_OP_MUL, b, &logarithm),
                 power = pm_jet_of_one(PM_OP_EXP, &exponent);
    f->value = power.value;
    f->rate = power.rate;
    f->bend = power.bend;
}

/* Sum of squares s with s' / 2 and s'' / 2. */
static pm_slopes squares(const pm_jet *a, const pm_jet *b)
{
    return (pm_slopes){
        SUM(pm_interval_square(a->value), pm_interval_square(b->value)),
        SUM(TIMES(a->value, a->rate), TIMES(b->value, b->rate)),
        SUM(SUM(pm_interval_square(a->rate), TIMES(a->value, a->bend)),
            SUM(pm_interval_square(b->rate), TIMES(b->value, b->bend))),
    };
}

static void length(const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    const pm_slopes s = squares(a, b);
    f->value = pm_interval_power(s.value, 0.5);
    f->rate = OVER(s.first, f->value);
    f->bend = OVER(LESS(s.second, pm_interval_square(f->rate)), f->value);
}

const pm_jet *pm_jet_leaps_with(const pm_jet *y, const pm_jet *x)
{
    if (x->value.lo > 0 || !pm_interval_holds(y->value, 0)) return NULL;
    const int stands = y->value.lo == y->value.hi && !y->gaps;
    return stands ? x : y;
}

static void angle(const pm_jet *y, const pm_jet *x, pm_jet *f)
{
    const pm_jet *leaps = pm_jet_leaps_with(y, x);
    if (leaps && !pm_jet_keeps_side(PM_OP_GE, leaps)) {
        f->value = (pm_interval){-M_PI, M_PI};
        f->rate = f->bend = PM_INTERVAL_ALL;
        return;
    }
    const pm_slopes s = squares(x, y);
    f->value = pm_interval_angle(y->value, x->value);
    f->rate = OVER(LESS(TIMES(y->rate, x->value), TIMES(y->value, x->rate)), s.value);
    f->bend = OVER(LESS(LESS(TIMES(y->bend, x->value), TIMES(y->value, x->bend)),
                        pm_interval_scaled(2, TIMES(f->rate, s.first))),
                   s.value);
}

pm_jet pm_jet_hull(const pm_jet *a, const pm_jet *b)
{
    return (pm_jet){.value = pm_interval_hull(a->value, b->value),
                    .rate = pm_interval_hull(a->rate, b->rate),
                    .bend = pm_interval_hull(a->bend, b->bend),
                    .motion = a->motion || b->motion,
                    .gaps = a->gaps == b->gaps ? a->gaps : PM_GAPS_SOMEWHERE};
}

/* The one that is less (or greater), or either where that is open. */
static void choose(int op, const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    const pm_jet hull = pm_jet_hull(a, b), difference = pm_jet_difference(a, b);
    const int first = (difference.at[1] < 0) == (op == PM_OP_MIN);
    const pm_jet *taken = !pm_jet_keeps_side(op, &difference) ? &hull : first ? a : b;
    f->value = taken->value;
    f->rate = taken->rate;
    f->bend = taken->bend;
}

pm_jet pm_jet_difference(const pm_jet *a, const pm_jet *b)
{
    pm_jet f = {.motion = a->motion || b->motion,
                .gaps = more_gaps(a->gaps, b->gaps),
                .value = LESS(a->value, b->value),
                .rate = LESS(a->rate, b->rate),
                .bend = LESS(a->bend, b->bend)};
    for (int k = 0; k < 3; k++) f.at[k] = a->at[k] - b->at[k];
    return f;
}

/* Yes or no: as in the middle, if that is decided. */
static void decide(int op, const pm_jet *a, const pm_jet *b, pm_jet *f)
{
    const pm_jet difference = pm_jet_difference(a, b);
    const int decided = op == PM_OP_AND || op == PM_OP_OR
                            ? pm_jet_keeps_side(op, a) && pm_jet_keeps_side(op, b)
                            : pm_jet_keeps_side(op, &difference);
    f->rate = f->bend = zero;
    f->value = decided && !f->motion ? pm_interval_of(f->at[1]) : (pm_interval){0, 1};
}

pm_jet pm_jet_of_two(int op, const pm_jet *a, const pm_jet *b)
{
    const int gaps = more_gaps(a->gaps, b->gaps), counts = pm_operation_has(op, PM_OPERATION_COUNTS);
    pm_jet f = {.motion = a->motion || b->motion, .gaps = counts ? 0 : gaps};
    for (int k = 0; k < 3; k++) f.at[k] = pm_operations[op].two(a->at[k], b->at[k]);
    switch (op) {
    case PM_OP_ADD:
        f.value = SUM(a->value, b->value);
        f.rate = SUM(a->rate, b->rate);
        f.bend = SUM(a->bend, b->bend);
        break;
    case PM_OP_SUB: {
        const pm_jet d = pm_jet_difference(a, b);
        f.value = d.value;
        f.rate = d.rate;
        f.bend = d.bend;
        break;
    }
    case PM_OP_MUL: multiply(a, b, &f); break;
    case PM_OP_DIV: divide(a, b, &f); break;
    case PM_OP_POW:
        raise(a, b, &f);
        f.gaps = more_gaps(gaps, gaps_of_power(a, b));
        break;
    case PM_OP_HYPOT: length(a, b, &f); break;
    case PM_OP_ATAN2: angle(a, b, &f); break;
    case PM_OP_MIN:
    case PM_OP_MAX: choose(op, a, b, &f); break;
    default: decide(op, a, b, &f);
    }
    return f;
}
