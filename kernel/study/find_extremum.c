/* find_extremum.c - extremes of an ask over a parameter.
 *
 * Values alone locate a smooth extreme to the root of their accuracy only.  Its derivative is small there to the first
 * order, so the root of the derivative is taken: central differences over h, h/2, h/4 ... freed from their errors in h^2,
 * h^4 ... (Richardson), the entry of the table that agrees best with its neighbours.  Where the derivative has no root (a
 * corner of the ask), GSL's minimiser on values is as good as it is bad at smooth ones. */
#include "study/find.h"

#include <math.h>

#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

#define LEVELS 6 /* of the Richardson table */

typedef struct pm_find_interval {
    double a, b;
} pm_find_interval;

static int goal_at(pm_workspace *w, double x, double *goal)
{
    pm_look look;
    const int status = pm_find_look(w, &x, &look);
    *goal = look.goal;
    return status;
}

/* d goal / dx at x, by differences that stay in the interval. */
static int slope(pm_workspace *w, double x, void *context, double *value)
{
    const pm_find_interval *within = context;
    double table[LEVELS][LEVELS], error = INFINITY;
    double h = fmin(PM_FIND_WIDEST * (within->b - within->a), fmin(x - within->a, within->b - x));
    *value = NAN;
    for (int i = 0; i < LEVELS; i++, h *= 0.5) {
        double right, left, factor = 1;
        const double x_right = x + h, x_left = x - h;
        int status = goal_at(w, x_right, &right);
        if (!status) status = goal_at(w, x_left, &left);
        if (status) return status;
        table[i][0] = (right - left) / (x_right - x_left);
        if (isnan(table[i][0])) return PM_OK;
        for (int k = 1; k <= i; k++) {
            factor *= 4;
            table[i][k] = table[i][k - 1] + (table[i][k - 1] - table[i - 1][k - 1]) / (factor - 1);
            const double now =
                fmax(fabs(table[i][k] - table[i][k - 1]), fabs(table[i][k] - table[i - 1][k - 1]));
            if (!(now < error)) continue;
            error = now;
            *value = table[i][k];
        }
    }
    return PM_OK;
}

/* From the middle towards one end until the derivative has the sign that it must have there. */
static int other_sign(pm_workspace *w, pm_find_interval *within, double middle, double end, double sign,
                      double *x, double *value)
{
    double part = 0.5;
    for (int i = 0; i < PM_FIND_HALVINGS; i++, part *= 0.5) {
        *x = end + part * (middle - end);
        const int status = slope(w, *x, within, value);
        if (status || sign * *value > 0) return status;
    }
    *value = NAN;
    return PM_OK;
}

static double worse(double x, void *context)
{
    double goal;
    pm_workspace *w = context;
    return goal_at(w, x, &goal) ? NAN : -goal;
}

/* By values alone. */
static int corner(pm_workspace *w, double a, double b, pm_look *best)
{
    double fa, fb;
    int status = goal_at(w, a, &fa);
    if (!status) status = goal_at(w, b, &fb);
    if (status) return status;
    const pm_valley in = {a, -fa, best->x[0], -best->goal, b, -fb};
    double x; /* the best place counts, however close it is */
    pm_bracket_minimum(w->find->minimum, worse, w, &in, &(pm_closeness){PM_FIND_VALUES, 0, PM_FIND_CLOSE},
                       &x);
    return pm_find_look(w, &x, best);
}

int pm_find_extremum(pm_workspace *w, double a, double b, pm_look *best)
{
    pm_find_interval within = {a, b};
    pm_find_root_place place;
    double x1, s1, x2, s2;
    pm_look look;
    int status = other_sign(w, &within, best->x[0], a, 1, &x1, &s1);
    if (!status) status = other_sign(w, &within, best->x[0], b, -1, &x2, &s2);
    if (status) return status;
    if (isnan(s1) || isnan(s2)) return corner(w, a, b, best);
    status = pm_find_root(w, slope, &within, x1, s1, x2, s2, &place);
    if (!status) status = pm_find_look(w, &place.x, &look);
    if (status) return status;
    if (place.jumps || !(look.goal >= best->goal - PM_FIND_NOISE * fabs(best->goal)))
        return corner(w, a, b, best);
    *best = look;
    return PM_OK;
}
