/* extremum_rise.c - extremes of a value that the nodes s_k of a step resolve nearly: they are near those of the polynomial p
 * through them,
 *
 *   g = p + w h,    w(s) = prod (s - s_k),    e = g - p = w h
 *
 * (Berrut and Trefethen, SIAM Rev. 46, 2004).  An exact look at x gives e there, and x becomes one more node: then
 *
 *   g'(x) = p'(x) + e w'/w + w h',    the extreme is at x - g' / g'', g'^2 / 2 |g''| above g(x)
 *
 * and w h', no more than some n e, is the error that is left.  More looks are taken until it is too small to matter. */
#include <math.h>

#include "events/extremum_parts.h"
#include "numerics/lanes.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

#define LOOKS 6 /* that are taken in as nodes */

/* Exact looks, each with what the polynomial through the nodes and the looks before was off by. */
typedef struct pm_extremum_looks {
    int n;
    double s[LOOKS], off[LOOKS], w[LOOKS];
} pm_extremum_looks;

/* s, but not so near to a node that it would show nothing more. */
static double beside(const pm_chebyshev_nodes *nodes, int k, double s)
{
    const double low = nodes->at[k] + PM_RISE_BESIDE, high = nodes->at[k + 1] - PM_RISE_BESIDE;
    return s < low ? low : s > high ? high : s;
}

/* Of p = N / D, N = sum c_k g_k, D = sum c_k, c_k = w_k / (s - s_k), for s between node k and the next; w_k alternate, and
 * are half as much at the ends.  Two nodes at a time. */
static pm_extremum_fit fit(const pm_chebyshev_nodes *nodes, const double *g, int k, double s)
{
    const double from = s - nodes->at[k] < nodes->at[k + 1] - s ? g[k] : g[k + 1];
    const int last = nodes->n - 1;
    pm_lanes n0 = {0, 0}, n1 = n0, n2 = n0, d0 = n0, d1 = n0, d2 = n0, weight = {0.5, -1};
    for (int i = 0; i <= last; i += 2) {
        const int alone = i == last;
        const pm_lanes at = {nodes->at[i], alone ? s - 1 : nodes->at[i + 1]};
        const pm_lanes value = {g[i] - from, alone ? 0 : g[i + 1] - from};
        if (alone) weight = (pm_lanes){0.5, 0};
        const pm_lanes inverse = 1 / (s - at), c0 = weight * inverse, c1 = c0 * inverse, c2 = c1 * inverse;
        n0 += c0 * value;
        n1 += c1 * value;
        n2 += c2 * value;
        d0 += c0;
        d1 += c1;
        d2 += c2;
        weight[0] = 1;
    }
    const double below = pm_lanes_sum(d0), first = pm_lanes_sum(d1);
    pm_extremum_fit x = {
        .s = s, .value = pm_lanes_sum(n0) / below, .pull = first / below, .w = 2 * last / below};
    x.slope = (x.value * first - pm_lanes_sum(n1)) / below;
    x.bend = 2 * (pm_lanes_sum(n2) + x.slope * first - x.value * pm_lanes_sum(d2)) / below;
    x.value += from;
    return x;
}

int pm_extremum_rise_side(const pm_chebyshev_nodes *nodes, int k, double s)
{
    return k > 0 && (s < nodes->at[k] || k + 1 == nodes->n) ? k - 1 : k;
}

int pm_extremum_rise_interval(const pm_chebyshev_nodes *nodes, double s)
{
    int k = 0;
    while (k + 2 < nodes->n && nodes->at[k + 1] <= s) k++;
    return k;
}

pm_extremum_fit pm_extremum_rise_fit(const pm_chebyshev_nodes *nodes, const pm_extremum *p, double s)
{
    const int k = pm_extremum_rise_interval(nodes, s);
    return fit(nodes, p->g, k, beside(nodes, k, s));
}

pm_extremum_fit pm_extremum_rise_top(const pm_chebyshev_nodes *nodes, const pm_extremum *p, int k, double s)
{
    s = beside(nodes, pm_extremum_rise_side(nodes, k, s), s);
    for (int i = 0;; i++) {
        const pm_extremum_fit x = fit(nodes, p->g, pm_extremum_rise_side(nodes, k, s), s);
        const double known = pm_max(p->slope_error, sqrt(p->nothing * fabs(x.bend)));
        if (!(x.bend < 0) || fabs(x.slope) <= known || i == PM_EXTREMUM_STEPS) return x;
        const double next = s - x.slope / x.bend;
        s = beside(nodes, pm_extremum_rise_side(nodes, k, next), next);
        if (s == x.s) return x;
    }
}

/* Takes the looks in as nodes: their part of value and slope. */
static void correct(const pm_extremum_looks *looks, pm_extremum_fit *x)
{
    double slope = 0, w = x->w, pull = x->pull;
    for (int i = 0; i < looks->n; i++) {
        const double part = looks->off[i] * w / looks->w[i], away = x->s - looks->s[i];
        x->value += part;
        slope += part * pull;
        w *= away;
        pull += 1 / away;
    }
    x->slope += slope;
    x->w = w;
    x->pull = pull;
}

/* The frame looks at x->s. */
static int take_look(pm_workspace *w, const pm_extremum *p, const pm_extremum_fit *x,
                     const pm_extremum_estimate *before, pm_extremum_looks *looks, pm_extremum_estimate *rise)
{
    const double n = w->step.nodes->n;
    const int status = pm_ask_look(w, pm_extremum_place(&w->step, x->s), 1);
    if (status) return status;
    rise->s = x->s;
    rise->value = pm_extremum_value(w, p);
    const double off = rise->value - x->value;
    rise->rate = x->slope + off * x->pull;
    double error = PM_RISE_PART * p->slope_error * fabs(x->w), bend = x->bend;
    for (int i = 0; i < looks->n; i++) error *= n; /* w has become smaller */
    error = rise->rate_error = pm_max(error, n * fabs(off)) + PM_EXTREMUM_ROUNDING * p->size * fabs(x->pull);
    double bend_error =
        PM_EXTREMUM_SLOPE_TAIL * n * p->slope_error / pm_max(2 * sqrt(x->s * (1 - x->s)), 1 / n);
    if (before) {
        const double way = rise->s - before->s, secant = (rise->rate - before->rate) / way;
        const double of_secant =
            (error + before->rate_error + n * n * fabs(way * (rise->rate - before->rate))) / fabs(way);
        if (of_secant < bend_error) bend = secant, bend_error = of_secant;
    }
    looks->s[looks->n] = x->s;
    looks->off[looks->n] = off;
    looks->w[looks->n++] = x->w;
    rise->residual = INFINITY;
    rise->gain = 0;
    rise->place = NAN;
    if (!(bend < 0)) return PM_OK;
    rise->place = rise->s - rise->rate / bend;
    if (!(bend_error < -bend)) return PM_OK; /* it may be the other way */
    const double doubt = bend_error / -bend + n * n * fabs(rise->rate / bend);
    rise->gain = -0.5 * rise->rate * rise->rate / bend;
    rise->residual = doubt * rise->gain - error * (fabs(rise->rate) + 0.5 * error) / bend;
    return PM_OK;
}

/* The extreme is known.  It may lie where another branch is taken than at the look beside it. */
static int take_top(pm_workspace *w, const pm_extremum *p, const pm_extremum_estimate *here, double most)
{
    if (!(here->place >= 0 && here->place <= p->end)) return PM_OK;
    double value = here->value, above = here->gain;
    if (value + above > p->best && p->branch && (above > p->nothing || !pm_extremum_is_taken(p))) {
        const int status = pm_ask_look(w, pm_extremum_place(&w->step, here->place), 1);
        if (status) return status;
        value = pm_extremum_value(w, p);
        above = 0;
        if (!pm_extremum_is_taken(p)) return PM_OK;
    }
    pm_extremum_skip(w->ask, p, most);
    if (value + above > p->best) pm_extremum_offer(w, p, value, above);
    return PM_OK;
}

int pm_extremum_rise_climb(pm_workspace *w, const pm_extremum *p, int k, const pm_extremum_fit *near,
                           int *found)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    const double low = k > 0 ? nodes->at[k - 1] : 0, high = k + 2 < nodes->n ? nodes->at[k + 2] : 1;
    pm_extremum_looks looks = {.n = 0};
    pm_extremum_estimate rise[2];
    pm_extremum_fit x = *near;
    *found = 0;
    for (int i = 0; i < LOOKS; i++) {
        pm_extremum_estimate *here = &rise[i % 2];
        const int status = take_look(w, p, &x, i > 0 ? &rise[(i + 1) % 2] : NULL, &looks, here);
        if (status) return status;
        const double most = here->value + here->gain + here->residual;
        *found = most <= p->best + p->nothing || here->residual <= p->nothing;
        if (*found) {
            return take_top(w, p, here, most);
        }
        const double before = i > 0 ? rise[(i + 1) % 2].residual : INFINITY;
        const int slowly = before < INFINITY && here->residual > PM_RISE_SLOWLY * before;
        if (slowly || !(here->place > low && here->place < high)) return PM_OK;
        while (k > 0 && here->place < nodes->at[k]) k--;
        while (k + 2 < nodes->n && here->place > nodes->at[k + 1]) k++;
        double s = beside(nodes, k, here->place);
        for (int j = 0; j < looks.n; j++)
            if (fabs(s - looks.s[j]) < PM_RISE_BESIDE)
                s = looks.s[j] + (s < looks.s[j] ? -PM_RISE_BESIDE : PM_RISE_BESIDE);
        x = fit(nodes, p->g, k, s);
        correct(&looks, &x);
    }
    return PM_OK;
}
