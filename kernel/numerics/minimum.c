/* minimum.c - what minimum.h says, by GSL. */
#include "numerics/minimum.h"

#include <gsl/gsl_min.h>
#include <math.h>

void *pm_minimum_create(void) { return gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent); }

void pm_minimum_free(void *solver)
{
    if (solver) gsl_min_fminimizer_free(solver);
}

double pm_minimum_find(void *solver, double (*f)(double, void *), void *context, const pm_valley *in,
                       const pm_closeness *to)
{
    gsl_function function = {.function = f, .params = context};
    double x = in->x;
    int result =
        gsl_min_fminimizer_set_with_values(solver, &function, x, in->fx, in->a, in->fa, in->b, in->fb);
    for (int i = 0; i < to->values && !result; i++) {
        result = gsl_min_fminimizer_iterate(solver);
        x = gsl_min_fminimizer_x_minimum(solver);
        const double low = gsl_min_fminimizer_x_lower(solver), high = gsl_min_fminimizer_x_upper(solver);
        if (high - low <= to->absolute + to->relative * fmax(fabs(low), fabs(high))) break;
    }
    return x;
}
