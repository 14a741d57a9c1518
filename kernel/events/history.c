/* history.c - appends records while there is room, and counts all of them. */
#include "events/history.h"

#include "equations/saddle.h"
#include "expression/program.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

static int record(pm_workspace *w, const pm_state *state, int mark)
{
    pm_history *x = w->record.history;
    if (x->needed < x->cap) {
        double *row = x->history + x->needed * (1 + x->nprogram);
        pm_frame_look_state(&w->frame, state);
        const int status = pm_saddle_accelerate(w);
        if (status) return status;
        row[0] = state->t;
        for (int64_t i = 0; i < x->nprogram; i++) row[1 + i] = pm_program_run(w, x->program[i]);
        x->mark[x->needed] = mark;
    }
    x->needed++;
    return PM_OK;
}

int pm_history_append(pm_workspace *w, int mark)
{
    return w->record.history ? record(w, &w->state, mark) : PM_OK;
}

void pm_history_step(const pm_step *step, pm_record *record)
{
    if (!record->history) return;
    record->history->length = step->end - step->begin;
    record->history->begin = record->history->inside = step->begin;
}

int pm_history_inside(pm_workspace *w, double x)
{
    pm_history *r = w->record.history;
    if (!r || w->phase.route->in_time) return PM_OK;
    for (int k = 0; k < w->step.nodes->n; k++) {
        const double place = r->begin + r->length * w->step.nodes->at[k];
        if (place <= r->inside || place >= x) continue;
        int status = w->phase.route->exact(w, place, &w->probe);
        if (!status) status = record(w, &w->probe, 0);
        if (status) return status;
        r->inside = place;
    }
    return PM_OK;
}
