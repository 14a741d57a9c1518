/* find_root.c - roots of readings, and thresholds of outcomes.
 *
 * A root is closed in by Brent's method.  A function that changes sign without going through zero shows by what is left of
 * its step when the bracket has shrunk to the rounding.  A threshold is where conditions change from no to yes: where one
 * condition alone changes and it has a size on both sides, that size's root; otherwise bisection of the outcome. */
#include "study/find.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "numerics/tolerances.h"
#include "state/workspace.h"

typedef struct pm_find_root_context {
    pm_workspace *w;
    pm_of_parameter *f;
    void *context;
    int status;
    double a, fa, b, fb;
    pm_find_root_place *place;
} pm_find_root_context;

static void keep(pm_find_root_place *place, double x, double value)
{
    if (value < 0 && !(value < place->f_below)) {
        place->below = x;
        place->f_below = value;
    }
    if (value >= 0 && !(value > place->f_above)) {
        place->above = x;
        place->f_above = value;
    }
}

static double call(double x, void *context)
{
    pm_find_root_context *c = context;
    double value = NAN;
    if (x == c->a) return c->fa;
    if (x == c->b) return c->fb;
    if (!c->status) c->status = c->f(c->w, x, c->context, &value);
    keep(c->place, x, value);
    return value;
}

static int is_narrow(double a, double b) { return fabs(b - a) <= 2 * PM_EPSILON * fmax(fabs(a), fabs(b)); }

int pm_find_root(pm_workspace *w, pm_of_parameter *f, void *context, double a, double fa, double b, double fb,
                 pm_find_root_place *place)
{
    pm_find_root_context c = {w, f, context, PM_OK, a, fa, b, fb, place};
    gsl_function function = {.function = call, .params = &c};
    gsl_root_fsolver *solver = w->find->root;
    *place = (pm_find_root_place){fa == 0 ? a : b, NAN, NAN, NAN, NAN, 0};
    keep(place, a, fa);
    keep(place, b, fb);
    if (fa == 0 || fb == 0) return PM_OK;
    double width = fabs(b - a);
    int result = gsl_root_fsolver_set(solver, &function, fmin(a, b), fmax(a, b));
    for (int i = 0; i < PM_ROOT_STEPS && !result && !c.status; i++) {
        result = gsl_root_fsolver_iterate(solver);
        place->x = gsl_root_fsolver_root(solver);
        const double low = gsl_root_fsolver_x_lower(solver), high = gsl_root_fsolver_x_upper(solver);
        width = high - low;
        if (is_narrow(low, high)) break;
    }
    if (c.status) return c.status;
    const double step = place->f_above - place->f_below;
    place->jumps = result != GSL_SUCCESS || !(width <= 4 * PM_EPSILON * (fabs(b - a) + fabs(place->x))) ||
                   !(step <= PM_ROOT_JUMP * fabs(fb - fa) || place->f_above == 0);
    return PM_OK;
}

int pm_find_reading(pm_workspace *w, double x, void *condition, double *value)
{
    pm_look look;
    const int status = pm_find_look(w, &x, &look);
    *value = look.reading[*(const int *)condition];
    return status;
}

static int bisect(pm_workspace *w, double no, int no_status, pm_look *yes)
{
    pm_look look;
    for (int i = 0; i < PM_ROOT_STEPS && !is_narrow(no, yes->x[0]); i++) {
        const double x = 0.5 * (no + yes->x[0]);
        if (x == no || x == yes->x[0]) break;
        const int status = pm_find_look(w, &x, &look);
        if (status) return status;
        if (look.holds) {
            *yes = look;
        } else {
            no = x;
            no_status = look.status;
        }
    }
    yes->edge = no_status < 0;
    yes->bisected = 1;
    yes->side = yes->x[0] > no ? 1 : -1;
    return PM_OK;
}

/* From a root of the one condition that changes to the nearest place on the side of `yes` where all hold. */
static int step_over(pm_workspace *w, double root, pm_look *yes)
{
    const double away = yes->x[0] - root;
    double step = copysign(PM_EPSILON * fmax(fabs(root), fabs(away)), away);
    pm_look look;
    for (double x = root; fabs(x - root) <= PM_ROOT_FEW * fabs(away); x = root + step, step *= 4) {
        const int status = pm_find_look(w, &x, &look);
        if (status) return status;
        if (!look.holds) continue;
        *yes = look;
        yes->side = away > 0 ? 1 : -1;
        return PM_OK;
    }
    return bisect(w, root, PM_OK, yes); /* another condition changes, too */
}

int pm_find_threshold(pm_workspace *w, const pm_look *no, pm_look *yes)
{
    int margin = pm_find_margin(w->model, w->find, no, yes);
    if (margin == PM_NONE) return bisect(w, no->x[0], no->status, yes);
    pm_find_root_place place;
    const int status = pm_find_root(w, pm_find_reading, &margin, no->x[0], no->reading[margin], yes->x[0],
                                    yes->reading[margin], &place);
    if (status) return status;
    return place.jumps ? bisect(w, no->x[0], no->status, yes) : step_over(w, place.x, yes);
}
