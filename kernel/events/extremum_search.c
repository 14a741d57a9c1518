/* extremum_search.c - extremes of a value that the nodes of a step do not resolve.
 *
 * Every interval where its rate changes sign is searched for the root of the rate (differences of the route's dense output),
 * and the value is taken on an exact state there. */
#include <math.h>

#include "elements/force_action_slope.h"
#include "events/extremum_parts.h"
#include "events/step.h"
#include "expression/program_class.h"
#include "numerics/bracket.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* The value along the step, or its rate by differences over so much of it. */
static pm_ask_watch watch_of(const pm_workspace *w, const pm_extremum *p, double step)
{
    return (pm_ask_watch){pm_ask_program(PM_ASK_ROW(w->model, p->ask)), 0,
                          step * (w->step.end - w->step.begin), p->branch ? &p->branch->here : NULL};
}

/* To the extreme of the value from near it, by Newton's method on the rate; the bend is at first the one given, then the
 * secant's.  0 if it does not stay between low and high. */
static int climb(pm_workspace *w, const pm_extremum *p, double bend, double low, double high, double *s)
{
    pm_ask_watch x = watch_of(w, p, 0);
    double last = 0, from = *s;
    for (int i = 0; i < PM_EXTREMUM_STEPS; i++) {
        const double rate = p->sign *
                            (pm_ask_along(w, pm_extremum_place(&w->step, *s + PM_EXTREMUM_NEAR_STEP), &x) -
                             pm_ask_along(w, pm_extremum_place(&w->step, *s - PM_EXTREMUM_NEAR_STEP), &x)) /
                            (2 * PM_EXTREMUM_NEAR_STEP);
        if (i > 0 && *s != from) bend = (rate - last) / (*s - from);
        const double shift = -rate / bend;
        if (!(bend < 0) || !(*s + shift > low && *s + shift < high)) return 0;
        last = rate;
        from = *s;
        *s += shift;
        if (fabs(rate * rate / bend) <= PM_EXTREMUM_NOTHING * p->size) return 1;
    }
    return 0;
}

static pm_extremum_slope slope_here(pm_workspace *w, const pm_extremum *p, double s)
{
    const double t = pm_extremum_place(&w->step, s), h = w->step.sampled_end - w->step.begin;
    pm_ask_watch value = watch_of(w, p, 0), rate = watch_of(w, p, PM_EXTREMUM_RATE_STEP);
    return (pm_extremum_slope){s, p->sign * pm_ask_along(w, t, &value),
                               p->sign * h * pm_ask_along(w, t, &rate)};
}

/* The rate of a program of places at t, by its derivatives and the velocities: differences round what they are of. */
static double rate_of_places(pm_workspace *w, int program, double t)
{
    pm_slope *by = &w->ask->slope;
    double rate = 0;
    if (pm_ask_look(w, t, 1)) return NAN;
    pm_slope_clear(by);
    pm_force_add_program(w, program, 1, by);
    for (int i = 0; i < 3 * by->n; i++) {
        const int k = 3 * by->body[i / 3] + i % 3;
        rate += by->q[k] * w->frame.v[k];
    }
    return rate;
}

/* From t to the root of the rate, by a step of Newton's method with rates so far apart. */
static double shift_by_rates(pm_workspace *w, int program, double t, double apart)
{
    const double before = rate_of_places(w, program, t - apart), here = rate_of_places(w, program, t),
                 after = rate_of_places(w, program, t + apart);
    return -2 * apart * here / (after - before);
}

static double shift_by_values(pm_workspace *w, pm_ask_watch *x, double t, double apart)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280}; /* central, order 8 */
    const double here = pm_ask_along(w, t, x);
    double rate = 0, bend = 0;
    for (int k = 1; k <= 4; k++) {
        const double before = pm_ask_along(w, t - k * apart, x), after = pm_ask_along(w, t + k * apart, x);
        rate += weight[k - 1] * (after - before);
        bend += (after - here - (here - before)) / (4.0 * k * k);
    }
    return -apart * rate / bend;
}

/* Where something is asked at the extreme the place matters, not the value: t, where the rate by five values is zero, is put
 * right by a step of Newton's method with the rate as it is known, or by nine values. */
static double put_right(pm_workspace *w, const pm_extremum *p, double t)
{
    const pm_step *step = &w->step;
    pm_ask_watch x = watch_of(w, p, 0);
    const double d = PM_EXTREMUM_RATE_STEP * (step->end - step->begin);
    if (t - 4 * d < step->begin || t + 4 * d > step->sampled_end) return t;
    const int of_places = w->model->programs.class[x.program] == PM_CLASS_PLACE;
    const double shift = of_places ? shift_by_rates(w, x.program, t, d) : shift_by_values(w, &x, t, d);
    return fabs(shift) < d ? t + shift : t;
}

/* The root of the rate. */
static int top_between(pm_workspace *w, const pm_extremum *p, const pm_extremum_slope *a,
                       const pm_extremum_slope *b)
{
    pm_ask_watch x = watch_of(w, p, PM_EXTREMUM_RATE_STEP);
    const double bend = (b->rate - a->rate) / (b->s - a->s);
    const double near = pm_extremum_hidden_cubic(a, b);
    double s = isnan(near) ? a->s - a->rate / bend : near, t;
    const int place_matters = pm_ask_at_extreme(PM_ASK_ROW(w->model, p->ask));
    const int climbs = !place_matters && climb(w, p, bend, a->s, b->s, &s);
    t = pm_extremum_place(&w->step, s);
    const double unit =
        p->sign / (w->step.sampled_end - w->step.begin); /* the rate in time, of the value as it is */
    const int end =
        climbs ? PM_SEARCH_FOUND
               : pm_bracket_find(w->ask->solver, pm_ask_along, w, &x, pm_extremum_place(&w->step, a->s),
                                 unit * a->rate, pm_extremum_place(&w->step, b->s), unit * b->rate, &t);
    if (end == PM_SEARCH_NO_NUMBER) {
        if (!p->branch) w->ask->undefined[p->ask] = 1; /* it takes finite rates: there is none somewhere */
        return PM_OK;
    }
    const int status = pm_fail_search(&w->result, end);
    if (status) return status;
    return pm_extremum_offer_at(w, p, place_matters ? put_right(w, p, t) : t);
}

int pm_extremum_search_part(pm_workspace *w, const pm_extremum *p, double from, double to)
{
    static const pm_extremum_curve in_looks = {slope_here, top_between},
                                   by_law = {pm_extremum_law_slope, pm_extremum_law_top};
    const pm_extremum_curve *x = p->law ? &by_law : &in_looks;
    const double end = pm_min(to, p->end);
    if (from >= end) return PM_OK;
    const pm_extremum_slope a = x->slope(w, p, from), b = x->slope(w, p, end);
    return pm_extremum_hidden_tops(w, p, x, &a, &b, PM_HIDDEN_PARTINGS);
}

int pm_extremum_search_root(pm_workspace *w, const pm_extremum *p, int k)
{
    const double *at = w->step.nodes->at;
    return k < 0 || k + 1 >= w->step.nodes->n ? PM_OK : pm_extremum_search_part(w, p, at[k], at[k + 1]);
}
