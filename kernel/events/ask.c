/* ask.c - answers taken at instants, the best of them over the run; those inside steps are found by ask_step.c. */
#include "events/ask.h"

#include <math.h>
#include <string.h>

#include "equations/shared_reading.h"
#include "events/blows_left.h"
#include "events/derived.h"
#include "events/event.h"
#include "events/integral.h"
#include "events/integral_series.h"
#include "events/step.h"
#include "events/watched_samples.h"
#include "expression/program.h"
#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

static void raise_to(int *highest, int level)
{
    if (level > *highest) *highest = level;
}

static void note_switches(pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    w->ask->switches[ask] = pm_program_switches(w->model, pm_ask_program(e));
    w->ask->dips[ask] = pm_program_only_dips(w->model, pm_ask_program(e), pm_ask_greatest(e));
}

int pm_ask_create(pm_workspace *w)
{
    const int nask = w->model->nask, nout = w->model->nout;
    if (PM_ARENA_NEW(&w->memory, w->ask)) return PM_NO_MEMORY;
    pm_ask_set *a = w->ask;
    const pm_array array[] = {
        PM_ARRAY(a->sample, PM_NODES_MOST * nask),
        PM_ARRAY(a->best, nask),
        PM_ARRAY(a->bound, nask),
        PM_ARRAY(a->before, nask),
        PM_ARRAY(a->size, nask),
        PM_ARRAY(a->observer, nask),
        PM_ARRAY(a->switches, nask),
        PM_ARRAY(a->dips, nask),
        PM_ARRAY(a->undefined, nask),
        PM_ARRAY(a->shared, nask),
        PM_ARRAY(a->filled, nout),
        PM_ARRAY(a->sound, nout),
    };
    a->solver = pm_bracket_create();
    int status = pm_arena_keep(&w->memory, a->solver, pm_bracket_free);
    if (status || pm_arena_take(&w->memory, PM_ARRAYS(array)) ||
        pm_slope_create(&w->memory, &a->slope, w->model) || pm_integral_create(w))
        return PM_NO_MEMORY;
    a->level = a->instant_level = a->fired_level = PM_LEVEL_KINEMATIC;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        const int watches = pm_model_ask_watches(e);
        if (watches) a->observer[a->nobserver++] = i;
        if (watches) {
            note_switches(w, i);
            pm_watched_samples_add(w, pm_ask_program(e), PM_SAMPLE_ASKS);
        }
        if (pm_model_ask_is_integral(e) && e[PM_ASK_PROGRAM_2] >= 0)
            pm_watched_samples_add(w, e[PM_ASK_PROGRAM_2], PM_SAMPLE_ASKS);
        for (int k = 0; k < 2; k++) {
            const int program = e[k ? PM_ASK_PROGRAM_2 : PM_ASK_PROGRAM];
            const int level = program >= 0 ? w->model->programs.level[program] : PM_LEVEL_NONE;
            raise_to(&a->instant_level, level);
            if (watches) raise_to(&a->level, level);
            if (e[PM_ASK_EVENT_INDEX] != PM_NONE) raise_to(&a->fired_level, level);
        }
    }
    return PM_OK;
}

void pm_ask_reset(pm_workspace *w)
{
    pm_ask_set *a = w->ask;
    for (int i = 0; i < w->model->nask; i++) a->best[i] = NAN, a->bound[i] = -INFINITY, a->size[i] = 0;
    memset(a->undefined, 0, (size_t)w->model->nask);
    memset(a->shared, 0, (size_t)w->model->nask);
    memset(a->filled, 0, (size_t)w->model->nout);
    memset(a->sound, 0, (size_t)w->model->nout);
    a->fresh = 0;
    pm_integral_reset(w);
    for (int i = 0; i < w->model->nout; i++) w->result.out[i] = NAN;
    for (int i = 0; i < w->model->nask; i++) w->result.reason[i] = PM_REASON_NOT_REACHED;
}

double pm_ask_value(pm_workspace *w, int program) { return pm_program_run(w, program); }

double pm_ask_run(pm_workspace *w, int ask)
{
    return pm_ask_value(w, pm_ask_program(PM_ASK_ROW(w->model, ask)));
}

static void answer(pm_workspace *w, int ask, int column, double value)
{
    const int out = PM_ASK_ROW(w->model, ask)[PM_ASK_OUT] + column;
    w->result.out[out] = value;
    w->ask->filled[out] = w->ask->fresh = 1;
}

/* The value of a program at the frame; not a number where redundant constraints leave it open. */
static double unique(pm_workspace *w, int ask, int program, double value)
{
    if (!pm_shared_matters(w) || pm_shared_is_unique(w, program)) return value;
    w->ask->shared[ask] = 1;
    return NAN;
}

void pm_ask_answer(pm_workspace *w, int ask, int column, int program, double value)
{
    const pm_route_ops *route = w->phase.route;
    answer(w, ask, column, unique(w, ask, program, value));
    const int out = PM_ASK_ROW(w->model, ask)[PM_ASK_OUT] + column;
    pm_evidence_more(&w->evidence, out, pm_blows_left_error(w, program, 0));
    if (!route->error_of) return;
    if (!pm_derived_is(w->model, program))
        route->error_of(w, ask, out, program, value);
    else if (w->evidence.active)
        pm_evidence_answer(&w->evidence, out, pm_derived_error(w, program, value));
}

int pm_ask_program(const int32_t *e)
{
    return e[PM_ASK_KIND] == PM_ASK_GRID || pm_ask_at_extreme(e) ? e[PM_ASK_PROGRAM_2] : e[PM_ASK_PROGRAM];
}

int pm_ask_watched(const pm_model *model, const pm_ask_set *ask, int i)
{
    return pm_ask_program(PM_ASK_ROW(model, ask->observer[i]));
}

void pm_ask_offer(pm_workspace *w, int ask, double value, double above)
{
    pm_ask_set *a = w->ask;
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    if (isnan(value)) {
        a->undefined[ask] = 1;
        return;
    }
    const double extreme = value + above;
    const int better = pm_ask_greatest(e) ? extreme > a->best[ask] : extreme < a->best[ask];
    if (!isnan(a->best[ask]) && !better) return;
    a->best[ask] = extreme;
    pm_ask_answer(w, ask, 0, e[PM_ASK_PROGRAM],
                  pm_ask_at_extreme(e) ? pm_ask_value(w, e[PM_ASK_PROGRAM]) : value);
    w->result.out[e[PM_ASK_OUT]] += above;
}

/* Grid values that are met at an instant: to rounding, of the value itself or of what it is a difference of. */
static void offer_grid(pm_workspace *w, int ask, double value)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    double *size = &w->ask->size[ask];
    for (int k = 0; k < e[PM_ASK_COUNT]; k++)
        *size = fmax(*size, fabs(w->numbers.value[e[PM_ASK_FIRST_VALUE] + k]));
    *size = fmax(*size, fabs(value));
    for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
        const double wanted = w->numbers.value[e[PM_ASK_FIRST_VALUE] + k];
        const double near = fmax(PM_ON_GRID * fabs(wanted), PM_GRID_ROUNDING * *size);
        if (w->ask->filled[e[PM_ASK_OUT] + k] || !(fabs(value - wanted) <= near)) continue;
        pm_ask_answer(w, ask, k, e[PM_ASK_PROGRAM], pm_ask_value(w, e[PM_ASK_PROGRAM]));
    }
}

void pm_ask_sample(pm_workspace *w)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        pm_watched_samples_run(w, pm_ask_program(PM_ASK_ROW(w->model, ask)), NULL, pm_ask_samples(w, ask));
    }
}

int pm_ask_look(pm_workspace *w, double t, int exact)
{
    if (!exact || w->phase.route->look) return pm_step_look(w, t, w->ask->level);
    return pm_step_look_exactly(w, t, w->ask->level);
}

static double value_at(pm_workspace *w, double t, const pm_ask_watch *x)
{
    if (pm_ask_look(w, t, 0)) return NAN;
    return (x->branch ? pm_watched_samples_here(w, x->program, x->branch) : pm_ask_value(w, x->program)) -
           x->minus;
}

double pm_ask_along(void *of, double t, void *context)
{
    pm_workspace *w = of;
    const pm_ask_watch *x = context;
    const double d = x->step;
    if (d == 0) return value_at(w, t, x);
    return (8 * (value_at(w, t + d, x) - value_at(w, t - d, x)) -
            (value_at(w, t + 2 * d, x) - value_at(w, t - 2 * d, x))) /
           (12 * d);
}

void pm_ask_instant(pm_workspace *w)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        const int32_t *e = PM_ASK_ROW(w->model, ask);
        const double value = unique(w, ask, pm_ask_program(e), pm_ask_run(w, ask));
        if (pm_model_ask_is_integral(e))
            w->ask->undefined[ask] |= w->ask->shared[ask]; /* of the phase that begins, too */
        else if (e[PM_ASK_KIND] == PM_ASK_GRID)
            offer_grid(w, ask, value);
        else
            pm_ask_offer(w, ask, value, 0);
    }
}

void pm_ask_look_before(pm_workspace *w)
{
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_BEFORE] && e[PM_ASK_EVENT_INDEX] != PM_NONE)
            w->ask->before[i] = unique(w, i, e[PM_ASK_PROGRAM], pm_ask_value(w, e[PM_ASK_PROGRAM]));
    }
}

/* A value from before the jump has left its frame: nothing is said of its error. */
static void answer_fired(pm_workspace *w, int ask, int column, double value)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    if (e[PM_ASK_BEFORE]) {
        answer(w, ask, column, value);
        pm_evidence_more(&w->evidence, e[PM_ASK_OUT] + column, pm_blows_left_error(w, e[PM_ASK_PROGRAM], 1));
    } else
        pm_ask_answer(w, ask, column, e[PM_ASK_PROGRAM], value);
}

void pm_ask_fired(pm_workspace *w, int event)
{
    const int64_t nth = w->firing.count[event];
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_EVENT_INDEX] != event) continue;
        const double value = e[PM_ASK_BEFORE] ? w->ask->before[i] : pm_ask_value(w, e[PM_ASK_PROGRAM]);
        if (e[PM_ASK_KIND] == PM_ASK_EVENT && nth == e[PM_ASK_NTH]) answer_fired(w, i, 0, value);
        if (e[PM_ASK_KIND] == PM_ASK_EACH && nth <= e[PM_ASK_COUNT]) answer_fired(w, i, (int)nth - 1, value);
    }
}

void pm_ask_fails(pm_workspace *w, int event)
{
    const int64_t nth = w->firing.count[event] + !w->firing.counted[event];
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        if (e[PM_ASK_EVENT_INDEX] != event || !e[PM_ASK_BEFORE]) continue;
        if (e[PM_ASK_KIND] == PM_ASK_EVENT && nth == e[PM_ASK_NTH]) answer(w, i, 0, w->ask->before[i]);
        if (e[PM_ASK_KIND] == PM_ASK_EACH && nth <= e[PM_ASK_COUNT])
            answer(w, i, (int)nth - 1, w->ask->before[i]);
    }
}

/* What an extreme may have above the one that is answered. */
static void charge_residual(pm_workspace *w, int ask)
{
    const pm_ask_set *a = w->ask;
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const double best = pm_ask_greatest(e) ? a->best[ask] : -a->best[ask];
    if (a->bound[ask] > best) pm_evidence_more(&w->evidence, e[PM_ASK_OUT], a->bound[ask] - best);
}

/* A list of an event that fired more often than it is long. */
static int is_cut(const pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    return e[PM_ASK_KIND] == PM_ASK_EACH && w->ask->filled[e[PM_ASK_OUT] + e[PM_ASK_COUNT] - 1] &&
           w->firing.count[e[PM_ASK_EVENT_INDEX]] > e[PM_ASK_COUNT];
}

void pm_ask_end(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_integral_series_break(w);
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        if (e[PM_ASK_KIND] == PM_ASK_END)
            pm_ask_answer(w, i, 0, e[PM_ASK_PROGRAM], pm_ask_value(w, e[PM_ASK_PROGRAM]));
        if (e[PM_ASK_KIND] == PM_ASK_GRID) offer_grid(w, i, pm_ask_value(w, e[PM_ASK_PROGRAM_2]));
        if (pm_model_ask_is_integral(e)) answer(w, i, 0, pm_integral_answer(w, i));
        if (w->ask->undefined[i]) answer(w, i, 0, NAN);
        charge_residual(w, i);
        int filled = 1, undefined = 0, infinite = 0;
        for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
            filled &= w->ask->filled[e[PM_ASK_OUT] + k];
            undefined |= isnan(w->result.out[e[PM_ASK_OUT] + k]);
            infinite |= isinf(w->result.out[e[PM_ASK_OUT] + k]);
        }
        const int each = e[PM_ASK_KIND] == PM_ASK_EACH;
        if (each) filled = w->ask->filled[e[PM_ASK_OUT]];
        if (filled) w->result.reason[i] = infinite ? PM_REASON_INFINITE : PM_REASON_NONE;
        if (filled && undefined && !each) w->result.reason[i] = PM_REASON_UNDEFINED;
        if (filled && undefined && w->ask->shared[i]) w->result.reason[i] = PM_REASON_SHARED;
        if (is_cut(w, i)) w->result.reason[i] = PM_REASON_CUT;
        const int missing =
            e[PM_ASK_KIND] == PM_ASK_END ? pm_derived_reason(w, e[PM_ASK_PROGRAM]) : PM_REASON_NONE;
        if (missing != PM_REASON_NONE) w->result.reason[i] = missing;
    }
}

/* ---- runs that do not come to their end ---- */
void pm_ask_seal(const pm_model *model, pm_ask_set *ask)
{
    memcpy(ask->sound, ask->filled, (size_t)model->nout);
    ask->fresh = 0;
}

void pm_ask_keep(pm_workspace *w, int sound, int others)
{
    const unsigned char *kept = sound ? w->ask->sound : w->ask->filled;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *e = PM_ASK_ROW(w->model, i);
        const int at_instant =
            e[PM_ASK_KIND] == PM_ASK_EVENT || e[PM_ASK_KIND] == PM_ASK_EACH || e[PM_ASK_KIND] == PM_ASK_GRID;
        w->result.reason[i] = others;
        for (int k = e[PM_ASK_OUT]; k < e[PM_ASK_OUT] + e[PM_ASK_COUNT]; k++)
            if (at_instant && kept[k])
                w->result.reason[i] = PM_REASON_NONE;
            else
                w->result.out[k] = NAN;
        if (is_cut(w, i)) w->result.reason[i] = PM_REASON_CUT;
    }
}
