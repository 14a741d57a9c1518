/* event.c - finds and locates what ends a phase.
 *
 * Every function of the phase is sampled at PM_NODES places of each step.  A change of sign between two nodes, or a dip
 * between three that goes through zero, is bracketed, located on the route's dense output, and then polished on exact
 * states, so that an event is as accurate as the trajectory and never only as good as an interpolant. */
#include "event.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "active.h"
#include "ask.h"
#include "audit.h"
#include "body.h"
#include "contact.h"
#include "program.h"
#include "root.h"
#include "route.h"
#include "saddle.h"
#include "trace.h"

enum pm_function_kind { FUNCTION_TRIGGER, FUNCTION_GAP, FUNCTION_NORMAL, FUNCTION_GRIP, FUNCTION_SLIP };

#define ON_ZERO 1e-12   /* of a function's greatest size in the step: zero when the phase begins */
#define SAME_TIME 1e-11 /* of a step: events closer than this are one instant */
#define HALVINGS 30     /* of a step, to find the top of a short bounce */
#define LEAVING \
    20 /* halvings of a step: a trigger has left its zero at the first place where it is seen off it */
#define POSITION_ROUNDING 4e-15 /* of how far bodies are from the origin */
#define FORCE_SLACK 1e-10       /* of the scene's weight-like force */

/* ---- memory ---- */
int pm_event_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t ntrigger = (size_t)m->rows[PM_TABLE_TRIGGER], nevent = (size_t)m->rows[PM_TABLE_EVENT];
    const size_t most = ntrigger + (size_t)m->rows[PM_TABLE_CONTACT] + 3 * (size_t)m->nslot;
    pm_event_set *e = w->event = calloc(1, sizeof *e);
    if (!e) return PM_NO_MEMORY;
    e->most = (int)most;
    e->function = calloc(most + 1, sizeof *e->function);
    e->value = calloc(PM_NODES * (most + 1) + ntrigger + nevent, sizeof(double));
    e->hit = calloc(2 * (most + 1), sizeof(int));
    e->count = calloc(nevent + 1, sizeof *e->count);
    e->fired = calloc(ntrigger + (size_t)m->rows[PM_TABLE_CONTACT] + 1, 1);
    e->solver = pm_root_create();
    if (!e->function || !e->value || !e->hit || !e->count || !e->fired || !e->solver) return PM_NO_MEMORY;
    e->spent = e->fired + ntrigger;
    e->root = e->hit + most + 1;
    e->before = e->value + PM_NODES * (most + 1);
    e->time = e->before + ntrigger;
    return PM_OK;
}

void pm_event_free(pm_workspace *w)
{
    pm_event_set *e = w->event;
    if (!e) return;
    free(e->function);
    free(e->value);
    free(e->hit);
    free(e->count);
    free(e->fired);
    pm_root_free(e->solver);
    free(e);
    w->event = NULL;
}

void pm_event_reset(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < w->model->rows[PM_TABLE_EVENT]; i++) {
        e->count[i] = 0;
        e->time[i] = NAN;
    }
    memset(e->fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

double pm_event_count(const pm_workspace *w, int event) { return (double)w->event->count[event]; }
double pm_event_time(const pm_workspace *w, int event) { return w->event->time[event]; }

/* ---- the functions of a phase ---- */
static void add(pm_workspace *w, int kind, int index, int direction, int level, double slack)
{
    pm_event_set *e = w->event;
    e->function[e->nfunction++] = (pm_event_function){
        .kind = kind, .index = index, .direction = direction, .level = level, .slack = slack};
    if (level > e->level) e->level = level;
}

static double trigger_program(pm_workspace *w, int trigger)
{
    return pm_program_run(w->model, PM_TRIGGER_ROW(w->model, trigger)[PM_TRIGGER_PROGRAM], w->param, w->value,
                          w);
}

static void add_triggers(pm_workspace *w)
{
    static const int direction[] = {
        [PM_TRIGGER_CROSS] = 0, [PM_TRIGGER_RISE] = 1, [PM_TRIGGER_FALL] = -1, [PM_TRIGGER_EVERY] = -1};
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        if (e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY) continue;
        add(w, FUNCTION_TRIGGER, i, direction[e[PM_TRIGGER_KIND]],
            w->model->program_level[e[PM_TRIGGER_PROGRAM]], 0);
        w->event->function[w->event->nfunction - 1].held = w->event->fired[i];
    }
}

static double force_scale(const pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++)
        sum += w->mass[i] * (hypot(w->gravity[0], w->gravity[1]) + w->speed * w->speed / w->size);
    return sum;
}

static void add_contacts(pm_workspace *w)
{
    const pm_model *m = w->model;
    const double force = FORCE_SLACK * force_scale(w);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++)
        add(w, FUNCTION_GAP, i, -1, PM_LEVEL_KINEMATIC, pm_contact_length(w));
    for (int i = 0; i < m->nslot; i++) {
        const int mode = w->state.slot[i].mode;
        if (mode == PM_OPEN) continue;
        add(w, FUNCTION_NORMAL, i, -1, PM_LEVEL_DYNAMIC, force);
        if (mode == PM_STICK && pm_contact_friction(m, pm_contact_of_slot(m, i)) == PM_FRICTION_COULOMB)
            add(w, FUNCTION_GRIP, i, -1, PM_LEVEL_DYNAMIC, force);
        if (mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD)
            add(w, FUNCTION_SLIP, i, -1, PM_LEVEL_KINEMATIC, pm_contact_speed(w));
    }
}

static double evaluate(pm_workspace *w, const pm_event_function *f)
{
    const pm_slot *slot = w->state.slot;
    int member;
    switch (f->kind) {
    case FUNCTION_GAP: {
        const double gap = pm_contact_gap(w, &w->state, f->index, &member);
        return isinf(gap) ? w->size : gap; /* nothing left to close */
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
    default: {
        const double p = trigger_program(w, f->index);
        const int every = PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY;
        return every ? (p - f->low) * (f->high - p) : p;
    }
    }
}

void pm_event_values(pm_workspace *w, double *value)
{
    for (int i = 0; i < w->event->nfunction; i++) value[i] = evaluate(w, &w->event->function[i]);
}

/* `every`: the multiples next to where the step begins; the one that holds must first be left. */
static void set_multiples(pm_workspace *w)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        pm_event_function *f = &w->event->function[i];
        if (f->kind != FUNCTION_TRIGGER ||
            PM_TRIGGER_ROW(w->model, f->index)[PM_TRIGGER_KIND] != PM_TRIGGER_EVERY)
            continue;
        const double p = trigger_program(w, f->index), nearest = round(p);
        const int holds = fabs(p - nearest) <= 1e-9 * fmax(1, fabs(p));
        f->low = holds ? nearest - 1 : floor(p);
        f->high = holds ? nearest + 1 : floor(p) + 1;
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
    e->nfunction = 0;
    e->level = PM_LEVEL_KINEMATIC;
    add_triggers(w);
    add_contacts(w);
    e->first_step = 1;
    memset(e->spent, 0, (size_t)w->model->rows[PM_TABLE_CONTACT]);
    set_multiples(w);
    pm_event_values(w, e->value);
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        if (f->kind == FUNCTION_TRIGGER || e->value[i] > f->slack) continue;
        f->held = 1;
        if (f->kind == FUNCTION_GAP && leaves(w, f->index))
            f->slack = POSITION_ROUNDING * pm_contact_reach(w);
    }
    memset(e->fired, 0, (size_t)w->model->rows[PM_TABLE_TRIGGER]);
}

/* ---- one step ---- */
static int look(pm_workspace *w, double t, int level)
{
    int status = PM_OK;
    const pm_state *s = &w->state;
    if (t != w->state.t) {
        status = w->route->at(w, t, &w->probe);
        s = &w->probe;
    }
    if (status) return status;
    pm_frame_look(w, s->t, s->q, s->v, s->z, w->state.memory);
    return level == PM_LEVEL_DYNAMIC ? pm_saddle_accelerate(w) : PM_OK;
}

static double node_time(const pm_workspace *w, int node)
{
    return node == PM_NODES - 1 ? w->step_end
                                : w->step_begin + (w->step_end - w->step_begin) * node / (PM_NODES - 1);
}

/* Samples functions and watched asks at all nodes of the step [step_begin, step_end] (state at its end). */
static int sample(pm_workspace *w, int with_functions)
{
    pm_event_set *e = w->event;
    const int functions = with_functions && e->nfunction > 0;
    const int watched = w->ask->nobserver > 0;
    if (!functions && !watched) return PM_OK;
    int level = PM_LEVEL_KINEMATIC;
    if (functions && e->level > level) level = e->level;
    if (watched && w->ask->level > level) level = w->ask->level;
    for (int i = 0; i < PM_NODES; i++) {
        const int status = look(w, node_time(w, i), level);
        if (status) return status;
        if (functions) pm_event_values(w, e->value + i * e->nfunction);
        if (watched) pm_ask_sample(w, i);
    }
    return PM_OK;
}

static double along(pm_workspace *w, double t, void *context)
{
    const pm_event_function *f = context;
    if (look(w, t, f->level)) return NAN;
    return evaluate(w, f);
}

/* Sign with which function i enters the interval after node k: a held zero has none yet. */
static int crosses(const pm_event_function *f, double a, double b)
{
    if (isnan(a) || isnan(b)) return 0;
    if (f->direction <= 0 && a > 0 && b <= 0) return 1;
    if (f->direction >= 0 && a < 0 && b >= 0) return 1;
    return 0;
}

/* A dip of three nodes towards zero: the vertex of their parabola, if the function goes through zero there. */
static int dips(pm_workspace *w, const pm_event_function *f, const double *g, const double *t, double *where,
                double *value)
{
    const double s = g[1] > 0 ? 1 : -1, a = s * g[0], b = s * g[1], c = s * g[2];
    if (!(b < a && b < c) || !(a > 0 && b > 0 && c > 0)) return 0;
    if ((f->direction > 0 && s > 0) || (f->direction < 0 && s < 0)) return 0;
    const double bend = a - 2 * b + c, shift = 0.5 * (a - c) / bend,
                 low = b - 0.125 * (a - c) * (a - c) / bend;
    if (low > 0.1 * b) return 0;
    *where = t[1] + shift * (t[2] - t[1]);
    *value = along(w, *where, (void *)(uintptr_t)f);
    return s * *value <= 0;
}

typedef struct pm_bracket {
    double a, b, ga, gb;
} pm_bracket;

/* A function held at zero is negative at b: it has gone up and come back (a short bounce), or it went the wrong way at
 * once and the event is now. */
static int leaves_and_returns(pm_workspace *w, const pm_event_function *f, double a, double b, double gb,
                              pm_bracket *x)
{
    *x = (pm_bracket){a, a, 0, 0};
    for (int i = 0; i < HALVINGS; i++) {
        const double t = 0.5 * (a + b), g = along(w, t, (void *)(uintptr_t)f);
        if (t <= a) break;
        if (g > 0) {
            *x = (pm_bracket){t, b, g, gb};
            break;
        }
        b = t;
        gb = g;
    }
    if (f->kind == FUNCTION_GAP && x->a == x->b) w->event->spent[f->index] = 1;
    return 1;
}

/* A trigger that was on zero at a: where it has definitely left tells its side; it may have come back before b. */
static int leaves_and_crosses(pm_workspace *w, const pm_event_function *f, double a, double b, double gb,
                              double noise, pm_bracket *x)
{
    for (int i = LEAVING; i > 0; i--) {
        const double t = a + ldexp(b - a, -i), g = along(w, t, (void *)(uintptr_t)f);
        if (t <= a || !(fabs(g) > noise)) continue;
        *x = (pm_bracket){t, b, g, gb};
        return crosses(f, g, gb);
    }
    return 0;
}

/* The first bracket of function i in the step, if any. */
static int bracket(pm_workspace *w, int i, pm_bracket *x)
{
    pm_event_set *e = w->event;
    pm_event_function *f = &e->function[i];
    double g[PM_NODES], t[PM_NODES], biggest = 0;
    for (int k = 0; k < PM_NODES; k++) {
        g[k] = e->value[k * e->nfunction + i];
        t[k] = node_time(w, k);
        biggest = fmax(biggest, fabs(g[k]));
    }
    int first = 0;
    if (e->first_step && f->kind == FUNCTION_TRIGGER && fabs(g[0]) <= ON_ZERO * biggest) f->held = 1;
    if (f->held && f->kind == FUNCTION_TRIGGER) { /* enters on the side where it goes */
        if (leaves_and_crosses(w, f, t[0], t[1], g[1], ON_ZERO * biggest, x)) return 1;
        first = 1;
    } else if (
        f->held) { /* a contact starts on the open side; it counts again from where it has left its zero */
        for (first = 1; first < PM_NODES && fabs(g[first]) <= f->slack;) first++;
        if (first == PM_NODES) return 0;
        if (g[first] < 0) return leaves_and_returns(w, f, t[first - 1], t[first], g[first], x);
    } else if (f->kind != FUNCTION_TRIGGER && g[0] <= 0) { /* the last step ended on its zero */
        *x = (pm_bracket){t[0], t[0], 0, 0};
        return 1;
    }
    if (fabs(g[PM_NODES - 1]) > f->slack) f->held = 0;
    for (int k = first; k + 1 < PM_NODES; k++) {
        double where, value;
        if (crosses(f, g[k], g[k + 1])) {
            *x = (pm_bracket){t[k], t[k + 1], g[k], g[k + 1]};
            return 1;
        }
        if (k + 2 < PM_NODES && dips(w, f, g + k, t + k, &where, &value)) {
            *x = (pm_bracket){t[k], where, g[k], value};
            return 1;
        }
    }
    return 0;
}

static int exactly(pm_workspace *w, double t, void *context, double *value)
{
    const pm_event_function *f = context;
    const pm_state *s = &w->probe;
    int status = w->route->exact(w, t, &w->probe);
    if (status) return status;
    pm_frame_look(w, s->t, s->q, s->v, s->z, w->state.memory);
    if (f->level == PM_LEVEL_DYNAMIC) status = pm_saddle_accelerate(w);
    *value = evaluate(w, f);
    return status;
}

/* Locates all functions that fire in the step; *first the earliest time, *taken where w->probe holds an exact state. */
static int locate(pm_workspace *w, double *first, double *taken)
{
    pm_event_set *e = w->event;
    const double h = w->step_end - w->step_begin;
    int earliest = PM_NONE;
    *first = INFINITY;
    for (int i = 0; i < e->nfunction; i++) {
        pm_bracket x;
        double t;
        e->hit[i] = 0;
        if (!bracket(w, i, &x)) continue;
        if (x.a > *first) continue; /* cannot be the first */
        int status = PM_OK;
        t = x.a;
        if (x.b > x.a) status = pm_root_find(w, e->solver, along, &e->function[i], x.a, x.ga, x.b, x.gb, &t);
        if (status) return status;
        if (t < *first - SAME_TIME * h)
            for (int k = 0; k < i; k++) e->hit[k] = 0;
        if (t > *first + SAME_TIME * h) continue;
        e->hit[i] = 1;
        if (t < *first) {
            *first = t;
            earliest = i;
        }
    }
    if (earliest == PM_NONE || *first <= w->step_begin) return PM_OK;
    return pm_root_polish(w, along, exactly, &e->function[earliest], first, taken);
}

/* Shortens the step to end at t, with the exact state there (already in w->probe if it was taken at t). */
static int stop_at(pm_workspace *w, double t, double taken)
{
    const int status = taken == t ? PM_OK : w->route->exact(w, t, &w->probe);
    if (status) return status;
    pm_state_copy(&w->state, &w->probe);
    w->state.t = t;
    w->step_end = t;
    return PM_OK;
}

/* A route with its own root finding has ended its step at the root. */
static void take_roots(pm_workspace *w, double *first)
{
    pm_event_set *e = w->event;
    int any = 0;
    for (int i = 0; i < e->nfunction; i++) {
        e->hit[i] = e->root[i] != 0;
        any |= e->hit[i];
    }
    *first = any ? w->step_end : INFINITY;
}

static void mark_hits(pm_workspace *w)
{
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_TRIGGER) e->fired[e->function[i].index] = 1;
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
    w->event->first_step = 0;
}

int pm_event_advance(pm_workspace *w, int *happened)
{
    pm_event_set *e = w->event;
    const double max_time = w->value[PM_SETTING(w->model, PM_SETTING_MAX_TIME)];
    *happened = 0;
    for (;;) {
        double first = INFINITY, taken = NAN;
        int status = limit_reached(w, max_time);
        if (status) return status;
        memset(e->root, 0, (size_t)e->nfunction * sizeof(int));
        if (!e->first_step) {
            pm_frame_look_state(w, &w->state);
            set_multiples(w);
        }
        status = w->route->step(w, max_time);
        if (!status) status = sample(w, !w->route->finds_roots);
        if (!status && w->route->finds_roots) take_roots(w, &first);
        if (!status && !w->route->finds_roots) status = locate(w, &first, &taken);
        if (status) return status;
        if (first < INFINITY && first < w->step_end) {
            if ((status = stop_at(w, first, taken)) || (status = sample(w, 0))) return status;
        }
        if (w->step_end > w->step_begin && (status = pm_ask_step(w))) return status;
        end_step(w);
        if (first < INFINITY) {
            mark_hits(w);
            *happened = 1;
            return PM_OK;
        }
        if (w->trace && (status = pm_trace_row(w, 0))) return status;
    }
}

/* ---- instants ---- */
void pm_event_look_before(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_KIND] <= PM_TRIGGER_FALL)
            w->event->before[i] = trigger_program(w, i);
}

void pm_event_look_after(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int kind = PM_TRIGGER_ROW(w->model, i)[PM_TRIGGER_KIND];
        if (kind > PM_TRIGGER_FALL || w->event->fired[i]) continue;
        const double before = w->event->before[i], after = trigger_program(w, i);
        const int rises = before < 0 && after > 0, falls = before > 0 && after < 0;
        w->event->fired[i] =
            (unsigned char)((rises && kind != PM_TRIGGER_FALL) || (falls && kind != PM_TRIGGER_RISE));
    }
}

void pm_event_mark(pm_workspace *w, int kind, int a)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        if (e[PM_TRIGGER_KIND] == kind && (kind == PM_TRIGGER_START || e[PM_TRIGGER_A] == a))
            w->event->fired[i] = 1;
    }
}

/* The marks stay until the next phase has begun: they tell which triggers start on zero. */
int pm_event_commit(pm_workspace *w)
{
    const pm_model *m = w->model;
    int n = 0;
    for (int event = 0; event < m->rows[PM_TABLE_EVENT]; event++) {
        int fires = 0;
        for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
            fires |= w->event->fired[i] && PM_TRIGGER_ROW(m, i)[PM_TRIGGER_EVENT] == event;
        if (!fires) continue;
        w->event->count[event]++;
        w->event->time[event] = w->state.t;
        pm_ask_fired(w, event);
        n++;
    }
    return n;
}

int pm_event_until(const pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int group = PM_UNTIL_ROW(m, i)[PM_UNTIL_GROUP];
        int all = 1;
        for (int k = 0; k < m->rows[PM_TABLE_UNTIL]; k++) {
            const int32_t *e = PM_UNTIL_ROW(m, k);
            if (e[PM_UNTIL_GROUP] == group && w->event->count[e[PM_UNTIL_EVENT]] < e[PM_UNTIL_NTH]) all = 0;
        }
        if (all) return 1;
    }
    return 0;
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
