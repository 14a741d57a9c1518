/* accuracy.c - estimated errors of the answers, from a second pass of the case, and the promise of accuracy.
 *
 * The coarse run of a pass is the same case at a tolerance PM_COARSER times as large, with longer steps where the
 * tolerance does not limit them and less care about what counts as touching or still, and with positions and velocities
 * disturbed by some roundings when a phase begins.  Its answers a' differ from the answers a by its own error:
 * truncation, amplified as the scene amplifies errors, and rounding, amplified likewise.  The errors of a method go with
 * its tolerance, so that a's own error is expected at |a' - a| / PM_COARSER; errors have signs and may be small by
 * chance:
 *
 *     error = max(spread |a' - a| / PM_COARSER, PM_ACCURACY_CLAIMED scale)
 *
 * scale is the natural size of the ask: |a|, or how much it would change if the state changed by its own size.  Where an
 * error is greater than accuracy times scale, or passes have decided differently, the case is run again at a tighter
 * tolerance, at most PM_ACCURACY_REFINEMENTS times; a pass that is not too far off serves as the coarse run of the next.
 * The spread of a route is above PM_COARSER: where a phase is one step, the coarse run, which takes it in two, shows a's
 * own error and no more.  It is calibrated: studies/benchmarks/calibration.py. */
#include "study/accuracy.h"

#include <math.h>
#include <string.h>

#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "events/history.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "run/run.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"
#include "study/find.h"

static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->accuracy)) return PM_NO_MEMORY;
    pm_accuracy *e = w->accuracy;
    const int ntrigger = m->rows[PM_TABLE_TRIGGER],
              kept = PM_SETTING(m, PM_SETTING_ESTIMATE) ? PM_DECISIONS : 0;
    pm_pass *const p = e->pass;
#define OF_EACH_PASS(array, count) \
    PM_ARRAY(p[0].array, count), PM_ARRAY(p[1].array, count), PM_ARRAY(p[2].array, count)
    const pm_array array[] = {
        OF_EACH_PASS(out, m->nout),     OF_EACH_PASS(error, m->nout),
        OF_EACH_PASS(more, m->nout),    OF_EACH_PASS(extreme, 2 * ntrigger),
        OF_EACH_PASS(reason, m->nask),  OF_EACH_PASS(log.entry, kept),
        PM_ARRAY(e->scale, m->nask),    PM_ARRAY(e->trigger_scale, ntrigger),
        PM_ARRAY(e->discrete, m->nask),
    };
#undef OF_EACH_PASS
    if (pm_arena_take(&w->memory, PM_ARRAYS(array))) return PM_NO_MEMORY;
    for (int i = 0; i < m->nask; i++)
        e->discrete[i] = (unsigned char)pm_program_class_is_discrete(m, PM_ASK_ROW(m, i)[PM_ASK_PROGRAM]);
    w->evidence.discrete = e->discrete;
    w->evidence.by_places = pm_path_error_by_places(m);
    return PM_OK;
}

int pm_accuracy_create(const pm_model *model, pm_workspace **workspace)
{
    int status = pm_workspace_create(model, workspace);
    if (!status) status = create(*workspace);
    if (!status) status = pm_find_create(*workspace);
    if (!status) return PM_OK;
    pm_workspace_free(*workspace);
    *workspace = NULL;
    return status;
}

/* ---- passes ---- */
static int run_once(pm_workspace *w, const double *param, double *found)
{
    return w->accuracy->runs_find ? pm_find_run(w, param, found) : pm_run(w, param);
}

static uint64_t outcome_of(const pm_model *model, const pm_firing *firing, const pm_pass *p)
{
    uint64_t hash = 14695981039346656037ULL; /* FNV-1a */
    hash = (hash ^ (uint64_t)(int64_t)p->status) * 1099511628211ULL;
    for (int i = 0; i < model->nask; i++) hash = (hash ^ (uint64_t)p->reason[i]) * 1099511628211ULL;
    for (int i = 0; i < model->rows[PM_TABLE_EVENT]; i++)
        hash = (hash ^ (uint64_t)firing->count[i]) * 1099511628211ULL;
    return hash;
}

static void make_pass(pm_workspace *w, const double *param, pm_pass *p, double factor, int coarse)
{
    pm_accuracy *e = w->accuracy;
    pm_history *const trace = w->record.history;
    pm_phase_report *const phases = w->record.phases;
    w->evidence.present = p;
    e->npass++;
    p->factor = factor;
    p->coarse = coarse;
    p->halves = e->npass > 1 && !(coarse ? e->main : e->last)->halves;
    if (!coarse) e->last = p;
    w->result.out = p->out;
    w->result.reason = p->reason;
    w->result.audit = p->audit;
    w->numbers.coarse = coarse ? PM_ACCURACY_COARSE : 1;
    if (coarse) w->record.history = NULL, w->record.phases = NULL;
    if (w->record.history) pm_history_reset(w->record.history); /* the last pass is the one recorded */
    if (w->record.phases) w->record.phases->needed = w->record.phases->steps = w->record.phases->repeated = 0;
    p->status = run_once(w, param, p->found);
    w->record.history = trace;
    w->record.phases = phases;
    memcpy(p->count, w->result.count, sizeof p->count);
    p->where = w->result.where;
    p->ordered = w->result.ordered;
    p->t = w->state.t;
    p->tolerance = w->numbers.tolerance;
    p->outcome = outcome_of(w->model, &w->firing, p);
}

static int stands(const pm_pass *p)
{
    return p->status >= PM_OK && p->status != PM_CANCELLED && p->status != PM_LIMIT_CPU;
}

/* ---- natural sizes ---- */
static int look_at_programs(pm_workspace *w, const pm_state *s, double *ask, double *trigger)
{
    const pm_model *m = w->model;
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    const int status = pm_saddle_accelerate(w);
    if (status) return status;
    for (int i = 0; i < m->nask; i++) ask[i] = pm_program_run(w, PM_ASK_ROW(m, i)[PM_ASK_PROGRAM]);
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        trigger[i] = PM_TRIGGER_ROW(m, i)[PM_TRIGGER_PROGRAM] >= 0 ? pm_trigger_program(w, i) : 0;
    return PM_OK;
}

static double size_of(double changed, double value, double part)
{
    const double size = fabs(changed - value) / part;
    return isfinite(size) ? size : 0;
}

/* What each ask and each trigger would change by if the state at the end changed by its own size. */
static void find_sizes(pm_workspace *w)
{
    pm_accuracy *e = w->accuracy;
    double *ask = e->spare->out, *trigger = w->firing.before; /* both are free between passes */
    const int nask = w->model->nask, ntrigger = w->model->rows[PM_TABLE_TRIGGER];
    memset(e->scale, 0, (size_t)nask * sizeof(double));
    memset(e->trigger_scale, 0, (size_t)ntrigger * sizeof(double));
    if (look_at_programs(w, &w->state, ask, trigger)) return;
    const double part = pm_case_shift(w, &w->probe);
    if (look_at_programs(w, &w->probe, e->scale, e->trigger_scale)) return;
    for (int i = 0; i < nask; i++) e->scale[i] = size_of(e->scale[i], ask[i], part);
    for (int i = 0; i < ntrigger; i++) e->trigger_scale[i] = size_of(e->trigger_scale[i], trigger[i], part);
}

/* ---- judging ---- */
static double scale_of(const pm_accuracy *e, int ask, int column)
{
    return fmax(e->scale[ask], fabs(e->main->out[column]));
}

/* Estimated errors of the main pass, given how much of the other's difference they are; the greatest over what the
 * accuracy asked allows. */
static double judge_answers(const pm_workspace *w, double share, double *error)
{
    const pm_accuracy *e = w->accuracy;
    double excess = 0;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *row = PM_ASK_ROW(w->model, i);
        for (int k = row[PM_ASK_OUT]; k < row[PM_ASK_OUT] + row[PM_ASK_COUNT]; k++) {
            const double a = e->main->out[k], b = e->other->out[k], scale = scale_of(e, i, k);
            error[k] = NAN;
            if (isnan(a)) continue;
            error[k] = isnan(b) ? INFINITY : fabs(a - b);
            if (e->discrete[i]) continue;
            error[k] = fmax(share * error[k], PM_ACCURACY_CLAIMED * scale);
            if (!isnan(e->main->error[k])) error[k] = fmax(e->main->error[k], PM_ACCURACY_CLAIMED * scale);
            error[k] += e->main->more[k];
            excess = fmax(excess, error[k] / (w->numbers.accuracy * scale));
        }
    }
    return excess;
}

/* Of the difference of both passes: what the error of the main one is taken for. */
static double share_of(const pm_phase *phase, const pm_accuracy *e)
{
    const double share = phase->route->spread * e->main->tolerance / e->other->tolerance;
    return e->other->coarse ? share : fmax(share, PM_ACCURACY_LEAST_SHARE);
}

/* Errors of the sought parameters of the main pass.  What follows from parameters alone is known no better than the
 * threshold of an outcome. */
static void judge_found(const pm_workspace *w, double share, double *error)
{
    const pm_accuracy *e = w->accuracy;
    const double resolution = pm_find_resolution(w->find);
    double *found = e->main->found;
    for (int i = 0; i < PM_FIND_MOST; i++)
        found[PM_FOUND_FIRST_ERROR + i] = fmax(share * fabs(found[i] - e->other->found[i]),
                                               fmax(PM_ACCURACY_CLAIMED, resolution) * fabs(found[i]));
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *row = PM_ASK_ROW(w->model, i);
        if (e->discrete[i] || w->model->programs.class[row[PM_ASK_PROGRAM]] != PM_CLASS_CONSTANT) continue;
        const int out = row[PM_ASK_OUT];
        error[out] = fmax(error[out], resolution * fabs(e->main->out[out]));
    }
}

static void judge(pm_workspace *w, double *error, double *trust)
{
    const double share = share_of(&w->phase, w->accuracy);
    trust[PM_TRUST_EXCESS] = judge_answers(w, share, error);
    if (w->evidence.seeks) judge_found(w, share, error);
    trust[PM_TRUST_MARGIN] = pm_margin_judge(w->accuracy, share);
}

static int knows_itself(const pm_workspace *w)
{
    if (w->evidence.seeks) return 0; /* nobody knows the error of what is sought */
    const pm_pass *p = w->accuracy->main;
    if (p->unsure) return 0;
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *row = PM_ASK_ROW(w->model, i);
        for (int k = row[PM_ASK_OUT]; k < row[PM_ASK_OUT] + row[PM_ASK_COUNT]; k++)
            if (isnan(p->error[k]) && !isnan(p->out[k])) return 0;
    }
    return w->model->nask > 0;
}

/* ---- the ladder ---- */
static void swap(pm_pass **a, pm_pass **b)
{
    pm_pass *const x = *a;
    *a = *b;
    *b = x;
}

/* Finds something to compare the main pass with; 0 if there is nothing. */
static int find_coarse(pm_workspace *w, const double *param)
{
    pm_accuracy *e = w->accuracy;
    e->closest = (pm_closest){INFINITY, NULL, PM_NONE};
    if (knows_itself(w)) {
        memcpy(e->other->out, e->main->out, (size_t)w->model->nout * sizeof(double));
        e->closest = pm_path_error_margin(w->model, e->main, e->trigger_scale);
        e->other->log.n = 0; /* its own decisions are judged by that */
        e->other->outcome = e->main->outcome;
        e->other->tied = e->main->tied;
        e->other->count[PM_COUNT_JUMPS] = e->main->count[PM_COUNT_JUMPS];
        e->other->tolerance = e->main->tolerance;
        e->other->coarse = 1;
        return 1;
    }
    make_pass(w, param, e->other, e->main->factor, 1);
    return stands(e->other);
}

/* Without a comparison so far: such that the last pass serves for one. */
static double next_factor(double factor, const double *trust)
{
    double change = PM_ACCURACY_AIM / trust[PM_TRUST_EXCESS];
    if (isnan(change)) return factor / PM_COARSER;
    if (trust[PM_TRUST_MARGIN] < 1) change = fmin(change, 1 / PM_COARSER);
    return factor * fmin(fmax(change, PM_ACCURACY_LEAST_FACTOR), PM_ACCURACY_MOST_FACTOR);
}

static int good_enough(const pm_phase *phase, const pm_accuracy *accuracy, const double *trust)
{
    const pm_pass *p = accuracy->main;
    const int decided = trust[PM_TRUST_MARGIN] >= 1 && trust[PM_TRUST_EXCESS] <= 1;
    return decided || p->status != PM_OK || p->tolerance <= PM_ACCURACY_FINER * phase->route->finest;
}

/* One pass at a tighter tolerance becomes the main one; 0 if it fails: then all stays as it was. */
static int refine(pm_workspace *w, const double *param, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    const int doubtful = trust[PM_TRUST_MARGIN] < 1; /* rounding may be what decides: see it disturbed */
    const double factor = next_factor(e->main->factor, trust);
    make_pass(w, param, e->spare, factor, 0);
    if (!stands(e->spare)) {
        if (w->record.history)
            make_pass(w, param, e->spare, e->main->factor, 0); /* what is recorded is what is answered */
        return 0;
    }
    swap(&e->main, &e->spare);
    swap(&e->other, &e->spare); /* the last main pass; what it was compared with is free */
    find_sizes(w);
    e->closest = (pm_closest){INFINITY, NULL, PM_NONE};
    /* what a cut loses does not go with the tolerance: only a coarse run shows it */
    if ((doubtful || e->main->cut || e->main->tolerance < PM_ACCURACY_NEAR_ENOUGH * e->other->tolerance) &&
        !find_coarse(w, param))
        return 0;
    judge(w, error, trust);
    return 1;
}

static void climb(pm_workspace *w, const double *param, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    find_sizes(w);
    if (find_coarse(w, param)) judge(w, error, trust);
    for (int i = 0; i < PM_ACCURACY_REFINEMENTS && !good_enough(&w->phase, w->accuracy, trust); i++)
        if (!refine(w, param, error, trust)) break;
    /* a run that sits on the threshold that was sought is not in doubt */
    if (e->main->status == PM_OK && trust[PM_TRUST_MARGIN] < 1 && !w->evidence.seeks)
        pm_margin_undecided(w->model, e, trust[PM_TRUST_MARGIN]);
}

/* The main pass goes to the caller's arrays, which the workspace points to again. */
static int deliver(pm_workspace *w, double *out, int32_t *reason, double *audit)
{
    const pm_pass *p = w->accuracy->main;
    w->result.out = out;
    w->result.reason = reason;
    w->result.audit = audit;
    memcpy(out, p->out, (size_t)w->model->nout * sizeof *out);
    memcpy(reason, p->reason, (size_t)w->model->nask * sizeof *reason);
    memcpy(audit, p->audit, sizeof p->audit);
    memcpy(w->result.count, p->count, sizeof p->count);
    w->state.t = p->t;
    w->result.count[PM_COUNT_PASSES] = w->accuracy->npass;
    w->result.where = p->where;
    w->result.ordered = p->ordered;
    /* it was given up in a later pass: the answers are there, of their errors not all is known */
    return p->status == PM_OK ? pm_fail_early(&w->result, &w->patience) : p->status;
}

/* An open ledger may be nothing but the errors of a loose integration: a tighter one shows. */
static int is_too_loose(const pm_phase *phase, const pm_pass *p)
{
    return p->status == PM_AUDIT && p->tolerance > PM_ACCURACY_FINER * phase->route->finest;
}

static int run(pm_workspace *w, const double *param, double *found, double *error, double *margin,
               double *trust)
{
    pm_accuracy *e = w->accuracy;
    double *const out = w->result.out, *const audit = w->result.audit;
    int32_t *const reason = w->result.reason;
    for (int i = 0; i < w->model->nout; i++) error[i] = NAN;
    for (int i = 0; i < w->model->nask; i++) margin[i] = NAN;
    for (int i = 0; i < PM_TRUSTS; i++) trust[i] = NAN;
    pm_patience_begin(&w->patience);
    w->evidence.active = PM_SETTING(w->model, PM_SETTING_ESTIMATE);
    if (!w->evidence.active) {
        const int status = found ? pm_find_run(w, param, found) : pm_run(w, param);
        w->result.count[PM_COUNT_PASSES] = 1;
        return status;
    }
    e->npass = 0;
    e->runs_find = found != NULL;
    w->evidence.seeks = found != NULL && w->model->rows[PM_TABLE_FIND] > 0;
    e->main = &e->pass[0];
    e->other = &e->pass[1];
    e->spare = &e->pass[2];
    make_pass(w, param, e->main, 1, 0);
    while (is_too_loose(&w->phase, e->main) && e->npass <= PM_ACCURACY_REFINEMENTS)
        make_pass(w, param, e->main, e->main->factor / PM_COARSER, 0);
    if (stands(e->main)) climb(w, param, error, trust);
    for (int i = 0; i < w->model->nask; i++)
        if (e->discrete[i]) margin[i] = trust[PM_TRUST_MARGIN];
    if (found) memcpy(found, e->main->found, sizeof e->main->found);
    return deliver(w, out, reason, audit);
}

int pm_accuracy_run(pm_workspace *w, const double *param, double *found, double *error, double *margin,
                    double *trust)
{
    return pm_plan_end(w->model, &w->result, run(w, param, found, error, margin, trust));
}
