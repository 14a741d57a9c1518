/* phase_report.c - appends a record for each phase while there is room, and counts all of them. */
#include "run/run.h"

#include <math.h>

#include "equations/fixed_bodies.h"
#include "equations/shared_loads.h"
#include "events/ask.h"
#include "events/event.h"
#include "state/route.h"
#include "state/workspace.h"
#include "tree/tree.h"

static int32_t *last_row(const pm_phase_report *x)
{
    return x->needed > 0 && x->needed <= x->cap ? x->row + (x->needed - 1) * PM_PHASE_COLUMNS : NULL;
}

static void count_steps(const pm_result *result, const struct pm_event_set *event, pm_phase_report *x)
{
    int32_t *row = last_row(x);
    if (row) row[PM_PHASE_STEPS] = (int32_t)(result->count[PM_COUNT_STEPS] - x->steps);
    if (row) row[PM_PHASE_SKIPPED] = (int32_t)(event->culling.nskipped - x->skipped);
    x->steps = result->count[PM_COUNT_STEPS];
    x->skipped = event->culling.nskipped;
}

static int free_coordinates(const pm_model *model, const pm_numbers *numbers)
{
    int n = 0;
    for (int i = 0; i < model->nq; i++) n += numbers->inverse_mass[i] > 0;
    return n;
}

static int has_clock(const pm_workspace *w)
{
    return w->phase.route->in_time || w->model->programs.read_time || w->record.history;
}

static void describe(const pm_workspace *w, int64_t repeated, int32_t *row)
{
    const int on_tree = w->phase.route->on_tree;
    row[PM_PHASE_ROUTE] = w->phase.route->route;
    row[PM_PHASE_RULE] = w->phase.rule;
    row[PM_PHASE_UNKNOWNS] = on_tree ? w->tree->n : free_coordinates(w->model, &w->numbers);
    row[PM_PHASE_LOOPS] = on_tree ? w->tree->nloop : w->active.n;
    row[PM_PHASE_CONSTRAINTS] = w->active.n;
    row[PM_PHASE_REDUNDANT] = w->active.nredundant;
    row[PM_PHASE_FREEDOM] = free_coordinates(w->model, &w->numbers) - w->active.n;
    row[PM_PHASE_WATCHED] = w->event->nfunction;
    row[PM_PHASE_CLOCK] = has_clock(w);
    row[PM_PHASE_DYNAMIC] = w->event->level == PM_LEVEL_DYNAMIC || w->ask->level == PM_LEVEL_DYNAMIC;
    row[PM_PHASE_STEPS] = 0;
    row[PM_PHASE_OUT_OF_REACH] = w->reach.ncontact;
    row[PM_PHASE_REPEATED_SEGMENTS] = (int32_t)repeated;
    row[PM_PHASE_FIXED] = w->fixed->n;
    row[PM_PHASE_SKIPPED] = 0;
}

int pm_phase_report_add(pm_workspace *w)
{
    pm_phase_report *x = w->record.phases;
    if (!x) return PM_OK;
    count_steps(&w->result, w->event, x);
    if (x->needed < x->cap) {
        describe(w, w->result.count[PM_COUNT_REPEATED_SEGMENTS] - x->repeated,
                 x->row + x->needed * PM_PHASE_COLUMNS);
        x->time[x->needed] = has_clock(w) ? w->state.t : NAN;
        pm_shared_elements(w, x->joint + x->needed * x->njoint, x->contact + x->needed * x->ncontact);
    }
    x->repeated = w->result.count[PM_COUNT_REPEATED_SEGMENTS];
    x->needed++;
    return x->most > 0 && x->needed >= x->most ? PM_CANCELLED : PM_OK;
}

void pm_phase_report_end(pm_workspace *w)
{
    if (w->record.phases) count_steps(&w->result, w->event, w->record.phases);
}
