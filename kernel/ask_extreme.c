/* ask_extreme.c - extremes of watched values inside a step.
 *
 * g is the value, or its negative: the greater the better.  Where the nodes s_k of a step tell it nearly, its extremes are
 * near those of the polynomial p through them,
 *
 *   g = p + w h,    w(s) = prod (s - s_k),    e = g - p = w h
 *
 * (Berrut and Trefethen, SIAM Rev. 46, 2004).  An exact look at x tells e there, and x becomes one more node: then
 *
 *   g'(x) = p'(x) + e w'/w + w h',    the extreme is at x - g' / g'', g'^2 / 2 |g''| above g(x)
 *
 * and w h', no more than some n e, is what stays untold.  Looks go on until that makes nothing.  Where the nodes do not
 * tell the value, every interval where its rate changes sign is searched for the root of the rate (differences of the
 * route's dense output), and the value is taken on an exact state there. */
#include <math.h>

#include "ask.h"
#include "crossing_sample.h"
#include "error.h"
#include "greater.h"
#include "minimum.h"
#include "pair.h"
#include "root.h"
#include "route.h"
#include "series.h"

#define RATE_STEP 2e-3  /* of the step: distance of the differences that make a rate */
#define NEARLY_FLAT 0.1 /* of the spread in a step: a slope between nodes that may have either sign */
#define SMOOTH 1e-3    /* highest coefficients of a value that its samples tell nearly: one without corners */
#define SHARP 0.1      /* of one whose slopes they tell roughly, at the best */
#define SLOWLY 0.5     /* looks that leave more untold than that of what was before lead nowhere */
#define UNTOLD 10.0    /* times these coefficients: how far the value may be from the polynomial */
#define PEAK_STEP 1e-4 /* of the step: distance of the differences that make the rate next to an extreme */
#define PEAK_STEPS 6   /* of Newton's method to an extreme */
#define SLOPE_TAIL 2.0 /* times the degree and the highest coefficients: error of a polynomial's slope */
#define END_TAIL 4.0   /* the same at the ends of the step */
#define LIKELY 0.1     /* of the most that a slope may be off by */
#define WIDE 3.0       /* as much may rise what the nodes do not tell */
#define NEAR 0.3       /* of a bend: so much it changes over this part of 1 / n^2 of the step, at the most */
#define LOOKS 6        /* that are taken in as nodes */
#define BESIDE 3e-6    /* of the step: nearer to each other two nodes tell no slope */
#define PART 0.3 /* of what is untold of a slope before a look there: it stays so after it, at the least */
#define ROUNDING 4e-16 /* of the value's size: what looks scatter by */
#define NOTHING 1e-15  /* of the value's size: so little more is rounding */
#define SHARE 1e-2     /* of the tolerance: so little more is not looked for, but counts as an error */
#define SEARCHES 60    /* values that are compared where slopes do not tell */
#define CLOSE 1e-8     /* of the step: so near to an extreme its value is that */
#define LEVEL 1e-14    /* of a value's size: so little spread is rounding */

/* A value in a step. */
typedef struct pm_peak {
    int ask;
    double sign; /* of the value in g */
    double g[PM_NODES_MOST];
    double size;    /* greatest of g */
    double tail;    /* highest coefficients over it */
    double best;    /* known before it is looked for, as g */
    double nothing; /* so much more is not looked for */
    double end;     /* of the step, as a fraction of what is sampled */
    double slope_error;
} pm_peak;

/* The polynomial somewhere: its value less that of the nearest node, slope and bend; w'/w; w, 1 where it is greatest. */
typedef struct pm_told {
    double s, value, slope, bend, pull, w;
} pm_told;

/* Exact looks, each with what the polynomial through the nodes and the looks before was off by. */
typedef struct pm_looks {
    int n;
    double s[LOOKS], off[LOOKS], w[LOOKS];
} pm_looks;

/* What a look tells of the extreme near it. */
typedef struct pm_rise {
    double s, value, rate, rate_error;
    double gain, place; /* the extreme is that much above the value, and there */
    double untold;      /* and may be so much more */
} pm_rise;

static double place_of(const pm_workspace *w, double s)
{
    return w->step_begin + s * (w->sampled_end - w->step_begin);
}

/* ---- where the nodes do not tell the value ---- */
/* To the extreme of the value from near it, by Newton's method on the rate; the bend is at first the one given, then the
 * secant's.  0 if it does not stay between low and high. */
static int climb(pm_workspace *w, const pm_peak *p, double bend, double low, double high, double *s)
{
    pm_ask_watch x = {pm_ask_program(PM_ASK_ROW(w->model, p->ask)), 0, 0};
    double last = 0, from = *s;
    for (int i = 0; i < PEAK_STEPS; i++) {
        const double rate = p->sign *
                            (pm_ask_along(w, place_of(w, *s + PEAK_STEP), &x) -
                             pm_ask_along(w, place_of(w, *s - PEAK_STEP), &x)) /
                            (2 * PEAK_STEP);
        if (i > 0 && *s != from) bend = (rate - last) / (*s - from);
        const double shift = -rate / bend;
        if (!(bend < 0) || !(*s + shift > low && *s + shift < high)) return 0;
        last = rate;
        from = *s;
        *s += shift;
        if (fabs(rate * rate / bend) <= NOTHING * p->size) return 1;
    }
    return 0;
}

/* Between node k and the next where the value may have an extreme better than the best so far: the root of its rate. */
static int refine(pm_workspace *w, const pm_peak *p, int k)
{
    const int32_t *e = PM_ASK_ROW(w->model, p->ask);
    if (k < 0 || k + 1 >= w->nodes->n) return PM_OK;
    const double begin = w->step_begin, h = w->sampled_end - begin;
    const double a = pm_crossing_node(w, k), b = pm_less(pm_crossing_node(w, k + 1), w->step_end);
    if (a >= b) return PM_OK;
    pm_ask_watch x = {pm_ask_program(e), 0, RATE_STEP * (w->step_end - begin)};
    const double fa = pm_ask_along(w, a, &x), fb = pm_ask_along(w, b, &x);
    if (!(p->sign * fa > 0 && p->sign * fb < 0)) return PM_OK;
    const double bend = p->sign * (fb - fa) * h * h / (b - a);
    double s = (a + (b - a) * (fa / (fa - fb)) - begin) / h, t;
    const int climbs = !pm_ask_at_extreme(e) && /* there the place matters, not the value */
                       climb(w, p, bend, (a - begin) / h, (b - begin) / h, &s);
    t = place_of(w, s);
    int status = climbs ? PM_OK : pm_root_find(w, w->ask->solver, pm_ask_along, &x, a, fa, b, fb, &t);
    if (status == PM_SOLVER)
        w->ask->undefined[p->ask] = 1; /* it takes finite rates: there is none somewhere */
    if (status) return status == PM_SOLVER ? PM_OK : status;
    if ((status = pm_ask_look(w, t, 1))) return status;
    pm_ask_offer(w, p->ask, pm_ask_run(w, p->ask), 0);
    return PM_OK;
}

/* ---- where they tell it nearly ---- */
/* s, but not so near to a node that it would tell nothing more. */
static double beside(const pm_nodes *nodes, int k, double s)
{
    const double low = nodes->at[k] + BESIDE, high = nodes->at[k + 1] - BESIDE;
    return s < low ? low : s > high ? high : s;
}

/* Of p = N / D, N = sum c_k g_k, D = sum c_k, c_k = w_k / (s - s_k), for s between node k and the next; w_k alternate, and
 * are half as much at the ends.  Two nodes at a time. */
static pm_told tell(const pm_nodes *nodes, const double *g, int k, double s)
{
    const double from = s - nodes->at[k] < nodes->at[k + 1] - s ? g[k] : g[k + 1];
    const int last = nodes->n - 1;
    pm_pair n0 = {0, 0}, n1 = n0, n2 = n0, d0 = n0, d1 = n0, d2 = n0, weight = {0.5, -1};
    for (int i = 0; i <= last; i += 2) {
        const int alone = i == last;
        const pm_pair at = {nodes->at[i], alone ? s - 1 : nodes->at[i + 1]};
        const pm_pair value = {g[i] - from, alone ? 0 : g[i + 1] - from};
        if (alone) weight = (pm_pair){0.5, 0};
        const pm_pair inverse = 1 / (s - at), c0 = weight * inverse, c1 = c0 * inverse, c2 = c1 * inverse;
        n0 += c0 * value;
        n1 += c1 * value;
        n2 += c2 * value;
        d0 += c0;
        d1 += c1;
        d2 += c2;
        weight[0] = 1;
    }
    const double below = pm_pair_sum(d0), first = pm_pair_sum(d1);
    pm_told x = {.s = s, .value = pm_pair_sum(n0) / below, .pull = first / below, .w = 2 * last / below};
    x.slope = (x.value * first - pm_pair_sum(n1)) / below;
    x.bend = 2 * (pm_pair_sum(n2) + x.slope * first - x.value * pm_pair_sum(d2)) / below;
    x.value += from;
    return x;
}

/* The interval of s, next to node k. */
static int side_of(const pm_nodes *nodes, int k, double s)
{
    return k > 0 && (s < nodes->at[k] || k + 1 == nodes->n) ? k - 1 : k;
}

/* The polynomial's extreme near s, beside node k; nearly: as far as its slope tells it.  The bend is not below zero if there
 * is none. */
static pm_told top_of(const pm_nodes *nodes, const pm_peak *p, int k, double s)
{
    s = beside(nodes, side_of(nodes, k, s), s);
    for (int i = 0;; i++) {
        const pm_told x = tell(nodes, p->g, side_of(nodes, k, s), s);
        const double told = pm_greater(p->slope_error, sqrt(p->nothing * fabs(x.bend)));
        if (!(x.bend < 0) || fabs(x.slope) <= told || i == PEAK_STEPS) return x;
        const double next = s - x.slope / x.bend;
        s = beside(nodes, side_of(nodes, k, next), next);
        if (s == x.s) return x;
    }
}

/* Takes the looks in as nodes: their part of value and slope. */
static void correct(const pm_looks *looks, pm_told *x)
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
static int take_look(pm_workspace *w, const pm_peak *p, const pm_told *x, const pm_rise *before,
                     pm_looks *looks, pm_rise *rise)
{
    const double n = w->nodes->n;
    const int status = pm_ask_look(w, place_of(w, x->s), 1);
    if (status) return status;
    rise->s = x->s;
    rise->value = p->sign * pm_ask_run(w, p->ask);
    const double off = rise->value - x->value;
    rise->rate = x->slope + off * x->pull;
    double error = PART * p->slope_error * fabs(x->w), bend = x->bend;
    for (int i = 0; i < looks->n; i++) error *= n; /* w has become smaller */
    error = rise->rate_error = pm_greater(error, n * fabs(off)) + ROUNDING * p->size * fabs(x->pull);
    double bend_error = SLOPE_TAIL * n * p->slope_error / pm_greater(2 * sqrt(x->s * (1 - x->s)), 1 / n);
    if (before) {
        const double way = rise->s - before->s, secant = (rise->rate - before->rate) / way;
        const double of_secant =
            (error + before->rate_error + n * n * fabs(way * (rise->rate - before->rate))) / fabs(way);
        if (of_secant < bend_error) bend = secant, bend_error = of_secant;
    }
    looks->s[looks->n] = x->s;
    looks->off[looks->n] = off;
    looks->w[looks->n++] = x->w;
    rise->untold = INFINITY;
    rise->gain = 0;
    rise->place = NAN;
    if (!(bend < 0)) return PM_OK;
    rise->place = rise->s - rise->rate / bend;
    if (!(bend_error < -bend)) return PM_OK; /* it may be the other way */
    const double doubt = bend_error / -bend + n * n * fabs(rise->rate / bend);
    rise->gain = -0.5 * rise->rate * rise->rate / bend;
    rise->untold = doubt * rise->gain - error * (fabs(rise->rate) + 0.5 * error) / bend;
    return PM_OK;
}

/* Nothing above `value` is looked for. */
static void leave_untold(pm_workspace *w, const pm_peak *p, double value)
{
    double *bound = &w->ask->bound[p->ask];
    *bound = pm_greater(*bound, value);
}

/* From a place near an extreme to it; *found is 0 if the looks do not tell it, *top is the best of them then. */
static int rise_to(pm_workspace *w, const pm_peak *p, int k, const pm_told *near, pm_rise *top, int *found)
{
    const pm_nodes *nodes = w->nodes;
    const double low = k > 0 ? nodes->at[k - 1] : 0, high = k + 2 < nodes->n ? nodes->at[k + 2] : 1;
    pm_looks looks = {.n = 0};
    pm_rise rise[2];
    pm_told x = *near;
    *found = 0;
    *top = (pm_rise){.value = -INFINITY};
    for (int i = 0; i < LOOKS; i++) {
        pm_rise *here = &rise[i % 2];
        const int status = take_look(w, p, &x, i > 0 ? &rise[(i + 1) % 2] : NULL, &looks, here);
        if (status) return status;
        if (here->value > top->value) *top = *here;
        const double most = here->value + here->gain + here->untold;
        *found = most <= p->best + p->nothing || here->untold <= p->nothing;
        if (*found) {
            const int inside = here->place >= 0 && here->place <= p->end;
            if (inside) leave_untold(w, p, most);
            if (inside && here->value + here->gain > p->best)
                pm_ask_offer(w, p->ask, p->sign * here->value, p->sign * here->gain);
            return PM_OK;
        }
        const double before = i > 0 ? rise[(i + 1) % 2].untold : INFINITY;
        const int slowly = before < INFINITY && here->untold > SLOWLY * before;
        if (slowly || !(here->place > low && here->place < high)) return PM_OK;
        while (k > 0 && here->place < nodes->at[k]) k--;
        while (k + 2 < nodes->n && here->place > nodes->at[k + 1]) k++;
        double s = beside(nodes, k, here->place);
        for (int j = 0; j < looks.n; j++)
            if (fabs(s - looks.s[j]) < BESIDE) s = looks.s[j] + (s < looks.s[j] ? -BESIDE : BESIDE);
        x = tell(nodes, p->g, k, s);
        correct(&looks, &x);
    }
    return PM_OK;
}

typedef struct pm_search {
    pm_workspace *w;
    const pm_peak *peak;
} pm_search;

static double depth(double s, void *context)
{
    const pm_search *x = context;
    return pm_ask_look(x->w, place_of(x->w, s), 1) ? NAN : -x->peak->sign * pm_ask_run(x->w, x->peak->ask);
}

/* By values alone, where slopes do not tell (a flat top, or one about to part in two): from a look that is better than the
 * nodes beside it. */
static int search(pm_workspace *w, const pm_peak *p, const pm_rise *top, int *found)
{
    const pm_nodes *nodes = w->nodes;
    int k = 0;
    while (k + 2 < nodes->n && nodes->at[k + 1] <= top->s) k++;
    *found = top->value > p->g[k] && top->value > p->g[k + 1];
    if (!*found) return PM_OK;
    pm_search context = {w, p};
    const pm_valley in = {nodes->at[k], -p->g[k], top->s, -top->value, nodes->at[k + 1], -p->g[k + 1]};
    const double s =
        pm_minimum_find(w->ask->minimum, depth, &context, &in, &(pm_closeness){SEARCHES, CLOSE, 0});
    if (s > p->end) return PM_OK;
    const int status = pm_ask_look(w, place_of(w, s), 1);
    if (!status) pm_ask_offer(w, p->ask, pm_ask_run(w, p->ask), 0);
    return status;
}

/* Whether node k is as good as the extreme at x right beside it. */
static int is_at_node(pm_workspace *w, const pm_peak *p, int k, const pm_told *x)
{
    const int n = w->nodes->n, at_end = k == 0 || k + 1 == n;
    if (n * n * fabs(x->s - w->nodes->at[k]) > NEAR) return 0;
    const double slope = fabs(pm_series_slope_at(w->nodes, p->g, k));
    const double error = (at_end ? END_TAIL / SLOPE_TAIL : 1) * p->slope_error;
    const double half = -(1 + NEAR) * 0.5 / x->bend,
                 most = p->g[k] + half * (slope + error) * (slope + error);
    const double likely = slope + LIKELY * error;
    if (most > p->best + p->nothing) return 0;
    leave_untold(w, p, p->g[k] + half * likely * likely);
    return 1;
}

/* The extreme near s, beside node k, if it may be better than the best. */
static int extreme_near(pm_workspace *w, const pm_peak *p, int k, double s)
{
    const pm_told x = top_of(w->nodes, p, k, s);
    if (x.bend < 0) {
        const double untold = UNTOLD * p->tail * p->size * fabs(x.w) - 0.5 * x.slope * x.slope / x.bend;
        if (is_at_node(w, p, k, &x)) return PM_OK;
        if (x.value + untold <= p->best + p->nothing) {
            leave_untold(w, p, x.value + untold);
            return PM_OK;
        }
        int found;
        pm_rise top;
        int status = rise_to(w, p, side_of(w->nodes, k, x.s), &x, &top, &found);
        if (!status && !found) status = search(w, p, &top, &found);
        if (status || found) return status;
    }
    const int status = refine(w, p, k - 1);
    return status ? status : refine(w, p, k);
}

/* Where the parabola through node k, which is better than those beside it, is greatest: at an end of the step, the one with
 * the slope there.  NaN if the value falls off there. */
static double vertex(const pm_nodes *nodes, const pm_peak *p, int k)
{
    const double *at = nodes->at, *g = p->g;
    if (k > 0 && k + 1 < nodes->n) {
        const double h = at[k] - at[k - 1], j = at[k + 1] - at[k];
        const double left = (g[k] - g[k - 1]) / h, right = (g[k + 1] - g[k]) / j;
        const double slope = (left * j + right * h) / (h + j), bend = 2 * (right - left) / (h + j);
        return at[k] - slope / bend;
    }
    const int in = k > 0 ? k - 1 : 1;
    const double h = at[in] - at[k], slope = pm_series_slope_at(nodes, g, k);
    if (slope * h <= -END_TAIL / SLOPE_TAIL * p->slope_error * fabs(h)) return NAN;
    const double bend = 2 * (g[in] - g[k] - slope * h) / (h * h);
    return at[k] - slope / bend;
}

/* Extremes are beside nodes that are better than both nodes next to them: a wave that none shows would not be resolved.
 * They rise above them by less than those fall off.  The first such node from k on that may beat the best, by `wide` times
 * as much, and is not beyond the end of the step; or n. */
static int next_top(const pm_nodes *nodes, const pm_peak *p, int k, double wide)
{
    const double *g = p->g;
    const int n = nodes->n;
    for (; k < n; k++) {
        const double here = g[k], before = k > 0 ? g[k - 1] : g[1], after = k + 1 < n ? g[k + 1] : g[n - 2];
        if (!(here > before && here >= after)) continue;
        if (here + wide * (here - pm_less(before, after)) > p->best && (k == 0 || nodes->at[k - 1] < p->end))
            return k;
    }
    return n;
}

static int extremes_of_samples(pm_workspace *w, pm_peak *p)
{
    const pm_nodes *nodes = w->nodes;
    for (int k = 0; (k = next_top(nodes, p, k, 1)) < nodes->n; k++) {
        const double s = vertex(nodes, p, k);
        if (isnan(s)) continue;
        const int status = extreme_near(w, p, k, s);
        if (status) return status;
        p->best = pm_greater(p->best, p->sign * w->ask->best[p->ask]);
    }
    return PM_OK;
}

/* Between node k and the next, where the samples tell the slopes but roughly. */
static int extreme_beside_top(pm_workspace *w, const pm_peak *p, int k, double spread)
{
    const pm_nodes *nodes = w->nodes;
    const double flat = NEARLY_FLAT * spread / (nodes->at[k + 1] - nodes->at[k]);
    const double a = pm_series_slope_at(nodes, p->g, k), b = pm_series_slope_at(nodes, p->g, k + 1);
    if (a < -flat || b > flat || pm_crossing_node(w, k) >= w->step_end) return PM_OK;
    if (p->tail < SHARP && a > 0 && b < 0) {
        const double low = nodes->at[k], high = nodes->at[k + 1];
        const pm_told x = top_of(nodes, p, k, low + (high - low) * (a / (a - b)));
        int found = 0, status = PM_OK;
        pm_rise top = {.value = -INFINITY};
        if (x.bend < 0) status = rise_to(w, p, side_of(nodes, k, x.s), &x, &top, &found);
        if (status || found) return status;
        if ((status = search(w, p, &top, &found))) return status;
    }
    return refine(w, p, k); /* a corner, too */
}

/* The best of the nodes, by its value; where something else is asked at the extreme, or its error, look again. */
static int offer_node(pm_workspace *w, const pm_peak *p, int top)
{
    if (p->g[top] <= p->sign * w->ask->best[p->ask]) return PM_OK;
    const int looks = pm_ask_at_extreme(PM_ASK_ROW(w->model, p->ask)) || w->error->active;
    const int status = looks ? pm_ask_look(w, pm_crossing_node(w, top), 1) : PM_OK;
    if (!status) pm_ask_offer(w, p->ask, p->sign * p->g[top], 0);
    return status;
}

/* Extremes between nodes that are better than any node; `spread` of the nodes, of which one, `top`, is the best. */
static int extreme_between_nodes(pm_workspace *w, pm_peak *p, int top, double spread)
{
    const pm_nodes *nodes = w->nodes;
    /* an extreme between the nodes exceeds them by no more than their spread */
    if (spread <= LEVEL * p->size || p->g[top] + spread < p->best) return PM_OK;
    p->tail = INFINITY;
    if (pm_nodes_spectral(nodes) && !pm_ask_at_extreme(PM_ASK_ROW(w->model, p->ask))) {
        if (next_top(nodes, p, 0, WIDE) == nodes->n) return PM_OK;
        p->tail = pm_series_tail(nodes, p->g);
        p->slope_error = SLOPE_TAIL * nodes->n * p->tail * p->size;
        p->nothing = pm_greater(NOTHING, SHARE * w->tolerance) * p->size;
        if (p->tail < SMOOTH) return extremes_of_samples(w, p);
    }
    for (int k = 0; (k = next_top(nodes, p, k, WIDE)) < nodes->n; k++) {
        int status = k > 0 ? extreme_beside_top(w, p, k - 1, spread) : PM_OK;
        if (!status && k + 1 < nodes->n) status = extreme_beside_top(w, p, k, spread);
        if (status) return status;
        p->best = pm_greater(p->best, p->sign * w->ask->best[p->ask]);
    }
    return PM_OK;
}

/* How many nodes are not beyond the end of the step, which may have been shortened. */
static int nodes_inside(const pm_workspace *w)
{
    int n = w->nodes->n;
    while (w->step_end < w->sampled_end && n > 1 && pm_crossing_node(w, n - 1) > w->step_end) n--;
    return n;
}

int pm_ask_extreme(pm_workspace *w, int ask)
{
    const double *sample = w->ask->sample + ask * PM_NODES_MOST;
    pm_peak p = {.ask = ask, .sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1};
    const int inside = nodes_inside(w);
    double least = INFINITY;
    int top = 0, top_inside = 0;
    for (int k = 0; k < w->nodes->n; k++) {
        const double g = p.g[k] = p.sign * sample[k];
        if (isnan(g)) {
            w->ask->undefined[ask] = 1;
            return PM_OK;
        }
        if (g < least) least = g;
        if (g > p.g[top]) top = k;
        if (k < inside) top_inside = top;
    }
    p.size = pm_greater(fabs(least), fabs(p.g[top]));
    p.end = (w->step_end - w->step_begin) / (w->sampled_end - w->step_begin);
    const double best = p.sign * w->ask->best[ask];
    p.best = best > p.g[top_inside] ? best : p.g[top_inside];
    const int status = extreme_between_nodes(w, &p, top, p.g[top] - least);
    return status ? status : offer_node(w, &p, top_inside);
}

int pm_ask_end_counts(pm_workspace *w, int ask)
{
    const double *value = w->ask->sample + ask * PM_NODES_MOST;
    const double sign = pm_ask_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1;
    const int inside = nodes_inside(w), from = inside > 1 ? inside - 2 : 0;
    double best = sign * w->ask->best[ask], low = INFINITY, high = -INFINITY;
    for (int k = 0; k < inside; k++)
        if (!(sign * value[k] <= best)) best = sign * value[k];
    for (int k = from; k < w->nodes->n && k <= inside + 1; k++) {
        low = pm_less(low, sign * value[k]);
        high = pm_greater(high, sign * value[k]);
    }
    const double next =
        pm_greater(sign * value[inside - 1], inside < w->nodes->n ? sign * value[inside] : -INFINITY);
    return !(next + (high - low) <= best);
}
