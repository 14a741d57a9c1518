/* accuracy.c - estimated errors of the answers, from a second pass of the case, and the promise of accuracy.
 *
 * The coarse run of a pass is the same case at a tolerance PM_COARSER times as large, with longer steps where the tolerance
 * does not limit them and less care about what counts as touching or still, and with positions, velocities and the times of
 * forces off by some roundings when a phase begins and at each step in time.  Series of blows without end are over earlier
 * in it (last_bounce.c, zeno.c).  Its answers a' differ from the answers a by its own error: truncation and rounding,
 * amplified as the scene amplifies errors.  The errors of a method go with its tolerance, so that a's own error is expected
 * at |a' - a| / PM_COARSER (judge.c).
 *
 * Where an error is greater than the accuracy asked, or passes have decided differently, the case is run again at a tighter
 * tolerance, with a coarse run of its own, at most PM_ACCURACY_REFINEMENTS times; what got no better is not taken, and what
 * takes much longer than the first pass is not waited for.  Where a phase is one step, or a run a few, the coarse run
 * takes each in two, and shows a's own error and no more.  The spread of a route is calibrated:
 * studies/benchmarks/calibration.py.
 *
 * Above an accuracy of PM_ACCURACY_LOOSE a second coarse run is compared on rk.  Where none can be compared, errors are infinite. */
#include "study/accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "events/ask.h"
#include "events/event.h"
#include "events/time_course.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "run/run.h"
#include "state/arena.h"
#include "state/route.h"
#include "state/workspace.h"
#include "study/find.h"
#include "study/judge.h"
#include "study/pass.h"

static int create_logs(pm_workspace *w)
{
    for (int i = 0; i < 3; i++)
        if (pm_arena_keep(&w->memory, &w->accuracy->pass[i].log, pm_evidence_free_log)) return PM_NO_MEMORY;
    return PM_OK;
}

static int create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->accuracy)) return PM_NO_MEMORY;
    pm_accuracy *e = w->accuracy;
    const int ntrigger = m->rows[PM_TABLE_TRIGGER];
    pm_pass *const p = e->pass;
#define OF_EACH_PASS(array, count) \
    PM_ARRAY(p[0].array, count), PM_ARRAY(p[1].array, count), PM_ARRAY(p[2].array, count)
    const pm_array array[] = {
        OF_EACH_PASS(out, m->nout),   OF_EACH_PASS(error, m->nout),        OF_EACH_PASS(more, m->nout),
        OF_EACH_PASS(end, 2 * m->nq), OF_EACH_PASS(extreme, 2 * ntrigger), OF_EACH_PASS(reason, m->nask),
        PM_ARRAY(e->kept, m->nout),   PM_ARRAY(e->discrete, m->nask),      PM_ARRAY(e->neighbours, m->nout),
        PM_ARRAY(e->first, m->nout),
    };
#undef OF_EACH_PASS
    if (pm_arena_take(&w->memory, PM_ARRAYS(array)) || pm_natural_size_create(w, &e->size) || create_logs(w))
        return PM_NO_MEMORY;
    for (int i = 0; i < m->nask; i++) {
        const int32_t *row = PM_ASK_ROW(m, i);
        e->discrete[i] =
            !pm_model_ask_is_integral(row) && pm_program_class_is_discrete(m, row[PM_ASK_PROGRAM]);
    }
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

/* ---- the ladder ---- */
/* Both arrays are free between passes. */
static void find_sizes(pm_workspace *w)
{
    pm_natural_size_find(w, &w->accuracy->size, w->accuracy->other->out, w->firing.before);
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
    e->closest = (pm_closest){INFINITY, NULL, PM_NONE, 0};
    if (knows_itself(w)) {
        memcpy(e->other->out, e->main->out, (size_t)w->model->nout * sizeof(double));
        e->closest = pm_path_error_margin(w->model, e->main, e->size.trigger);
        e->other->log.n = 0; /* its own decisions are judged by that */
        e->other->outcome = e->main->outcome;
        e->other->tied = e->main->tied;
        e->other->unseen.t = NAN; /* that of the main one is told */
        e->other->count[PM_COUNT_JUMPS] = e->main->count[PM_COUNT_JUMPS];
        e->other->tolerance = e->main->tolerance;
        e->other->coarse = 1;
        return 1;
    }
    pm_pass_make(w, param, e->other, e->main->factor, 1);
    /* at a singular position a disturbed state may leave its branch */
    w->evidence.calm = e->other->status != e->main->status &&
                       (e->other->status < PM_OK || e->other->status == PM_ENDS_SINGULAR) &&
                       w->patience.over == 0;
    if (w->evidence.calm) pm_pass_make(w, param, e->other, e->main->factor, 1);
    w->evidence.calm = 0;
    return pm_pass_stands(e->other);
}

static double next_factor(double factor, const double *trust)
{
    double change = PM_ACCURACY_AIM / trust[PM_TRUST_EXCESS];
    if (isnan(change)) return factor / PM_COARSER;
    if (trust[PM_TRUST_MARGIN] < 1) change = fmin(change, 1 / PM_COARSER);
    return factor * fmin(fmax(change, PM_ACCURACY_LEAST_FACTOR), PM_ACCURACY_MOST_FACTOR);
}

/* Routes on which nothing goes with the tolerance give the same again. */
static int goes_with_tolerance(const pm_pass *p)
{
    return (p->count[PM_COUNT_ROUTES] & ~((int64_t)1 << PM_ROUTE_UNIFORM)) != 0;
}

static int good_enough(const pm_workspace *w, const double *trust)
{
    const pm_pass *p = w->accuracy->main;
    const int decided = trust[PM_TRUST_MARGIN] >= 1 && trust[PM_TRUST_EXCESS] <= 1;
    if (!goes_with_tolerance(p) && !w->evidence.seeks) return 1;
    return decided || p->status != PM_OK || p->tolerance <= PM_ACCURACY_FINER * w->phase.route->finest;
}

/* A pass is no answer where it leaves a decision open that the one before did not, or greater errors. */
static int is_better(const double *trust, const double *before)
{
    const int decided = trust[PM_TRUST_MARGIN] >= 1, was = !(before[PM_TRUST_MARGIN] < 1);
    if (decided != was) return decided;
    return !(trust[PM_TRUST_EXCESS] > before[PM_TRUST_EXCESS]);
}

/* Errors that a tighter tolerance leaves as they were are those of rounding: neither estimate is the better one, and a decision
 * that one of them leaves open is open.  What a cut loses does not go with the tolerance either, but is no rounding. */
static int has_paid(pm_accuracy *e, double *trust, const double *before, const pm_closest *closest)
{
    if (e->main->cut || !(before[PM_TRUST_EXCESS] > 1) ||
        trust[PM_TRUST_EXCESS] < PM_ACCURACY_PAYS * before[PM_TRUST_EXCESS])
        return 1;
    if (!(before[PM_TRUST_MARGIN] < trust[PM_TRUST_MARGIN])) return 0;
    trust[PM_TRUST_MARGIN] = before[PM_TRUST_MARGIN];
    e->closest = *closest;
    return 0;
}

/* The main pass before is the answer after all. */
static void go_back(pm_workspace *w, const double *param, const double *before, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    memcpy(error, e->kept, (size_t)w->model->nout * sizeof *error);
    memcpy(trust, before, PM_TRUSTS * sizeof *trust);
    if (w->record.history) /* what is recorded is what is answered */
        pm_pass_make(w, param, e->spare, e->main->factor, 0);
}

/* Whether the tolerance alone chose the steps of two main passes: then each step errs far more than it is rounded. */
static int steps_go_with_tolerance(const pm_phase *phase, const pm_pass *loose, const pm_pass *tight)
{
    const int64_t alone = (int64_t)1 << phase->route->route;
    if (loose->count[PM_COUNT_ROUTES] != alone || tight->count[PM_COUNT_ROUTES] != alone) return 0;
    const double growth = log((double)tight->count[PM_COUNT_STEPS] / (double)loose->count[PM_COUNT_STEPS]);
    return growth >=
           PM_SCALES_STEPS * phase->route->steps_by_tolerance * log(loose->tolerance / tight->tolerance);
}

/* The main pass before, in e->spare, may do for a comparison: where errors go with the tolerance its difference is its own error,
 * as its coarse run has shown, and that of the main pass is known from both.  Elsewhere nobody would see what the scene makes of
 * rounding: both passes are rounded alike, or as it happens. */
static int judge_beside_before(pm_workspace *w, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    if (pm_evidence_has_series(e->main) || pm_evidence_has_series(e->spare)) return 0; /* both cut it alike */
    if (pm_time_course_rounded(w) > PM_SCALES_TIMES * w->numbers.accuracy) return 0;
    if (e->main->count[PM_COUNT_JUMPS] > 0)
        return 0; /* flights between blows may have no error but rounding */
    if (w->evidence.seeks || !(w->phase.route->steps_by_tolerance > 0) ||
        !steps_go_with_tolerance(&w->phase, e->spare, e->main))
        return 0;
    swap(&e->other, &e->spare);
    e->before = e->other;
    e->closest = (pm_closest){INFINITY, NULL, PM_NONE, 0};
    if (pm_judge_goes_with_tolerance(w)) {
        pm_judge(w, error, trust);
        if (trust[PM_TRUST_MARGIN] >= 1) return 1;
    }
    swap(&e->other, &e->spare);
    return 0;
}

/* Steps at a loose accuracy err as it happens, not as their tolerance: what one coarse run tells alike by chance another does not. */
static int errs_by_chance(const pm_workspace *w)
{
    const pm_accuracy *e = w->accuracy;
    return w->numbers.accuracy > PM_ACCURACY_LOOSE && e->other->coarse && !e->other->fine &&
           pm_pass_steps_on_rk(e->main);
}

/* From blow to blow a motion may make far more of rounding than it was; a coarse run shows what it made of one disturbance. */
static int makes_much_of_rounding(const pm_workspace *w, const double *trust)
{
    const pm_accuracy *e = w->accuracy;
    return e->main->count[PM_COUNT_JUMPS] > 1 && pm_pass_steps_on_rk(e->main) && e->other->coarse &&
           trust[PM_TRUST_EXCESS] * w->numbers.accuracy > PM_ACCURACY_GROWN;
}

/* A second coarse run, at another tolerance: each error is the greater of both.  One that decided otherwise, which the first did not,
 * is no comparison. */
static void judge_by_another(pm_workspace *w, const double *param, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    double first[PM_TRUSTS];
    const pm_closest closest = e->closest;
    memcpy(first, trust, sizeof first);
    memcpy(e->first, error, (size_t)w->model->nout * sizeof *error);
    pm_pass_make(w, param, e->other, e->main->factor * PM_ACCURACY_ANOTHER, 1);
    const int compares = e->other->outcome == e->main->outcome && pm_margin_same_jumps(e);
    if (compares) pm_judge(w, error, trust);
    for (int k = 0; k < w->model->nout; k++)
        error[k] = compares ? pm_max(e->first[k], error[k]) : e->first[k];
    trust[PM_TRUST_EXCESS] = pm_max(first[PM_TRUST_EXCESS], trust[PM_TRUST_EXCESS]);
    if (trust[PM_TRUST_MARGIN] < first[PM_TRUST_MARGIN]) return;
    trust[PM_TRUST_MARGIN] = first[PM_TRUST_MARGIN];
    e->closest = closest;
}

static int judge_by_coarse(pm_workspace *w, const double *param, const pm_pass *before, double *error,
                           double *trust)
{
    w->accuracy->before = before;
    if (!find_coarse(w, param)) return 0;
    pm_judge(w, error, trust);
    if (errs_by_chance(w) || makes_much_of_rounding(w, trust)) judge_by_another(w, param, error, trust);
    return 1;
}

/* One pass at a tighter tolerance becomes the main one, unless it is no better: then all stays as it was.  Whether a further one
 * may pay. */
static int refine(pm_workspace *w, const double *param, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    double before[PM_TRUSTS] = {
        [PM_TRUST_MARGIN] = trust[PM_TRUST_MARGIN], [PM_TRUST_EXCESS] = trust[PM_TRUST_EXCESS]};
    const pm_closest closest = e->closest;
    memcpy(e->kept, error, (size_t)w->model->nout * sizeof *error);
    pm_pass_make(w, param, e->spare, next_factor(e->main->factor, trust), 0);
    int better = pm_pass_stands(e->spare) && !pm_pass_took_too_long(&w->evidence, e->spare);
    if (better && e->spare->outcome == e->main->outcome) before[PM_TRUST_EXCESS] = pm_judge_again(w, e->kept);
    if (better) {
        swap(&e->main, &e->spare);
        find_sizes(w);
        better = judge_beside_before(w, error, trust) || judge_by_coarse(w, param, e->spare, error, trust);
        better = better && is_better(trust, before);
        if (!better) swap(&e->main, e->before == e->other ? &e->other : &e->spare);
    }
    if (better) return has_paid(e, trust, before, &closest);
    e->closest = closest;
    go_back(w, param, before, error, trust);
    return 0;
}

/* Nobody knows the errors of a run that goes on where all that it could be compared with fails. */
static void know_nothing(const pm_workspace *w, double *error, double *trust)
{
    const pm_pass *p = w->accuracy->main;
    for (int k = 0; k < w->model->nout; k++) error[k] = isnan(p->out[k]) ? NAN : INFINITY;
    trust[PM_TRUST_EXCESS] = INFINITY;
}

static void climb(pm_workspace *w, const double *param, double *error, double *trust)
{
    pm_accuracy *e = w->accuracy;
    find_sizes(w);
    judge_by_coarse(w, param, NULL, error, trust);
    for (int i = 0; i < PM_ACCURACY_REFINEMENTS && !good_enough(w, trust); i++)
        if (!refine(w, param, error, trust)) break;
    if (isnan(trust[PM_TRUST_MARGIN]) && e->main->status == PM_OK && w->patience.over == 0)
        know_nothing(w, error, trust);
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
    w->evidence.most_steps = INFINITY;
    w->evidence.seeks = found != NULL && w->model->rows[PM_TABLE_FIND] > 0;
    if (!w->evidence.active) {
        const int status = found ? pm_find_run(w, param, found) : pm_run(w, param);
        w->result.count[PM_COUNT_PASSES] = 1;
        return status == PM_OK ? pm_margin_unseen(w) : status;
    }
    e->npass = 0;
    e->before = NULL;
    e->runs_find = found != NULL;
    e->main = &e->pass[0];
    e->other = &e->pass[1];
    e->spare = &e->pass[2];
    pm_pass_make(w, param, e->main, 1, 0);
    while (is_too_loose(&w->phase, e->main) && e->npass <= PM_ACCURACY_REFINEMENTS)
        pm_pass_make(w, param, e->main, e->main->factor / PM_COARSER, 0);
    if (pm_pass_stands(e->main)) {
        w->evidence.most_steps =
            PM_ACCURACY_FEW_STEPS + PM_ACCURACY_LONGER * (double)e->main->count[PM_COUNT_STEPS];
        climb(w, param, error, trust);
    }
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
