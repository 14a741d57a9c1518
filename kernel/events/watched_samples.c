/* watched_samples.c - the watched programs at the nodes of a step.
 *
 * The frame looks at one node after the other; every measure that some program reads is read there once.  Then each program
 * is run for all nodes together. */
#include "events/watched_samples.h"

#include "expression/program.h"
#include "expression/program_fold.h"
#include "state/arena.h"
#include "state/workspace.h"

static void add_measure(pm_workspace *w, int measure, int who)
{
    pm_watched_samples *s = w->watched;
    int i = 0;
    while (i < s->n && s->measure[i] != measure) i++;
    if (i == s->n) s->n++;
    s->measure[i] = measure;
    s->reader[i] = pm_measure_reader_of(w, measure);
    s->place[measure] = i;
    s->who[i] |= (unsigned char)who;
}

void pm_watched_samples_add(pm_workspace *w, int program, int who)
{
    const pm_program_fold *f = w->model->programs.fold;
    for (int k = f->first[program]; k < f->first[program + 1]; k++)
        if (f->step[k].kind == STEP_MEASURE) add_measure(w, f->step[k].arg, who);
}

int pm_watched_samples_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const int n = m->rows[PM_TABLE_MEASURE];
    if (PM_ARENA_NEW(&w->memory, w->watched)) return PM_NO_MEMORY;
    pm_watched_samples *s = w->watched;
    const pm_array array[] = {
        PM_ARRAY(s->measure, n),
        PM_ARRAY(s->reader, n),
        PM_ARRAY(s->place, n),
        PM_ARRAY(s->who, n),
        PM_ARRAY(s->value, n * PM_NODES_MOST),
        PM_ARRAY(s->here, n * PM_NODES_MOST),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_watched_samples_read(pm_workspace *w, int node, int who)
{
    const pm_watched_samples *s = w->watched;
    const pm_measure_reader *x = s->reader;
    double *value = s->value + node;
    for (int i = 0, n = s->n; i < n; i++, x++, value += PM_NODES_MOST)
        if (s->who[i] & who) *value = pm_measure_read(x);
}

void pm_watched_samples_run(pm_workspace *w, int program, pm_switches *switches, double *value)
{
    const pm_watched_samples *s = w->watched;
    pm_program_run_nodes(w, program, w->step.nodes->n, s->place, s->value, switches, value);
}

double pm_watched_samples_here(pm_workspace *w, int program, pm_switches *switches)
{
    const pm_watched_samples *s = w->watched;
    const pm_program_fold *f = w->model->programs.fold;
    double value;
    for (int k = f->first[program]; k < f->first[program + 1]; k++) {
        if (f->step[k].kind != STEP_MEASURE) continue;
        const int i = s->place[f->step[k].arg];
        s->here[i * PM_NODES_MOST] = pm_measure_read(&s->reader[i]);
    }
    pm_program_run_nodes(w, program, 1, s->place, s->here, switches, &value);
    return value;
}
