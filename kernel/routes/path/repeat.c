/* repeat.c - segments that repeat.
 *
 * A segment is a path phase and the instant that ends it.  If the next one begins like it (repeat_match.c) - the same modes,
 * the same configuration but for a shift that the scene does not notice (symmetry.c), velocities in the same proportion -
 * then its path, its blow and its marks are the same, and its kinetic energies follow (repeat_energy.c).
 *
 * At every place velocities go by sqrt(T) and forces of contacts linearly by T (program_grade.c).  So an event that happens
 * neither in the segment that was computed, nor in the one after those that are to be skipped, does not happen in between; and
 * extremes lie in one of these two (repeat_limit.c).  The later one is checked before any is skipped (repeat_replay.c): if
 * something would happen in it, fewer are tried, and after the last sure one segments are computed one by one.  The least
 * kinetic energy, that of the barrier on the way, is known of each.
 *
 * A path without blows that closes on itself is a segment as well: a lap.  From rest to rest at the same place it is a period
 * (repeat_rest.c). */
#include "routes/path/repeat.h"

#include <math.h>
#include <string.h>

#include "events/event.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "scene/symmetry.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- memory ---- */
int pm_repeat_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    if (PM_ARENA_NEW(&w->memory, w->repeat)) return PM_NO_MEMORY;
    pm_repeat *l = w->repeat;
    const pm_array array[] = {PM_ARRAY(l->rotation, m->nbody),
                              PM_ARRAY(l->event_count, m->rows[PM_TABLE_EVENT]),
                              PM_ARRAY(l->side, m->rows[PM_TABLE_TRIGGER])};
    const int status = pm_state_create(&w->memory, m, &l->begin);
    return status ? status : pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_repeat_forget(pm_repeat *repeat)
{
    repeat->known = 0;
    repeat->unsure = NAN;
}

/* ---- passing over ---- */
/* Of these segments those that are sure, and so is the one after them, so that a blow is computed before anything else
 * happens: fewer are tried until it is. */
static int keep_sure(pm_workspace *w, double kinetic, pm_repeats *segments)
{
    pm_repeat *l = w->repeat;
    while (segments->n > 0) {
        int sure;
        const int status = pm_repeat_replay_check(w, segments->kinetic, &sure);
        if (status || sure) return status;
        l->unsure = segments->kinetic;
        *segments = pm_repeat_energy_over_barrier(l, kinetic, segments->n / 2, w->path->error);
    }
    return PM_OK;
}

/* The phase begins like the last segment, with T = kinetic. */
static int repeat(pm_workspace *w, double kinetic, int *passed)
{
    pm_repeat *l = w->repeat;
    const pm_symmetry_shift shift = {{l->by[0], l->by[1]}, l->rotation};
    const int in_time = w->model->programs.read_time || w->record.history;
    const int steady = l->steady = fabs(kinetic - l->kinetic) <= PM_REPEAT_SAME_ENERGY * kinetic;
    if (w->record.history || ((in_time || l->ends_by_force) && !steady) ||
        !pm_symmetry_holds(&w->frame, &shift))
        return PM_OK;
    l->work = steady ? 0 : pm_repeat_energy_work(w);
    l->ratio = steady ? 1 : kinetic / l->before;
    const double time = in_time ? pm_repeat_pass_time(w, l) : 0;
    const int64_t most = pm_repeat_limit(w, l, &shift, time);
    if (steady && most == PM_REPEAT_FOR_EVER) return pm_repeat_limit_never(w);
    w->path->repeats = !w->phase.lap && l->steps == 1;
    pm_repeats segments = pm_repeat_energy_over_barrier(l, kinetic, most, w->path->error);
    int found = 0, status = PM_OK;
    if (segments.is_last) status = pm_repeat_replay_tell(w, &segments, &found);
    if (found)
        pm_repeat_energy_add(l, &segments);
    else if (!status && !steady)
        status = keep_sure(w, kinetic, &segments);
    *passed = !status && segments.n > 0;
    return *passed ? pm_repeat_pass(w, l, &segments, kinetic, time) : status;
}

/* A segment begins at w->state. */
static void remember(pm_workspace *w)
{
    pm_repeat *l = w->repeat;
    pm_state_copy(&l->begin, &w->state);
    l->kinetic = l->before = pm_frame_kinetic(&w->frame, PM_NONE);
    l->ends_by_force = 0;
    pm_repeat_pass_begin(w, l);
    memcpy(l->count, w->result.count, sizeof l->count);
    memcpy(l->event_count, w->firing.count, (size_t)w->model->rows[PM_TABLE_EVENT] * sizeof *l->event_count);
    l->known = 1;
}

int pm_repeat_begin(pm_workspace *w, int *passed)
{
    pm_repeat *l = w->repeat;
    const double kinetic = pm_frame_kinetic(&w->frame, PM_NONE);
    int status = PM_OK;
    *passed = w->path->repeats = 0;
    const int alike = l->known && kinetic != 0 && pm_repeat_match(w, kinetic);
    if (pm_repeat_limit_read_sides(w) || !alike) l->unsure = NAN; /* another series */
    if (alike) status = repeat(w, kinetic, passed);
    remember(w);
    return status;
}

/* ---- the end of a segment ---- */
static int is_force(int kind)
{
    return kind == FUNCTION_NORMAL || kind == FUNCTION_STICK || kind == FUNCTION_JOINT_STICK ||
           kind == FUNCTION_FLANK;
}

void pm_repeat_end(pm_workspace *w)
{
    pm_repeat *l = w->repeat;
    const pm_event_set *e = w->event;
    pm_path_error_end(w);
    if (!l->known) return;
    l->before = pm_frame_kinetic(&w->frame, PM_NONE);
    l->end = w->step.end;
    l->steps = w->result.count[PM_COUNT_STEPS] - l->count[PM_COUNT_STEPS];
    l->lowest = fmin(w->path->lowest, l->kinetic);
    for (int i = 0; i < e->nfunction; i++) l->ends_by_force |= e->hit[i] && is_force(e->function[i].kind);
}
