/* repeat.c - legs that repeat.
 *
 * A leg is a path phase and the instant that ends it.  If the next one begins like it (repeat_match.c) - the same modes, the
 * same configuration but for a shift that the scene does not notice (symmetry.c), velocities in the same proportion - then
 * its path, its blow and its marks are the same, and its kinetic energies follow (repeat_energy.c).
 *
 * At every place velocities go by sqrt(T) and forces of contacts linearly by T (program_energy.c).  So what did not happen in the
 * leg that was computed and does not happen in the last one, which is computed too, does not happen between; extremes lie
 * in these two (repeat_limit.c).  Only the least kinetic energy, that of the barrier on the way, is looked at leg by leg.  If
 * the last leg ends otherwise after all, the legs are given back and fewer are tried (repeat_record.c).
 *
 * A path without blows that closes on itself is a leg as well: a lap. */
#include "routes/path/repeat.h"

#include <math.h>

#include "elements/contact.h"
#include "events/event.h"
#include "routes/path/path.h"
#include "routes/path/repeat_energy.h"
#include "routes/path/repeat_limit.h"
#include "routes/path/repeat_match.h"
#include "routes/path/repeat_pass.h"
#include "routes/path/repeat_record.h"
#include "routes/path/repeat_replay.h"
#include "scene/symmetry.h"
#include "state/frame.h"
#include "state/workspace.h"

#define SAME_ENERGY 1e-13 /* a lap without gain or loss */

void pm_repeat_forget(pm_workspace *w)
{
    w->repeat->known = 0;
    w->repeat->pending = 0;
    w->repeat->most = PM_MOST_REPEATS;
}

/* ---- passing over ---- */
/* The last leg over the barrier, by the places of the one that was computed. */
static int tell_last(pm_workspace *w, pm_repeats *legs, int *told)
{
    pm_repeat *l = w->repeat;
    pm_path *p = w->path;
    const double error = p->error, ended = p->ended;
    const int dips = l->lowest < fmin(l->kinetic, l->before);
    if (!p->repeats) return PM_OK;
    const pm_replay replay = {.end = l->end,
                              .kinetic = legs->kinetic,
                              .kinetic1 = legs->kinetic + l->work,
                              .lowest = dips ? legs->kinetic - pm_repeat_energy_depth(l) : INFINITY,
                              .error = legs->error};
    pm_repeat_record_save_range(w);
    int clear, status = pm_repeat_replay(w, &replay, &clear);
    if (!status && clear && !pm_repeat_limit_signs_changed(w))
        status = pm_repeat_replay_watch(w, &replay, told);
    pm_frame_look_state(&w->frame, &w->state);
    p->error = error;
    p->ended = ended;
    if (*told) pm_repeat_energy_add(l, legs);
    return status;
}

/* These legs, and the last one over the barrier if it can be told; what can refute them is the end of the next one. */
static int pass_over(pm_workspace *w, double kinetic, pm_repeats *legs, int steady, double time)
{
    pm_repeat *l = w->repeat;
    int told = 0, status = PM_OK;
    if (legs->n > 0) pm_repeat_record_save(w);
    if (legs->is_last) status = tell_last(w, legs, &told);
    if (status || legs->n == 0) return status;
    l->pending = steady || told ? 0 : legs->n;
    l->expected_kind = l->end_kind;
    l->expected_mark = l->end_mark;
    return pm_repeat_pass(w, legs, kinetic, time);
}

/* The phase begins like the last leg, with T = kinetic: as many legs as nobody asks about are passed over. */
static int repeat(pm_workspace *w, double kinetic, int *passed)
{
    pm_repeat *l = w->repeat;
    const pm_symmetry_shift shift = {{l->by[0], l->by[1]}, l->turn};
    const int in_time = w->model->programs.read_time || w->history;
    const int steady = fabs(kinetic - l->kinetic) <= SAME_ENERGY * kinetic;
    if (w->history || (in_time && !steady) || !pm_symmetry_holds(&w->frame, &shift)) return PM_OK;
    l->work = pm_repeat_energy_work(w);
    l->ratio = kinetic / l->before;
    if (steady) l->ratio = 1, l->work = 0;
    const double time = in_time ? w->state.t - l->begin.t : 0;
    const int64_t most = pm_repeat_limit(w, &shift, time);
    w->path->repeats = !w->phase.lap && l->steps == 1;
    pm_repeats legs = pm_repeat_energy_over_barrier(l, kinetic, most, w->path->error);
    l->most = PM_MOST_REPEATS;
    const int status = pass_over(w, kinetic, &legs, steady, time);
    *passed = !status && legs.n > 0;
    return status;
}

int pm_repeat_begin(pm_workspace *w, int *passed)
{
    pm_repeat *l = w->repeat;
    const double kinetic = pm_body_kinetic(&w->frame, PM_NONE);
    int status = PM_OK;
    *passed = w->path->repeats = 0;
    l->pending = 0; /* legs passed over: the one that was computed ended as those before it */
    if (l->known && kinetic != 0 && pm_repeat_match(w, kinetic))
        status = repeat(w, kinetic, passed);
    else
        l->most = PM_MOST_REPEATS;
    pm_repeat_record_begin(w);
    return status;
}

/* ---- the end of a leg ---- */
/* What ended the phase: the first function that is no trigger, by its kind and contact. */
static void read_end(const pm_workspace *w, int *kind, int *mark)
{
    const pm_event_set *e = w->event;
    *kind = w->step.reverses ? PM_GROUND : PM_NONE;
    *mark = PM_NONE;
    for (int i = 0; i < e->nfunction; i++) {
        if (!e->hit[i] || e->function[i].kind == FUNCTION_TRIGGER) continue;
        *kind = e->function[i].kind;
        *mark = *kind == FUNCTION_GAP || *kind == FUNCTION_MEETING
                    ? e->function[i].index
                    : pm_contact_of_slot(w->model, e->function[i].index);
        return;
    }
}

void pm_repeat_end(pm_workspace *w)
{
    pm_repeat *l = w->repeat;
    if (!l->known) return;
    l->before = pm_body_kinetic(&w->frame, PM_NONE);
    l->end = w->step.end;
    l->steps = w->result.count[PM_COUNT_STEPS] - l->count[PM_COUNT_STEPS];
    l->lowest = fmin(w->path->lowest, l->kinetic);
    read_end(w, &l->end_kind, &l->end_mark);
}

void pm_repeat_lap(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    pm_repeat_end(w);
}

int pm_repeat_doubts(const pm_workspace *w)
{
    const pm_event_set *e = w->event;
    if (w->repeat->pending == 0) return 0;
    for (int i = 0; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_TRIGGER &&
            pm_repeat_limit_moves(w, e->function[i].index))
            return 1;
    return 0;
}

int pm_repeat_refuted(pm_workspace *w)
{
    pm_repeat *l = w->repeat;
    int kind, mark;
    if (l->pending == 0) return 0;
    read_end(w, &kind, &mark);
    if (kind == l->expected_kind && mark == l->expected_mark && !pm_repeat_limit_signs_changed(w)) return 0;
    l->most = l->pending / 2;
    l->pending = 0;
    return pm_repeat_record_restore(w) == PM_OK;
}
