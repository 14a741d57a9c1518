/* extremum.c - extremes of watched values inside a step: which nodes they are beside, and who finds them (extremum_parts.h). */
#include <math.h>

#include "events/ask.h"
#include "events/extremum.h"
#include "events/extremum_parts.h"
#include "events/step.h"
#include "events/watched_samples.h"
#include "events/waves.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* ---- beside a node ---- */
/* Whether node k is as good as the extreme at x right beside it. */
static int is_at_node(const pm_step *step, struct pm_ask_set *ask, const pm_extremum *p, int k,
                      const pm_extremum_fit *x)
{
    const int n = step->nodes->n, at_end = k == 0 || k + 1 == n;
    if (n * n * fabs(x->s - step->nodes->at[k]) > PM_EXTREMUM_NEAR) return 0;
    const double slope = fabs(pm_chebyshev_slope_at(step->nodes, p->g, k));
    const double error = (at_end ? PM_EXTREMUM_END_TAIL / PM_EXTREMUM_SLOPE_TAIL : 1) * p->slope_error;
    const double half = -(1 + PM_EXTREMUM_NEAR) * 0.5 / x->bend,
                 most = p->g[k] + half * (slope + error) * (slope + error);
    const double likely = slope + PM_EXTREMUM_LIKELY * error;
    if (pm_max(most, x->value) > p->best + p->nothing) return 0;
    pm_extremum_skip(ask, p, p->g[k] + half * likely * likely);
    return 1;
}

int pm_extremum_near(pm_workspace *w, const pm_extremum *p, int k, const pm_extremum_fit *x)
{
    if (x->bend < 0) {
        const double residual =
            PM_TAIL_RESIDUAL * p->tail * p->size * fabs(x->w) - 0.5 * x->slope * x->slope / x->bend;
        if (is_at_node(&w->step, w->ask, p, k, x)) return PM_OK;
        if (x->value + residual <= p->best + p->nothing) {
            pm_extremum_skip(w->ask, p, x->value + residual);
            return PM_OK;
        }
        int found;
        const int status =
            pm_extremum_rise_climb(w, p, pm_extremum_rise_side(w->step.nodes, k, x->s), x, &found);
        if (status || found) return status;
    }
    const int status = pm_extremum_search_root(w, p, k - 1);
    return status ? status : pm_extremum_search_root(w, p, k);
}

/* Where the parabola through node k, which is better than those beside it, is greatest: at an end of the step, the one with
 * the slope there.  NaN if the value falls off there. */
static double vertex(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k)
{
    const double *at = nodes->at, *g = p->g;
    if (k > 0 && k + 1 < nodes->n) {
        const double h = at[k] - at[k - 1], j = at[k + 1] - at[k];
        const double left = (g[k] - g[k - 1]) / h, right = (g[k + 1] - g[k]) / j;
        const double slope = (left * j + right * h) / (h + j), bend = 2 * (right - left) / (h + j);
        return at[k] - slope / bend;
    }
    const int in = k > 0 ? k - 1 : 1;
    const double h = at[in] - at[k], slope = pm_chebyshev_slope_at(nodes, g, k);
    if (slope * h <= -PM_EXTREMUM_END_TAIL / PM_EXTREMUM_SLOPE_TAIL * p->slope_error * fabs(h)) return NAN;
    const double bend = 2 * (g[in] - g[k] - slope * h) / (h * h);
    return at[k] - slope / bend;
}

/* Extremes are beside nodes that are better than both nodes next to them: a wave that none shows would not be resolved.
 * They rise above them by less than those fall off to the nodes next to them.  The first such node from k on that may beat
 * the best, by `wide` times as much, and is not beyond the end of the step; or n. */
static int next_top(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k, double wide)
{
    const double *g = p->g;
    const int n = nodes->n;
    for (k = k > p->first ? k : p->first; k <= p->last; k++) {
        const double here = g[k], before = k > 0 ? g[k - 1] : g[1], after = k + 1 < n ? g[k + 1] : g[n - 2];
        if (!(here > before && here >= after)) continue;
        const double fall = here - pm_min(before, after);
        if (here + wide * fall > p->best && (k == 0 || nodes->at[k - 1] < p->end)) return k;
    }
    return n;
}

static int extremes_of_samples(pm_workspace *w, pm_extremum *p)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    for (int k = 0; (k = next_top(nodes, p, k, 1)) < nodes->n; k++) {
        const double s = vertex(nodes, p, k);
        if (isnan(s)) continue;
        const pm_extremum_fit x = pm_extremum_rise_top(nodes, p, k, s);
        if (x.s <= p->end) p->top[p->ntop++] = x.s;
        const int status = pm_extremum_near(w, p, k, &x);
        if (status) return status;
        p->best = pm_extremum_best(w->ask, p);
    }
    return PM_OK;
}

/* Between node k and the next, where the samples show the slopes only roughly. */
static int extreme_beside_top(pm_workspace *w, const pm_extremum *p, int k, double spread)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    if (p->law) return pm_extremum_search_root(w, p, k);
    const double flat = PM_EXTREMUM_FLAT * spread / (nodes->at[k + 1] - nodes->at[k]);
    const double a = pm_chebyshev_slope_at(nodes, p->g, k), b = pm_chebyshev_slope_at(nodes, p->g, k + 1);
    if (a < -flat || b > flat || pm_step_node(&w->step, k) >= w->step.end) return PM_OK;
    if (p->tail < PM_EXTREMUM_SHARP && a > 0 && b < 0) {
        const double low = nodes->at[k], high = nodes->at[k + 1];
        const pm_extremum_fit x = pm_extremum_rise_top(nodes, p, k, low + (high - low) * (a / (a - b)));
        int found = 0, status = PM_OK;
        if (x.bend < 0)
            status = pm_extremum_rise_climb(w, p, pm_extremum_rise_side(nodes, k, x.s), &x, &found);
        if (status || found) return status;
    }
    return pm_extremum_search_root(w, p, k); /* a corner, too */
}

/* The best of the nodes, by its value; where something else is asked at the extreme, or its error, look again. */
static int offer_node(pm_workspace *w, const pm_extremum *p, int top)
{
    if (p->g[top] <= p->sign * w->ask->best[p->ask]) return PM_OK;
    const int looks = pm_ask_at_extreme(PM_ASK_ROW(w->model, p->ask)) || w->evidence.active;
    const int status = looks ? pm_ask_look(w, pm_step_node(&w->step, top), 1) : PM_OK;
    if (!status) pm_ask_offer(w, p->ask, p->sign * p->g[top], 0);
    return status;
}

static int extremes_between_slopes(pm_workspace *w, pm_extremum *p, double spread)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    for (int k = 0; (k = next_top(nodes, p, k, PM_EXTREMUM_WIDE)) < nodes->n; k++) {
        p->met |= (k > 0 ? 3u << (k - 1) : 1u);
        int status = k > 0 ? extreme_beside_top(w, p, k - 1, spread) : PM_OK;
        if (!status && k + 1 < nodes->n) status = extreme_beside_top(w, p, k, spread);
        if (status) return status;
        p->best = pm_extremum_best(w->ask, p);
    }
    return PM_OK;
}

int pm_extremum_find(pm_workspace *w, pm_extremum *p, int top, double spread)
{
    /* an extreme between the nodes exceeds them by no more than their spread */
    if (spread <= PM_EXTREMUM_LEVEL * p->size || p->g[top] + spread < p->best) return PM_OK;
    p->tail = INFINITY;
    p->met = 0;
    p->ntop = 0;
    if (p->spectral) pm_extremum_take_tail(w, p, pm_chebyshev_high(w->step.nodes, p->g));
    if (!p->branch && w->ask->switches[p->ask] > 0 &&
        p->tail > (w->ask->dips[p->ask] ? PM_EXTREMUM_DIPS : 0)) {
        int taken;
        const int status = pm_extremum_branch_all(w, p, &taken);
        if (status || taken) return status;
    }
    const int smooth = p->spectral && p->tail < (p->law ? PM_TAIL_RESOLVED : PM_CHEBYSHEV_SMOOTH);
    if (!smooth && p->law) p->tail = INFINITY;
    const int status = smooth ? extremes_of_samples(w, p) : extremes_between_slopes(w, p, spread);
    return status || p->bounded ? status : pm_extremum_bound_by_samples(w, p);
}

/* How many nodes are not beyond the end of the step, which may have been shortened. */
static int nodes_inside(const pm_step *step)
{
    int n = step->nodes->n;
    while (step->end < step->sampled_end && n > 1 && pm_step_node(step, n - 1) > step->end) n--;
    return n;
}

int pm_extremum_take(pm_workspace *w, int ask)
{
    const double *sample = pm_ask_samples(w, ask);
    pm_extremum p = {.ask = ask,
                     .sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1,
                     .last = w->step.nodes->n - 1,
                     .spectral = pm_chebyshev_nodes_spectral(w->step.nodes) &&
                                 !pm_ask_at_extreme(PM_ASK_ROW(w->model, ask))};
    p.bounded = pm_extremum_law_known(w, ask);
    p.law = p.spectral && p.bounded && pm_waves_may_be(w, pm_ask_program(PM_ASK_ROW(w->model, ask)));
    const int inside = nodes_inside(&w->step);
    double least = INFINITY;
    int top = 0, top_inside = 0;
    for (int k = 0; k < w->step.nodes->n; k++) {
        const double g = p.g[k] = p.sign * sample[k];
        if (isnan(g)) {
            w->ask->undefined[ask] = 1;
            return PM_OK;
        }
        if (g < least) least = g;
        if (g > p.g[top]) top = k;
        if (k < inside) top_inside = top;
    }
    p.size = pm_max(fabs(least), fabs(p.g[top]));
    p.end = (w->step.end - w->step.begin) / (w->step.sampled_end - w->step.begin);
    const double best = p.sign * w->ask->best[ask];
    p.best = best > p.g[top_inside] ? best : p.g[top_inside];
    const int status = pm_extremum_find(w, &p, top, p.g[top] - least);
    return status ? status : offer_node(w, &p, top_inside);
}

int pm_extremum_end_counts(pm_workspace *w, int ask)
{
    const double *value = pm_ask_samples(w, ask);
    const double sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1;
    const int inside = nodes_inside(&w->step), from = inside > 1 ? inside - 2 : 0;
    double best = sign * w->ask->best[ask], low = INFINITY, high = -INFINITY;
    for (int k = 0; k < inside; k++)
        if (!(sign * value[k] <= best)) best = sign * value[k];
    for (int k = from; k < w->step.nodes->n && k <= inside + 1; k++) {
        low = pm_min(low, sign * value[k]);
        high = pm_max(high, sign * value[k]);
    }
    const double next =
        pm_max(sign * value[inside - 1], inside < w->step.nodes->n ? sign * value[inside] : -INFINITY);
    return !(next + (high - low) <= best);
}
