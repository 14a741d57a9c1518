/* derived.c - the answers that a program reads are changed one by one: by their errors, or by a part of their size. */
#include "events/derived.h"

#include <math.h>

#include "expression/program.h"
#include "expression/program_fold.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"

/* The next step of the program from k on that reads an answer; or its end. */
static int next_answer(const pm_program_fold *f, int program, int k)
{
    while (k < f->first[program + 1] && f->step[k].kind != STEP_ANSWER) k++;
    return k;
}

int pm_derived_is(const pm_model *model, int program)
{
    const pm_program_fold *f = model->programs.fold;
    return next_answer(f, program, f->first[program]) < f->first[program + 1];
}

static int ask_of(const pm_model *model, int column)
{
    int ask = 0;
    while (PM_ASK_ROW(model, ask)[PM_ASK_OUT] != column) ask++;
    return ask;
}

int pm_derived_reason(const pm_workspace *w, int program)
{
    const pm_program_fold *f = w->model->programs.fold;
    for (int k = f->first[program]; (k = next_answer(f, program, k)) < f->first[program + 1]; k++) {
        const int reason = w->result.reason[ask_of(w->model, f->step[k].arg)];
        if (reason != PM_REASON_NONE) return reason;
    }
    return PM_REASON_NONE;
}

/* By how much the program changes with one answer. */
static double change(pm_workspace *w, int program, double value, int column, double by)
{
    const double answer = w->result.out[column];
    w->result.out[column] = answer + by;
    const double changed = pm_program_run(w, program);
    w->result.out[column] = answer;
    return fabs(changed - value);
}

double pm_derived_error(pm_workspace *w, int program, double value)
{
    const pm_program_fold *f = w->model->programs.fold;
    const double *error = w->evidence.present->error;
    double sum = 0;
    for (int k = f->first[program]; k < f->first[program + 1]; k++)
        if (f->step[k].kind == STEP_MEASURE) return NAN;
    for (int k = f->first[program]; (k = next_answer(f, program, k)) < f->first[program + 1]; k++)
        sum += change(w, program, value, f->step[k].arg, error[f->step[k].arg]);
    return sum;
}

double pm_derived_terms(pm_workspace *w, int program, const double *size)
{
    const pm_program_fold *f = w->model->programs.fold;
    const double value = pm_program_run(w, program);
    double sum = 0;
    for (int k = f->first[program]; (k = next_answer(f, program, k)) < f->first[program + 1]; k++) {
        const int column = f->step[k].arg;
        const double of = fmax(fabs(w->result.out[column]), size[ask_of(w->model, column)]);
        const double changed = change(w, program, value, column, PM_SHIFT * of) / PM_SHIFT;
        if (isfinite(changed)) sum += changed;
    }
    return sum;
}
