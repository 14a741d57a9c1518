/* repeat_replay.c - the last leg once more, at other speeds.
 *
 * Its places are those of the leg that was computed, shifted (path_cycle.c).  Functions of the place alone, and those that
 * go with sqrt(T), fire where they did.  What is linear in T (forces of contacts, what is left of friction) is looked at
 * again at the nodes, as is everything whose extremes are asked.  Blows are not repeated: repeat_energy.c knows what they leave. */
#include "routes/path/repeat_replay.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "events/ask.h"
#include "events/event.h"
#include "events/event_search.h"
#include "routes/path/path.h"
#include "routes/path/path_error.h"
#include "scene/program_class.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

#define SAME 1e-9 /* of T: the same leg */
#define CLEAR 0.3 /* of a function's greatest value: none of its values may come nearer to zero */

/* ---- may the leg be told by its nodes? ---- */
/* Impulses of the last blow are read, and there will be none; or values where something is greatest, with counts of then. */
static int is_missed(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int kind = PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND];
        if (kind == PM_MEASURE_JOINT_IMPULSE || kind == PM_MEASURE_CONTACT_IMPULSE || kind == PM_MEASURE_LOST)
            return 1;
    }
    for (int i = 0; i < m->nask; i++) {
        const int kind = PM_ASK_ROW(m, i)[PM_ASK_KIND];
        if (kind == PM_ASK_AT_MAX || kind == PM_ASK_AT_MIN) return 1;
    }
    return m->nfriction > 0;
}

/* T vanishes at no place of the step. */
static int never_rests(const pm_workspace *w, const pm_replay *r)
{
    pm_path *p = w->path;
    const double more = r->kinetic - p->node[0].kinetic;
    for (int k = 0; k < p->nodes->n; k++)
        if (!(pm_path_node(p, k)->kinetic + more > 0)) return 0;
    return p->clock.kind == PM_CLOCK_NONE;
}

/* The step of the last leg becomes one of this leg, at its T. */
static void fill_step(pm_workspace *w, const pm_replay *r)
{
    pm_path *p = w->path;
    pm_path_cycle_of(w, r->kinetic);
    p->clock.t0 = w->state.t;
    memcpy(p->weight, w->state.z, (size_t)w->model->nz_controlled * sizeof(double));
    p->energy = r->kinetic + p->begin.potential - pm_path_work(w, w->state.z);
    p->error = r->error;
    w->step.nodes = p->nodes;
    w->step.begin = 0;
    w->step.end = p->h;
}

/* ---- what is looked at ---- */
static int by_place(const pm_model *m, const pm_event_function *f)
{
    if (f->kind == FUNCTION_NORMAL || f->kind == FUNCTION_GRIP) return 0;
    if (f->kind != FUNCTION_TRIGGER) return 1;
    return m->programs.energy[PM_TRIGGER_ROW(m, f->index)[PM_TRIGGER_PROGRAM]] == PM_ENERGY_CLASS_NONE;
}

/* The slot of the same contact that is closed now. */
static int closed_slot(const pm_workspace *w, int slot)
{
    const int contact = pm_contact_of_slot(w->model, slot), first = w->model->contact_slot[contact];
    for (int i = first; i < first + pm_contact_slots(w->model, contact); i++)
        if (w->state.slot[i].mode != PM_OPEN) return i;
    return slot;
}

/* The functions of the last leg serve again, but for those that the place tells. */
static void choose_functions(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        f->owned = by_place(w->model, f);
        if (f->owned) continue;
        if (f->kind != FUNCTION_TRIGGER) {
            f->index = closed_slot(w, f->index);
        } else {
            e->least[f->index] = INFINITY;
            e->greatest[f->index] = -INFINITY;
        }
    }
}

/* Forces of contacts that stay well away from zero; a trigger must be on its side, as the caller sees. */
static int stays_clear(const pm_workspace *w, int function)
{
    const pm_event_set *e = w->event;
    double least = INFINITY, greatest = 0;
    if (e->function[function].owned || e->function[function].kind == FUNCTION_TRIGGER) return 1;
    for (int k = 0; k < w->step.nodes->n; k++) {
        const double value = pm_event_samples(w, function)[k];
        least = fmin(least, value);
        greatest = fmax(greatest, value);
    }
    return least > CLEAR * greatest && pm_event_samples_resolve(w, function);
}

static int nothing_new(const pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++)
        if (!stays_clear(w, i)) return 0;
    return pm_ask_keeps_samples(w);
}

int pm_repeat_replay(pm_workspace *w, const pm_replay *r, int *clear)
{
    *clear = 0;
    if (is_missed(w->model) || !pm_path_cycle(w) || !never_rests(w, r)) return PM_OK;
    fill_step(w, r);
    choose_functions(w);
    const int status = pm_event_samples_fill(w, 1);
    *clear = !status && nothing_new(w);
    return status;
}

int pm_repeat_replay_watch(pm_workspace *w, const pm_replay *r, int *told)
{
    pm_state_copy(&w->ahead, &w->state);
    w->step.end = r->end;
    int status = w->phase.route->exact(w, r->end, &w->probe); /* the frame looks there, too */
    *told = !status && fabs(pm_body_kinetic(&w->frame, PM_NONE) - r->kinetic1) <= SAME * r->kinetic1;
    if (!*told) return status;
    pm_state_copy(&w->state, &w->probe);
    pm_path_error_sampled(w);
    pm_path_error_step(w, r->kinetic1);
    if (r->lowest < INFINITY) pm_path_error_barrier(w, r->lowest);
    status = pm_ask_step(w);
    pm_state_copy(&w->state, &w->ahead);
    return status;
}
