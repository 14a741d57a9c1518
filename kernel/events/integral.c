/* integral.c - each step adds its part: by the polynomial through its nodes where that resolves the value, else by
 * Gauss-Kronrod quadrature.
 *
 * Where a switch of the program changes (program.h) the value has a corner or jumps: the step is cut there, and each piece is
 * smooth.  The windows of a step (step_window.h) see to it that between two nodes no switch changes twice. */
#include "events/integral.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

#include "events/ask.h"
#include "events/percentile.h"
#include "events/step.h"
#include "events/switch_search.h"
#include "events/watched_samples.h"
#include "numerics/chebyshev.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"

#define INTERVALS 200   /* of one adaptive quadrature */
#define FEW_INTERVALS 8 /* of one whose value is noise: it is not as loud everywhere */
#define PM_CUTS 256     /* of one step, at the most: what is left is smooth no more, and needs more looks */

static void quadrature_free(void *quadrature) { gsl_integration_workspace_free(quadrature); }

int pm_integral_create(pm_workspace *w)
{
    pm_ask_set *a = w->ask;
    const pm_array array[] = {PM_ARRAY(a->integral, w->model->nask)};
    a->quadrature = gsl_integration_workspace_alloc(INTERVALS);
    if (pm_arena_keep(&w->memory, a->quadrature, quadrature_free)) return PM_NO_MEMORY;
    if (pm_percentile_create(w)) return PM_NO_MEMORY;
    return pm_arena_take(&w->memory, PM_ARRAYS(array)) || pm_integral_series_create(w) ? PM_NO_MEMORY : PM_OK;
}

void pm_integral_reset(pm_workspace *w)
{
    memset(w->ask->integral, 0, (size_t)w->model->nask * sizeof *w->ask->integral);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) pm_integral_series_forget(w, i);
    pm_percentile_reset(w);
}

/* ---- one program over a piece of the step ---- */
typedef struct pm_integrand {
    pm_workspace *w;
    int program, squared;
    const double *sample; /* at the nodes, squared if that is wanted */
    double size;          /* greatest of its size so far */
} pm_integrand;

static double at(double t, void *context)
{
    const pm_integrand *f = context;
    const double value = pm_ask_look(f->w, t, 0) ? NAN : pm_ask_value(f->w, f->program);
    return f->squared ? value * value : value;
}

/* What may be wrong with the integral over a second. */
static double allowed(const pm_integrand *f) { return PM_INTEGRAL_ERROR * f->w->numbers.tolerance * f->size; }

/* Through all nodes; 0 if the polynomial does not resolve it so well. */
static int by_nodes(const pm_integrand *f, double to, double *sum, double *error)
{
    const pm_step *s = &f->w->step;
    const double whole = s->sampled_end - s->begin;
    if (!pm_chebyshev_nodes_spectral(s->nodes)) return 0;
    *error = pm_chebyshev_high(s->nodes, f->sample) * whole;
    if (!(*error <= allowed(f) * whole)) return 0;
    *sum = whole * (to == s->sampled_end
                        ? pm_chebyshev_whole(s->nodes, f->sample)
                        : pm_chebyshev_integral(s->nodes, f->sample, 1, (to - s->begin) / whole));
    return 1;
}

/* What no number of looks makes better, by the time: what the value is off a smooth one in pieces so short that all else is
 * straight there.  The middle one of three: one may have a corner, and one may be quiet. */
static double noise_of(gsl_function *g, double from, double to)
{
    static const double place[3] = {0.191, 0.464, 0.7236};
    double noise[3];
    for (int i = 0; i < 3; i++) {
        const double begin = from + place[i] * (to - from), end = begin + PM_INTEGRAL_SHORT * (to - from);
        double sum, size, range;
        gsl_integration_qk15(g, begin, end, &sum, &noise[i], &size, &range);
        noise[i] /= end - begin;
    }
    const double low = fmin(noise[0], noise[1]), high = fmax(noise[0], noise[1]);
    const double middle = fmax(low, fmin(high, noise[2]));
    return isfinite(middle) ? middle : 0;
}

/* By looks inside of (from, to): once, and if that is not enough of halves of it, and halves of these, down to its noise. */
static void by_looks(pm_integrand *f, double from, double to, double *sum, double *error)
{
    double size, range;
    gsl_function g = {at, f};
    const double relative = fmax(PM_INTEGRAL_ERROR * f->w->numbers.tolerance, PM_INTEGRAL_ROUNDING);
    double absolute = allowed(f) * (to - from);
    gsl_integration_qk15(&g, from, to, sum, error, &size, &range);
    if (*error <= fmax(absolute, relative * fabs(*sum))) return;
    const double noise = PM_INTEGRAL_NOISE * noise_of(&g, from, to) * (to - from);
    const size_t most = noise > absolute ? FEW_INTERVALS : INTERVALS;
    absolute = fmax(noise, absolute);
    if (*error <= absolute) return;
    gsl_integration_qag(&g, from, to, absolute, relative, most, GSL_INTEG_GAUSS21, f->w->ask->quadrature, sum,
                        error);
}

static void over_piece(pm_integrand *f, double from, double to, int uncut, double *sum, double *error)
{
    double more, off;
    if (!uncut || !by_nodes(f, to, &more, &off)) by_looks(f, from, to, &more, &off);
    *sum += more;
    *error += off;
}

/* ---- where the program switches ---- */
/* The arguments of its switches at a place: 0 where one has been found to change. */
typedef struct pm_integral_place {
    double t, arg[PM_SWITCHES];
} pm_integral_place;

/* The places inside a step where one of the n switches changes. */
typedef struct pm_integral_cuts {
    int nswitch, n;
    double at[PM_CUTS];
    pm_switch_search search;
} pm_integral_cuts;

static int changes(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

/* A switch that changes between two places, at `middle`; one that does so on one of them is on its zero there.  0: none does. */
static int find_change(pm_workspace *w, pm_integral_cuts *x, pm_integral_place *from, pm_integral_place *to,
                       pm_integral_place *middle)
{
    for (int i = 0; i < x->nswitch; i++) {
        if (!changes(from->arg[i], to->arg[i])) continue;
        x->search.i = i;
        const enum pm_search_end end =
            pm_switch_search_find(w, &x->search, from->t, from->arg[i], to->t, to->arg[i], &middle->t);
        if (end == PM_SEARCH_NO_NUMBER) continue;
        if (middle->t > from->t && middle->t < to->t) {
            (void)pm_switch_search_argument(w, middle->t, &x->search);
            for (int k = 0; k < x->nswitch; k++) middle->arg[k] = k == i ? 0 : x->search.here.arg[k][0];
            return 1;
        }
        (middle->t <= from->t ? from : to)->arg[i] = 0;
    }
    return 0;
}

/* Between two places: in order.  What changes there and back, as abs does to what it is compared with, shows where another
 * switch changes in between. */
static void cut_between(pm_workspace *w, pm_integral_cuts *x, pm_integral_place from, pm_integral_place to)
{
    pm_integral_place middle;
    if (x->n == PM_CUTS || !find_change(w, x, &from, &to, &middle)) return;
    cut_between(w, x, from, middle);
    if (x->n < PM_CUTS) x->at[x->n++] = middle.t;
    cut_between(w, x, middle, to);
}

static void place_node(const pm_step *step, const pm_switches *at_nodes, int node, pm_integral_place *place)
{
    place->t = pm_step_node(step, node);
    for (int i = 0; i < at_nodes->n; i++) place->arg[i] = at_nodes->arg[i][node];
}

/* Those of the samples, nodes on which a switch is zero among them. */
static void find_cuts(pm_workspace *w, int ask, pm_integral_cuts *x)
{
    pm_switches at_nodes = {.sign = NULL};
    pm_integral_place from, to;
    double value[PM_NODES_MOST];
    x->n = 0;
    if (w->ask->switches[ask] == 0) return;
    x->search.program = pm_ask_program(PM_ASK_ROW(w->model, ask));
    x->search.exactly = 0;
    x->search.here.sign = NULL;
    pm_watched_samples_run(w, x->search.program, &at_nodes, value);
    x->nswitch = at_nodes.n;
    place_node(&w->step, &at_nodes, 0, &from);
    for (int k = 1; k < w->step.nodes->n; k++, from = to) {
        int on_zero = 0;
        place_node(&w->step, &at_nodes, k, &to);
        cut_between(w, x, from, to);
        for (int i = 0; i < x->nswitch; i++) on_zero |= to.arg[i] == 0;
        if (on_zero && x->n < PM_CUTS) x->at[x->n++] = to.t;
    }
}

/* ---- a step ---- */
/* The samples of f, and how large it is. */
static void read_nodes(pm_workspace *w, int ask, double *sample)
{
    pm_integral *x = &w->ask->integral[ask];
    const double *value = pm_ask_samples(w, ask);
    const int n = w->step.nodes->n, squared = pm_integral_is_squared(PM_ASK_ROW(w->model, ask));
    double sum = 0;
    for (int k = 0; k < n; k++) {
        sample[k] = squared ? value[k] * value[k] : value[k];
        if (!isfinite(sample[k])) continue;
        x->size = fmax(x->size, fabs(sample[k]));
        sum += fabs(sample[k]);
    }
    x->terms += sum / n * (w->step.end - w->step.begin);
}

int pm_integral_step(pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const pm_step *s = &w->step;
    pm_integral *x = &w->ask->integral[ask];
    double sample[PM_NODES_MOST], holds[PM_NODES_MOST], from = s->begin, nothing = 0;
    const int condition = e[PM_ASK_PROGRAM_2];
    pm_integral_cuts cut;
    find_cuts(w, ask, &cut);
    read_nodes(w, ask, sample);
    if (condition >= 0) pm_watched_samples_run(w, condition, NULL, holds);
    pm_integrand f = {w, e[PM_ASK_PROGRAM], pm_integral_is_squared(e), sample, x->size},
                 c = {w, condition, 0, holds, 1};
    for (int i = 0; i <= cut.n && from < s->end; i++) {
        const double to = i < cut.n ? fmin(cut.at[i], s->end) : s->end;
        if (!(to > from)) continue;
        over_piece(&f, from, to, cut.n == 0, &x->sum, &x->error);
        if (condition >= 0) over_piece(&c, from, to, cut.n == 0, &x->weight, &nothing);
        if (pm_integral_is_percentile(e) && pm_percentile_take(w, ask, from, to)) return PM_NO_MEMORY;
        from = to;
    }
    if (condition < 0) x->weight += s->end - s->begin;
    const int whole = s->end == s->sampled_end, last = s->nodes->n - 1;
    x->last = whole ? sample[last] : NAN;
    x->last_weight = condition < 0 ? 1 : whole ? holds[last] : NAN;
    x->span += s->end - s->begin;
    return PM_OK;
}

/* ---- the answer ---- */
/* What the sum is divided by. */
static double divisor(const pm_integral *x, const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_INTEGRAL ? 1 : x->weight;
}

double pm_integral_answer(pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const pm_integral *x = &w->ask->integral[ask];
    const double mean = x->sum / divisor(x, e),
                 value = pm_integral_is_squared(e) ? sqrt(fmax(mean, 0)) : mean;
    if (!(fabs(x->span - w->state.t) <= PM_INTEGRAL_ALL * w->state.t) || isnan(mean)) return NAN;
    double error =
        (x->error + (e[PM_ASK_KIND] == PM_ASK_INTEGRAL ? 0 : fabs(mean) * x->weight_error)) / divisor(x, e);
    if (pm_integral_is_percentile(e)) {
        const double percentile = pm_percentile_answer(w, ask, &error);
        pm_evidence_more(&w->evidence, e[PM_ASK_OUT], error);
        return percentile;
    }
    pm_evidence_more(&w->evidence, e[PM_ASK_OUT],
                     pm_integral_is_squared(e) ? sqrt(mean + error) - sqrt(mean) : error);
    return value;
}

double pm_integral_terms(const pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const pm_integral *x = &w->ask->integral[ask];
    const double terms = divisor(x, e) > 0 ? x->terms / divisor(x, e) : 0;
    return pm_integral_is_squared(e) ? sqrt(terms) : terms;
}
