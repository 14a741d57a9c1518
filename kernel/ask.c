/* ask.c - answers taken at instants, over the run, and on grids.
 *
 * Extremes: every interval between nodes where the rate of the watched value changes sign is searched for the root of
 * the rate (differences of the route's dense output), and the value is taken on an exact state there. */
#include "ask.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "crossing.h"
#include "event.h"
#include "path_error.h"
#include "program.h"
#include "root.h"
#include "route.h"
#include "saddle.h"
#include "sample.h"
#include "series.h"

#define RATE_STEP 2e-3  /* of the step: distance of the differences that make a rate */
#define NEARLY_FLAT 0.1 /* of the spread in a step: a slope between nodes that may have either sign */
#define SMOOTH 1e-3    /* highest coefficients of a value that its samples tell nearly: one without corners */
#define UNTOLD 10.0    /* times these coefficients: how far the value may be from the polynomial */
#define PEAK_STEP 1e-4 /* of the step: distance of the differences that make the rate next to an extreme */
#define SLOPE_TAIL 2.0 /* times the degree and the highest coefficients: error of a polynomial's slope */
#define BESIDE 3e-6    /* of the step: from near an extreme to the second place that tells where it is */
#define BEND_NOISE 1e-14 /* of the value's size: what rounding makes of a second difference */
#define PEAK_STEPS 6     /* of Newton's method to an extreme */
#define PEAK_GAIN 1e-15  /* of the value's size: a step that would gain less is not taken */
#define LEVEL 1e-14      /* of a value's size: so little spread is rounding */
#define ON_GRID 1e-9     /* relative: a grid value met at the very start or end of the run */

static void raise_to(int *highest, int level)
{
    if (level > *highest) *highest = level;
}

int pm_ask_create(pm_workspace *w)
{
    const size_t nask = (size_t)w->model->nask, nout = (size_t)w->model->nout;
    pm_ask_set *a = w->ask = calloc(1, sizeof *a);
    if (!a) return PM_NO_MEMORY;
    a->observer = calloc(nask + 1, sizeof *a->observer);
    a->sample = calloc((PM_NODES_MOST + 2) * nask + 1, sizeof *a->sample);
    a->undefined = calloc(nask + 2 * nout + 1, 1);
    a->solver = pm_root_create();
    if (!a->observer || !a->sample || !a->undefined || !a->solver) return PM_NO_MEMORY;
    a->best = a->sample + PM_NODES_MOST * nask;
    a->before = a->best + nask;
    a->filled = a->undefined + nask;
    a->sound = a->filled + nout;
    a->level = a->instant_level = a->fired_level = a->end_level = PM_LEVEL_KINEMATIC;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        const int watches = e[PM_ASK_KIND] >= PM_ASK_MAX && e[PM_ASK_KIND] <= PM_ASK_GRID;
        if (watches) a->observer[a->nobserver++] = i;
        for (int k = 0; k < 2; k++) {
            const int program = e[k ? PM_ASK_PROGRAM_2 : PM_ASK_PROGRAM];
            const int level = program >= 0 ? w->model->program_level[program] : PM_LEVEL_NONE;
            raise_to(&a->instant_level, level);
            if (watches) raise_to(&a->level, level);
            if (e[PM_ASK_EVENT_INDEX] != PM_NONE) raise_to(&a->fired_level, level);
            if (e[PM_ASK_KIND] == PM_ASK_END || e[PM_ASK_KIND] == PM_ASK_GRID) raise_to(&a->end_level, level);
        }
    }
    return PM_OK;
}

void pm_ask_free(pm_workspace *w)
{
    if (!w->ask) return;
    free(w->ask->observer);
    free(w->ask->sample);
    free(w->ask->undefined);
    pm_root_free(w->ask->solver);
    free(w->ask);
    w->ask = NULL;
}

void pm_ask_reset(pm_workspace *w)
{
    pm_ask_set *a = w->ask;
    for (int i = 0; i < w->model->nask; i++) a->best[i] = NAN;
    memset(a->undefined, 0, (size_t)(w->model->nask + 2 * w->model->nout));
    a->fresh = 0;
    for (int i = 0; i < w->model->nout; i++) w->out[i] = NAN;
    for (int i = 0; i < w->model->nask; i++) w->reason[i] = PM_REASON_NOT_REACHED;
}

static double run(pm_workspace *w, int program)
{
    return pm_program_run(w->model, program, w->param, w->value, w);
}

static void answer(pm_workspace *w, int ask, int column, double value)
{
    const int out = PM_ASK_ROW(w->model, ask)[PM_ASK_OUT] + column;
    w->out[out] = value;
    w->ask->filled[out] = w->ask->fresh = 1;
}

/* The value of a program at the frame, with what the route knows of its error. */
static void answer_here(pm_workspace *w, int ask, int column, int program, double value)
{
    answer(w, ask, column, value);
    pm_path_error_answer(w, ask, PM_ASK_ROW(w->model, ask)[PM_ASK_OUT] + column, program, value);
}

static int is_greatest(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_MAX || e[PM_ASK_KIND] == PM_ASK_AT_MAX;
}
static int at_extreme(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_AT_MAX || e[PM_ASK_KIND] == PM_ASK_AT_MIN;
}
static int watched_program(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_GRID || at_extreme(e) ? e[PM_ASK_PROGRAM_2] : e[PM_ASK_PROGRAM];
}

int pm_ask_watched(const pm_workspace *w, int i)
{
    return watched_program(PM_ASK_ROW(w->model, w->ask->observer[i]));
}

/* Takes a value of a watched extreme, `above` more than it is at the frame. */
static void offer_near(pm_workspace *w, int ask, double value, double above)
{
    pm_ask_set *a = w->ask;
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    if (isnan(value)) {
        a->undefined[ask] = 1;
        return;
    }
    const double extreme = value + above;
    const int better = is_greatest(e) ? extreme > a->best[ask] : extreme < a->best[ask];
    if (!isnan(a->best[ask]) && !better) return;
    a->best[ask] = extreme;
    answer_here(w, ask, 0, e[PM_ASK_PROGRAM], at_extreme(e) ? run(w, e[PM_ASK_PROGRAM]) : value);
    w->out[e[PM_ASK_OUT]] += above;
}

static void offer(pm_workspace *w, int ask, double value) { offer_near(w, ask, value, 0); }

static void offer_grid(pm_workspace *w, int ask, double value, double tolerance)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
        const double wanted = w->value[e[PM_ASK_FIRST_VALUE] + k];
        if (w->ask->filled[e[PM_ASK_OUT] + k] ||
            !(fabs(value - wanted) <= tolerance * fmax(fabs(wanted), 1e-3)))
            continue;
        answer_here(w, ask, k, e[PM_ASK_PROGRAM], run(w, e[PM_ASK_PROGRAM]));
    }
}

void pm_ask_sample(pm_workspace *w)
{
    double value[PM_NODES_MOST];
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        pm_sample_run(w, watched_program(PM_ASK_ROW(w->model, ask)), value);
        for (int k = 0; k < w->nodes->n; k++) w->ask->sample[k * w->model->nask + ask] = value[k];
    }
}

typedef struct pm_watch {
    int program;
    double minus; /* value to take off: a grid value */
    double step;  /* > 0: the rate by differences instead of the value */
} pm_watch;

static int look(pm_workspace *w, double t, int exact)
{
    if (!exact || w->route->look) return pm_route_look(w, t, w->ask->level);
    const int status = w->route->exact(w, t, &w->probe);
    if (status) return status;
    pm_frame_look(w, w->probe.t, w->probe.q, w->probe.v, w->probe.z, w->state.memory);
    return w->ask->level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
}

static double value_at(pm_workspace *w, double t, const pm_watch *x)
{
    return look(w, t, 0) ? NAN : run(w, x->program) - x->minus;
}

static double along(pm_workspace *w, double t, void *context)
{
    const pm_watch *x = context;
    const double d = x->step;
    if (d == 0) return value_at(w, t, x);
    return (8 * (value_at(w, t + d, x) - value_at(w, t - d, x)) -
            (value_at(w, t + 2 * d, x) - value_at(w, t - 2 * d, x))) /
           (12 * d);
}

static int exactly(pm_workspace *w, double t, void *context, double *value)
{
    const pm_watch *x = context;
    const int status = look(w, t, 1);
    *value = run(w, x->program) - x->minus;
    return status;
}

/* A value in a step that its nodes tell nearly: g the greater the better, its slopes d by the fraction of the step. */
typedef struct pm_peak {
    double sign; /* of the value in g */
    double g[PM_NODES_MOST], d[PM_NODES_MOST];
    double size; /* greatest of g */
    double tail; /* highest coefficients over it */
    double best; /* known before it is looked for, as g */
} pm_peak;

/* How far the slope of the polynomial may be off, by the fraction of the step. */
static double slope_error(const pm_nodes *nodes, const pm_peak *p)
{
    return SLOPE_TAIL * nodes->n * p->tail * p->size;
}

static double bend_at(const pm_nodes *nodes, const pm_peak *p, double s)
{
    double slope;
    return pm_series_slope(nodes, p->d, s, &slope);
}

/* Of the value's rate by the fraction of the step: its bend, and how far that may be off, over it. */
typedef struct pm_slope {
    double bend, error;
} pm_slope;

static pm_slope slope_of(const pm_nodes *nodes, const pm_peak *p, double s)
{
    const double bend = bend_at(nodes, p, s);
    return (pm_slope){bend, SLOPE_TAIL * nodes->n * slope_error(nodes, p) / fabs(bend)};
}

/* To the extreme of the value from near it, by Newton's method on the rate; the bend is at first the one given, then the
 * secant's.  0 if it does not stay between low and high.  size: of the value. */
static int climb(pm_workspace *w, int ask, const pm_slope *slope, double low, double high, double size,
                 double *s)
{
    const double h = w->sampled_end - w->step_begin, sign = is_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1;
    const pm_watch x = {watched_program(PM_ASK_ROW(w->model, ask)), 0, 0};
    double bend = slope->bend, last = 0, from = *s;
    for (int i = 0; i < PEAK_STEPS; i++) {
        const double place = w->step_begin + *s * h;
        const double rate =
            sign * (value_at(w, place + PEAK_STEP * h, &x) - value_at(w, place - PEAK_STEP * h, &x)) /
            (2 * PEAK_STEP);
        if (i > 0 && *s != from) bend = (rate - last) / (*s - from);
        const double shift = -rate / bend;
        if (!(bend < 0) || !(*s + shift > low && *s + shift < high)) return 0;
        last = rate;
        from = *s;
        *s += shift;
        const double left = i == 0 ? fmin(slope->error, 1) * rate : rate; /* of the rate, after this step */
        if (fabs(left * left / bend) <= PEAK_GAIN * size) return 1;
    }
    return 0;
}

/* Between two nodes where the value may have an extreme better than the best so far: the root of its rate. */
static int refine(pm_workspace *w, int ask, const pm_peak *p, double a, double b)
{
    const double begin = w->step_begin, h = w->sampled_end - begin;
    pm_watch x = {watched_program(PM_ASK_ROW(w->model, ask)), 0, RATE_STEP * (w->step_end - w->step_begin)};
    const double fa = along(w, a, &x), fb = along(w, b, &x);
    const int greatest = is_greatest(PM_ASK_ROW(w->model, ask));
    if (!(greatest ? fa > 0 && fb < 0 : fa < 0 && fb > 0)) return PM_OK;
    double s = (a + (b - a) * (fa / (fa - fb)) - begin) / h, t;
    const pm_slope slope = {(greatest ? fb - fa : fa - fb) * h * h / (b - a), 1};
    const int climbs = !at_extreme(PM_ASK_ROW(w->model, ask)) && /* there the place matters, not the value */
                       climb(w, ask, &slope, (a - begin) / h, (b - begin) / h, p->size, &s);
    t = begin + s * h;
    int status = climbs ? PM_OK : pm_root_find(w, w->ask->solver, along, &x, a, fa, b, fb, &t);
    if (status || (status = look(w, t, 1))) return status;
    offer(w, ask, run(w, x.program));
    return PM_OK;
}

/* The polynomial's extreme is off by its slope's error over its bend, and the value there by half the square of that. */
static int is_told(const pm_nodes *nodes, const pm_peak *p, double bend)
{
    const double error = slope_error(nodes, p);
    return bend < 0 && 0.5 * error * error <= PEAK_GAIN * p->size * -bend;
}

/* A place near an extreme: the value there, and its rate by the fraction of the step, the greater the better. */
typedef struct pm_near {
    double s, value, rate;
} pm_near;

/* Looks at x->s and right beside it; the frame stays at x->s.  bend: roughly, of the value. */
static int look_near(pm_workspace *w, int ask, double bend, double high, pm_near *x)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const double begin = w->step_begin, h = w->sampled_end - begin, sign = is_greatest(e) ? 1 : -1;
    const double d = x->s + BESIDE < high ? BESIDE : -BESIDE;
    int status = look(w, begin + (x->s + d) * h, 1);
    const double beside = sign * run(w, watched_program(e));
    if (!status) status = look(w, begin + x->s * h, 1);
    x->value = sign * run(w, watched_program(e));
    x->rate = (beside - x->value) / d - 0.5 * bend * d;
    return status;
}

/* The bend at the second of two places, of the cubic through both. */
static double bend_between(const pm_near *a, const pm_near *b)
{
    const double h = b->s - a->s;
    return (2 * a->rate + 4 * b->rate - 6 * (b->value - a->value) / h) / h;
}

/* What an extreme has above the value at x, if the bend is known: its place, too. */
static double above(const pm_near *x, double bend, double *place)
{
    *place = x->s - x->rate / bend;
    return -0.5 * x->rate * x->rate / bend;
}

/* The extreme at `place`, `gain` better than it is at the frame. */
static void offer_peak(pm_workspace *w, int ask, const pm_near *x, double gain, double place)
{
    const double sign = is_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1;
    if (w->step_begin + place * (w->sampled_end - w->step_begin) <= w->step_end)
        offer_near(w, ask, sign * x->value, sign * gain);
}

/* From near an extreme to it: values and rates at one place, or at two, tell what it has above them as far as the bend is
 * known.  Further rates of what n nodes resolve are no more than n^2 times the one before (they are near an end of the
 * step).  *found is 0 if that does not do, and *s is nearer then. */
static int step_up(pm_workspace *w, int ask, const pm_slope *slope, double low, double high, double size,
                   double *s, int *found)
{
    const double nothing = PEAK_GAIN * size, n = w->nodes->n;
    pm_near x = {.s = *s}, y = {.s = NAN};
    *found = 0;
    int status = look_near(w, ask, slope->bend, high, &x);
    if (status || !(slope->bend < 0)) return status;
    const double first = above(&x, slope->bend, &y.s);
    if (!(y.s > low && y.s < high)) return PM_OK;
    *s = y.s;
    if ((n * slope->error + n * n * fabs(y.s - x.s)) * first <= nothing) {
        offer_peak(w, ask, &x, first, y.s);
        *found = 1;
        return PM_OK;
    }
    if ((status = look_near(w, ask, slope->bend, high, &y))) return status;
    const double h = y.s - x.s, bend = bend_between(&x, &y), second = above(&y, bend, s);
    const double error =
        n * n * (n * n * h * h / 12 + fabs(*s - y.s)) + BEND_NOISE * size / fabs(h * h * bend);
    *found = bend < 0 && *s > low && *s < high && error * second <= nothing;
    if (*found) offer_peak(w, ask, &y, second, *s);
    return PM_OK;
}

/* The extreme near the fraction s of the step, between node k and the next. */
static int take_extreme(pm_workspace *w, int ask, const pm_peak *p, int k, double s)
{
    const pm_nodes *nodes = w->nodes;
    const double *at = nodes->at, low = k > 0 ? at[k - 1] : 0, high = k + 2 < nodes->n ? at[k + 2] : 1;
    const pm_slope slope = slope_of(nodes, p, s);
    int found = is_told(nodes, p, slope.bend);
    if (!found) {
        const int status = step_up(w, ask, &slope, low, high, p->size, &s, &found);
        if (status || found) return status;
        found = climb(w, ask, &slope, low, high, p->size, &s);
    }
    if (!found)
        return refine(w, ask, p, pm_crossing_node(w, k), fmin(pm_crossing_node(w, k + 1), w->step_end));
    const double place = w->step_begin + s * (w->sampled_end - w->step_begin);
    if (place > w->step_end) return PM_OK;
    const int status = look(w, place, 1);
    if (!status) offer(w, ask, run(w, watched_program(PM_ASK_ROW(w->model, ask))));
    return status;
}

/* Extremes between nodes: where the slope of the polynomial falls through zero; a closer look is taken only where it may
 * be better than the best so far. */
static int extremes_of_samples(pm_workspace *w, int ask, const pm_peak *p)
{
    const pm_nodes *nodes = w->nodes;
    const double *at = nodes->at, *d = p->d, untold = (UNTOLD * p->tail - LEVEL) * p->size;
    for (int k = 0; k + 1 < nodes->n; k++) {
        double s;
        if (!(d[k] > 0 && d[k + 1] < 0)) continue;
        int status = pm_series_root(w, nodes, d, at[k], d[k], at[k + 1], d[k + 1], &s);
        if (status) return status;
        if (pm_series_value(nodes, p->g, 1, s) + untold <= fmax(p->best, p->sign * w->ask->best[ask]))
            continue;
        if ((status = take_extreme(w, ask, p, k, s))) return status;
    }
    return PM_OK;
}

/* The intervals next to the greatest node are searched, unless the slopes clearly do not change sign there. */
static int extremes_beside_top(pm_workspace *w, int ask, const pm_peak *p, int top, double spread)
{
    const pm_nodes *nodes = w->nodes;
    for (int k = top - 1; k <= top; k++) {
        if (k < 0 || k + 1 >= nodes->n) continue;
        const double flat = NEARLY_FLAT * spread / (nodes->at[k + 1] - nodes->at[k]);
        if (p->d[k] < -flat || p->d[k + 1] > flat) continue;
        const double end = fmin(pm_crossing_node(w, k + 1), w->step_end);
        if (pm_crossing_node(w, k) >= end) continue;
        const int status = refine(w, ask, p, pm_crossing_node(w, k), end);
        if (status) return status;
    }
    return PM_OK;
}

/* The better of the best so far and the best of the nodes up to the end of the step, `p` of all nodes. */
static double best_known(const pm_workspace *w, int ask, const pm_peak *p)
{
    double best = p->sign * w->ask->best[ask];
    for (int k = 0; k < w->nodes->n && pm_crossing_node(w, k) <= w->step_end; k++)
        if (!(p->g[k] <= best)) best = p->g[k];
    return best;
}

/* Extremes between nodes that are better than any node. */
static int extreme_in_step(pm_workspace *w, int ask)
{
    const int nask = w->model->nask, n = w->nodes->n;
    pm_peak p = {.sign = is_greatest(PM_ASK_ROW(w->model, ask)) ? 1 : -1};
    double spread = 0;
    int top = 0;
    for (int k = 0; k < n; k++) {
        p.g[k] = p.sign * w->ask->sample[k * nask + ask];
        if (isnan(p.g[k])) {
            w->ask->undefined[ask] = 1;
            return PM_OK;
        }
        if (p.g[k] > p.g[top]) top = k;
        spread = fmax(spread, fabs(p.g[k] - p.g[0]));
        p.size = fmax(p.size, fabs(p.g[k]));
    }
    /* an extreme between the nodes exceeds them by no more than their spread */
    p.best = best_known(w, ask, &p);
    if (spread <= LEVEL * p.size || p.g[top] + spread < p.best) return PM_OK;
    pm_series_slopes(w->nodes, p.g, p.d);
    if (pm_nodes_spectral(w->nodes) && !at_extreme(PM_ASK_ROW(w->model, ask))) {
        p.tail = pm_series_tail(w->nodes, p.g);
        if (p.tail < SMOOTH) return extremes_of_samples(w, ask, &p);
    }
    return extremes_beside_top(w, ask, &p, top, spread);
}

static int grid_in_step(pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const int n = w->nodes->n;
    for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
        pm_watch x = {e[PM_ASK_PROGRAM_2], w->value[e[PM_ASK_FIRST_VALUE] + k], 0};
        for (int i = 0; i + 1 < n && !w->ask->filled[e[PM_ASK_OUT] + k]; i++) {
            const double a = w->ask->sample[i * w->model->nask + ask] - x.minus;
            const double b = w->ask->sample[(i + 1) * w->model->nask + ask] - x.minus;
            const double from = pm_crossing_node(w, i), to = pm_crossing_node(w, i + 1);
            if (!((a < 0 && b >= 0) || (a > 0 && b <= 0))) continue;
            double t, taken, off;
            int status = pm_root_find(w, w->ask->solver, along, &x, from, a, to, b, &t);
            if (!status && t > w->step_end) continue; /* an instant comes before */
            if (!status) status = pm_root_polish(w, along, exactly, &x, NAN, &t, &taken, &off);
            if (!status && taken != t) status = look(w, t, 1);
            if (status) return status;
            if (t <= w->step_end) answer_here(w, ask, k, e[PM_ASK_PROGRAM], run(w, e[PM_ASK_PROGRAM]));
        }
    }
    return PM_OK;
}

/* The best of the nodes, by its value; where something else is asked at the extreme, look again. */
static int offer_node(pm_workspace *w, int ask)
{
    const int nask = w->model->nask;
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const int n = w->nodes->n;
    int top = PM_NONE;
    for (int k = 0; k < n && pm_crossing_node(w, k) <= w->step_end; k++) {
        const double value = w->ask->sample[k * nask + ask];
        if (isnan(value)) offer(w, ask, value);
        if (isnan(value)) return PM_OK;
        const double best = top == PM_NONE ? NAN : w->ask->sample[top * nask + ask];
        if (top == PM_NONE || (is_greatest(e) ? value > best : value < best)) top = k;
    }
    const double value = w->ask->sample[top * nask + ask], best = w->ask->best[ask];
    if (!isnan(best) && !(is_greatest(e) ? value > best : value < best)) return PM_OK;
    const int status = look(w, pm_crossing_node(w, top), 1);
    if (!status) offer(w, ask, value);
    return status;
}

/* The samples of a whole step serve for its part up to step_end, too, where they resolve the values. */
int pm_ask_keeps_samples(const pm_workspace *w)
{
    if (!pm_nodes_spectral(w->nodes)) return 0;
    for (int i = 0; i < w->ask->nobserver; i++)
        for (int k = 0; k < w->nodes->n; k++)
            if (isnan(w->ask->sample[k * w->model->nask + w->ask->observer[i]])) return 0;
    return 1;
}

/* The end of a step that was shortened is no node. */
static int offer_end(pm_workspace *w)
{
    pm_frame_look_state(w, &w->state);
    const int status = w->ask->level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
    for (int i = 0; i < w->ask->nobserver && !status; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, w->ask->observer[i]);
        if (e[PM_ASK_KIND] != PM_ASK_GRID) offer(w, w->ask->observer[i], run(w, watched_program(e)));
    }
    return status;
}

int pm_ask_step(pm_workspace *w)
{
    if (w->ask->nobserver > 0 && w->step_end < w->sampled_end) {
        const int status = offer_end(w);
        if (status) return status;
    }
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i], grid = PM_ASK_ROW(w->model, ask)[PM_ASK_KIND] == PM_ASK_GRID;
        int status = grid ? grid_in_step(w, ask) : extreme_in_step(w, ask);
        if (!status && !grid) status = offer_node(w, ask);
        if (status) return status;
    }
    return PM_OK;
}

void pm_ask_instant(pm_workspace *w)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        const int32_t *e = PM_ASK_ROW(w->model, ask);
        const double value = run(w, watched_program(e));
        if (e[PM_ASK_KIND] == PM_ASK_GRID)
            offer_grid(w, ask, value, ON_GRID);
        else
            offer(w, ask, value);
    }
}

void pm_ask_look_before(pm_workspace *w)
{
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_BEFORE] && e[PM_ASK_EVENT_INDEX] != PM_NONE)
            w->ask->before[i] = run(w, e[PM_ASK_PROGRAM]);
    }
}

/* A value from before the jump has left its frame: nothing is said of its error. */
static void answer_fired(pm_workspace *w, int ask, int column, double value)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    if (e[PM_ASK_BEFORE])
        answer(w, ask, column, value);
    else
        answer_here(w, ask, column, e[PM_ASK_PROGRAM], value);
}

void pm_ask_fired(pm_workspace *w, int event)
{
    const int64_t nth = w->event->count[event];
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_EVENT_INDEX] != event) continue;
        const double value = e[PM_ASK_BEFORE] ? w->ask->before[i] : run(w, e[PM_ASK_PROGRAM]);
        if (e[PM_ASK_KIND] == PM_ASK_EVENT && nth == e[PM_ASK_NTH]) answer_fired(w, i, 0, value);
        if (e[PM_ASK_KIND] == PM_ASK_EACH && nth <= e[PM_ASK_COUNT]) answer_fired(w, i, (int)nth - 1, value);
    }
}

void pm_ask_end(pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        if (e[PM_ASK_KIND] == PM_ASK_END) answer_here(w, i, 0, e[PM_ASK_PROGRAM], run(w, e[PM_ASK_PROGRAM]));
        if (e[PM_ASK_KIND] == PM_ASK_GRID) offer_grid(w, i, run(w, e[PM_ASK_PROGRAM_2]), ON_GRID);
        if (w->ask->undefined[i]) answer(w, i, 0, NAN);
        int filled = 1, undefined = 0, infinite = 0;
        for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
            filled &= w->ask->filled[e[PM_ASK_OUT] + k];
            undefined |= isnan(w->out[e[PM_ASK_OUT] + k]);
            infinite |= isinf(w->out[e[PM_ASK_OUT] + k]);
        }
        const int each = e[PM_ASK_KIND] == PM_ASK_EACH;
        if (each) filled = w->ask->filled[e[PM_ASK_OUT]];
        if (filled) w->reason[i] = infinite ? PM_REASON_INFINITE : PM_REASON_NONE;
        if (filled && undefined && !each) w->reason[i] = PM_REASON_UNDEFINED;
    }
}

/* ---- runs that do not come to their end ---- */
void pm_ask_seal(pm_workspace *w)
{
    memcpy(w->ask->sound, w->ask->filled, (size_t)w->model->nout);
    w->ask->fresh = 0;
}

void pm_ask_keep(pm_workspace *w, int sound, int others)
{
    const unsigned char *kept = sound ? w->ask->sound : w->ask->filled;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        const int at_instant =
            e[PM_ASK_KIND] == PM_ASK_EVENT || e[PM_ASK_KIND] == PM_ASK_EACH || e[PM_ASK_KIND] == PM_ASK_GRID;
        w->reason[i] = others;
        for (int k = e[PM_ASK_OUT]; k < e[PM_ASK_OUT] + e[PM_ASK_COUNT]; k++)
            if (at_instant && kept[k])
                w->reason[i] = PM_REASON_NONE;
            else
                w->out[k] = NAN;
    }
}
