/* extremum_hidden.c - extremes that no node of a step shows.
 *
 * A top and a dip may have hardly parted, and a top may be right before the end of a step that was shortened, which is no
 * node, or have but its dip there.  There nodes next to each other are nearly alike, or the step begins or ends; such tops
 * rise above the nodes by no more than those differ about them.  The polynomial through the nodes shows them, or the rates
 * there do.
 *
 * A top and a dip that have parted by less than the distance of the nodes may both lie between two places where the value
 * rises, or between two where it falls.  The cubic that has both values and rates shows them: then the value is asked for on
 * both sides of its top, and so on in all parts. */
#include <math.h>

#include "events/extremum_parts.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* ---- between two places ---- */
double pm_extremum_hidden_cubic(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    const double h = b->s - a->s, secant = (b->g - a->g) / h;
    const double c = (3 * secant - 2 * a->rate - b->rate) / h, d = (a->rate + b->rate - 2 * secant) / (h * h);
    const double root = sqrt(c * c - 3 * d * a->rate); /* its rate is a->rate + 2 c x + 3 d x^2 */
    const double s = a->s + (c > 0 ? -(c + root) / (3 * d) : a->rate / (root - c));
    return s > a->s && s < b->s ? s : NAN;
}

static int falls(const pm_extremum_slope *a, const pm_extremum_slope *b)
{
    return a->rate > 0 && b->rate < 0;
}

int pm_extremum_hidden_tops(pm_workspace *w, const pm_extremum *p, const pm_extremum_curve *x,
                            const pm_extremum_slope *a, const pm_extremum_slope *b, int partings)
{
    if (falls(a, b)) return x->top(w, p, a, b);
    if (partings == 0 || (a->rate < 0 && b->rate > 0)) return PM_OK;
    const double makes = (b->s - a->s) * pm_max(fabs(a->rate), fabs(b->rate));
    const double s = pm_extremum_hidden_cubic(a, b);
    if (isnan(s) || !(makes > PM_EXTREMUM_LEVEL * p->size)) return PM_OK;
    const pm_extremum_slope left = x->slope(w, p, 0.5 * (a->s + s)), right = x->slope(w, p, 0.5 * (s + b->s));
    int status = pm_extremum_hidden_tops(w, p, x, a, &left, partings - 1);
    if (!status) status = pm_extremum_hidden_tops(w, p, x, &left, &right, partings - 1);
    return status ? status : pm_extremum_hidden_tops(w, p, x, &right, b, partings - 1);
}

/* ---- between two nodes ---- */
static pm_extremum_slope slope_of_fit(pm_workspace *w, const pm_extremum *p, double s)
{
    pm_extremum_slope x = {.s = s};
    x.rate = pm_chebyshev_slope(w->step.nodes, p->g, s, &x.g);
    return x;
}

static double rate_of_fit(void *of, double s, void *context)
{
    pm_workspace *w = of;
    const pm_extremum *const *p = context;
    return slope_of_fit(w, *p, s).rate;
}

/* The polynomial's top, inside its bracket: Newton's method may find another one next to it. */
static int top_of_fit(pm_workspace *w, const pm_extremum *p, const pm_extremum_slope *a,
                      const pm_extremum_slope *b)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    double s;
    const int status = pm_fail_search(
        &w->result, pm_bracket_find(w->ask->solver, rate_of_fit, w, &p, a->s, a->rate, b->s, b->rate, &s));
    if (status) return status;
    int k = pm_extremum_rise_interval(nodes, s);
    if (nodes->at[k + 1] - s < s - nodes->at[k]) k++;
    const pm_extremum_fit x = pm_extremum_rise_fit(nodes, p, s);
    return pm_extremum_near(w, p, k, &x);
}

/* The first node from k on with a hidden top between it and the next that may beat the best; or n. */
static int next_hidden(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k)
{
    const double *g = p->g, above = p->best + p->nothing;
    const int n = nodes->n;
    double before = k > 0 ? fabs(g[k] - g[k - 1]) : 0, here = k + 1 < n ? fabs(g[k + 1] - g[k]) : 0, after;
    for (; k + 1 < n && nodes->at[k] < p->end; k++, before = here, here = after) {
        after = k + 2 < n ? fabs(g[k + 2] - g[k + 1]) : 0;
        const double rise = pm_max(here, pm_max(before, after));
        if (!(pm_max(g[k], g[k + 1]) + rise > above)) continue;
        const int rises_again = k + 2 < n && nodes->at[k + 2] > p->end && g[k + 2] > g[k + 1];
        if (nodes->at[k + 1] > p->end || rises_again ||
            pm_min(here, pm_min(before, after)) <= PM_HIDDEN_ALIKE * rise)
            return k;
    }
    return n;
}

int pm_extremum_hidden_possible(const pm_chebyshev_nodes *nodes, const pm_extremum *p)
{
    return next_hidden(nodes, p, 0) < nodes->n;
}

/* The polynomial at a node, or at the end of a step before it. */
static pm_extremum_slope slope_at_node(pm_workspace *w, const pm_extremum *p, int k)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    if (nodes->at[k] > p->end) return slope_of_fit(w, p, p->end);
    return (pm_extremum_slope){nodes->at[k], p->g[k], pm_chebyshev_slope_at(nodes, p->g, k)};
}

/* Whether the nodes do not resolve the slope at one place, nor, by the cubic through both, that it bends as a top does. */
static int is_level(const pm_extremum *p, const pm_extremum_slope *here, const pm_extremum_slope *other)
{
    const double h = other->s - here->s;
    const double bend = (6 * (other->g - here->g) / h - 4 * here->rate - 2 * other->rate) / h;
    return fabs(here->rate) <= p->slope_error && bend * fabs(h) > -PM_HIDDEN_BEND * fabs(other->rate);
}

/* Between node k and the next. */
static int hidden_between(pm_workspace *w, const pm_extremum *p, int k)
{
    static const pm_extremum_curve by_polynomial = {slope_of_fit, top_of_fit};
    const int met = p->met >> k & 1;
    if (!(p->tail < PM_CHEBYSHEV_SMOOTH)) return met ? PM_OK : pm_extremum_search_root(w, p, k);
    const pm_extremum_slope a = slope_at_node(w, p, k), b = slope_at_node(w, p, k + 1);
    if (is_level(p, &a, &b) || is_level(p, &b, &a)) return pm_extremum_search_root(w, p, k);
    if (met && w->step.nodes->at[k + 1] <= p->end && falls(&a, &b)) return PM_OK;
    return pm_extremum_hidden_tops(w, p, &by_polynomial, &a, &b, PM_HIDDEN_PARTINGS);
}

int pm_extremum_hidden_find(pm_workspace *w, pm_extremum *p)
{
    const int n = w->step.nodes->n;
    for (int k = 0; (k = next_hidden(w->step.nodes, p, k)) < n; k++) {
        const int status = hidden_between(w, p, k);
        if (status) return status;
        p->best = pm_extremum_best(w->ask, p);
    }
    return PM_OK;
}
