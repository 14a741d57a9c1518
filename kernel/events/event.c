/* event.c - the functions of a phase: which there are, and their values.
 *
 * Each is zero where something may happen: a trigger its program less what it crosses, or the multiple that it reaches next; a
 * contact its gap, its normal force N, what is left of its friction mu N - F and mu N + F, its slip,
 * the room on its edge; friction of a joint what is left of it either way, or its slip. */
#include "events/event.h"

#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "elements/teeth.h"
#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/saddle.h"
#include "equations/shared_loads.h"
#include "equations/shared_reading.h"
#include "events/bounce_series.h"
#include "events/track.h"
#include "events/watched_samples.h"
#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/frame.h"
#include "state/route.h"
#include "state/workspace.h"

/* ---- memory ---- */
static int patterns_watched(const pm_model *m)
{
    int n = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) n += pm_contact_is_pattern(m, i);
    return n;
}

int pm_event_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const int ntrigger = m->rows[PM_TABLE_TRIGGER], nevent = m->rows[PM_TABLE_EVENT],
              ncontact = m->rows[PM_TABLE_CONTACT];
    const int most = ntrigger + ncontact + 7 * m->nslot + 2 * m->nfriction + 2 * m->rows[PM_TABLE_JOINT];
    if (PM_ARENA_NEW(&w->memory, w->event)) return PM_NO_MEMORY;
    pm_event_set *e = w->event;
    e->most = most;
    const pm_array array[] = {
        PM_ARRAY(e->function, most),
        PM_ARRAY(e->value, PM_NODES_MOST * most),
        PM_ARRAY(e->beside, PM_NODES_MOST * patterns_watched(m)),
        PM_ARRAY(e->near, patterns_watched(m)),
        PM_ARRAY(e->beside_edge, PM_NODES_MOST * m->nedge),
        PM_ARRAY(e->hit, most),
        PM_ARRAY(e->root, most),
        PM_ARRAY(e->due, ntrigger),
        PM_ARRAY(e->least, ntrigger),
        PM_ARRAY(e->greatest, ntrigger),
        PM_ARRAY(e->multiples, ntrigger),
        PM_ARRAY(e->last, ntrigger),
        PM_ARRAY(e->came, ntrigger),
        PM_ARRAY(e->spent, ncontact),
        PM_ARRAY(e->vain, ncontact),
        PM_ARRAY(e->acted, nevent),
        PM_ARRAY(e->culling.left, ncontact),
        PM_ARRAY(e->culling.moved, m->nbody + 1),
        PM_ARRAY(e->culling.pose, 3 * m->nbody * PM_NODES_MOST),
        PM_ARRAY(e->culling.radius, m->nbody),
        PM_ARRAY(e->culling.skipped, ncontact),
    };
    e->solver = pm_bracket_create();
    if (pm_arena_keep(&w->memory, e->solver, pm_bracket_free) || pm_arena_take(&w->memory, PM_ARRAYS(array)))
        return PM_NO_MEMORY;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *x = PM_TRIGGER_ROW(m, i);
        if (x[PM_TRIGGER_KIND] <= PM_TRIGGER_EVERY)
            pm_watched_samples_add(w, x[PM_TRIGGER_PROGRAM], PM_SAMPLE_TRIGGERS);
    }
    return pm_bounce_series_create(w);
}

/* ---- the functions of a phase ---- */
static void add(const pm_phase *phase, pm_event_set *e, int kind, int index, int direction, int level,
                double slack, double natural)
{
    pm_event_function *f = &e->function[e->nfunction++];
    memset(f, 0, sizeof *f);
    f->kind = kind;
    f->index = index;
    f->direction = direction;
    f->level = level;
    f->slack = slack;
    f->owned = phase->route->locates_contacts && kind != FUNCTION_TRIGGER;
    f->natural = natural;
    f->near = f->rested = INFINITY;
    f->pattern = f->edge = PM_NONE;
    if (f->owned) return;
    e->nsampled++;
    if (level > e->level) e->level = level;
}

/* A trigger on time alone needs no watching where the route steps in time: the step ends when it is due. */
static void add_triggers(pm_workspace *w)
{
    static const int direction[] = {
        [PM_TRIGGER_CROSS] = 0, [PM_TRIGGER_RISE] = 1, [PM_TRIGGER_FALL] = -1, [PM_TRIGGER_EVERY] = 0};
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        const int in_time = w->phase.route->in_time && pm_trigger_on_time(w->model, i);
        w->event->least[i] = INFINITY;
        w->event->greatest[i] = -INFINITY;
        if (w->result.count[PM_COUNT_PHASES] == 0) {
            w->event->last[i] = INFINITY;
            w->event->multiples[i].low = w->event->multiples[i].high = NAN;
        }
        w->event->due[i] = in_time ? pm_trigger_due(w, i) : INFINITY;
        if (in_time || e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY) continue;
        add(&w->phase, w->event, FUNCTION_TRIGGER, i, direction[e[PM_TRIGGER_KIND]],
            w->model->programs.level[e[PM_TRIGGER_PROGRAM]], 0, 1);
        pm_event_function *f = &w->event->function[w->event->nfunction - 1];
        f->every = e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY;
        f->held = w->firing.fired[i] && !f->every;
        f->rested = f->held ? INFINITY : w->event->last[i];
        const int goes_on =
            w->result.count[PM_COUNT_PHASES] > 0 && w->result.count[PM_COUNT_JUMPS] == w->event->came_jumps;
        const int came = !f->held || w->firing.fired[i] == PM_FIRED_SHORT;
        f->left = goes_on && came && !f->every ? w->event->came[i] : 0;
    }
}

/* What is left of a friction that holds, either way: mu N - |F| has a corner where F changes its direction, and what it does beside
 * that would not be seen between samples. */
static void add_hold(const pm_phase *phase, pm_event_set *e, int kind, int index, double size)
{
    for (int sense = 1; sense >= -1; sense -= 2) {
        add(phase, e, kind, index, -1, PM_LEVEL_DYNAMIC, PM_FORCE_SLACK * size, size);
        e->function[e->nfunction - 1].sense = sense;
    }
}

static void add_gap(pm_workspace *w, int contact)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[e->nfunction];
    /* what others all but hold is left open, and sinks by a hair: each time it closes in vain it may sink by twice as much */
    add(&w->phase, w->event, FUNCTION_GAP, contact, -1, PM_LEVEL_KINEMATIC,
        ldexp(pm_contact_length(&w->frame), e->vain[contact]), w->numbers.size);
    const int beside_edge = pm_edge_is(w->model, contact),
              open_edge = beside_edge && pm_contact_is_open(w->model, &w->state, contact);
    f->below = (beside_edge && pm_edge_is_below(&w->frame, contact)) ||
               pm_contact_curve_is_below(&w->frame, &w->state, contact);
    f->over_end = open_edge && !f->below && pm_edge_is_over_end(&w->frame, contact);
    f->born =
        pm_contact_curve_is(w->model, contact) && pm_contact_curve_is_closed(w->model, &w->state, contact);
    if (pm_contact_is_pattern(w->model, contact)) f->pattern = e->npattern++;
    if (open_edge && !f->owned) f->edge = e->nedge++;
}

static void add_contacts(pm_workspace *w, double size)
{
    const pm_model *m = w->model;
    const double force = PM_FORCE_SLACK * size;
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        if (pm_state_is_absent(m, &w->state, PM_TABLE_CONTACT, i))
            continue;
        else if (pm_capture_is_meeting(m, i))
            add(&w->phase, w->event, FUNCTION_MEETING, i, 1, PM_LEVEL_KINEMATIC, 0,
                w->numbers.size * w->numbers.speed);
        else
            add_gap(w, i);
    for (int i = 0; i < m->nslot; i++) {
        const int mode = w->state.slot[i].mode;
        if (mode == PM_OPEN || mode == PM_CAPTURED) continue;
        for (int k = 0; k < pm_event_strands(m, i); k++)
            add(&w->phase, w->event, FUNCTION_STRAND, 2 * i + k, 1, PM_LEVEL_KINEMATIC, 0,
                w->numbers.size * w->numbers.speed);
        if (pm_event_wraps(&w->frame, i))
            add(&w->phase, w->event, FUNCTION_WRAP, i, -1, PM_LEVEL_KINEMATIC, PM_WRAP_NOTHING, 1);
        add(&w->phase, w->event, FUNCTION_NORMAL, i, -1, PM_LEVEL_DYNAMIC, force, size);
        if (mode == PM_STICK && pm_contact_friction(m, pm_contact_of_slot(m, i)) == PM_FRICTION_COULOMB)
            add_hold(&w->phase, w->event, FUNCTION_STICK, i, size);
        if (pm_edge_is(m, pm_contact_of_slot(m, i)) || pm_contact_curve_parts(m, pm_contact_of_slot(m, i)))
            add(&w->phase, w->event, FUNCTION_END, i, -1, PM_LEVEL_KINEMATIC, pm_contact_length(&w->frame),
                w->numbers.size);
        if (mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD)
            add(&w->phase, w->event, FUNCTION_SLIP, i, -1, PM_LEVEL_KINEMATIC, pm_contact_speed(&w->frame),
                w->numbers.speed);
    }
}

static void add_joint_friction(pm_workspace *w, double size)
{
    for (int i = 0; i < w->model->nfriction; i++) {
        if (w->state.friction[i] == PM_STICK)
            add_hold(&w->phase, w->event, FUNCTION_JOINT_STICK, i, size);
        else if (w->state.friction[i] != PM_OPEN)
            add(&w->phase, w->event, FUNCTION_JOINT_SLIP, i, -1, PM_LEVEL_KINEMATIC,
                pm_joint_friction_no_slip(&w->frame, i), w->numbers.speed);
    }
}

static void add_teeth(pm_workspace *w, double size)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++)
        if (pm_teeth_mesh(w->model, &w->state, i))
            add(&w->phase, w->event, FUNCTION_FLANK, i, -1, PM_LEVEL_DYNAMIC, PM_FORCE_SLACK * size, size);
}

/* How far a closed contact is from opening, or from slipping, N; of several that share their loads, how far all of them are. */
static double contact_stands(pm_workspace *w, const pm_event_function *f)
{
    const int normal = w->active.slot_normal[f->index], tangent = w->active.slot_tangent[f->index];
    double slack;
    if (w->active.nredundant > 0 && pm_shared_slack(w, f->index, &slack)) return slack;
    if (f->kind == FUNCTION_NORMAL) return normal < 0 ? w->numbers.size : w->frame.lambda[normal];
    if (normal < 0 || tangent < 0) return 1;
    const double mu = pm_contact_static(&w->frame, pm_contact_of_slot(w->model, f->index));
    return mu * w->frame.lambda[normal] - f->sense * w->frame.lambda[tangent];
}

/* The nearest member of an open contact is noted. */
static double sample_gap(const pm_workspace *w, const pm_event_function *f, int *member)
{
    const double gap = pm_contact_gap(&w->frame, &w->state, f->index, member);
    if (isinf(gap)) return w->numbers.size; /* nothing left to close */
    if (f->over_end) return pm_edge_gap_over_end(&w->frame, f->index);
    if (!f->below) return gap + f->sunk;
    return pm_edge_is(w->model, f->index) ? pm_edge_gap_from_below(&w->frame, f->index)
                                          : pm_contact_curve_gap_from_below(&w->frame, &w->state, f->index);
}

static double room_of(const pm_workspace *w, int slot)
{
    const int contact = pm_contact_of_slot(w->model, slot), member = w->state.slot[slot].member;
    return pm_edge_is(w->model, contact) ? pm_edge_room(&w->frame, &w->state, contact, member)
                                         : pm_contact_curve_room(&w->frame, slot, member);
}

double pm_event_sample(pm_workspace *w, const pm_event_function *f)
{
    const pm_slot *slot = w->state.slot;
    int member;
    switch (f->kind) {
    case FUNCTION_GAP: return sample_gap(w, f, &member);
    case FUNCTION_NORMAL:
    case FUNCTION_STICK: return contact_stands(w, f);
    case FUNCTION_SLIP: {
        const double slip =
            pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, f->index), slot[f->index].member);
        return slot[f->index].mode == PM_SLIDE_FORWARD ? slip : -slip;
    }
    case FUNCTION_MEETING: /* a pair that is not open meets no more */
        return isinf(pm_contact_gap(&w->frame, &w->state, f->index, &member))
                   ? w->numbers.size * w->numbers.speed
                   : pm_capture_approach(&w->frame, f->index);
    case FUNCTION_END: return room_of(w, f->index);
    case FUNCTION_FLANK: return pm_teeth_pressed(w, f->index);
    case FUNCTION_TRACK: return pm_track_left(&w->frame, f->index);
    case FUNCTION_WRAP: return pm_event_wrap(&w->frame, f->index);
    case FUNCTION_STRAND: return pm_event_strand_approach(&w->frame, f->index);
    case FUNCTION_JOINT_STICK:
        if (w->active.friction_constraint[f->index] < 0) return 1; /* something else holds it, too */
        return pm_joint_friction_limit(w, f->index) -
               f->sense * w->frame.lambda[w->active.friction_constraint[f->index]];
    case FUNCTION_JOINT_SLIP:
        return w->state.friction[f->index] == PM_SLIDE_FORWARD ? pm_joint_friction_slip(&w->frame, f->index)
                                                               : -pm_joint_friction_slip(&w->frame, f->index);
    default: return pm_trigger_program(w, f->index);
    }
}

int pm_event_owner(const pm_model *m, const pm_event_function *f, int32_t *row)
{
    switch (f->kind) {
    case FUNCTION_TRIGGER: return *row = PM_TRIGGER_ROW(m, f->index)[PM_TRIGGER_EVENT], PM_TABLE_EVENT;
    case FUNCTION_JOINT_STICK:
    case FUNCTION_JOINT_SLIP: return *row = m->friction_force[f->index], PM_TABLE_FORCE;
    case FUNCTION_FLANK:
    case FUNCTION_TRACK: return *row = f->index, PM_TABLE_JOINT;
    case FUNCTION_GAP:
    case FUNCTION_MEETING: return *row = f->index, PM_TABLE_CONTACT;
    case FUNCTION_STRAND: return *row = pm_contact_of_slot(m, f->index / 2), PM_TABLE_CONTACT;
    default: return *row = pm_contact_of_slot(m, f->index), PM_TABLE_CONTACT;
    }
}

double pm_event_of_sample(const pm_event_function *f, double sample)
{
    return f->every ? sample - f->multiple : sample;
}

double pm_event_value(pm_workspace *w, const pm_event_function *f)
{
    return pm_event_of_sample(f, pm_event_sample(w, f));
}

/* The nearest open member of a touching contact moves away with a definite speed: it may come back at once. */
static int leaves(const pm_frame *frame, int contact, int member)
{
    double rate;
    pm_contact_member_gap(frame, contact, member, &rate);
    return rate > pm_contact_speed(frame);
}

double pm_event_value_at(pm_workspace *w, const pm_event_function *f, const pm_state *s)
{
    pm_frame_look(&w->frame, s->t, s->q, s->v, s->z, w->state.memory);
    if (f->level == PM_LEVEL_DYNAMIC && pm_saddle_accelerate(w)) return NAN;
    return pm_event_value(w, f);
}

/* The samples of what rests are rounding, and those of a short step are small: the natural size of a trigger tells what is zero. */
void pm_event_hold_on_zero(pm_workspace *w)
{
    for (int i = 0; i < w->event->ntrigger; i++) {
        pm_event_function *f = &w->event->function[i];
        if (f->every) continue; /* on which multiple it is is known (event_multiple.h) */
        const double now = pm_event_value_at(w, f, &w->state), part = pm_case_shift(w, &w->probe);
        const double natural = fabs(pm_event_value_at(w, f, &w->probe) - now) / part;
        f->slack = isfinite(natural) ? PM_EVENT_ON_ZERO * natural : 0;
        f->held |= fabs(now) <= f->slack;
    }
}

/* What parts goes up from where it is, though that be too deep by what touching allows, and by where others have come to rest: from
 * below zero a short bounce would not be seen. */
static void leave_from(const pm_workspace *w, pm_event_function *f, double value)
{
    f->slack = PM_GAP_ROUNDING * pm_contact_reach(w);
    if (f->pattern != PM_NONE) return;
    if (value < -f->slack && value >= -PM_EDGE_SUNK * pm_contact_length(&w->frame)) f->sunk = -value;
}

void pm_event_begin(pm_workspace *w)
{
    pm_event_set *e = w->event;
    e->nfunction = e->nsampled = e->npattern = e->nedge = 0;
    e->level = PM_LEVEL_KINEMATIC;
    add_triggers(w);
    e->ntrigger = e->nfunction;
    const double force = pm_case_force(w->model, &w->numbers);
    add_contacts(w, force);
    add_joint_friction(w, force);
    if (w->model->nteeth > 0) add_teeth(w, force);
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++)
        if (pm_track_ends(w, i))
            add(&w->phase, w->event, FUNCTION_TRACK, i, -1, PM_LEVEL_KINEMATIC, pm_contact_length(&w->frame),
                w->numbers.size);
    e->first_step = 1;
    if (e->nsampled > 0) pm_gap_culling_begin(&w->event->culling, &w->frame);
    memset(e->spent, 0, (size_t)w->model->rows[PM_TABLE_CONTACT]);
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        /* of what the route finds itself only the log of decisions wants to know how it begins */
        if (pm_event_changes_sign(f) || (f->owned && !w->evidence.active)) continue;
        const int gap = f->kind == FUNCTION_GAP;
        int member;
        const double value = gap ? sample_gap(w, f, &member) : pm_event_value(w, f);
        if (value > f->slack) continue;
        f->held = 1;
        if (gap && leaves(&w->frame, f->index, member)) leave_from(w, f, value);
    }
    memset(w->firing.fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

int pm_event_check_unique(pm_workspace *w)
{
    if (!pm_shared_matters(w)) return PM_OK;
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if (f->kind != FUNCTION_TRIGGER) continue;
        const int program = PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_PROGRAM];
        if (program != PM_NONE && !pm_shared_is_unique(w, program))
            return pm_fail(&w->result, PM_NOT_UNIQUE, PM_TABLE_TRIGGER, f->index, NAN, NAN);
    }
    return PM_OK;
}
