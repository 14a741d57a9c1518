/* trace.c - appends rows while there is room, and counts all of them. */
#include "trace.h"

#include "body.h"
#include "program.h"
#include "saddle.h"

int pm_trace_row(pm_workspace *w, int mark)
{
    pm_record *x = w->trace;
    if (!x) return PM_OK;
    if (x->needed < x->cap) {
        double *row = x->history + x->needed * (1 + x->nprogram);
        pm_frame_look_state(w, &w->state);
        const int status = pm_saddle_accelerate(w);
        if (status) return status;
        row[0] = w->state.t;
        for (int64_t i = 0; i < x->nprogram; i++)
            row[1 + i] = pm_program_run(w->model, x->program[i], w->param, w->value, w);
        x->mark[x->needed] = mark;
    }
    x->needed++;
    return PM_OK;
}
