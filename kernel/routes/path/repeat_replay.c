/* repeat_replay.c - the last segment once more, at other speeds.
 *
 * Its places are those of the segment that was computed, shifted (path_cycle.c).  Functions of the place alone, and those that
 * go with sqrt(T), fire where they did.  Forces of contacts, what is left of friction, triggers that go with T are looked at
 * again at the nodes, as is everything whose extremes are asked.  Between two nodes, h apart, with values a, b and slopes a',
 * b' there, a function is greater than the least of
 *
 *   a,   b,   a + h a' / 2,   b - h b' / 2                 (if its samples show it: Bezier points of a parabola)
 *   min(a, b) - |a - b|                                    (if they do not: where it has a corner)
 *
 * Blows are not repeated: repeat_energy.c knows what they leave. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/event_search.h"
#include "numerics/chebyshev.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/path/path.h"
#include "routes/path/repeat.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- may the segment be shown by its nodes? ---- */
/* T vanishes at no place of the step, and nobody asks for the time. */
static int never_rests(pm_path *p, double kinetic)
{
    const double more = kinetic - p->node[0].kinetic;
    for (int k = 0; k < p->nodes->n; k++)
        if (!(pm_path_node(p, k)->kinetic + more > 0)) return 0;
    return p->clock.kind == PM_CLOCK_NONE;
}

/* The step of the last segment becomes one of this segment, at its T. */
static void fill_step(pm_workspace *w, double kinetic)
{
    pm_path *p = w->path;
    pm_path_cycle_of(w->model, w->path, kinetic);
    p->clock.t0 = w->state.t;
    memcpy(p->weight, w->state.z, (size_t)w->model->nz_controlled * sizeof(double));
    p->energy = kinetic + p->begin.potential - pm_path_work(w->model, w->state.z);
    w->step.nodes = p->nodes;
    pm_step_set(&w->step, 0, p->h);
}

/* ---- what goes with T ---- */
static int goes_with_energy(const pm_model *model, const pm_event_function *f)
{
    if (f->kind == FUNCTION_TRIGGER) return pm_repeat_limit_moves(model, f->index);
    return f->kind == FUNCTION_NORMAL || f->kind == FUNCTION_STICK || f->kind == FUNCTION_JOINT_STICK ||
           f->kind == FUNCTION_FLANK;
}

/* The slot of the same contact that is closed now. */
static int closed_slot(const pm_model *model, const pm_state *state, int slot)
{
    const int contact = pm_contact_of_slot(model, slot), first = model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(model, contact); i++)
        if (state->slot[i].mode != PM_OPEN) return i;
    return slot;
}

/* The functions of the last segment serve again, but for those that the place tells; 1 if there is any. */
static int choose_functions(pm_workspace *w)
{
    pm_event_set *e = w->event;
    int any = 0;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        f->owned = !goes_with_energy(w->model, f);
        any |= !f->owned;
        if (f->kind == FUNCTION_NORMAL || f->kind == FUNCTION_STICK)
            f->index = closed_slot(w->model, &w->state, f->index);
    }
    return any;
}

/* A lower bound of side times function i, up to where the segment ends. */
static double least_of(const pm_workspace *w, int i, double side)
{
    const pm_chebyshev_nodes *nodes = w->step.nodes;
    const double *value = pm_event_samples(w->event, i), end = w->repeat->end / w->path->h;
    const int shown = pm_event_samples_resolve(&w->step, w->event, i);
    double least = INFINITY;
    for (int k = 0; k + 1 < nodes->n && nodes->at[k] < end; k++) {
        const double half = 0.5 * (nodes->at[k + 1] - nodes->at[k]), a = side * value[k],
                     b = side *
                         (nodes->at[k + 1] <= end ? value[k + 1] : pm_chebyshev_value(nodes, value, 1, end));
        least = pm_min(fmin(a, b), least);
        if (!shown) {
            least = pm_min(fmin(a, b) - fabs(a - b), least);
        } else {
            least = pm_min(a + half * side * pm_chebyshev_slope_at(nodes, value, k), least);
            if (nodes->at[k + 1] <= end)
                least = pm_min(b - half * side * pm_chebyshev_slope_at(nodes, value, k + 1), least);
        }
    }
    return least;
}

/* All that goes with T keeps its sign in the step.  What is left of a friction that holds is no linear function of T: it
 * would have to be looked at in each segment. */
static int signs_stay(const pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (f->owned) continue;
        const int side = f->kind == FUNCTION_TRIGGER ? w->repeat->side[f->index] : 1;
        if (side == 0 || f->kind == FUNCTION_JOINT_STICK || !(least_of(w, i, side) > 0)) return 0;
    }
    return 1;
}

/* Fills and samples the step at T = kinetic, if the last segment was one step that can be. */
static int look_at(pm_workspace *w, double kinetic, int *sure)
{
    *sure = 0;
    if (!w->path->repeats || !pm_path_cycle(w) || !never_rests(w->path, kinetic)) return PM_OK;
    fill_step(w, kinetic);
    int shown;
    const int status = pm_event_samples_fill(w, 1, &shown);
    *sure = !status && shown && signs_stay(w);
    return status;
}

int pm_repeat_replay_check(pm_workspace *w, double kinetic, int *sure)
{
    *sure = !choose_functions(w);
    if (*sure) return PM_OK;
    const int status = look_at(w, kinetic, sure);
    pm_frame_look_state(&w->frame, &w->state);
    return status;
}

/* ---- a segment that is told ---- */
/* Impulses of the last blow are read, and there will be none; or values where something is greatest, with counts of then. */
static int is_missed(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int kind = PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND];
        if (kind == PM_MEASURE_JOINT_IMPULSE || kind == PM_MEASURE_CONTACT_IMPULSE ||
            kind == PM_MEASURE_CONTACT_TENSION_IMPULSE || kind == PM_MEASURE_LOST)
            return 1;
    }
    for (int i = 0; i < m->nask; i++) {
        const int kind = PM_ASK_ROW(m, i)[PM_ASK_KIND];
        if (kind == PM_ASK_AT_MAX || kind == PM_ASK_AT_MIN) return 1;
    }
    return m->nfriction > 0;
}

/* Extremes that are asked see the step, up to where the segment ends. */
static int watch(pm_workspace *w, const pm_repeats *segments, int *found)
{
    const pm_repeat *l = w->repeat;
    const double kinetic = segments->kinetic + l->work;
    pm_state_copy(&w->ahead, &w->state);
    pm_step_set(&w->step, 0, l->end);
    int status = w->phase.route->exact(w, l->end, &w->probe); /* the frame looks there, too */
    *found = !status && fabs(pm_frame_kinetic(&w->frame, PM_NONE) - kinetic) <= PM_REPEAT_SAME_END * kinetic;
    if (!*found) return status;
    pm_state_copy(&w->state, &w->probe);
    pm_path_error_sampled(w);
    pm_path_error_step(w, kinetic);
    if (l->lowest < fmin(l->kinetic, l->before)) /* the barrier is inside */
        pm_path_error_barrier(&w->evidence, w->path, segments->kinetic - pm_repeat_energy_depth(l));
    status = pm_ask_step(w);
    pm_state_copy(&w->state, &w->ahead);
    return status;
}

int pm_repeat_replay_tell(pm_workspace *w, const pm_repeats *segments, int *found)
{
    pm_path *p = w->path;
    const double error = p->error, ended = p->ended;
    int sure;
    *found = 0;
    if (is_missed(w->model)) return PM_OK;
    choose_functions(w);
    int status = look_at(w, segments->kinetic, &sure);
    if (!status && sure && pm_ask_keeps_samples(&w->step, w->ask)) {
        p->error = segments->error;
        status = watch(w, segments, found);
        p->error = error;
        p->ended = ended;
    }
    pm_frame_look_state(&w->frame, &w->state);
    return status;
}
