/* bracket.c - roots of functions of time along a step.
 *
 * Newton's method: where it would leave the bracket, or gains less than a bisection, the bracket is halved instead.  Its
 * shifts d fall by squares: the next one is d (d / d_before)^2. */
#include "numerics/bracket.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "state/workspace.h"

#define ITERATIONS 100
#define ROUNDING 2.3e-16
#define NOTHING 1e-16   /* of the bracket: a shift that gains nothing */
#define POLISH 6        /* exact states taken to polish a root */
#define SLOPE_STEP 1e-4 /* of the step: distance of the difference that makes a slope */
#define FAR 0.1         /* of the step: a shift this long is no polish */

typedef struct pm_bracket_call {
    pm_workspace *w;
    pm_along *f;
    void *context;
    double a, fa, b, fb;
} pm_bracket_call;

/* At the ends the values that were given: they differ in sign, also where the dense output is off by its error. */
static double call(double t, void *x)
{
    const pm_bracket_call *c = x;
    if (t == c->a) return c->fa;
    if (t == c->b) return c->fb;
    return c->f(c->w, t, c->context);
}

int pm_bracket_find(pm_workspace *w, void *solver, pm_along *f, void *context, double a, double fa, double b,
                    double fb, double *root)
{
    pm_bracket_call c = {w, f, context, a, fa, b, fb};
    gsl_function function = {.function = call, .params = &c};
    *root = fa == 0 ? a : b;
    if (fa == 0 || fb == 0) return PM_OK;
    int status = gsl_root_fsolver_set(solver, &function, a, b);
    for (int i = 0; i < ITERATIONS && !status; i++) {
        status = gsl_root_fsolver_iterate(solver);
        *root = gsl_root_fsolver_root(solver);
        const double low = gsl_root_fsolver_x_lower(solver), high = gsl_root_fsolver_x_upper(solver);
        if (high - low <= 4 * ROUNDING * fmax(fabs(low), fabs(high)) || high - low <= 1e-14 * fabs(b - a))
            break;
    }
    return status ? pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, status, 0) : PM_OK;
}

int pm_bracket_newton(pm_workspace *w, pm_sloped *f, void *context, double a, double fa, double b, double fb,
                      double *root)
{
    double low = a, high = b, last = fabs(b - a), slope;
    int quadratic = 0; /* the last shift was Newton's, too */
    *root = fa == 0 ? a : b;
    if (fa == 0 || fb == 0) return PM_OK;
    *root = a + (b - a) * (fa / (fa - fb));
    for (int i = 0; i < ITERATIONS; i++) {
        const double x = *root, value = f(w, x, context, &slope);
        if (isnan(value)) return pm_fail(w, PM_SOLVER, PM_NONE, PM_NONE, i, ITERATIONS);
        if (value == 0) break;
        *((value > 0) == (fa > 0) ? &low : &high) = x;
        const double shift = -value / slope, inside = (x + shift - low) * (high - x - shift);
        const double nothing = fmax(ROUNDING * fabs(x), NOTHING * fabs(b - a));
        if (fabs(shift) <= nothing) break;
        const int gains = inside > 0 && fabs(shift) <= 0.5 * last;
        *root = gains ? x + shift : 0.5 * (low + high);
        const double size = fabs(*root - x),
                     next = quadratic && gains ? size * (size / last) * (size / last) : size;
        if (next <= nothing) break;
        quadratic = gains;
        last = size;
    }
    return PM_OK;
}

static double slope_at(pm_workspace *w, pm_along *f, void *context, double t, double d)
{
    return (f(w, t + d, context) - f(w, t - d, context)) / (2 * d);
}

int pm_bracket_polish(pm_workspace *w, pm_along *f, pm_exactly *exactly, void *context, double slope,
                      double *t, double *taken, double *off)
{
    const double h = w->step.end - w->step.begin, rounding = ROUNDING * fabs(*t) + 1e-15 * h;
    double best = INFINITY, value, last = 0, place = *t;
    if (isnan(slope)) slope = slope_at(w, f, context, *t, SLOPE_STEP * h);
    for (int i = 0; i < POLISH; i++) {
        *taken = *t;
        const int status = exactly(w, *t, context, &value);
        if (status) return status;
        *off = value;
        if (i > 0 && value != last && *t != place) slope = (value - last) / (*t - place); /* secant */
        const double shift = slope != 0 ? -value / slope : 0;
        if (!(fabs(value) < best) || fabs(shift) <= rounding || fabs(shift) > FAR * h) break;
        best = fabs(value);
        last = value;
        place = *t;
        *t = fmin(fmax(*t + shift, w->step.begin), w->step.end);
    }
    return PM_OK;
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
