/* extremum_bound.c - extremes that no node of a step shows, by bounds (bounds.h), part by part of the step.
 *
 * A part whose bound is not above the best is left out; so is one along which the value only rises or falls, or bends up, but for
 * its ends.  One along which it bends down all the way has its one top by the rate.  What is left is halved.  What bounds have
 * above the best where no more is looked for counts as an error of the answer.
 *
 * A value that the nodes show is bounded by the polynomial through them: its tops lead to those of the value (extremum_rise.c), or,
 * where the polynomial does not tell the sign of the rate, looks do (extremum_search.c).  A value that may have more in a step
 * than its nodes show is bounded by its law. */
#include "events/extremum_bound.h"

#include <math.h>

#include "events/bounds.h"
#include "events/extremum_parts.h"
#include "events/step.h"
#include "events/waves.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* A part of the step that has to be halved. */
typedef struct pm_bound_part {
    double from, to, most;
} pm_bound_part;

typedef struct pm_bound_search {
    pm_workspace *w;
    pm_extremum *p;
    pm_bounds of;
    double residual;       /* so much more the value may have than what is bounded */
    double slow, straight; /* so small a rate, or bend, may have another sign than that of the value */
    double left_out;       /* the most that parts may have in which no more is looked for */
    int unsure;            /* something is asked of nodes that they do not tell */
    int n;
    pm_bound_part part[PM_BOUND_PARTS + 1];
    /* what it looks for in a part */
    int (*offer)(struct pm_bound_search *x, double from, double to, const pm_bound *bound);
} pm_bound_search;

/* ---- by the law ---- */
/* A place where the law has more than the best. */
static int offer_place(pm_workspace *w, pm_extremum *p, double s, double g)
{
    if (!isfinite(g)) return PM_OK;
    if (g <= p->best + p->nothing) {
        pm_extremum_skip(w->ask, p, g);
        return PM_OK;
    }
    const int status = pm_extremum_offer_at(w, p, pm_extremum_place(&w->step, s));
    p->best = pm_extremum_best(w->ask, p);
    return status;
}

/* Its ends and its middle, and the one top of a part along which the value bends down. */
static int offer_by_law(pm_bound_search *x, double from, double to, const pm_bound *bound)
{
    pm_workspace *w = x->w;
    int status = PM_OK;
    for (int k = 0; k < 3 && !status; k++)
        status = offer_place(w, x->p, from + 0.5 * k * (to - from), bound->at[k]);
    if (status || !(bound->smooth && bound->bend.hi < 0)) return status;
    const pm_extremum_slope a = pm_extremum_law_slope(w, x->p, from), b = pm_extremum_law_slope(w, x->p, to);
    return a.rate > 0 && b.rate < 0 ? pm_extremum_law_top(w, x->p, &a, &b) : PM_OK;
}

/* ---- by the polynomial ---- */
static double rate_of_fit(void *of, double s, void *context)
{
    const pm_workspace *w = of;
    const pm_extremum *const *p = context;
    double value;
    return pm_chebyshev_slope(w->step.nodes, (*p)->g, s, &value);
}

/* Newton's method may find another top next to it. */
static int top_of_fit(pm_workspace *w, const pm_extremum *p, double from, double to)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    const double a = rate_of_fit(w, from, &p), b = rate_of_fit(w, to, &p);
    double s;
    if (!(a > 0 && b < 0)) return PM_OK;
    const int status =
        pm_fail_search(&w->result, pm_bracket_find(w->ask->solver, rate_of_fit, w, &p, from, a, to, b, &s));
    if (status) return status;
    int k = pm_extremum_rise_interval(nodes, s);
    if (nodes->at[k + 1] - s < s - nodes->at[k]) k++;
    const pm_extremum_fit fit = pm_extremum_rise_fit(nodes, p, s);
    if (p->spectral) return pm_extremum_near(w, p, k, &fit);
    /* where something is asked at the extreme, and between few nodes */
    if (fit.value > p->best + p->nothing) return pm_extremum_search_part(w, p, from, to);
    pm_extremum_skip(w->ask, p, fit.value);
    return PM_OK;
}

static int has_been_met(const pm_extremum *p, double from, double to)
{
    for (int i = 0; i < p->ntop; i++)
        if (p->top[i] >= from && p->top[i] <= to) return 1;
    return 0;
}

/* The nodes do not tell the sign of the rate all along a part.  (What is told begins below that: no place is between both.) */
static int is_slow(const pm_bound_search *x, const pm_bound *bound)
{
    return pm_interval_size(bound->rate) <= 2 * x->slow;
}

/* The top of a part along which it bends down; or what looks show where its rate does not tell. */
static int offer_by_polynomial(pm_bound_search *x, double from, double to, const pm_bound *bound)
{
    const int bends_down = bound->bend.hi < -x->straight, unsure = is_slow(x, bound);
    if (!(bends_down || unsure) || (bends_down && has_been_met(x->p, from, to))) return PM_OK;
    if (bends_down) return top_of_fit(x->w, x->p, from, to);
    x->unsure = 1;
    return x->w->step.nodes->n < PM_NODES_MOST ? PM_OK : pm_extremum_search_part(x->w, x->p, from, to);
}

/* ---- part by part ---- */
/* Whether what is known of a part tells its greatest value. */
static int is_told(const pm_bound_search *x, const pm_bound *bound)
{
    const int keeps_its_way = bound->rate.lo > x->slow || bound->rate.hi < -x->slow,
              turns_once = bound->bend.hi < -x->straight || bound->bend.lo > x->straight;
    return bound->smooth && (keeps_its_way || turns_once || is_slow(x, bound));
}

/* No more is looked for where there is so little above the best. */
static int is_below(const pm_bound_search *x, double most)
{
    return most + x->residual <= x->p->best + x->p->nothing;
}

/* Bounds a part, and looks for tops in it; keeps it if it has to be halved. */
static int take_part(pm_bound_search *x, double from, double to)
{
    const pm_bound bound = pm_bounds_over(&x->of, from, to);
    if (!is_below(x, bound.most)) {
        const int status = x->offer(x, from, to, &bound);
        x->p->best = pm_extremum_best(x->w->ask, x->p);
        if (status || is_told(x, &bound)) return status;
        if (!is_below(x, bound.most) && to - from > PM_BOUND_LEAST) {
            x->part[x->n++] = (pm_bound_part){from, to, bound.most};
            return PM_OK;
        }
    }
    x->left_out = pm_max(bound.most, x->left_out);
    return PM_OK;
}

static int with_most(const pm_bound_search *x)
{
    int most = 0;
    for (int i = 1; i < x->n; i++)
        if (x->part[i].most > x->part[most].most) most = i;
    return most;
}

/* The part that may have most is halved, until none has more than the best, or there are too many. */
static int search(pm_bound_search *x, double from, double to)
{
    x->left_out = -INFINITY;
    x->n = 0;
    int status = take_part(x, from, to);
    for (int halvings = 0; x->n > 0 && !status; halvings++) {
        pm_bound_part *most = &x->part[with_most(x)], part = *most;
        if (is_below(x, part.most) || halvings == PM_BOUND_PARTS) {
            x->left_out = pm_max(part.most, x->left_out);
            break;
        }
        const double middle = 0.5 * (part.from + part.to);
        *most = x->part[--x->n];
        status = take_part(x, part.from, middle);
        if (!status) status = take_part(x, middle, part.to);
    }
    pm_extremum_skip(x->w->ask, x->p, x->left_out + x->residual);
    return status;
}

/* The value that such a polynomial shows rises all along the step, or falls; or it bends up, or down from a top that has been
 * met: no more is to be found inside. */
static int has_no_more(const pm_bound_search *x, double from, double to)
{
    const pm_chebyshev_series *series = &x->of.series;
    if (pm_chebyshev_series_least_rate(series) > x->slow) return 1;
    if (!(pm_chebyshev_series_least_bend(series) > x->straight)) return 0;
    return series->value[2] > 0 || has_been_met(x->p, from, to);
}

/* *unsure: the nodes do not tell all. */
static int search_samples(pm_workspace *w, pm_extremum *p, double from, double to, int *unsure)
{
    const int n = w->step.nodes->n;
    pm_bound_search x; /* parts are filled as they come */
    pm_chebyshev_series_begin(&x.of.series, w->step.nodes, p->g);
    pm_extremum_take_tail(w, p, x.of.series.high);
    *unsure = !(p->tail < PM_CHEBYSHEV_SMOOTH);
    if (*unsure) return n < PM_NODES_MOST ? PM_OK : pm_extremum_hidden_find(w, p);
    x.w = w;
    x.p = p;
    x.slow = p->slope_error;
    x.straight = n * n * p->slope_error;
    if (has_no_more(&x, from, to)) return PM_OK;
    x.of.w = w;
    x.of.sign = 1;
    x.of.program = PM_NONE;
    x.of.narrow = 1;
    pm_chebyshev_series_bends(&x.of.series, &x.of.bends);
    x.residual = PM_TAIL_RESIDUAL * p->tail * p->size;
    x.offer = offer_by_polynomial;
    x.unsure = 0;
    const int status = search(&x, from, to);
    *unsure = x.unsure;
    return status;
}

/* The same by as many nodes as there may be. */
static int search_finer(pm_workspace *w, pm_extremum *p, double from, double to)
{
    pm_ask_watch watch = {pm_ask_program(PM_ASK_ROW(w->model, p->ask)), 0, 0,
                          p->branch ? &p->branch->here : NULL};
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    pm_extremum finer = *p;
    int unsure, known = 1;
    w->step.nodes = &pm_chebyshev_nodes_17;
    for (int k = 0; k < PM_NODES_MOST && known; k++) {
        finer.g[k] = p->sign * pm_ask_along(w, pm_step_node(&w->step, k), &watch);
        known = isfinite(finer.g[k]);
    }
    finer.met = 0;
    const int status = known ? search_samples(w, &finer, from, to, &unsure) : PM_OK;
    w->step.nodes = nodes;
    return status;
}

int pm_extremum_bound_by_samples(pm_workspace *w, pm_extremum *p)
{
    const double *at = w->step.nodes->at, from = at[p->first], to = pm_min(at[p->last], p->end);
    int unsure;
    const int status = search_samples(w, p, from, to, &unsure);
    return status || !unsure || w->step.nodes->n == PM_NODES_MOST ? status : search_finer(w, p, from, to);
}

int pm_extremum_bound_by_law(pm_workspace *w, int ask)
{
    const double *sample = pm_ask_samples(w, ask);
    const double sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1;
    pm_extremum p = {.ask = ask, .sign = sign};
    pm_bound_search x;
    if (w->ask->undefined[ask] || !pm_extremum_law_known(w, ask)) return PM_OK;
    for (int k = 0; k < w->step.nodes->n; k++) p.size = pm_max(fabs(sample[k]), p.size);
    p.best = sign * w->ask->best[ask];
    p.nothing = pm_extremum_nothing(w, p.size);
    x.w = w;
    x.p = &p;
    x.of.w = w;
    x.of.sign = sign;
    x.of.program = pm_ask_program(PM_ASK_ROW(w->model, ask));
    x.residual = x.slow = x.straight = 0;
    x.offer = offer_by_law;
    return search(&x, 0, (w->step.end - w->step.begin) / (w->step.sampled_end - w->step.begin));
}
