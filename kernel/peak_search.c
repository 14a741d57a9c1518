/* peak_search.c - extremes of a value that the nodes of a step do not tell.
 *
 * Every interval where its rate changes sign is searched for the root of the rate (differences of the route's dense output),
 * and the value is taken on an exact state there; or it is searched by values alone. */
#include <math.h>

#include "crossing_sample.h"
#include "greater.h"
#include "minimum.h"
#include "peak.h"
#include "root.h"

#define RATE_STEP 2e-3 /* of the step: distance of the differences that make a rate */
#define PEAK_STEP 1e-4 /* of the step: distance of the differences that make the rate next to an extreme */
#define PEAK_STEPS 6   /* of Newton's method to an extreme */
#define SEARCHES 60    /* values that are compared where slopes do not tell */
#define CLOSE 1e-8     /* of the step: so near to an extreme its value is that */

static pm_switches *switches_of(const pm_peak *p) { return p->branch ? &p->branch->here : NULL; }

/* To the extreme of the value from near it, by Newton's method on the rate; the bend is at first the one given, then the
 * secant's.  0 if it does not stay between low and high. */
static int climb(pm_workspace *w, const pm_peak *p, double bend, double low, double high, double *s)
{
    pm_ask_watch x = {pm_ask_program(PM_ASK_ROW(w->model, p->ask)), 0, 0, switches_of(p)};
    double last = 0, from = *s;
    for (int i = 0; i < PEAK_STEPS; i++) {
        const double rate = p->sign *
                            (pm_ask_along(w, pm_peak_place(w, *s + PEAK_STEP), &x) -
                             pm_ask_along(w, pm_peak_place(w, *s - PEAK_STEP), &x)) /
                            (2 * PEAK_STEP);
        if (i > 0 && *s != from) bend = (rate - last) / (*s - from);
        const double shift = -rate / bend;
        if (!(bend < 0) || !(*s + shift > low && *s + shift < high)) return 0;
        last = rate;
        from = *s;
        *s += shift;
        if (fabs(rate * rate / bend) <= PM_PEAK_NOTHING * p->size) return 1;
    }
    return 0;
}

int pm_peak_refine(pm_workspace *w, const pm_peak *p, int k)
{
    const int32_t *e = PM_ASK_ROW(w->model, p->ask);
    if (k < 0 || k + 1 >= w->nodes->n) return PM_OK;
    const double begin = w->step_begin, h = w->sampled_end - begin;
    const double a = pm_crossing_node(w, k), b = pm_less(pm_crossing_node(w, k + 1), w->step_end);
    if (a >= b) return PM_OK;
    pm_ask_watch x = {pm_ask_program(e), 0, RATE_STEP * (w->step_end - begin), switches_of(p)};
    const double fa = pm_ask_along(w, a, &x), fb = pm_ask_along(w, b, &x);
    if (!(p->sign * fa > 0 && p->sign * fb < 0)) return PM_OK;
    const double bend = p->sign * (fb - fa) * h * h / (b - a);
    double s = (a + (b - a) * (fa / (fa - fb)) - begin) / h, t;
    const int climbs = !pm_ask_at_extreme(e) && /* there the place matters, not the value */
                       climb(w, p, bend, (a - begin) / h, (b - begin) / h, &s);
    t = pm_peak_place(w, s);
    int status = climbs ? PM_OK : pm_root_find(w, w->ask->solver, pm_ask_along, &x, a, fa, b, fb, &t);
    if (status == PM_SOLVER && !p->branch)
        w->ask->undefined[p->ask] = 1; /* it takes finite rates: there is none somewhere */
    if (status) return status == PM_SOLVER ? PM_OK : status;
    if ((status = pm_ask_look(w, t, 1))) return status;
    pm_peak_offer(w, p, pm_peak_value(w, p), 0);
    return PM_OK;
}

typedef struct pm_search {
    pm_workspace *w;
    const pm_peak *peak;
} pm_search;

static double depth(double s, void *context)
{
    const pm_search *x = context;
    return pm_ask_look(x->w, pm_peak_place(x->w, s), 1) ? NAN : -pm_peak_value(x->w, x->peak);
}

/* The look and the nodes beside it, or the better of these and those beside that; 0 if neither is a top. */
static int top_of_three(const pm_nodes *nodes, const double *g, const pm_rise *top, pm_valley *in)
{
    const double *at = nodes->at;
    int k = 0;
    while (k + 2 < nodes->n && at[k + 1] <= top->s) k++;
    *in = (pm_valley){at[k], -g[k], top->s, -top->value, at[k + 1], -g[k + 1]};
    if (top->value > g[k] && top->value > g[k + 1]) return 1;
    if (g[k + 1] > g[k]) k++;
    if (k == 0 || k + 1 == nodes->n) return 0;
    *in = (pm_valley){at[k - 1], -g[k - 1], at[k], -g[k], at[k + 1], -g[k + 1]};
    return g[k] > g[k - 1] && g[k] > g[k + 1];
}

int pm_peak_search(pm_workspace *w, const pm_peak *p, const pm_rise *top, int *found)
{
    pm_search context = {w, p};
    pm_valley in;
    *found = top_of_three(w->nodes, p->g, top, &in);
    if (!*found) return PM_OK;
    const double s =
        pm_minimum_find(w->ask->minimum, depth, &context, &in, &(pm_closeness){SEARCHES, CLOSE, 0});
    if (s > p->end) return PM_OK;
    const int status = pm_ask_look(w, pm_peak_place(w, s), 1);
    if (!status) pm_peak_offer(w, p, pm_peak_value(w, p), 0);
    return status;
}
