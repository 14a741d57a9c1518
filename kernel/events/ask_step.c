/* ask_step.c - what asks take of a step that has been sampled: grid values that it passes, extremes in it, its part of integrals.
 *
 * A grid value lies between two nodes with samples on both sides of it: it is bracketed there on the dense output, and
 * polished on exact states.  Extremes: extremum.h; integrals: integral.h. */
#include <math.h>

#include "events/ask.h"
#include "events/extremum.h"
#include "events/extremum_bound.h"
#include "events/integral.h"
#include "events/step.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev_nodes.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static int exactly(void *of, double t, void *context, double *value)
{
    pm_workspace *w = of;
    const pm_ask_watch *x = context;
    const int status = pm_ask_look(w, t, 1);
    *value = pm_ask_value(w, x->program) - x->minus;
    return status;
}

/* A grid value is passed between node i and the next: where, if that is in the step. */
static int pass_grid_value(pm_workspace *w, int ask, pm_ask_watch *x, int i, int column)
{
    const int program = PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM];
    const double *sample = pm_ask_samples(w, ask) + i;
    double t, taken, off;
    int status =
        pm_fail_search(&w->result, pm_bracket_find(w->ask->solver, pm_ask_along, w, x,
                                                   pm_step_node(&w->step, i), sample[0] - x->minus,
                                                   pm_step_node(&w->step, i + 1), sample[1] - x->minus, &t));
    if (!status)
        status =
            pm_bracket_polish(pm_ask_along, exactly, w, x, w->step.begin, w->step.end, NAN, &t, &taken, &off);
    if (!status && taken != t) status = pm_ask_look(w, t, 1);
    if (!status && t <= w->step.end) pm_ask_answer(w, ask, column, program, pm_ask_value(w, program));
    return status;
}

/* The run has begun on a grid value, to the rounding of what is watched: how large that is the first step shows. */
static int has_begun_on(const pm_step *step, const pm_result *result, const double *sample, double wanted)
{
    double size = 0;
    if (result->count[PM_COUNT_STEPS] != 1) return 0;
    for (int i = 0; i < step->nodes->n; i++) size = fmax(size, fabs(sample[i]));
    return fabs(sample[0] - wanted) <= PM_GRID_ROUNDING * size;
}

static int grid_in_step(pm_workspace *w, int ask)
{
    const int32_t *e = PM_ASK_ROW(w->model, ask);
    const double *sample = pm_ask_samples(w, ask);
    int status = PM_OK;
    for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
        const unsigned char *filled = &w->ask->filled[e[PM_ASK_OUT] + k];
        pm_ask_watch x = {e[PM_ASK_PROGRAM_2], w->numbers.value[e[PM_ASK_FIRST_VALUE] + k], 0, NULL};
        for (int i = 0; i + 1 < w->step.nodes->n && !*filled; i++) {
            const double a = sample[i] - x.minus, b = sample[i + 1] - x.minus;
            if ((a < 0 && b >= 0) || (a > 0 && b <= 0)) status = pass_grid_value(w, ask, &x, i, k);
            if (status) return status;
        }
        if (*filled || !has_begun_on(&w->step, &w->result, sample, x.minus)) continue;
        if ((status = pm_ask_look(w, w->step.begin, 1))) return status;
        pm_ask_answer(w, ask, k, e[PM_ASK_PROGRAM], pm_ask_value(w, e[PM_ASK_PROGRAM]));
    }
    return PM_OK;
}

/* The samples of a whole step serve for its part up to step_end, too, where they resolve the values. */
int pm_ask_keeps_samples(const pm_step *step, const struct pm_ask_set *ask)
{
    if (!pm_chebyshev_nodes_spectral(step->nodes)) return 0;
    for (int i = 0; i < ask->nobserver; i++)
        for (int k = 0; k < step->nodes->n; k++)
            if (isnan(ask->sample[ask->observer[i] * PM_NODES_MOST + k])) return 0;
    return 1;
}

static int extreme_in_step(pm_workspace *w, int ask)
{
    const int status = pm_extremum_take(w, ask);
    return status ? status : pm_extremum_bound_by_law(w, ask);
}

/* The end of a step that was shortened is no node. */
static int offer_end(pm_workspace *w)
{
    int counts = 0;
    for (int i = 0; i < w->ask->nobserver && !counts; i++)
        counts = pm_model_ask_is_extreme(PM_ASK_ROW(w->model, w->ask->observer[i])) &&
                 pm_extremum_end_counts(w, w->ask->observer[i]);
    const int status = counts ? pm_ask_look(w, w->step.end, 1) : PM_OK;
    for (int i = 0; i < w->ask->nobserver && !status && counts; i++) {
        const int ask = w->ask->observer[i];
        if (pm_model_ask_is_extreme(PM_ASK_ROW(w->model, ask))) pm_ask_offer(w, ask, pm_ask_run(w, ask), 0);
    }
    return status;
}

int pm_ask_step(pm_workspace *w)
{
    if (w->ask->nobserver > 0 && w->step.end < w->step.sampled_end) {
        const int status = offer_end(w);
        if (status) return status;
    }
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        const int32_t *e = PM_ASK_ROW(w->model, ask);
        const int status = pm_model_ask_is_integral(e)  ? pm_integral_step(w, ask)
                           : pm_model_ask_is_extreme(e) ? extreme_in_step(w, ask)
                                                        : grid_in_step(w, ask);
        if (status) return status;
    }
    return PM_OK;
}
