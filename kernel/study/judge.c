/* judge.c - what a pass and its coarse run tell of its errors and its decisions.
 *
 * The error of an answer a is taken from its difference to the answer a' of the coarse run; errors have signs and may be small
 * by chance:
 *
 *     error = max(spread |a' - a| / PM_COARSER, PM_ACCURACY_CLAIMED scale, PM_ACCURACY_OF_TERMS terms,
 *                 PM_ACCURACY_OF_STEP steps |a|, PM_ACCURACY_OF_MOTION late |da/dt|)
 *
 * Beside a main pass before, at a looser tolerance, it is at least spread |a - a''| tolerance / tolerance''.  In a list no value is
 * known better than its neighbours.  Where errors go with the tolerance another answer is known no better than PM_ACCURACY_OF_OTHERS
 * of what the two runs differ by elsewhere, each difference over the size of what differs; its own error grows by PM_ACCURACY_CHANCE
 * at the most, as an early answer may well be better known than a late one.
 * scale is the natural size of the ask: |a|, or how much it would change if the state changed by its own size; terms: how much
 * if all that it reads changed by the greatest of its kind in the run (natural_size.c).  An error is as great as asked where it
 * is accuracy times the greater of both. */
#include "study/judge.h"

#include <math.h>
#include <string.h>

#include "equations/case.h"
#include "events/ask.h"
#include "expression/program_class.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/route.h"
#include "state/workspace.h"
#include "study/accuracy.h"
#include "study/find.h"

static double scale_of(const pm_accuracy *e, int ask, int column)
{
    return fmax(e->size.ask[ask], fabs(e->main->out[column]));
}

/* Of what an answer is measured by: the least that is claimed.  Where something is greatest it is level, and rounding moves that
 * place. */
static double claimed(const int32_t *row)
{
    return pm_ask_at_extreme(row) ? PM_ACCURACY_CLAIMED_PLACE : PM_ACCURACY_CLAIMED;
}

/* What an answer is known to at the best.  Steps may all be rounded to one side. */
static double least_error(const pm_workspace *w, int ask, int column)
{
    const pm_accuracy *e = w->accuracy;
    const pm_pass *p = e->main;
    const double rounded =
        isnan(p->error[column]) ? PM_ACCURACY_OF_STEP * (double)p->count[PM_COUNT_STEPS] : 0;
    return fmax(
        fmax(claimed(PM_ASK_ROW(w->model, ask)) * scale_of(e, ask, column), rounded * fabs(p->out[column])),
        PM_ACCURACY_OF_TERMS * e->size.terms[ask]);
}

/* The error by the main pass at the looser tolerance before, if there was one: their difference is that one's error, and it is
 * told already if it is what this one is compared with. */
static double beside_before(const pm_workspace *w, int column)
{
    const pm_accuracy *e = w->accuracy;
    if (!e->before) return 0;
    if (e->before == e->other) return e->kept[column] * e->main->tolerance / e->before->tolerance;
    const double off = fabs(e->main->out[column] - e->before->out[column]);
    return isnan(off) ? 0 : fmin(1, w->phase.route->spread * e->main->tolerance / e->before->tolerance) * off;
}

/* Of the main pass, given how much of the other's difference it is. */
static double estimate(const pm_workspace *w, double share, int column)
{
    const pm_accuracy *e = w->accuracy;
    const double own = e->main->error[column], off = fabs(e->main->out[column] - e->other->out[column]);
    if (!isnan(own)) return own;
    return isnan(off) ? INFINITY : fmax(share * off, beside_before(w, column));
}

/* Whether it is asked of the end, and nobody but the difference of two runs knows its error. */
static int is_of_end(const pm_workspace *w, int ask)
{
    const int32_t *row = PM_ASK_ROW(w->model, ask);
    return row[PM_ASK_KIND] == PM_ASK_END && isnan(w->accuracy->main->error[row[PM_ASK_OUT]]);
}

/* The state at a time errs mostly along its motion, as if it were late.  An answer of the end that two runs tell alike by chance
 * is known no better than a part of what it changes by in that time.  (An event ends runs by the state, whenever that is.) */
static void find_late(pm_workspace *w, double share)
{
    pm_accuracy *e = w->accuracy;
    const int nask = w->model->nask;
    int ask = 0;
    e->late = 0;
    while (ask < nask && !is_of_end(w, ask)) ask++;
    if (ask == nask || w->evidence.seeks || e->main->t != e->other->t) return;
    e->late = share * pm_case_apart(&w->numbers, w->model->nq, e->main->end, e->other->end) *
              w->numbers.size / w->numbers.speed;
    pm_natural_size_find_rates(w, &e->size, e->neighbours);
}

/* Values of a list are those of one function at instants that follow each other: its error goes through zero between some of
 * them, and there the difference of two runs is small by chance.  None is known better than its neighbours. */
static void spread_over_neighbours(int n, double *error, double *spare)
{
    const int reach = n / PM_ACCURACY_NEIGHBOURS + 1;
    memcpy(spare, error, (size_t)n * sizeof *error);
    for (int k = 0; k < n; k++)
        for (int i = k > reach ? k - reach : 0; i <= k + reach && i < n && !isnan(error[k]); i++)
            if (isfinite(spare[i])) error[k] = pm_max(spare[i], error[k]);
}

/* What an answer is measured by: what it would change by if the state, or all that it reads, changed by its own size. */
static double size_of(const pm_accuracy *e, int ask, int column)
{
    return fmax(scale_of(e, ask, column), e->size.terms[ask]);
}

/* It is no list, and nobody but the difference of two runs knows its error. */
static int is_single(const pm_accuracy *e, const int32_t *row)
{
    return row[PM_ASK_COUNT] == 1 && isnan(e->main->error[row[PM_ASK_OUT]]);
}

/* By how much of their sizes the two runs differ at the most: in the state at the end, and in single answers. */
static double find_apart(const pm_workspace *w)
{
    const pm_accuracy *e = w->accuracy;
    double apart = pm_case_apart(&w->numbers, w->model->nq, e->main->end, e->other->end);
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *row = PM_ASK_ROW(w->model, i);
        if (e->discrete[i] || !is_single(e, row)) continue;
        const int k = row[PM_ASK_OUT];
        const double off = fabs(e->main->out[k] - e->other->out[k]) / size_of(e, i, k);
        if (isfinite(off)) apart = pm_max(off, apart);
    }
    return apart;
}

/* The least error of a single answer, of which the difference of the two runs tells this one: that may be small by chance. */
static double beside_others(const pm_workspace *w, double share, int ask, int column, double error)
{
    const pm_accuracy *e = w->accuracy;
    if (!is_single(e, PM_ASK_ROW(w->model, ask))) return 0;
    return fmin(PM_ACCURACY_CHANCE * error,
                PM_ACCURACY_OF_OTHERS * share * e->apart * size_of(e, ask, column));
}

/* An error over what the accuracy asked allows. */
static double excess_of(const pm_workspace *w, int ask, int column, double error)
{
    const pm_accuracy *e = w->accuracy;
    return error / (w->numbers.accuracy * size_of(e, ask, column));
}

/* Errors of one ask; the greatest over what the accuracy asked allows. */
static double judge_ask(const pm_workspace *w, int ask, double share, double *error)
{
    const pm_accuracy *e = w->accuracy;
    const int first = PM_ASK_ROW(w->model, ask)[PM_ASK_OUT], n = PM_ASK_ROW(w->model, ask)[PM_ASK_COUNT];
    const double late = is_of_end(w, ask) ? PM_ACCURACY_OF_MOTION * e->late * e->size.rate[ask] : 0;
    double excess = 0;
    for (int k = first; k < first + n; k++) {
        const double own = estimate(w, share, k);
        error[k] = isnan(e->main->out[k]) ? NAN : fmax(fmax(own, beside_others(w, share, ask, k, own)), late);
    }
    if (n > 1 && isnan(e->main->error[first])) spread_over_neighbours(n, error + first, e->neighbours);
    for (int k = first; k < first + n; k++) {
        if (isnan(error[k])) continue;
        error[k] = fmax(error[k], least_error(w, ask, k)) + e->main->more[k];
        excess = pm_max(excess_of(w, ask, k, error[k]), excess);
    }
    return excess;
}

/* What is counted, yes or no: by how much the other pass says otherwise. */
static void judge_discrete(const pm_workspace *w, int ask, double *error)
{
    const pm_accuracy *e = w->accuracy;
    const int first = PM_ASK_ROW(w->model, ask)[PM_ASK_OUT], n = PM_ASK_ROW(w->model, ask)[PM_ASK_COUNT];
    for (int k = first; k < first + n; k++) {
        const double a = e->main->out[k], b = e->other->out[k];
        error[k] = isnan(a) ? NAN : isnan(b) ? INFINITY : fabs(a - b);
    }
}

/* Estimated errors of the main pass; the greatest over what the accuracy asked allows. */
static double judge_answers(const pm_workspace *w, double share, double *error)
{
    double excess = 0;
    for (int i = 0; i < w->model->nask; i++)
        if (w->accuracy->discrete[i])
            judge_discrete(w, i, error);
        else
            excess = pm_max(judge_ask(w, i, share, error), excess);
    return excess;
}

/* Of the difference of both passes: what the error of the main one is taken for. */
static double share_of(const pm_phase *phase, const pm_accuracy *e)
{
    const double share = phase->route->spread * e->main->tolerance / e->other->tolerance;
    return e->other->coarse ? share : fmin(1, share); /* a looser main pass errs by all of it at the most */
}

double pm_judge_again(const pm_workspace *w, double *error)
{
    const pm_accuracy *e = w->accuracy;
    double excess = 0;
    for (int i = 0; i < w->model->nask; i++) {
        const int first = PM_ASK_ROW(w->model, i)[PM_ASK_OUT], n = PM_ASK_ROW(w->model, i)[PM_ASK_COUNT];
        for (int k = first; k < first + n && !e->discrete[i]; k++) {
            error[k] = pm_max(fabs(e->main->out[k] - e->spare->out[k]), error[k]);
            excess = pm_max(excess_of(w, i, k, error[k]), excess);
        }
    }
    return excess;
}

int pm_judge_goes_with_tolerance(const pm_workspace *w)
{
    const pm_accuracy *e = w->accuracy;
    const double share = share_of(&w->phase, e);
    for (int i = 0; i < w->model->nask; i++) {
        const int first = PM_ASK_ROW(w->model, i)[PM_ASK_OUT], n = PM_ASK_ROW(w->model, i)[PM_ASK_COUNT];
        for (int k = first; k < first + n; k++) {
            const double off = share * fabs(e->main->out[k] - e->other->out[k]);
            if (!e->discrete[i] && off > fmax(PM_SCALES_ERRORS * beside_before(w, k), least_error(w, i, k)))
                return 0;
        }
    }
    return 1;
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
        if (e->discrete[i] || pm_model_ask_is_integral(row) ||
            w->model->programs.class[row[PM_ASK_PROGRAM]] != PM_CLASS_CONSTANT)
            continue;
        const int out = row[PM_ASK_OUT];
        error[out] = fmax(error[out], resolution * fabs(e->main->out[out]));
    }
}

/* Whether the numbers that are counted, yes or no are those of the other pass. */
static int counts_agree(const pm_workspace *w, const double *error)
{
    for (int i = 0; i < w->model->nask; i++) {
        const int32_t *row = PM_ASK_ROW(w->model, i);
        for (int k = row[PM_ASK_OUT]; w->accuracy->discrete[i] && k < row[PM_ASK_OUT] + row[PM_ASK_COUNT];
             k++)
            if (error[k] > 0) return 0;
    }
    return 1;
}

/* Passes with other numbers of blows have decided otherwise: the whole difference of their answers is the error then, and where
 * that is more than was asked which of them is right is open. */
void pm_judge(pm_workspace *w, double *error, double *trust)
{
    const int alike = pm_margin_same_jumps(w->accuracy);
    const double of_errors = share_of(&w->phase, w->accuracy), share = alike ? of_errors : fmax(1, of_errors);
    find_late(w, share);
    w->accuracy->apart = alike && w->phase.route->steps_by_tolerance > 0 ? find_apart(w) : 0;
    trust[PM_TRUST_EXCESS] = judge_answers(w, share, error);
    if (w->evidence.seeks) judge_found(w, share, error);
    trust[PM_TRUST_MARGIN] = pm_margin_judge(w->accuracy, share);
    if (!alike && !(trust[PM_TRUST_EXCESS] <= 1 && counts_agree(w, error))) trust[PM_TRUST_MARGIN] = 0;
}
