/* judge.c - what a pass and its coarse run tell of its errors and its decisions.
 *
 * The error of an answer a is taken from its difference to the answer a' of the coarse run; errors have signs and may be small
 * by chance:
 *
 *     error = max(spread |a' - a| / PM_COARSER, PM_ACCURACY_CLAIMED scale, PM_ACCURACY_OF_TERMS terms,
 *                 PM_ACCURACY_OF_STEP steps |a|)
 *
 * scale is the natural size of the ask: |a|, or how much it would change if the state changed by its own size; terms: how much
 * if all that it reads changed by the greatest of its kind in the run (natural_size.c).  An error is as great as asked where it
 * is accuracy times the greater of both. */
#include "study/judge.h"

#include <math.h>

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

/* What an answer of this scale, made of these terms, is known to at the best.  Steps may all be rounded to one side. */
static double least_error(const pm_pass *p, int column, double scale, double terms)
{
    const double rounded =
        isnan(p->error[column]) ? PM_ACCURACY_OF_STEP * (double)p->count[PM_COUNT_STEPS] : 0;
    return fmax(fmax(PM_ACCURACY_CLAIMED * scale, rounded * fabs(p->out[column])),
                PM_ACCURACY_OF_TERMS * terms);
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
            const double a = e->main->out[k], b = e->other->out[k], scale = scale_of(e, i, k),
                         least = least_error(e->main, k, scale, e->size.terms[i]);
            error[k] = NAN;
            if (isnan(a)) continue;
            error[k] = isnan(b) ? INFINITY : fabs(a - b);
            if (e->discrete[i]) continue;
            error[k] = fmax(isnan(e->main->error[k]) ? share * error[k] : e->main->error[k], least);
            error[k] += e->main->more[k];
            excess = pm_max(error[k] / (w->numbers.accuracy * fmax(scale, e->size.terms[i])), excess);
        }
    }
    return excess;
}

/* Of the difference of both passes: what the error of the main one is taken for. */
static double share_of(const pm_phase *phase, const pm_accuracy *e)
{
    return phase->route->spread * e->main->tolerance / e->other->tolerance;
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
    trust[PM_TRUST_EXCESS] = judge_answers(w, share, error);
    if (w->evidence.seeks) judge_found(w, share, error);
    trust[PM_TRUST_MARGIN] = pm_margin_judge(w->accuracy, share);
    if (!alike && !(trust[PM_TRUST_EXCESS] <= 1 && counts_agree(w, error))) trust[PM_TRUST_MARGIN] = 0;
}
