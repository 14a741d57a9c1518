/* repeat_record.c - memory of the last leg, and of the run before legs were passed over. */
#include "routes/path/repeat_record.h"

#include <stdlib.h>
#include <string.h>

#include "equations/active_set.h"
#include "events/ask.h"
#include "events/event.h"
#include "routes/path/path.h"
#include "state/frame.h"
#include "state/workspace.h"

static size_t ask_flags(const pm_workspace *w) { return (size_t)w->model->nask + (size_t)w->model->nout; }

/* Least and greatest values of the triggers lie together, as they do in the set of events. */
static size_t range_doubles(const pm_workspace *w) { return 2 * (size_t)w->model->rows[PM_TABLE_TRIGGER]; }

int pm_repeat_record_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t nevent = (size_t)m->rows[PM_TABLE_EVENT], nout = (size_t)m->nout;
    pm_repeat *l = w->repeat = calloc(1, sizeof *l);
    if (!l) return PM_NO_MEMORY;
    int status = pm_state_create(m, &l->begin);
    if (!status) status = pm_state_create(m, &l->saved.begin);
    if (!status) status = pm_state_create(m, &l->saved.last);
    const size_t doubles = (size_t)m->nbody + nevent + nout + pm_ask_numbers(m) + range_doubles(w);
    double *p = l->block = calloc(doubles * sizeof *p + 3 * nevent * sizeof(int64_t) + ask_flags(w) + 1, 1);
    if (status || !p) return PM_NO_MEMORY;
    l->turn = p;
    l->saved.event_time = l->turn + m->nbody;
    l->saved.out = l->saved.event_time + nevent;
    l->saved.ask = l->saved.out + nout;
    l->saved.range = l->saved.ask + pm_ask_numbers(m);
    l->event_count = (int64_t *)(void *)(p + doubles);
    l->saved.event_count = l->event_count + nevent;
    l->saved.event_before = l->saved.event_count + nevent;
    l->saved.ask_flags = (unsigned char *)(l->saved.event_before + nevent);
    return PM_OK;
}

void pm_repeat_record_free(pm_workspace *w)
{
    if (!w->repeat) return;
    pm_state_free(&w->repeat->begin);
    pm_state_free(&w->repeat->saved.begin);
    pm_state_free(&w->repeat->saved.last);
    free(w->repeat->block);
    free(w->repeat);
    w->repeat = NULL;
}

void pm_repeat_record_begin(pm_workspace *w)
{
    pm_repeat *l = w->repeat;
    pm_state_copy(&l->begin, &w->state);
    l->kinetic = pm_body_kinetic(&w->frame, PM_NONE);
    l->before = l->kinetic;
    l->end_kind = l->end_mark = PM_NONE;
    memcpy(l->count, w->result.count, sizeof l->count);
    memcpy(l->event_count, w->event->count, (size_t)w->model->rows[PM_TABLE_EVENT] * sizeof *l->event_count);
    l->known = 1;
}

int64_t pm_repeat_record_fires(const pm_workspace *w, int event)
{
    return w->event->count[event] - w->repeat->event_count[event];
}

/* ---- one list of all that is saved, both ways ---- */
static void move(void *kept, void *now, size_t bytes, int back)
{
    memcpy(back ? now : kept, back ? kept : now, bytes);
}
#define MOVE(kept, now) move(&(kept), &(now), sizeof(kept), back)

static void move_state(pm_state *kept, pm_state *now, int back)
{
    pm_state_copy(back ? now : kept, back ? kept : now);
}

static void move_leg(pm_repeat *l, size_t nevent, int back)
{
    pm_repeat_saved *s = &l->saved;
    move_state(&s->last, &l->begin, back);
    MOVE(s->kinetic, l->kinetic);
    MOVE(s->before, l->before);
    MOVE(s->lowest, l->lowest);
    MOVE(s->end_kind, l->end_kind);
    MOVE(s->end_mark, l->end_mark);
    MOVE(s->count_before, l->count);
    move(s->event_before, l->event_count, nevent * sizeof *s->event_before, back);
}

static void move_run(pm_workspace *w, size_t nevent, int back)
{
    const pm_model *m = w->model;
    pm_repeat_saved *s = &w->repeat->saved;
    move_state(&s->begin, &w->state, back);
    MOVE(s->ledger, w->ledger);
    MOVE(s->speed, w->numbers.speed);
    MOVE(s->error, w->path->error);
    MOVE(s->count, w->result.count);
    move(s->event_count, w->event->count, nevent * sizeof *s->event_count, back);
    move(s->event_time, w->event->time, nevent * sizeof *s->event_time, back);
    move(s->range, w->event->least, range_doubles(w) * sizeof *s->range, back);
    move(s->out, w->result.out, (size_t)m->nout * sizeof *s->out, back);
    move(s->ask, w->ask->sample, pm_ask_numbers(m) * sizeof *s->ask, back);
    move(s->ask_flags, w->ask->undefined, ask_flags(w), back);
}

static void move_all(pm_workspace *w, int back)
{
    const size_t nevent = (size_t)w->model->rows[PM_TABLE_EVENT];
    move_leg(w->repeat, nevent, back);
    move_run(w, nevent, back);
}

void pm_repeat_record_save(pm_workspace *w) { move_all(w, 0); }

void pm_repeat_record_save_range(pm_workspace *w)
{
    move(w->repeat->saved.range, w->event->least, range_doubles(w) * sizeof(double), 0);
}

int pm_repeat_record_restore(pm_workspace *w)
{
    const int64_t steps = w->result.count[PM_COUNT_STEPS], solves = w->result.count[PM_COUNT_SOLVES];
    move_all(w, 1);
    w->result.count[PM_COUNT_STEPS] = steps; /* work that was done */
    w->result.count[PM_COUNT_SOLVES] = solves;
    w->path->ended = 0;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_active_set_build(w);
}
