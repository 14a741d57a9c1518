/* pass.c - one pass of a case: what is asked of it, and what is kept of it. */
#include "study/pass.h"

#include <math.h>
#include <string.h>

#include "events/history.h"
#include "numerics/tolerances.h"
#include "run/run.h"
#include "state/route.h"
#include "state/workspace.h"
#include "study/accuracy.h"
#include "study/find.h"

static int run_once(pm_workspace *w, const double *param, double *found)
{
    return w->accuracy->runs_find ? pm_find_run(w, param, found) : pm_run(w, param);
}

/* How often a force switches, as one that stays beside its switch may by rounding, shows in the answers alone. */
static uint64_t outcome_of(const pm_model *model, const pm_firing *firing, const pm_pass *p)
{
    uint64_t hash = 14695981039346656037ULL; /* FNV-1a */
    hash = (hash ^ (uint64_t)(int64_t)p->status) * 1099511628211ULL;
    for (int i = 0; i < model->nask; i++) hash = (hash ^ (uint64_t)p->reason[i]) * 1099511628211ULL;
    for (int i = 0; i < model->rows[PM_TABLE_EVENT]; i++)
        if (PM_EVENT_ROW(model, i)[PM_EVENT_EFFECT] != PM_EFFECT_SWITCH)
            hash = (hash ^ (uint64_t)firing->count[i]) * 1099511628211ULL;
    return hash;
}

int pm_pass_steps_on_rk(const pm_pass *p)
{
    return (p->count[PM_COUNT_ROUTES] & ((int64_t)1 << PM_ROUTE_RK)) != 0;
}

/* So few steps on a route whose errors go with them that another run may err alike. */
static int takes_few_steps(const pm_pass *p)
{
    return p->count[PM_COUNT_STEPS] <= PM_ACCURACY_FEW && pm_pass_steps_on_rk(p);
}

void pm_pass_make(pm_workspace *w, const double *param, pm_pass *p, double factor, int coarse)
{
    pm_accuracy *e = w->accuracy;
    pm_history *const trace = w->record.history;
    pm_phase_report *const phases = w->record.phases;
    w->evidence.present = p;
    p->number = ++e->npass;
    p->factor = factor;
    p->coarse = coarse;
    p->fine = coarse && takes_few_steps(e->main);
    p->halves = e->npass > 1 && !(coarse ? e->main : e->last)->halves;
    if (!coarse) e->last = p;
    w->result.out = p->out;
    w->result.reason = p->reason;
    w->result.audit = p->audit;
    w->numbers.coarse = coarse ? PM_ACCURACY_COARSE : 1;
    w->evidence.late = coarse ? e->main->late * PM_COARSER / w->phase.route->spread : 0;
    if (coarse) w->record.history = NULL, w->record.phases = NULL;
    if (w->record.history) pm_history_reset(w->record.history); /* the last pass is the one recorded */
    if (w->record.phases) w->record.phases->needed = w->record.phases->steps = w->record.phases->repeated = 0;
    p->status = run_once(w, param, p->found);
    w->record.history = trace;
    w->record.phases = phases;
    memcpy(p->count, w->result.count, sizeof p->count);
    p->unseen = w->evidence.unseen;
    p->where = w->result.where;
    p->ordered = w->result.ordered;
    p->t = w->state.t;
    memcpy(p->end, w->state.q, 2 * (size_t)w->model->nq * sizeof *p->end); /* v stands behind q */
    p->tolerance = w->numbers.tolerance;
    p->outcome = outcome_of(w->model, &w->firing, p);
}

int pm_pass_stands(const pm_pass *p)
{
    return p->status >= PM_OK && p->status != PM_CANCELLED && p->status != PM_LIMIT_CPU;
}

int pm_pass_took_too_long(const pm_evidence *evidence, const pm_pass *p)
{
    return p->status == PM_LIMIT_STEPS && (double)p->count[PM_COUNT_STEPS] >= evidence->most_steps;
}
