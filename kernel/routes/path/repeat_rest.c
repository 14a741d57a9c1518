/* repeat_rest.c - swings that repeat.
 *
 * A motion along a path that begins at rest is told by the place alone: forces depend on the place, and nothing else is known
 * of the past.  Where it comes to rest again in a place in which it has begun, in the same modes, and nothing has struck, what
 * lay between is a period, and so it goes on: the way back is that forth, and no work is done on it.  n periods are passed over
 * at once:
 *
 *   t += n T,    integrals, counts, and the error of a period's time n times;  T has no other error than at their begin
 *
 * The place is the same if the work on the way between both is less than the error of T.  The first place of rest is compared with those that
 * follow; if none is the same among so many, a later one takes its place, and twice as many are compared with that (Brent). */
#include "routes/path/repeat_rest.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_repeat_rest_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->repeat->rest)) return PM_NO_MEMORY;
    pm_repeat *l = &w->repeat->rest->period;
    const pm_array array[] = {PM_ARRAY(l->rotation, m->nbody),
                              PM_ARRAY(l->event_count, m->rows[PM_TABLE_EVENT]),
                              PM_ARRAY(l->side, m->rows[PM_TABLE_TRIGGER])};
    l->steady = 1;
    const int status = pm_state_create(&w->memory, m, &l->begin);
    return status ? status : pm_arena_take(&w->memory, PM_ARRAYS(array));
}

/* Nothing that happens in a period leaves a trace but counts and times, which no force reads. */
static int may_repeat(const pm_workspace *w)
{
    const pm_model *m = w->model;
    return !m->acts && m->nkept == 0 && !m->programs.watch_counts && !w->record.history;
}

/* ---- the same place ---- */
static int same_memory(const pm_workspace *w, const pm_state *then)
{
    const pm_model *m = w->model;
    const double close = PM_REPEAT_SAME_PLACE * pm_contact_reach(w);
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode != then->slot[i].mode || w->state.slot[i].member != then->slot[i].member)
            return 0;
    for (int i = 0; i < m->nmemory; i++) {
        const pm_memory *a = &w->state.memory[i], *b = &then->memory[i];
        if (fabs(a->anchor - b->anchor) > close || fabs(a->direction - b->direction) > PM_REPEAT_SAME_PLACE)
            return 0;
    }
    return 1;
}

static int same_place(const pm_workspace *w, const pm_rest *rest)
{
    const pm_path *p = w->path;
    const double close = PM_REPEAT_SAME_PLACE * pm_contact_reach(w);
    if (p->driver != rest->driver ||
        !(fabs(p->begin.force * (p->begin.y[p->driver] - rest->place)) <= p->error))
        return 0;
    for (int i = 0; i < w->model->nq; i++) {
        const double unit = i % 3 == 2 ? PM_REPEAT_SAME_PLACE : close;
        if (fabs(w->state.q[i] - rest->period.begin.q[i]) > unit) return 0;
    }
    return same_memory(w, &rest->period.begin);
}

/* ---- a period ---- */
static void remember(pm_workspace *w, int most)
{
    const pm_path *p = w->path;
    pm_rest *rest = w->repeat->rest;
    pm_repeat *l = &rest->period;
    pm_state_copy(&l->begin, &w->state);
    memcpy(l->count, w->result.count, sizeof l->count);
    memcpy(l->event_count, w->firing.count, (size_t)w->model->rows[PM_TABLE_EVENT] * sizeof *l->event_count);
    l->known = 1;
    rest->seen = 0;
    rest->most = most;
    rest->driver = p->driver;
    rest->place = p->begin.y[p->driver];
    pm_repeat_pass_begin(w, l);
}

static int pass(pm_workspace *w, int *passed)
{
    const pm_rest *rest = w->repeat->rest;
    const pm_symmetry_shift none = {{0, 0}, rest->period.rotation};
    const double time = w->model->programs.read_time ? pm_repeat_pass_time(w, &rest->period) : 0;
    const int64_t most = pm_repeat_limit(w, &rest->period, &none, time);
    if (most == PM_REPEAT_FOR_EVER) return pm_repeat_limit_never(w);
    if (most < 1) return PM_OK;
    *passed = 1;
    const pm_repeats periods = {.n = most, .error = w->path->error};
    return pm_repeat_pass(w, &rest->period, &periods, 0, time);
}

void pm_repeat_rest_forget(pm_rest *rest) { rest->period.known = 0; }

int pm_repeat_rest_begin(pm_workspace *w, int *passed)
{
    pm_rest *rest = w->repeat->rest;
    int status = PM_OK, most = PM_REPEAT_RESTS;
    if (!w->path->at_rest || w->path->balanced || !may_repeat(w)) return PM_OK;
    if (rest->period.known && w->result.count[PM_COUNT_JUMPS] != rest->period.count[PM_COUNT_JUMPS])
        pm_repeat_rest_forget(rest);
    if (rest->period.known && !same_place(w, rest)) {
        if (++rest->seen < rest->most) return PM_OK;
        most = 2 * rest->most;
    } else if (rest->period.known) {
        status = pass(w, passed);
    }
    remember(w, most);
    if (*passed) pm_repeat_forget(w->repeat);
    return status;
}
