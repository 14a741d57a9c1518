/* rk_error.c - which error of a step is allowed, and how much of it a step has.
 *
 * Errors of lengths count against the scene's size, of angles against 1 rad (they grow with every revolution), of
 * speeds against its speed. */
#include <math.h>

#include "equations/ledger.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/rk/rk.h"
#include "state/workspace.h"
#include "tree/tree.h"

void pm_rk_set_scale(pm_workspace *w)
{
    const pm_model *m = w->model;
    struct pm_rk *r = w->rk;
    /* in independent coordinates the others are found by closing loops: there errors of the place count,
     * too */
    const int on_level = r->level.kept && w->tree->n - w->tree->nloop == 1 && !w->tree->part.few;
    const double tolerance = r->tolerance =
        fmax((on_level ? PM_RK_LEVEL_MARGIN : PM_RK_MARGIN) * w->numbers.tolerance, PM_RK_TIGHTEST);
    for (int i = 0; i < r->n; i++) {
        const int angle = pm_tree_is_angle(w->tree, i);
        r->scale[i] = 1 / (tolerance * (angle ? 1 : w->numbers.size));
        r->scale[r->n + i] =
            1 / (tolerance * (angle ? w->numbers.speed / w->numbers.size : w->numbers.speed));
    }
    for (int i = 0; i < m->nz_controlled; i++)
        r->scale[2 * r->n + i] = 1 / (tolerance * pm_ledger_controlled_scale(&w->frame, i));
}

static double speed_at_end(const pm_workspace *w)
{
    const struct pm_rk *r = w->rk;
    double fastest = 0;
    for (int i = 0; i < r->n; i++)
        fastest =
            pm_max(fabs(r->y[r->n + i]) * (pm_tree_is_angle(w->tree, i) ? w->numbers.size : 1), fastest);
    return fastest;
}

/* Far away from where places are counted, and after many turns, the allowed error may be less than their rounding. */
static double place_rounding(const pm_workspace *w)
{
    const struct pm_rk *r = w->rk;
    double most = 0;
    for (int i = 0; i < r->n; i++) {
        const double place = fabs(r->y0[i]) + fabs(r->y[i]);
        if (place > PM_RK_FAR * pm_tree_scale(w->tree, &w->numbers, i))
            most = pm_max(r->scale[i] * place, most);
    }
    return PM_RK_PLACE_ROUNDED * most;
}

static double error_over_allowed(const pm_workspace *w, double h)
{
    double error = pm_rk_error(w->rk, h, 0);
    if (error > PM_RK_STEADY) {
        const double time = error > 1 ? pm_rk_time_rounding(w, h) : 0,
                     rounding = fmax(time, place_rounding(w));
        if (rounding > 0) error = pm_rk_error(w->rk, h, rounding);
    }
    return error <= 1 ? fmax(pm_rk_time_error(w, h), error) : error;
}

/* A motion that begins from rest has a speed at the end of the step: that counts. */
static double error_of_motion(pm_workspace *w, double h)
{
    const double error = error_over_allowed(w, h), speed = w->numbers.speed;
    if (!(error > 1)) return error;
    const double at_end = speed_at_end(w);
    if (!(at_end > PM_RK_FROM_REST * speed)) return error;
    w->numbers.speed = at_end;
    pm_rk_set_scale(w);
    const double then = error_over_allowed(w, h);
    w->numbers.speed = speed;
    pm_rk_set_scale(w);
    return then;
}

/* How far the step went in the coordinates that are much faster at its end: angles alone in rad, or lengths by the scene's size, too. */
static double way_of(const pm_workspace *w, int angles)
{
    const struct pm_rk *r = w->rk;
    const double *rate = r->y + r->n, *rate0 = r->y0 + r->n;
    double most = 0;
    for (int i = 0; i < r->n; i++)
        if ((!angles || pm_tree_is_angle(w->tree, i)) && fabs(rate[i]) > PM_RK_GROWN * fabs(rate0[i]))
            most = pm_max(fabs(r->y[i] - r->y0[i]) / pm_tree_scale(w->tree, &w->numbers, i), most);
    return most;
}

/* Which length of step is left of it goes by the error: in order 8. */
static double eighth_power(double x)
{
    const double square = x * x, fourth = square * square;
    return fourth * fourth;
}

/* What was at rest, or slow, may have gone far at the end of a step, where its rates at the begin did not limit that: no farther than
 * a step that is sampled may go.  Reactions, whose integrals check the run, turn with it; they may err with the tolerance. */
static double way_over_allowed(const pm_workspace *w)
{
    const double moved = pm_rk_is_sampled(w) ? way_of(w, 0) / (PM_RK_MOST_MOVED * w->numbers.coarse) : 0,
                 turned = w->rk->ledger && w->active.n > 0 ? way_of(w, 1) / PM_RK_MOST_TURNED : 0,
                 loose = fmax(PM_LEDGER_ERRORS * w->numbers.tolerance / PM_LEDGER_ROUNDING, 1);
    return fmax(moved > 1 ? eighth_power(moved) : 0, turned > 1 ? eighth_power(turned) / loose : 0);
}

double pm_rk_step_error(pm_workspace *w, double h)
{
    const double error = error_of_motion(w, h);
    return error <= 1 ? fmax(way_over_allowed(w), error) : error; /* NaN stays */
}
