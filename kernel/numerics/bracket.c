/* bracket.c - roots and minima of functions of one variable.
 *
 * Newton's method: where it would leave the bracket, or gains less than a bisection, the bracket is halved instead.  Its
 * shifts d fall by squares: the next one is d (d / d_before)^2.  Roots of an approximation are polished on exact values by
 * the secant; where that does not gain, and values on both sides of the root have been seen, the bracket of these is halved:
 * next to where a motion rests the time goes as the root of the way.  Where that ends at a jump the jump is the root. */
#include "numerics/bracket.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "numerics/tolerances.h"

typedef struct pm_bracket_call {
    pm_along *f;
    void *of, *context;
    double a, fa, b, fb;
} pm_bracket_call;

/* At the ends the values that were given: they differ in sign, also where the dense output is off by its error. */
static double call(double t, void *x)
{
    const pm_bracket_call *c = x;
    if (t == c->a) return c->fa;
    if (t == c->b) return c->fb;
    return c->f(c->of, t, c->context);
}

/* GSL may well go wrong where the function is not a number: what it then says is one thing here. */
static int end_of(int status) { return status ? PM_SEARCH_NO_NUMBER : PM_SEARCH_FOUND; }

int pm_bracket_find(void *solver, pm_along *f, void *of, void *context, double a, double fa, double b,
                    double fb, double *root)
{
    pm_bracket_call c = {f, of, context, a, fa, b, fb};
    gsl_function function = {.function = call, .params = &c};
    *root = fa == 0 ? a : b;
    if (fa == 0 || fb == 0) return PM_SEARCH_FOUND;
    int status = gsl_root_fsolver_set(solver, &function, a, b);
    for (int i = 0; i < PM_BRACKET_VALUES && !status; i++) {
        status = gsl_root_fsolver_iterate(solver);
        *root = gsl_root_fsolver_root(solver);
        const double low = gsl_root_fsolver_x_lower(solver), high = gsl_root_fsolver_x_upper(solver);
        if (high - low <= 4 * PM_EPSILON * fmax(fabs(low), fabs(high)) ||
            high - low <= PM_BRACKET_WIDTH * fabs(b - a))
            return end_of(status);
    }
    return status ? end_of(status) : PM_SEARCH_TOO_MANY;
}

int pm_bracket_newton(pm_sloped *f, void *of, void *context, double a, double fa, double b, double fb,
                      double *root)
{
    double low = a, high = b, last = fabs(b - a), slope;
    int quadratic = 0; /* the last shift was Newton's, too */
    *root = fa == 0 ? a : b;
    if (fa == 0 || fb == 0) return PM_SEARCH_FOUND;
    *root = a + (b - a) * (fa / (fa - fb));
    for (int i = 0; i < PM_BRACKET_VALUES; i++) {
        const double x = *root, value = f(of, x, context, &slope);
        if (isnan(value)) return PM_SEARCH_NO_NUMBER;
        if (value == 0) return PM_SEARCH_FOUND;
        *((value > 0) == (fa > 0) ? &low : &high) = x;
        const double shift = -value / slope, inside = (x + shift - low) * (high - x - shift);
        const double nothing = fmax(PM_EPSILON * fabs(x), PM_BRACKET_NOTHING * fabs(b - a));
        if (fabs(shift) <= nothing) return PM_SEARCH_FOUND;
        const int gains = inside > 0 && fabs(shift) <= PM_GAIN * last;
        *root = gains ? x + shift : 0.5 * (low + high);
        const double size = fabs(*root - x),
                     next = quadratic && gains ? size * (size / last) * (size / last) : size;
        if (next <= nothing) return PM_SEARCH_FOUND;
        quadratic = gains;
        last = size;
    }
    return PM_SEARCH_TOO_MANY;
}

/* Beyond an end there may be nothing: a path that turns has no time there. */
double pm_bracket_slope(pm_along *f, void *of, void *context, double begin, double end, double x, double d)
{
    const double slope = (f(of, x + d, context) - f(of, x - d, context)) / (2 * d);
    if (!isnan(slope)) return slope;
    const double low = fmax(x - d, begin), high = fmin(x + d, end);
    return (f(of, high, context) - f(of, low, context)) / (high - low);
}

/* Exact values on both sides of a root, where both have been seen: a < 0 < b. */
typedef struct pm_bracket_sides {
    double below, above; /* places; NAN before */
} pm_bracket_sides;

static void see(pm_bracket_sides *sides, double x, double value)
{
    *(value > 0 ? &sides->above : &sides->below) = x;
}

static int has_both(const pm_bracket_sides *sides) { return !isnan(sides->below) && !isnan(sides->above); }

static int is_between(const pm_bracket_sides *sides, double x)
{
    return (x - sides->below) * (sides->above - x) > 0;
}

/* The best place; but a function that jumps through zero may be nearer to it elsewhere: where that is far from the sides
 * that have closed, the later of these, where it is through. */
static double polished(const pm_bracket_sides *sides, double best, double rounding)
{
    if (!has_both(sides)) return best;
    const double low = fmin(sides->below, sides->above), high = fmax(sides->below, sides->above);
    const double apart = fmax(low - best, best - high);
    return apart > PM_BRACKET_JUMPS * fmax(high - low, rounding) ? high : best;
}

int pm_bracket_polish(pm_along *f, pm_exactly *exactly, void *of, void *context, double begin, double end,
                      double slope, double *x, double *taken, double *off)
{
    const double h = end - begin, rounding = PM_EPSILON * fabs(*x) + PM_BRACKET_POLISHED * h;
    double best = INFINITY, value, last = 0, place = *x, at_best = *x;
    pm_bracket_sides sides = {NAN, NAN};
    if (isnan(slope)) slope = pm_bracket_slope(f, of, context, begin, end, *x, PM_BRACKET_SLOPE_STEP * h);
    for (int i = 0; i < (has_both(&sides) ? PM_BRACKET_VALUES : PM_BRACKET_POLISH); i++) {
        *taken = *x;
        const int status = exactly(of, *x, context, &value);
        if (status) return status;
        const int gains = fabs(value) < best;
        if (gains) {
            best = fabs(value);
            at_best = *x;
            *off = value;
        }
        if (i > 0 && value != last && *x != place) slope = (value - last) / (*x - place); /* secant */
        const double shift = slope != 0 ? -value / slope : 0;
        if (value != 0 && !isnan(value)) see(&sides, *x, value);
        if (fabs(shift) <= rounding || value == 0 || isnan(value)) break;
        const int inside = has_both(&sides) && fabs(sides.above - sides.below) > rounding;
        const double far =
            i > 0 ? fmin(PM_BRACKET_FAR * h, PM_BRACKET_LONGER * fabs(*x - place)) : PM_BRACKET_FAR * h;
        if (!inside && (!gains || !(fabs(shift) <= far))) break;
        last = value;
        place = *x;
        *x = fmin(fmax(*x + shift, begin), end);
        if (inside && !(gains && is_between(&sides, *x))) *x = 0.5 * (sides.below + sides.above);
    }
    *x = polished(&sides, at_best, rounding);
    return 0;
}

void *pm_bracket_create(void)
{
    gsl_set_error_handler_off(); /* the default one aborts the process */
    return gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
}

void pm_bracket_free(void *solver)
{
    if (solver) gsl_root_fsolver_free(solver);
}

/* ---- minima ---- */
int pm_bracket_minimum(void *solver, double (*f)(double, void *), void *context, const pm_valley *in,
                       const pm_closeness *to, double *place)
{
    gsl_function function = {.function = f, .params = context};
    *place = in->x;
    int status =
        gsl_min_fminimizer_set_with_values(solver, &function, in->x, in->fx, in->a, in->fa, in->b, in->fb);
    for (int i = 0; i < to->values && !status; i++) {
        status = gsl_min_fminimizer_iterate(solver);
        *place = gsl_min_fminimizer_x_minimum(solver);
        const double low = gsl_min_fminimizer_x_lower(solver), high = gsl_min_fminimizer_x_upper(solver);
        if (high - low <= to->absolute + to->relative * fmax(fabs(low), fabs(high))) return end_of(status);
    }
    return status ? end_of(status) : PM_SEARCH_TOO_MANY;
}

void *pm_bracket_minimum_create(void)
{
    gsl_set_error_handler_off();
    return gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
}

void pm_bracket_minimum_free(void *solver)
{
    if (solver) gsl_min_fminimizer_free(solver);
}
