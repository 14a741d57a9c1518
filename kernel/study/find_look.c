/* find_look.c - one run, looked at: do the conditions hold, how far is it from them, how good is it. */
#include "study/find_look.h"

#include <math.h>
#include <string.h>

#include "equations/saddle.h"
#include "expression/program.h"
#include "run/run.h"
#include "state/frame.h"
#include "state/workspace.h"

static int condition_holds(int kind, double reading)
{
    switch ((enum pm_condition_kind)kind) {
    case PM_CONDITION_POSITIVE: return reading > 0;
    case PM_CONDITION_NOT_NEGATIVE: return reading >= 0;
    case PM_CONDITION_HOLDS: return reading != 0 && !isnan(reading);
    default: return 1; /* ZERO: a root is looked for apart */
    }
}

static int kind_of(const pm_model *model, int condition)
{
    return PM_CONDITION_ROW(model, condition)[PM_CONDITION_KIND];
}

/* The end of a run that stopped early is an outcome only for what is yes or no. */
static void read_end(pm_workspace *w, pm_look *look)
{
    const pm_find *f = w->find;
    look->holds = 1;
    for (int i = 0; i < f->ncondition; i++) {
        const int32_t *e = PM_CONDITION_ROW(w->model, i);
        if (look->status == PM_OK || e[PM_CONDITION_KIND] == PM_CONDITION_HOLDS)
            look->reading[i] = pm_program_run(w, e[PM_CONDITION_PROGRAM]);
        look->holds = look->holds && condition_holds(e[PM_CONDITION_KIND], look->reading[i]);
    }
    if (f->goal != PM_FIND_VALUE && f->program != PM_NONE && look->status == PM_OK)
        look->goal = (f->goal == PM_FIND_GREATEST ? 1 : -1) * pm_program_run(w, f->program);
}

int pm_find_look(pm_workspace *w, const double *x, pm_look *look)
{
    pm_find *f = w->find;
    for (int i = 0; i < f->nvary; i++) {
        look->x[i] = x[i];
        f->param[PM_VARY_ROW(w->model, i)[PM_VARY_PARAMETER]] = x[i];
    }
    look->goal = NAN;
    look->off = 0;
    look->edge = look->bisected = look->loose = look->side = 0;
    look->holds = 0;
    for (int i = 0; i < PM_FIND_MOST_CONDITIONS; i++) look->reading[i] = NAN;
    look->status = pm_run(w, f->param);
    f->runs++;
    if (look->status == PM_CANCELLED || look->status == PM_LIMIT_CPU) return look->status;
    if (look->status < 0) return PM_OK;
    pm_frame_look_state(&w->frame, &w->state);
    const pm_where where = w->result.where;
    if (pm_saddle_accelerate(w)) {
        w->result.where = where; /* the run itself came through: only what needs accelerations has no value */
        return PM_OK;
    }
    read_end(w, look);
    return PM_OK;
}

int pm_find_margin(const pm_model *model, const pm_find *f, const pm_look *no, const pm_look *yes)
{
    int margin = PM_NONE;
    for (int i = 0; i < f->ncondition; i++) {
        if (condition_holds(kind_of(model, i), no->reading[i])) continue;
        const int smooth =
            kind_of(model, i) == PM_CONDITION_POSITIVE || kind_of(model, i) == PM_CONDITION_NOT_NEGATIVE;
        if (margin != PM_NONE || !smooth || isnan(no->reading[i]) || isnan(yes->reading[i])) return PM_NONE;
        margin = i;
    }
    return margin;
}
