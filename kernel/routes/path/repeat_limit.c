/* repeat_limit.c - how many segments may be passed over, and nobody notices.
 *
 * A value that is watched changes by a constant from segment to segment (symmetry.c) or goes with a power of T (program_grade.c), and T
 * rises or falls throughout.  If it does one of both, its extremes lie in the first or the last segment, which are computed;
 * and if it has the same sign throughout these two it has that in between.  What stays in [low, high] in one segment, low > 0,
 * and changes by d from segment to segment stays off its zero for (low - (high - low)) / |d| segments. */
#include <math.h>

#include "elements/trigger.h"
#include "equations/case.h"
#include "events/ask.h"
#include "events/event.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "routes/path/repeat.h"
#include "state/workspace.h"

static int64_t fewest(int64_t a, int64_t b) { return a < b ? a : b; }

/* `segments`, but no less than none, and no more than `most` or than are passed over at once. */
static int64_t at_most(int64_t most, double segments)
{
    const int64_t bound = fewest(most, PM_MOST_REPEATS);
    return segments < (double)bound ? (int64_t)fmax(segments, 0) : bound;
}

/* ---- triggers ---- */
/* A trigger that moves with the segments towards its zero must stay off it. */
static int64_t until_zero(const struct pm_event_set *event, int trigger, double change)
{
    const double low = event->least[trigger], high = event->greatest[trigger], spread = high - low;
    if (low > 0 && change > 0) return PM_REPEAT_FOR_EVER;
    if (high < 0 && change < 0) return PM_REPEAT_FOR_EVER;
    const double room = low > 0 ? low : high < 0 ? -high : 0;
    return at_most(PM_REPEAT_FOR_EVER, floor((room - spread) / fabs(change)) - 1);
}

static int64_t time_allows(pm_workspace *w, int trigger, double time)
{
    const double due = pm_trigger_due(w, trigger);
    if (!isfinite(due)) return PM_REPEAT_FOR_EVER;
    return time > 0 ? at_most(PM_REPEAT_FOR_EVER, floor((due - w->state.t) / time) - 1) : 0;
}

static int64_t trigger_allows(pm_workspace *w, const pm_repeat *l, int trigger,
                              const pm_symmetry_shift *shift, double time)
{
    const int32_t *e = PM_TRIGGER_ROW(w->model, trigger);
    const int kind = e[PM_TRIGGER_KIND];
    double change;
    if (kind > PM_TRIGGER_EVERY) return PM_REPEAT_FOR_EVER;
    if (pm_trigger_on_time(w->model, trigger)) return time_allows(w, trigger, time);
    const int growth = w->model->programs.energy[e[PM_TRIGGER_PROGRAM]];
    if (!pm_symmetry_program(&w->frame, shift, e[PM_TRIGGER_PROGRAM], &change)) return 0;
    if (kind == PM_TRIGGER_EVERY)
        return growth != PM_ENERGY_CLASS_NONE || fabs(change - round(change)) > PM_REPEAT_WHOLE
                   ? 0
                   : PM_REPEAT_FOR_EVER;
    if (change != 0) return growth != PM_ENERGY_CLASS_NONE ? 0 : until_zero(w->event, trigger, change);
    if (l->steady) return PM_REPEAT_FOR_EVER; /* it fires as it did */
    if (growth <= PM_ENERGY_CLASS_ROOT && growth != PM_ENERGY_CLASS_LINEAR) return PM_REPEAT_FOR_EVER;
    /* its zero moves with T: it must stay off it, here and in the last segment (repeat_replay.c) */
    return growth > PM_ENERGY_CLASS_STEADY || l->side[trigger] == 0 ? 0 : PM_REPEAT_FOR_EVER;
}

int pm_repeat_limit_moves(const pm_model *model, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(model, trigger);
    if (e[PM_TRIGGER_KIND] >= PM_TRIGGER_EVERY || pm_trigger_on_time(model, trigger)) return 0;
    const int growth = model->programs.energy[e[PM_TRIGGER_PROGRAM]];
    return growth == PM_ENERGY_CLASS_LINEAR || growth == PM_ENERGY_CLASS_STEADY;
}

int pm_repeat_limit_read_sides(pm_workspace *w)
{
    int changed = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int side = w->event->least[i] > 0 ? 1 : w->event->greatest[i] < 0 ? -1 : 0;
        changed |= side != w->repeat->side[i];
        w->repeat->side[i] = side;
    }
    return changed;
}

int64_t pm_repeat_limit_fires(const pm_firing *firing, const struct pm_repeat *repeat, int event)
{
    return firing->count[event] - repeat->event_count[event];
}

int64_t pm_repeat_limit_instants(const pm_workspace *w, const pm_repeat *l)
{
    const int64_t *now = w->result.count;
    int64_t fired = now[PM_COUNT_JUMPS] - l->count[PM_COUNT_JUMPS];
    for (int i = 0; i < w->model->rows[PM_TABLE_EVENT]; i++) fired += pm_repeat_limit_fires(&w->firing, l, i);
    return l->steady && fired == 0 ? 0 : now[PM_COUNT_EVENTS] - l->count[PM_COUNT_EVENTS];
}

/* ---- asks ---- */
static int grid_is_full(const struct pm_ask_set *ask, const int32_t *e)
{
    for (int k = 0; k < e[PM_ASK_COUNT]; k++)
        if (!ask->filled[e[PM_ASK_OUT] + k]) return 0;
    return 1;
}

/* All values of the grid are there, or what it watches goes the same way again and meets no other. */
static int64_t grid_allows(const pm_workspace *w, const pm_repeat *l, const int32_t *e,
                           const pm_symmetry_shift *shift)
{
    double change;
    if (grid_is_full(w->ask, e)) return PM_REPEAT_FOR_EVER;
    const int alike = l->steady && pm_symmetry_program(&w->frame, shift, pm_ask_program(e), &change);
    return alike && change == 0 ? PM_REPEAT_FOR_EVER : 0;
}

/* Firings up to the last one that is asked. */
static int64_t firings_allow(const pm_firing *firing, const struct pm_repeat *repeat, const int32_t *e)
{
    const int event = e[PM_ASK_EVENT_INDEX], each_is_asked = e[PM_ASK_KIND] == PM_ASK_EACH;
    const int64_t last = each_is_asked ? e[PM_ASK_COUNT] : e[PM_ASK_NTH],
                  each = pm_repeat_limit_fires(firing, repeat, event);
    if (each == 0 || firing->count[event] >= last) return PM_REPEAT_FOR_EVER;
    return each_is_asked ? 0
                         : at_most(PM_REPEAT_FOR_EVER, (double)((last - 1 - firing->count[event]) / each));
}

static int64_t extreme_allows(const pm_frame *frame, const pm_repeat *l, const int32_t *e,
                              const pm_symmetry_shift *shift)
{
    const int growth = frame->model->programs.energy[pm_ask_program(e)];
    double change;
    if (!pm_symmetry_program(frame, shift, pm_ask_program(e), &change)) return 0;
    if (change == 0 && l->steady) return PM_REPEAT_FOR_EVER;
    if (change != 0 && growth != PM_ENERGY_CLASS_NONE) return 0; /* both change: neither end is the extreme */
    const int bends_well = growth == (pm_ask_greatest(e) ? PM_ENERGY_CLASS_CONVEX : PM_ENERGY_CLASS_CONCAVE);
    return growth > PM_ENERGY_CLASS_STEADY && !bends_well ? 0 : PM_REPEAT_FOR_EVER;
}

static int64_t ask_allows(const pm_workspace *w, const pm_repeat *l, const int32_t *e,
                          const pm_symmetry_shift *shift)
{
    switch (e[PM_ASK_KIND]) {
    case PM_ASK_END: return PM_REPEAT_FOR_EVER;
    case PM_ASK_EVENT:
    case PM_ASK_EACH: return firings_allow(&w->firing, l, e);
    case PM_ASK_GRID: return grid_allows(w, l, e, shift);
    default: return extreme_allows(&w->frame, l, e, shift);
    }
}

/* ---- limits, and the end of the run ---- */
static int64_t limits_allow(const pm_workspace *w, const pm_repeat *l, double time)
{
    const pm_model *m = w->model;
    const int64_t events = pm_repeat_limit_instants(w, l);
    const double left = PM_SETTING(m, PM_SETTING_MAX_EVENTS) - (double)w->result.count[PM_COUNT_EVENTS];
    const double room = pm_case_max_time(w->model, &w->numbers) - w->state.t;
    int64_t most = PM_REPEAT_FOR_EVER;
    if (events > 0) most = at_most(most, floor(left / (double)events) - 1);
    /* the last segment but one is computed, too: the run may end within the last one */
    if (time > 0 && room < INFINITY) most = at_most(most, floor(room / time) - 1);
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int32_t *e = PM_UNTIL_ROW(m, i);
        const int64_t each = pm_repeat_limit_fires(&w->firing, l, e[PM_UNTIL_EVENT]),
                      lacks = e[PM_UNTIL_NTH] - 1 - w->firing.count[e[PM_UNTIL_EVENT]];
        if (each > 0 && lacks >= 0) most = at_most(most, (double)(lacks / each - 1));
    }
    return most;
}

int64_t pm_repeat_limit(pm_workspace *w, const pm_repeat *l, const pm_symmetry_shift *shift, double time)
{
    const pm_model *m = w->model;
    int64_t most = limits_allow(w, l, time);
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER] && most > 0; i++)
        most = fewest(most, trigger_allows(w, l, i, shift, time));
    for (int i = 0; i < m->nask && most > 0; i++)
        most = fewest(most, ask_allows(w, l, PM_ASK_ROW(m, i), shift));
    return most;
}

int pm_repeat_limit_never(pm_workspace *w)
{
    const double max_time = pm_case_max_time(w->model, &w->numbers);
    return pm_fail(&w->result, PM_LIMIT_TIME, PM_TABLE_SETTING, 0, INFINITY, max_time);
}
