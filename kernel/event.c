/* event.c - the functions of a phase, and the steps until something happens. */
#include "event.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "action.h"
#include "active.h"
#include "ask.h"
#include "audit.h"
#include "body.h"
#include "capture.h"
#include "case.h"
#include "contact.h"
#include "crossing.h"
#include "crossing_sample.h"
#include "grip.h"
#include "instant.h"
#include "leg.h"
#include "path_error.h"
#include "plan.h"
#include "root.h"
#include "route.h"
#include "saddle.h"
#include "segment.h"
#include "trace.h"
#include "trigger.h"

#define POSITION_ROUNDING 4e-15 /* of how far bodies are from the origin */
#define FORCE_SLACK 1e-10       /* of the scene's weight-like force */
#define ON_MULTIPLE 1e-9        /* of the multiples' distance: `every` begins on one of them */

/* ---- memory ---- */
static size_t rows_watched(const pm_model *m)
{
    size_t n = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) n += (size_t)pm_contact_is_row(m, i);
    return n;
}

int pm_event_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t ntrigger = (size_t)m->rows[PM_TABLE_TRIGGER], nevent = (size_t)m->rows[PM_TABLE_EVENT];
    const size_t most =
        ntrigger + (size_t)m->rows[PM_TABLE_CONTACT] + 4 * (size_t)m->nslot + (size_t)m->ngrip;
    pm_event_set *e = w->event = calloc(1, sizeof *e);
    if (!e) return PM_NO_MEMORY;
    e->most = (int)most;
    e->function = calloc(most + 1, sizeof *e->function);
    e->value = calloc(PM_NODES_MOST * (most + 1) + 4 * ntrigger + nevent, sizeof(double));
    e->beside = calloc(PM_NODES_MOST * rows_watched(m) + 1, sizeof *e->beside);
    e->hit = calloc(2 * (most + 1), sizeof(int));
    e->count = calloc(2 * nevent + 1, sizeof *e->count);
    e->fired = calloc(ntrigger + (size_t)m->rows[PM_TABLE_CONTACT] + nevent + 1, 1);
    e->solver = pm_root_create();
    if (!e->function || !e->value || !e->beside || !e->hit || !e->count || !e->fired || !e->solver)
        return PM_NO_MEMORY;
    if (pm_clear_create(m, &e->clear)) return PM_NO_MEMORY;
    e->seen = e->count + nevent;
    e->spent = e->fired + ntrigger;
    e->acted = e->spent + m->rows[PM_TABLE_CONTACT];
    e->root = e->hit + most + 1;
    e->before = e->value + PM_NODES_MOST * (most + 1);
    e->due = e->before + ntrigger;
    e->least = e->due + ntrigger;
    e->greatest = e->least + ntrigger;
    e->time = e->greatest + ntrigger;
    return PM_OK;
}

void pm_event_free(pm_workspace *w)
{
    pm_event_set *e = w->event;
    if (!e) return;
    free(e->function);
    free(e->value);
    free(e->beside);
    free(e->hit);
    free(e->count);
    free(e->fired);
    pm_root_free(e->solver);
    pm_clear_free(&e->clear);
    free(e);
    w->event = NULL;
}

/* ---- the functions of a phase ---- */
static void add(pm_workspace *w, int kind, int index, int direction, int level, double slack, double natural)
{
    pm_event_set *e = w->event;
    const int owned = w->route->finds_roots == PM_ROOTS_ALL ||
                      (w->route->finds_roots == PM_ROOTS_OF_CONTACTS && kind != FUNCTION_TRIGGER);
    e->function[e->nfunction++] = (pm_event_function){.kind = kind,
                                                      .index = index,
                                                      .direction = direction,
                                                      .level = level,
                                                      .slack = slack,
                                                      .owned = owned,
                                                      .natural = natural,
                                                      .near = INFINITY,
                                                      .row = PM_NONE};
    if (!owned) e->nsampled++;
    /* a route that finds all roots itself reads all functions at one look; contacts of their own need none */
    if (level > e->level && (!owned || w->route->finds_roots == PM_ROOTS_ALL)) e->level = level;
}

/* A trigger on time alone needs no watching where the route steps in time: the step ends when it is due. */
static void add_triggers(pm_workspace *w)
{
    static const int direction[] = {
        [PM_TRIGGER_CROSS] = 0, [PM_TRIGGER_RISE] = 1, [PM_TRIGGER_FALL] = -1, [PM_TRIGGER_EVERY] = -1};
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        const int in_time =
            w->route->in_time && w->route->finds_roots != PM_ROOTS_ALL && pm_trigger_on_time(w, i);
        w->event->least[i] = INFINITY;
        w->event->greatest[i] = -INFINITY;
        w->event->due[i] = in_time ? pm_trigger_due(w, i) : INFINITY;
        if (in_time || e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY) continue;
        add(w, FUNCTION_TRIGGER, i, direction[e[PM_TRIGGER_KIND]],
            w->model->program_level[e[PM_TRIGGER_PROGRAM]], 0, 1);
        pm_event_function *f = &w->event->function[w->event->nfunction - 1];
        f->held = w->event->fired[i];
        f->every = e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY;
    }
}

static void add_gap(pm_workspace *w, int contact)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[e->nfunction];
    add(w, FUNCTION_GAP, contact, -1, PM_LEVEL_KINEMATIC, pm_contact_length(w), w->size);
    f->below = pm_segment_is(w->model, contact) && pm_segment_is_below(w, contact);
    if (pm_contact_is_row(w->model, contact)) f->row = e->nrow++;
}

static void add_contacts(pm_workspace *w)
{
    const pm_model *m = w->model;
    const double size = pm_case_force(w), force = FORCE_SLACK * size;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (pm_is_absent(m, &w->state, PM_TABLE_CONTACT, i))
            continue;
        else if (pm_capture_is_meeting(m, i))
            add(w, FUNCTION_MEETING, i, 1, PM_LEVEL_KINEMATIC, 0, w->size * w->speed);
        else
            add_gap(w, i);
    for (int i = 0; i < m->nslot; i++) {
        const int mode = w->state.slot[i].mode;
        if (mode == PM_OPEN || mode == PM_CAPTURED) continue;
        add(w, FUNCTION_NORMAL, i, -1, PM_LEVEL_DYNAMIC, force, size);
        if (mode == PM_STICK && pm_contact_friction(m, pm_contact_of_slot(m, i)) == PM_FRICTION_COULOMB)
            add(w, FUNCTION_GRIP, i, -1, PM_LEVEL_DYNAMIC, force, size);
        if (pm_segment_is(m, pm_contact_of_slot(m, i)))
            add(w, FUNCTION_END, i, -1, PM_LEVEL_KINEMATIC, pm_contact_length(w), w->size);
        if (mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD)
            add(w, FUNCTION_SLIP, i, -1, PM_LEVEL_KINEMATIC, pm_contact_speed(w), w->speed);
    }
}

static void add_grips(pm_workspace *w)
{
    const double size = pm_case_force(w), force = FORCE_SLACK * size;
    for (int i = 0; i < w->model->ngrip; i++) {
        if (w->state.grip[i] == PM_STICK)
            add(w, FUNCTION_HOLD, i, -1, PM_LEVEL_DYNAMIC, force, size);
        else if (w->state.grip[i] != PM_OPEN)
            add(w, FUNCTION_RUB, i, -1, PM_LEVEL_KINEMATIC, pm_grip_still(w, i), w->speed);
    }
}

double pm_event_sample(pm_workspace *w, const pm_event_function *f)
{
    const pm_slot *slot = w->state.slot;
    int member;
    switch (f->kind) {
    case FUNCTION_GAP: {
        const double gap = pm_contact_gap(w, &w->state, f->index, &member);
        if (isinf(gap)) return w->size; /* nothing left to close */
        return f->below ? pm_segment_gap_from_below(w, f->index) : gap;
    }
    case FUNCTION_NORMAL:
        return w->slot_normal[f->index] == PM_NONE ? w->size : w->frame.lambda[w->slot_normal[f->index]];
    case FUNCTION_GRIP: {
        if (w->slot_tangent[f->index] == PM_NONE || w->slot_normal[f->index] == PM_NONE) return 1;
        const double mu = pm_contact_static(w, pm_contact_of_slot(w->model, f->index));
        return mu * w->frame.lambda[w->slot_normal[f->index]] -
               fabs(w->frame.lambda[w->slot_tangent[f->index]]);
    }
    case FUNCTION_SLIP: {
        const double slip =
            pm_contact_member_slip(w, pm_contact_of_slot(w->model, f->index), slot[f->index].member);
        return slot[f->index].mode == PM_SLIDE_FORWARD ? slip : -slip;
    }
    case FUNCTION_MEETING: /* a pair that is not open meets no more */
        return isinf(pm_contact_gap(w, &w->state, f->index, &member)) ? w->size * w->speed
                                                                      : pm_capture_approach(w, f->index);
    case FUNCTION_END:
        return pm_segment_room(w, pm_contact_of_slot(w->model, f->index), slot[f->index].member);
    case FUNCTION_HOLD:
        if (w->grip_row[f->index] == PM_NONE) return 1; /* something else holds it, too */
        return pm_grip_limit(w, f->index) - fabs(w->frame.lambda[w->grip_row[f->index]]);
    case FUNCTION_RUB:
        return w->state.grip[f->index] == PM_SLIDE_FORWARD ? pm_grip_slip(w, f->index)
                                                           : -pm_grip_slip(w, f->index);
    default: return pm_trigger_program(w, f->index);
    }
}

int pm_event_changes_sign(const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER || f->kind == FUNCTION_MEETING;
}

double pm_event_of_sample(const pm_event_function *f, double sample)
{
    return f->every ? (sample - f->low) * (f->high - sample) : sample;
}

double pm_event_value(pm_workspace *w, const pm_event_function *f)
{
    return pm_event_of_sample(f, pm_event_sample(w, f));
}

void pm_event_values(pm_workspace *w, double *value)
{
    for (int i = 0; i < w->event->nfunction; i++) value[i] = pm_event_value(w, &w->event->function[i]);
}

/* `every`: the multiples next to the frame; the one that holds must first be left. */
static void set_multiples(pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        pm_event_function *f = &w->event->function[i];
        if (!f->every) continue;
        const double p = pm_trigger_program(w, f->index), nearest = round(p);
        const int holds = fabs(p - nearest) <= ON_MULTIPLE * fmax(1, fabs(p));
        const double low = holds ? nearest - 1 : floor(p), high = holds ? nearest + 1 : low + 1;
        if (low != f->low || high != f->high) f->search = SEARCH_NONE;
        f->low = low;
        f->high = high;
    }
}

/* The nearest open member of a touching contact moves away with a definite speed: it may come back at once. */
static int leaves(pm_workspace *w, int contact)
{
    int member;
    double rate;
    pm_contact_gap(w, &w->state, contact, &member);
    pm_contact_member_gap(w, contact, member, &rate);
    return rate > pm_contact_speed(w);
}

void pm_event_begin(pm_workspace *w)
{
    pm_event_set *e = w->event;
    e->nfunction = e->nsampled = e->nrow = 0;
    e->level = PM_LEVEL_KINEMATIC;
    add_triggers(w);
    e->ntrigger = e->nfunction;
    add_contacts(w);
    add_grips(w);
    e->first_step = 1;
    pm_clear_begin(w);
    memset(e->spent, 0, (size_t)w->model->rows[PM_TABLE_CONTACT]);
    set_multiples(w);
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (pm_event_changes_sign(f) || pm_event_value(w, f) > f->slack) continue;
        f->held = 1;
        if (f->kind == FUNCTION_GAP && leaves(w, f->index))
            f->slack = POSITION_ROUNDING * pm_contact_reach(w);
    }
    memset(e->fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

/* ---- one step ---- */
/* Shortens the step to end at x, with the exact state there (already in w->probe if it was taken at x). */
static int stop_at(pm_workspace *w, double x, double taken)
{
    const int status = taken == x ? PM_OK : w->route->exact(w, x, &w->probe);
    if (status) return status;
    pm_state_copy(&w->state, &w->probe);
    w->step_end = x;
    return PM_OK;
}

static void look_for_roots(pm_workspace *w)
{
    pm_event_set *e = w->event;
    e->at_root = 0;
    for (int i = 0; i < e->nfunction; i++) {
        e->hit[i] = 0;
        e->at_root |= e->root[i] != 0;
    }
}

/* A route that finds roots itself has ended its step there, unless something that is sampled comes first. */
static void take_roots(pm_workspace *w, double *first)
{
    pm_event_set *e = w->event;
    if (!e->at_root || *first < w->step_end) return;
    for (int i = 0; i < e->nfunction; i++) e->hit[i] |= e->root[i] != 0;
    *first = w->step_end;
}

static void mark_hits(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_TRIGGER) e->fired[e->function[i].index] = 1;
}

static double next_due(const pm_workspace *w)
{
    double next = INFINITY;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) next = fmin(next, w->event->due[i]);
    return next;
}

/* The step has ended when triggers on time are due. */
static int mark_due(pm_workspace *w)
{
    int any = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        if (w->event->due[i] > w->state.t) continue;
        w->event->fired[i] = 1;
        w->event->due[i] = INFINITY;
        any = 1;
    }
    return any;
}

static int limit_reached(pm_workspace *w, double max_time)
{
    if (w->stop && *w->stop) return PM_CANCELLED;
    if (w->state.t >= max_time) return pm_fail(w, PM_LIMIT_TIME, PM_TABLE_SETTING, 0, w->state.t, max_time);
    const double most = PM_SETTING(w->model, PM_SETTING_MAX_STEPS);
    if ((double)w->count[PM_COUNT_STEPS] >= most)
        return pm_fail(w, PM_LIMIT_STEPS, PM_TABLE_SETTING, 0, most, most);
    return PM_OK;
}

static void end_step(pm_workspace *w)
{
    pm_frame_look_state(w, &w->state);
    pm_active_follow(w, &w->state);
    pm_audit_step(w);
    if (w->route->in_time && w->ask->fresh) pm_audit_seal(w);
    w->event->first_step = 0;
}

static int only_marks(const pm_workspace *w)
{
    const pm_model *m = w->model;
    if (m->watches_counts || pm_leg_doubts(w)) return 0;
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (!w->event->hit[i]) continue;
        if (f->kind != FUNCTION_TRIGGER) return 0;
        if (m->acts && pm_action_of(m, PM_TRIGGER_ROW(m, f->index)[PM_TRIGGER_EVENT])) return 0;
    }
    return 1;
}

/* What has just fired must be left before it fires again.  x is where it is zero exactly; further zeros are looked for on
 * the dense output, which may have the same one a little later. */
static void hold_hits(pm_workspace *w, double x)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        if (!e->hit[i]) continue;
        e->function[i].held = 1;
        e->function[i].since = fmax(x, e->function[i].located);
        e->function[i].search = SEARCH_NONE;
    }
    set_multiples(w);
    memset(e->fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

/* Something is marked at x inside the step and the motion goes on: no blow, no change of modes, no new phase. */
static int pass(pm_workspace *w, double x, double taken, int *ended)
{
    int status = pm_trace_inside(w, x);
    if (!status && (taken != x || w->trace)) status = w->route->exact(w, x, &w->probe);
    if (status) return status;
    pm_state_copy(&w->ahead, &w->state);
    pm_state_copy(&w->state, &w->probe);
    mark_hits(w);
    status = pm_instant_mark(w, ended);
    if (*ended) return status;
    hold_hits(w, x);
    pm_state_copy(&w->state, &w->ahead);
    return status;
}

/* What fires right before the step's end, where triggers on time are due or a contact changes, belongs to that instant. */
static void join_end(const pm_workspace *w, double *first)
{
    const double same = PM_SAME_PLACE * (w->step_end - w->step_begin);
    const int something = w->event->at_root || (w->route->in_time && next_due(w) <= w->step_end);
    if (something && *first >= w->step_end - same) *first = w->step_end;
}

/* What happens at the end of the step, found there, only marks something, and the phase goes on in another step. */
static int marks_end(const pm_workspace *w, double first, int due)
{
    return first == w->step_end && !due && !w->turns && !w->lap && !w->event->at_root && only_marks(w);
}

/* Something is marked at the end of the step, where the frame looks. */
static int pass_end(pm_workspace *w, int *ended)
{
    const int status = pm_instant_mark(w, ended);
    if (status || *ended) return status;
    hold_hits(w, w->step_end);
    pm_crossing_leave(w); /* what has left its zero is no more held; in the next step places are others */
    return PM_OK;
}

/* Passes the instants of the step that only mark something; *first is that of a full one, or of the end. */
static int pass_marks(pm_workspace *w, double *first, double *taken, int *ended)
{
    double from = w->step_begin;
    for (;;) {
        int status = pm_crossing_first(w, from, first, taken);
        if (!status && *first < INFINITY) join_end(w, first);
        if (status || *first >= w->step_end || *first <= w->step_begin || !only_marks(w)) return status;
        status = pass(w, *first, *taken, ended);
        if (status || *ended) return status;
        from = *first;
    }
}

int pm_event_advance(pm_workspace *w, int *ended)
{
    pm_event_set *e = w->event;
    const double max_time = pm_case_max_time(w);
    *ended = 0;
    for (;;) {
        double first = INFINITY, taken = NAN;
        int status = limit_reached(w, max_time);
        if (status) return status;
        memset(e->root, 0, (size_t)e->nfunction * sizeof(int));
        if (!e->first_step) {
            pm_frame_look_state(w, &w->state);
            set_multiples(w);
        }
        w->nodes = w->route->nodes;
        status = w->route->step(w, fmin(max_time, next_due(w)));
        pm_trace_step(w);
        look_for_roots(w);
        if (!status) status = pm_crossing_sample(w, 1);
        if (!status && e->nsampled > 0) pm_path_error_sampled(w);
        if (!status && e->nsampled > 0) status = pass_marks(w, &first, &taken, ended);
        if (status) return status;
        if (e->nsampled > 0) pm_crossing_leave(w);
        if (!*ended) take_roots(w, &first);
        const int inside = first < w->step_end;
        if (inside) {
            if (!*ended && (status = stop_at(w, first, taken))) return status;
            w->step_end = first;
            if (!pm_ask_keeps_samples(w) && (status = pm_crossing_sample(w, 0))) return status;
        }
        if (w->step_end > w->step_begin && (status = pm_ask_step(w))) return status;
        if ((status = pm_trace_inside(w, w->step_end))) return status;
        end_step(w);
        const int due = first >= w->step_end && mark_due(w);
        if (*ended) return PM_OK;
        if (first < INFINITY) mark_hits(w);
        if (!inside && marks_end(w, first, due)) {
            if ((status = pass_end(w, ended)) || *ended) return status;
            continue;
        }
        if (first < INFINITY || due || w->turns) {
            w->lap = 0;
            return PM_OK;
        }
        w->lap |= pm_plan_has_passed(w);
        if (w->lap) return PM_OK;
        if (w->trace && (status = pm_trace_row(w, 0))) return status;
    }
}

int pm_event_contact_change(const pm_workspace *w, int function)
{
    switch (w->event->function[function].kind) {
    case FUNCTION_NORMAL: return PM_TRIGGER_OPEN;
    case FUNCTION_GRIP: return PM_TRIGGER_SLIP;
    case FUNCTION_SLIP: return PM_TRIGGER_STICK;
    default: return PM_NONE;
    }
}
