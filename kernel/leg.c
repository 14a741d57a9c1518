/* leg.c - legs that repeat.
 *
 * A leg is a path phase and the instant that ends it.  If the next one begins like it - the same modes, the same
 * configuration but for a shift that the scene does not notice (symmetry.c), velocities in the same proportion - then its
 * path, its blow and its marks are the same, and its kinetic energies follow:
 *
 *   T_end = T + W,   T_next = m T_end      W the work on the leg, m the blow's ratio: neither depends on the speed
 *
 * At every place velocities go by sqrt(T) and forces of contacts linearly by T (growth.c).  So what did not happen in the
 * leg that was computed and does not happen in the last one, which is computed too, does not happen between; extremes lie
 * in these two.  Only the least kinetic energy, that of the barrier on the way, is looked at leg by leg.  If the last leg
 * ends otherwise after all, the legs are given back and fewer are tried.
 *
 * A path without blows that closes on itself is a leg as well: a lap. */
#include "leg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "active.h"
#include "ask.h"
#include "audit.h"
#include "body.h"
#include "case.h"
#include "contact.h"
#include "event.h"
#include "leg_replay.h"
#include "nature.h"
#include "path.h"
#include "symmetry.h"
#include "trigger.h"

#define TURN (2 * 3.14159265358979323846)
#define SAME_PLACE 1e-11  /* of the scene's reach: the same configuration */
#define SAME_MOTION 1e-9  /* of the scene's speed: velocities in the same proportion */
#define SAME_ENERGY 1e-13 /* a lap without gain or loss */
#define STEADY 1e-16      /* of the energy: legs that are all the same */
#define BARRIER 1e-6      /* of the leg's energies: so near to the barrier a leg is computed */
#define WHOLE 1e-9        /* of a multiple */
#define ROUNDINGS 1e-15   /* of the energies, in a blow and on the leg after it */
#define MOST_LEGS 100000000

/* What legs that were passed over may have to be given back to. */
typedef struct pm_saved {
    pm_state begin, before;      /* of the first leg passed over, and of the leg before it */
    double kinetic, end, lowest; /* of the leg before */
    int end_kind, end_mark;
    double energy_lost, energy_scale, momentum_scale, constraint_worst, evidence, speed, error;
    int64_t count[PM_COUNT_COLUMNS], count_before[PM_COUNT_COLUMNS];
    int64_t *event_count, *event_before;
    double *event_time, *out, *ask;
    double *range; /* least and greatest of the triggers in the leg before */
    unsigned char *ask_flags;
} pm_saved;

typedef struct pm_leg {
    int known;                                     /* `begin` is the begin of the last leg */
    pm_state begin;                                /* of the last leg */
    double kinetic;                                /* T there */
    double before;                                 /* T at its end, before the blow */
    double lowest;                                 /* least T on it */
    double end;                                    /* place in the step at which it ended */
    int64_t steps;                                 /* of which it consisted */
    int end_kind, end_mark;                        /* what ended it: kind of function, contact */
    int64_t count[PM_COUNT_COLUMNS], *event_count; /* at its begin */
    /* from one leg to the next */
    double by[2], *turn;
    int member;
    double work, ratio;
    /* legs passed over and not yet confirmed by the one that is computed */
    int64_t pending, most;
    int expected_kind, expected_mark;
    pm_saved saved;
    void *block;
} pm_leg;

/* ---- memory ---- */
static size_t ask_flags(const pm_workspace *w) { return (size_t)w->model->nask + (size_t)w->model->nout; }

/* Least and greatest values of the triggers lie together. */
static size_t range_doubles(const pm_workspace *w) { return 2 * (size_t)w->model->rows[PM_TABLE_TRIGGER]; }

int pm_leg_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    const size_t nevent = (size_t)m->rows[PM_TABLE_EVENT], nout = (size_t)m->nout;
    const size_t ntrigger = (size_t)m->rows[PM_TABLE_TRIGGER];
    pm_leg *l = w->leg = calloc(1, sizeof *l);
    if (!l) return PM_NO_MEMORY;
    int status = pm_state_create(m, &l->begin);
    if (!status) status = pm_state_create(m, &l->saved.begin);
    if (!status) status = pm_state_create(m, &l->saved.before);
    const size_t doubles = (size_t)m->nbody + nevent + nout + pm_ask_numbers(w->model) + 2 * ntrigger;
    double *p = l->block = calloc(doubles * sizeof *p + 3 * nevent * sizeof(int64_t) + ask_flags(w) + 1, 1);
    if (status || !p) return PM_NO_MEMORY;
    l->turn = p;
    l->saved.event_time = l->turn + m->nbody;
    l->saved.out = l->saved.event_time + nevent;
    l->saved.ask = l->saved.out + nout;
    l->saved.range = l->saved.ask + pm_ask_numbers(w->model);
    l->event_count = (int64_t *)(void *)(p + doubles);
    l->saved.event_count = l->event_count + nevent;
    l->saved.event_before = l->saved.event_count + nevent;
    l->saved.ask_flags = (unsigned char *)(l->saved.event_before + nevent);
    return PM_OK;
}

void pm_leg_free(pm_workspace *w)
{
    if (!w->leg) return;
    pm_state_free(&w->leg->begin);
    pm_state_free(&w->leg->saved.begin);
    pm_state_free(&w->leg->saved.before);
    free(w->leg->block);
    free(w->leg);
    w->leg = NULL;
}

void pm_leg_forget(pm_workspace *w)
{
    w->leg->known = 0;
    w->leg->pending = 0;
    w->leg->most = MOST_LEGS;
}

static void remember(pm_workspace *w)
{
    pm_leg *l = w->leg;
    pm_state_copy(&l->begin, &w->state);
    l->kinetic = pm_body_kinetic(w, PM_NONE);
    l->before = l->kinetic;
    l->end_kind = l->end_mark = PM_NONE;
    memcpy(l->count, w->count, sizeof l->count);
    memcpy(l->event_count, w->event->count, (size_t)w->model->rows[PM_TABLE_EVENT] * sizeof *l->event_count);
    l->known = 1;
}

/* ---- does the phase begin like the last leg? ---- */
/* The contacts are closed in the same modes, each with a member that is as many further on; or with none at all. */
static int same_modes(pm_workspace *w)
{
    const pm_model *m = w->model;
    const pm_slot *then = w->leg->begin.slot, *now = w->state.slot;
    int found = 0, member = 0;
    for (int c = 0; c < m->rows[PM_TABLE_CONTACT]; c++) {
        const int first = m->contact_slot[c], n = pm_contact_slots(m, c);
        int a = PM_NONE, b = PM_NONE, na = 0, nb = 0;
        for (int i = first; i < first + n; i++) {
            if (then[i].mode != PM_OPEN) a = i, na++;
            if (now[i].mode != PM_OPEN) b = i, nb++;
        }
        if (na != nb || na > 1) return 0; /* several members closed at once: not looked into */
        if (na == 0) continue;
        if (then[a].mode != now[b].mode) return 0;
        if (PM_CONTACT_ROW_OF(m, c)[PM_CONTACT_KIND] != PM_CONTACT_ROW) continue;
        const int step = now[b].member - then[a].member;
        if (found && step != member) return 0;
        found = 1;
        member = step;
    }
    w->leg->member = member;
    return 1;
}

/* The way that goes with the members, or, where none is passed, that of the first body; 0 if rows of several steps, or
 * moving ones, are in touch. */
static int find_way(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_leg *l = w->leg;
    int found = 0;
    l->by[0] = l->by[1] = 0;
    if (l->member == 0) {
        for (int k = 0; k < 2; k++) l->by[k] = w->state.q[k] - l->begin.q[k];
        if (fmax(fabs(l->by[0]), fabs(l->by[1])) <= SAME_PLACE * pm_contact_reach(w)) l->by[0] = l->by[1] = 0;
        return 1;
    }
    for (int c = 0; c < m->rows[PM_TABLE_CONTACT]; c++) {
        const int32_t *e = PM_CONTACT_ROW_OF(m, c);
        if (e[PM_CONTACT_KIND] != PM_CONTACT_ROW) continue;
        const int32_t *row = PM_ROW_ROW(m, e[PM_CONTACT_B]);
        if (PM_POINT_ROW(m, row[PM_ROW_POINT])[PM_POINT_BODY] != PM_GROUND) return 0;
        const double x = l->member * w->value[row[PM_ROW_STEP_X]],
                     y = l->member * w->value[row[PM_ROW_STEP_Y]];
        if (found && (x != l->by[0] || y != l->by[1])) return 0;
        found = 1;
        l->by[0] = x;
        l->by[1] = y;
    }
    return found;
}

static int same_place_and_motion(pm_workspace *w, double kinetic)
{
    pm_leg *l = w->leg;
    const double place = SAME_PLACE * pm_contact_reach(w), motion = SAME_MOTION * w->speed;
    const double faster = l->kinetic > 0 ? sqrt(kinetic / l->kinetic) : 0;
    for (int i = 0; i < w->model->nbody; i++) {
        const double *q = w->state.q + 3 * i, *v = w->state.v + 3 * i;
        const double *q0 = l->begin.q + 3 * i, *v0 = l->begin.v + 3 * i;
        for (int k = 0; k < 2; k++) {
            if (fabs(q[k] - q0[k] - l->by[k]) > place) return 0;
            if (fabs(v[k] - faster * v0[k]) > motion) return 0;
        }
        if (fabs(v[2] - faster * v0[2]) * w->size > motion) return 0;
        l->turn[i] = q[2] - q0[2];
        const double turns = l->turn[i] / TURN;
        if (fabs(turns - round(turns)) <= SAME_PLACE * fmax(1, fabs(turns))) l->turn[i] = TURN * round(turns);
    }
    return 1;
}

/* ---- who may notice legs passed over, and how many may be ---- */
static int64_t fewer(int64_t most, double legs)
{
    return legs < (double)most ? (int64_t)fmax(legs, 0) : most;
}

static int64_t fires(const pm_workspace *w, int event)
{
    return w->event->count[event] - w->leg->event_count[event];
}

/* On which side of its zero a trigger was in the whole phase; 0: on both.  range: its least values, then its greatest. */
static int side_of(const pm_workspace *w, int trigger, const double *range)
{
    return range[trigger] > 0 ? 1 : range[w->model->rows[PM_TABLE_TRIGGER] + trigger] < 0 ? -1 : 0;
}

/* A trigger that moves with the legs towards its zero must stay off it. */
static int64_t until_zero(const pm_workspace *w, int trigger, double change)
{
    const double low = w->event->least[trigger], high = w->event->greatest[trigger], spread = high - low;
    if (low > 0 && change > 0) return MOST_LEGS;
    if (high < 0 && change < 0) return MOST_LEGS;
    const double room = low > 0 ? low : high < 0 ? -high : 0;
    return fewer(MOST_LEGS, floor((room - spread) / fabs(change)) - 1);
}

static int64_t triggers_allow(pm_workspace *w, const pm_shift *shift, double time)
{
    const pm_model *m = w->model;
    int64_t most = MOST_LEGS;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        double change;
        if (e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY) continue;
        if (pm_trigger_on_time(w, i)) {
            const double due = pm_trigger_due(w, i);
            if (isfinite(due)) most = fewer(most, time > 0 ? floor((due - w->state.t) / time) - 1 : 0);
            continue;
        }
        const int growth = m->program_growth[e[PM_TRIGGER_PROGRAM]];
        if (!pm_symmetry_program(w, shift, e[PM_TRIGGER_PROGRAM], &change)) return 0;
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY) {
            if (growth != PM_GROWTH_NONE || fabs(change - round(change)) > WHOLE) return 0;
        } else if (change != 0) {
            if (growth != PM_GROWTH_NONE) return 0;
            const int64_t legs = until_zero(w, i, change);
            if (legs < most) most = legs;
        } else if (growth > PM_GROWTH_ROOT || growth == PM_GROWTH_LINEAR) {
            /* its zero moves with T: it must stay off it, here and in the last leg (see signs_changed) */
            if (growth > PM_GROWTH_STEADY || side_of(w, i, w->event->least) == 0) return 0;
        }
    }
    return most;
}

static int grid_is_full(const pm_workspace *w, const int32_t *e)
{
    for (int k = 0; k < e[PM_ASK_COUNT]; k++)
        if (!w->ask->filled[e[PM_ASK_OUT] + k]) return 0;
    return 1;
}

static int64_t asks_allow(pm_workspace *w, const pm_shift *shift)
{
    const pm_model *m = w->model;
    int64_t most = MOST_LEGS;
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        const int kind = e[PM_ASK_KIND], event = e[PM_ASK_EVENT_INDEX];
        if (kind == PM_ASK_END) continue;
        if (kind == PM_ASK_EVENT || kind == PM_ASK_EACH) {
            const int64_t last = kind == PM_ASK_EVENT ? e[PM_ASK_NTH] : e[PM_ASK_COUNT],
                          each = fires(w, event);
            if (each == 0 || w->event->count[event] >= last) continue;
            most =
                kind == PM_ASK_EACH ? 0 : fewer(most, (double)((last - 1 - w->event->count[event]) / each));
            continue;
        }
        if (kind == PM_ASK_GRID) {
            if (!grid_is_full(w, e)) return 0;
            continue;
        }
        const int watched =
            kind == PM_ASK_MAX || kind == PM_ASK_MIN ? e[PM_ASK_PROGRAM] : e[PM_ASK_PROGRAM_2];
        const int growth = m->program_growth[watched];
        const int least = kind == PM_ASK_MIN || kind == PM_ASK_AT_MIN;
        double change;
        if (!pm_symmetry_program(w, shift, watched, &change)) return 0;
        if (change != 0 && growth != PM_GROWTH_NONE) return 0; /* both change: neither end is the extreme */
        if (growth > PM_GROWTH_STEADY && growth != (least ? PM_GROWTH_CONCAVE : PM_GROWTH_CONVEX)) return 0;
    }
    return most;
}

static int64_t limits_allow(const pm_workspace *w, double time)
{
    const pm_model *m = w->model;
    const int64_t events = w->count[PM_COUNT_EVENTS] - w->leg->count[PM_COUNT_EVENTS];
    const double left = PM_SETTING(m, PM_SETTING_MAX_EVENTS) - (double)w->count[PM_COUNT_EVENTS];
    const double room = pm_case_max_time(w) - w->state.t;
    int64_t most = events > 0 ? fewer(MOST_LEGS, floor(left / (double)events) - 1) : MOST_LEGS;
    /* the last leg but one is computed, too: the run may end within the last one */
    if (time > 0 && room < INFINITY) most = fewer(most, floor(room / time) - 1);
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int32_t *e = PM_UNTIL_ROW(m, i);
        const int64_t each = fires(w, e[PM_UNTIL_EVENT]),
                      lacks = e[PM_UNTIL_NTH] - 1 - w->event->count[e[PM_UNTIL_EVENT]];
        if (each > 0 && lacks >= 0) most = fewer(most, (double)(lacks / each - 1));
    }
    return most;
}

/* Legs from now on. */
typedef struct pm_course {
    int64_t legs;   /* that are passed over */
    double kinetic; /* T with which the one after them begins */
    double lost;    /* what their blows take */
    double error;   /* of T after them */
    int is_last;    /* the one after them is the last that gets over the barrier */
} pm_course;

/* T with which the leg after the next one begins. */
static double kinetic_after(const pm_leg *l, const pm_course *c) { return l->ratio * (c->kinetic + l->work); }

static double depth_of(const pm_leg *l) { return l->kinetic - l->lowest; }

static void add_leg(const pm_leg *l, pm_course *c)
{
    const double end = c->kinetic + l->work, next = kinetic_after(l, c);
    c->legs++;
    c->lost += end - next;
    c->error = l->ratio * c->error + ROUNDINGS * (end + next);
    c->kinetic = next;
}

/* Those that get over the barrier, as the leg after each of them does, too: that one is left to be looked at. */
static pm_course course_over_barrier(const pm_leg *l, double begin, int64_t most, double error)
{
    pm_course c = {.kinetic = begin, .error = error};
    const double near = BARRIER * fmax(l->kinetic, fabs(depth_of(l)));
    if (!(begin - depth_of(l) > near)) return c;
    while (c.legs < most) {
        const double t = c.kinetic, next = kinetic_after(l, &c);
        if (!(next - depth_of(l) > near)) {
            c.is_last = 1;
            return c;
        }
        add_leg(l, &c);
        if (fabs(next - t) > STEADY * t) continue;
        /* what is gained is lost in the blow: so it goes on */
        c.lost += (double)(most - c.legs) * (t + l->work - next);
        c.legs = most;
        c.kinetic = t;
    }
    return c;
}

/* ---- passing over ---- */
static void save(pm_workspace *w)
{
    pm_leg *l = w->leg;
    pm_saved *s = &l->saved;
    const size_t nevent = (size_t)w->model->rows[PM_TABLE_EVENT];
    pm_state_copy(&s->begin, &w->state);
    pm_state_copy(&s->before, &l->begin);
    s->kinetic = l->kinetic;
    s->end = l->before;
    s->lowest = l->lowest;
    s->end_kind = l->end_kind;
    s->end_mark = l->end_mark;
    s->energy_lost = w->energy_lost;
    s->error = w->path->error;
    s->energy_scale = w->energy_scale;
    s->momentum_scale = w->momentum_scale;
    s->constraint_worst = w->constraint_worst;
    s->evidence = w->evidence;
    s->speed = w->speed;
    memcpy(s->count, w->count, sizeof s->count);
    memcpy(s->count_before, l->count, sizeof s->count);
    memcpy(s->event_count, w->event->count, nevent * sizeof *s->event_count);
    memcpy(s->event_before, l->event_count, nevent * sizeof *s->event_count);
    memcpy(s->event_time, w->event->time, nevent * sizeof *s->event_time);
    memcpy(s->out, w->out, (size_t)w->model->nout * sizeof *s->out);
    memcpy(s->ask, w->ask->sample, pm_ask_numbers(w->model) * sizeof *s->ask);
    memcpy(s->ask_flags, w->ask->undefined, ask_flags(w));
    memcpy(s->range, w->event->least, range_doubles(w) * sizeof *s->range);
}

static int give_back(pm_workspace *w)
{
    pm_leg *l = w->leg;
    const pm_saved *s = &l->saved;
    const size_t nevent = (size_t)w->model->rows[PM_TABLE_EVENT];
    const int64_t steps = w->count[PM_COUNT_STEPS], solves = w->count[PM_COUNT_SOLVES];
    pm_state_copy(&w->state, &s->begin);
    pm_state_copy(&l->begin, &s->before);
    l->kinetic = s->kinetic;
    l->before = s->end;
    l->lowest = s->lowest;
    l->end_kind = s->end_kind;
    l->end_mark = s->end_mark;
    w->energy_lost = s->energy_lost;
    w->path->error = s->error;
    w->path->ended = 0;
    w->energy_scale = s->energy_scale;
    w->momentum_scale = s->momentum_scale;
    w->constraint_worst = s->constraint_worst;
    w->evidence = s->evidence;
    w->speed = s->speed;
    memcpy(w->count, s->count, sizeof s->count);
    memcpy(l->count, s->count_before, sizeof s->count);
    w->count[PM_COUNT_STEPS] = steps; /* work that was done */
    w->count[PM_COUNT_SOLVES] = solves;
    memcpy(w->event->count, s->event_count, nevent * sizeof *s->event_count);
    memcpy(l->event_count, s->event_before, nevent * sizeof *s->event_count);
    memcpy(w->event->time, s->event_time, nevent * sizeof *s->event_time);
    memcpy(w->out, s->out, (size_t)w->model->nout * sizeof *s->out);
    memcpy(w->ask->sample, s->ask, pm_ask_numbers(w->model) * sizeof *s->ask);
    memcpy(w->ask->undefined, s->ask_flags, ask_flags(w));
    memcpy(w->event->least, s->range, range_doubles(w) * sizeof *s->range);
    pm_frame_look_state(w, &w->state);
    return pm_active_build(w);
}

static void close_momentum(pm_workspace *w, const double *before)
{
    double *ledger = w->state.z + pm_audit_ledger(w->model), after[PM_LEDGER];
    pm_body_momentum(w, PM_NONE, after);
    for (int i = 0; i < PM_LEDGER; i++) ledger[i] += after[i] - before[i];
}

/* Moves the state on by n legs. */
static int pass(pm_workspace *w, int64_t legs, double kinetic_now, double kinetic, double lost, double time)
{
    const pm_model *m = w->model;
    pm_leg *l = w->leg;
    const double n = (double)legs, faster = sqrt(kinetic / kinetic_now);
    double momentum[PM_LEDGER];
    pm_body_momentum(w, PM_NONE, momentum);
    for (int i = 0; i < m->nz_controlled; i++) w->state.z[i] += n * (w->state.z[i] - l->begin.z[i]);
    for (int i = 0; i < m->nbody; i++) {
        for (int k = 0; k < 2; k++) w->state.q[3 * i + k] += n * l->by[k];
        w->state.q[3 * i + 2] += n * l->turn[i];
    }
    for (int i = 0; i < m->nq; i++) w->state.v[i] *= faster;
    w->state.t += n * time;
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode != PM_OPEN && pm_contact_is_row(m, pm_contact_of_slot(m, i)))
            w->state.slot[i].member += (int32_t)(legs * l->member);
    for (int i = 0; i < m->rows[PM_TABLE_EVENT]; i++) {
        const int64_t each = fires(w, i);
        w->event->count[i] += legs * each;
        if (each > 0) w->event->time[i] += n * time;
    }
    static const int counted[] = {PM_COUNT_PHASES, PM_COUNT_EVENTS, PM_COUNT_JUMPS};
    for (int i = 0; i < 3; i++) w->count[counted[i]] += legs * (w->count[counted[i]] - l->count[counted[i]]);
    w->count[PM_COUNT_LEGS] += legs;
    w->energy_lost += lost;
    pm_frame_look_state(w, &w->state);
    for (int i = 0; i < m->nslot; i++)
        if (w->state.slot[i].mode == PM_STICK) pm_active_anchor(w, &w->state, i);
    close_momentum(w, momentum);
    return pm_active_build(w);
}

/* From one begin to the next, places that differ by the shift alone: the work of the weight on the way that all bodies
 * have gone, and what forces without potential have done; exactly, while differences of energies would be rounded, and
 * alike in all legs. */
static double work_of_leg(const pm_workspace *w)
{
    const pm_leg *l = w->leg;
    double mass = 0, work = 0;
    for (int i = 0; i < w->model->nbody; i++) mass += w->mass[i];
    for (int i = 0; i < w->model->nz_work; i++) work += w->state.z[i] - l->begin.z[i];
    return work + mass * (w->gravity[0] * l->by[0] + w->gravity[1] * l->by[1]);
}

static int moves_with_energy(const pm_workspace *w, int trigger)
{
    const int32_t *e = PM_TRIGGER_ROW(w->model, trigger);
    if (e[PM_TRIGGER_KIND] >= PM_TRIGGER_EVERY || pm_trigger_on_time(w, trigger)) return 0;
    const int growth = w->model->program_growth[e[PM_TRIGGER_PROGRAM]];
    return growth == PM_GROWTH_LINEAR || growth == PM_GROWTH_STEADY;
}

/* A trigger that the kinetic energy moves has gone through its zero since the first leg passed over. */
static int signs_changed(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        if (moves_with_energy(w, i) && side_of(w, i, w->event->least) != side_of(w, i, w->leg->saved.range))
            return 1;
    return 0;
}

/* The last leg over the barrier, by the places of the one that was computed. */
static int tell_last(pm_workspace *w, pm_course *course, int *told)
{
    pm_leg *l = w->leg;
    pm_path *p = w->path;
    const double error = p->error, ended = p->ended;
    const int dips = l->lowest < fmin(l->kinetic, l->before);
    if (!p->repeats) return PM_OK;
    const pm_replay replay = {.end = l->end,
                              .kinetic = course->kinetic,
                              .kinetic1 = course->kinetic + l->work,
                              .lowest = dips ? course->kinetic - depth_of(l) : INFINITY,
                              .error = course->error};
    memcpy(l->saved.range, w->event->least, range_doubles(w) * sizeof *l->saved.range);
    int clear, status = pm_leg_replay(w, &replay, &clear);
    if (!status && clear && !signs_changed(w)) status = pm_leg_watch(w, &replay, told);
    pm_frame_look_state(w, &w->state);
    p->error = error;
    p->ended = ended;
    if (*told) add_leg(l, course);
    return status;
}

int pm_leg_begin(pm_workspace *w, int *passed)
{
    pm_leg *l = w->leg;
    const double kinetic = pm_body_kinetic(w, PM_NONE);
    *passed = w->path->repeats = 0;
    if (!l->known || kinetic == 0 || !same_modes(w) || !find_way(w) || !same_place_and_motion(w, kinetic)) {
        remember(w);
        l->most = MOST_LEGS;
        l->pending = 0;
        return PM_OK;
    }
    l->pending = 0; /* the leg that was computed ended as those before it */
    const pm_shift shift = {{l->by[0], l->by[1]}, l->turn};
    const int in_time = w->model->reads_time || w->trace;
    const double time = in_time ? w->state.t - l->begin.t : 0;
    l->work = work_of_leg(w);
    l->ratio = kinetic / l->before;
    const int steady = fabs(kinetic - l->kinetic) <= SAME_ENERGY * kinetic;
    if (w->trace || (in_time && !steady) || !pm_symmetry_holds(w, &shift)) {
        remember(w);
        return PM_OK;
    }
    if (steady) l->ratio = 1, l->work = 0;
    int64_t most = l->most;
    const int64_t allowed[] = {triggers_allow(w, &shift, time), asks_allow(w, &shift), limits_allow(w, time)};
    for (int i = 0; i < 3; i++)
        if (allowed[i] < most) most = allowed[i];
    w->path->repeats = !w->lap && l->steps == 1;
    pm_course course = course_over_barrier(l, kinetic, most, w->path->error);
    l->most = MOST_LEGS;
    if (course.legs > 0) save(w);
    int told = 0, status = course.is_last ? tell_last(w, &course, &told) : PM_OK;
    if (!status && course.legs > 0) {
        w->path->error = course.error;
        w->path->ended = 0; /* the error is that at the begin of the leg that follows */
        status = pass(w, course.legs, kinetic, course.kinetic, course.lost, time);
        l->pending = steady || told ? 0 : course.legs;
        l->expected_kind = l->end_kind;
        l->expected_mark = l->end_mark;
        *passed = 1;
    }
    remember(w);
    return status;
}

/* What ended the phase: the first function that is no trigger, by its kind and contact. */
static void read_end(const pm_workspace *w, int *kind, int *mark)
{
    const pm_event_set *e = w->event;
    *kind = w->turns ? PM_GROUND : PM_NONE;
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

void pm_leg_end(pm_workspace *w)
{
    pm_leg *l = w->leg;
    if (!l->known) return;
    l->before = pm_body_kinetic(w, PM_NONE);
    l->end = w->step_end;
    l->steps = w->count[PM_COUNT_STEPS] - l->count[PM_COUNT_STEPS];
    l->lowest = fmin(w->path->lowest, l->kinetic);
    read_end(w, &l->end_kind, &l->end_mark);
}

void pm_leg_lap(pm_workspace *w)
{
    pm_frame_look_state(w, &w->state);
    pm_leg_end(w);
}

int pm_leg_doubts(const pm_workspace *w)
{
    const pm_event_set *e = w->event;
    if (w->leg->pending == 0) return 0;
    for (int i = 0; i < e->nfunction; i++)
        if (e->hit[i] && e->function[i].kind == FUNCTION_TRIGGER &&
            moves_with_energy(w, e->function[i].index))
            return 1;
    return 0;
}

int pm_leg_refuted(pm_workspace *w)
{
    pm_leg *l = w->leg;
    int kind, mark;
    if (l->pending == 0) return 0;
    read_end(w, &kind, &mark);
    if (kind == l->expected_kind && mark == l->expected_mark && !signs_changed(w)) return 0;
    l->most = l->pending / 2;
    l->pending = 0;
    return give_back(w) == PM_OK;
}
