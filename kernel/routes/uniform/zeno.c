/* zeno.c - infinitely many blows in finite time, taken at once.
 *
 * In a phase with constant accelerations a contact that is struck again and again changes the velocities by D, D e, D e^2 ..
 * at times that shrink by e as well: the equations of motion and of the blows are linear.  From right after a blow that
 * changed them by D, with the next one `flight` later, e the ratio, T = flight / (1 - e), and blow k at t_k = T (1 - e^k):
 *   v(T) = v + a T + D e / (1 - e)
 *   q(T) = q + v T + a T^2/2 + sum_k D e^k (T - t_k) = q + v T + a T^2/2 + D T e^2 / (1 - e^2)
 * There the contact touches with no speed left, and stays closed.  Nothing is assumed of the law of the blows: that they
 * follow the series is observed, with friction or without.
 *
 * Ledger.  Rates are linear in q and v, so that their integral is T times the rate at the mean place (q with the last sum
 * replaced by D T/2 e^3 / (1 - e^3)); the blows' impulses e^k P act at places q_k = A + B e^k + C e^2k with velocities
 * (before and after, on average) v(T) - e^k (a T + D (1 + e) / 2(1 - e)): they count once, at the means by e^k.
 *
 * The leap is taken when nothing that is asked lies in it: no strike that anybody waits for, no trigger or extreme within
 * the reach of what the last flight shows, no other contact within the reach of the motion.  The event of the strikes has
 * then fired infinitely often.  A coarse run takes it at faster blows: their times shrink, so that what rounding does to the
 * time of the rest is done by the first of them, and the two leaps show what a leap is off by. */
#include <math.h>
#include <string.h>

#include "elements/capture.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "equations/saddle.h"
#include "events/ask.h"
#include "events/awaited.h"
#include "events/event.h"
#include "events/integral_series.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

#define FLIGHT_NODES 5 /* places of a flight where programs are looked at */

/* ---- the series ---- */
void pm_zeno_reset(pm_uniform *uniform)
{
    pm_series *x = &uniform->series;
    x->contact = x->pending = PM_NONE;
    x->alike = 0;
    x->flight = 0;
}

void pm_zeno_end(pm_workspace *w, int contact)
{
    pm_series *x = &w->uniform->series;
    x->pending = contact;
    if (contact == PM_NONE) return;
    memcpy(x->before, w->state.v, (size_t)w->model->nq * sizeof(double));
    x->phase = w->result.count[PM_COUNT_PHASES];
    x->jumps = w->result.count[PM_COUNT_JUMPS];
    x->pending_end = w->state.t;
    x->pending_flight = w->uniform->end;
}

/* The instant before this phase was one blow of the contact that ended the last one, and nothing else. */
static int follows_a_blow(const pm_workspace *w)
{
    const pm_series *x = &w->uniform->series;
    return x->pending != PM_NONE && x->phase == w->result.count[PM_COUNT_PHASES] &&
           x->jumps + 1 == w->result.count[PM_COUNT_JUMPS] && x->pending_end == w->state.t;
}

static int is_alike(const pm_frame *frame, const pm_uniform *uniform, const double *change, double flight)
{
    const pm_series *x = &uniform->series;
    const double e = pm_contact_restitution(frame, x->contact);
    double size = 0, off = 0;
    for (int i = 0; i < frame->model->nq; i++) {
        const double length = i % 3 == 2 ? frame->numbers->size : 1;
        size = fmax(size, length * fabs(change[i]));
        off = fmax(off, length * fabs(change[i] - e * x->change[i]));
    }
    const int flights = x->flight == 0 || fabs(flight - e * x->flight) <= PM_ZENO_GEOMETRIC * flight;
    return off <= PM_ZENO_GEOMETRIC * size && flights;
}

void pm_zeno_begin(pm_workspace *w)
{
    pm_series *x = &w->uniform->series;
    if (!follows_a_blow(w) ||
        pm_capture_holds(w->model, &w->state)) { /* what a captured pair takes over is not thought through */
        pm_zeno_reset(w->uniform);
        pm_turns_reset(w->uniform);
        return;
    }
    pm_turns_follow(w, x->pending, x->before);
    double *change = x->spare;
    const int same = x->contact == x->pending;
    const double flight = same ? x->pending_flight : 0; /* that phase began with the blow before */
    for (int i = 0; i < w->model->nq; i++) change[i] = w->state.v[i] - x->before[i];
    x->alike = same && is_alike(&w->frame, w->uniform, change, flight) ? x->alike + 1 : 0;
    x->spare = x->change;
    x->change = change;
    x->contact = x->pending;
    x->flight = flight;
    x->pending = PM_NONE;
}

/* ---- whether anything asked lies in the rest of the series ---- */
typedef struct pm_rest {
    int contact;
    double e, flight, time; /* T */
} pm_rest;

/* Values of a program in the flight that comes, and what the rest of the series may give: each flight repeats the one
 * before on a smaller scale. */
typedef struct pm_outlook {
    double least, greatest;
    int rises, falls; /* throughout */
} pm_outlook;

static pm_outlook outlook_of(pm_workspace *w, const pm_rest *r, int program)
{
    pm_outlook x = {INFINITY, -INFINITY, 1, 1};
    double before = NAN;
    for (int k = 0; k < FLIGHT_NODES; k++) {
        pm_uniform_look_at_forces(w, r->flight * k / (FLIGHT_NODES - 1));
        const double p = pm_program_run(w, program);
        if (!(p <= x.greatest)) x.greatest = p; /* not a number stays one */
        if (!(p >= x.least)) x.least = p;
        x.rises &= k == 0 || p >= before;
        x.falls &= k == 0 || p <= before;
        before = p;
    }
    const double reach = PM_ZENO_MARGIN * (x.greatest - x.least) / (1 - r->e);
    x.least -= reach;
    x.greatest += reach;
    return x;
}

/* State at the end of the series. */
static void end_of_series(pm_uniform *u, int nq, const pm_rest *r, double *q, double *v)
{
    const double t = r->time, e = r->e;
    u->looked = NAN; /* this may be written where that place is */
    for (int i = 0; i < nq; i++) {
        const double d = u->series.change[i];
        q[i] = u->q0[i] + t * (u->v[i] + 0.5 * t * u->a[i] + d * e * e / (1 - e * e));
        v[i] = u->v[i] + t * u->a[i] + d * e / (1 - e);
    }
}

static void look_at_end(pm_workspace *w, const pm_rest *r)
{
    end_of_series(w->uniform, w->model->nq, r, w->uniform->q_look, w->uniform->v_look);
    pm_uniform_look_there(w, r->time);
}

/* A trigger of the motion that the rest of the series may fire; what ends the step is none. */
static int may_fire(pm_workspace *w, const pm_rest *r, int trigger, pm_outlook *x)
{
    const int32_t *e = PM_TRIGGER_ROW(w->model, trigger);
    if (e[PM_TRIGGER_KIND] > PM_TRIGGER_EVERY || pm_trigger_on_time(w->model, trigger)) return 0;
    *x = outlook_of(w, r, e[PM_TRIGGER_PROGRAM]);
    return e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY ? !(floor(x->least) == floor(x->greatest))
                                                  : !(x->least > 0 || x->greatest < 0);
}

/* All flights are alike to it, down to the smallest: at the end of the series it is on its zero. */
static int fires_alike(pm_workspace *w, const pm_rest *r, int trigger, const pm_outlook *x)
{
    const int32_t *e = PM_TRIGGER_ROW(w->model, trigger);
    look_at_end(w, r);
    const double p = pm_trigger_program(w, trigger);
    const double off = e[PM_TRIGGER_KIND] == PM_TRIGGER_EVERY ? p - round(p) : p;
    return fabs(off) <= PM_ZENO_GEOMETRIC * (x->greatest - x->least);
}

static int triggers_are_clear(pm_workspace *w, const pm_rest *r)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        const int awaited = pm_awaited(w->model, &w->firing, e[PM_TRIGGER_EVENT], INT64_MAX);
        pm_outlook x;
        if (awaited && e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == r->contact) return 0;
        if (may_fire(w, r, i, &x) && (awaited || !fires_alike(w, r, i, &x))) return 0;
    }
    return 1;
}

/* What fired in the last flight, and may do so in the next, has fired without end at the end. */
static void count_without_end(pm_workspace *w, const pm_rest *r)
{
    const double flight = w->uniform->series.flight, t0 = w->uniform->t0;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(w->model, i);
        const int event = e[PM_TRIGGER_EVENT];
        pm_outlook x;
        if (w->firing.time[event] > t0 - (1 - PM_ZENO_GEOMETRIC) * flight && may_fire(w, r, i, &x))
            pm_trigger_countless(w->model, &w->firing, event, t0 + r->time);
    }
}

static int grid_is_clear(const pm_numbers *numbers, const struct pm_ask_set *ask, const int32_t *e,
                         const pm_outlook *x)
{
    for (int k = 0; k < e[PM_ASK_COUNT]; k++) {
        const double wanted = numbers->value[e[PM_ASK_FIRST_VALUE] + k];
        if (!ask->filled[e[PM_ASK_OUT] + k] && !(wanted < x->least || wanted > x->greatest)) return 0;
    }
    return 1;
}

/* An extreme that goes on to get better is the one at the limit, which is looked at. */
static int observers_are_clear(pm_workspace *w, const pm_rest *r)
{
    for (int i = 0; i < w->ask->nobserver; i++) {
        const int ask = w->ask->observer[i];
        const int32_t *e = PM_ASK_ROW(w->model, ask);
        const pm_outlook x = outlook_of(w, r, pm_ask_watched(w->model, w->ask, i));
        int clear;
        switch (e[PM_ASK_KIND]) {
        case PM_ASK_MAX:
        case PM_ASK_AT_MAX: clear = x.rises || x.greatest <= w->ask->best[ask]; break;
        case PM_ASK_MIN:
        case PM_ASK_AT_MIN: clear = x.falls || x.least >= w->ask->best[ask]; break;
        case PM_ASK_GRID: clear = grid_is_clear(&w->numbers, w->ask, e, &x); break;
        default: look_at_end(w, r); clear = pm_integral_series_is_clear(w, r->contact, ask, r->e, r->time);
        }
        if (!clear) return 0;
    }
    return 1;
}

/* How fast the blows to come may still make two bodies part. */
static double kicks(const pm_workspace *w, const pm_rest *r, const pm_constraint *c)
{
    const double lever = w->numbers.size + pm_contact_reach(w);
    double sum = 0;
    for (int p = 0; p < pm_constraint_bodies(c); p++) {
        if (c->body[p] == w->model->nbody) continue;
        const double *d = w->uniform->series.change + 3 * c->body[p];
        sum += pm_length(d) + lever * fabs(d[2]);
    }
    return sum / (1 - r->e);
}

/* What is struck lies below, if it ends. */
static int stays_over(pm_workspace *w, const pm_rest *r)
{
    pm_constraint c, tangent;
    pm_constraint_bounds x;
    const int slot = w->model->contact_slot[r->contact];
    if (!pm_edge_is(w->model, r->contact)) return 1;
    pm_uniform_look(w, 0);
    if (w->state.slot[slot].member != PM_SEGMENT_FACE) return 0;
    pm_contact_constraint_both(&w->frame, r->contact, slot, PM_SEGMENT_FACE, &c, &tangent);
    pm_constraint_kind(c.kind)->bound(&w->frame, &c, w->uniform->a, r->time, &x);
    return pm_edge_room(&w->frame, &w->state, r->contact, PM_SEGMENT_FACE) >
           (x.rate + kicks(w, r, &c)) * r->time;
}

static int others_stay_open(pm_workspace *w, const pm_rest *r)
{
    const pm_model *m = w->model;
    pm_uniform_look(w, 0);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        int member[2];
        const int n = i == r->contact ? 0 : pm_contact_near(&w->frame, &w->state, i, 2, member);
        for (int k = 0; k < n; k++) {
            pm_constraint c, tangent;
            pm_constraint_bounds x;
            pm_contact_constraint_both(&w->frame, i, m->contact_slot[i], member[k], &c, &tangent);
            pm_constraint_kind(c.kind)->evaluate(&w->frame, &c);
            pm_constraint_kind(c.kind)->bound(&w->frame, &c, w->uniform->a, r->time, &x);
            if (!(c.g > (x.rate + kicks(w, r, &c)) * r->time)) return 0;
        }
    }
    return 1;
}

static double slip_with(pm_workspace *w, int slot, double t, double factor)
{
    const pm_uniform *u = w->uniform;
    const int contact = pm_contact_of_slot(w->model, slot);
    pm_uniform_look_at_forces(w, t); /* which nobody takes for looked at: its velocities become others */
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] += factor * u->series.change[i];
    return pm_contact_member_slip(&w->frame, contact, w->state.slot[slot].member);
}

/* Where there is slip - of closed contacts, and of the struck one with friction - it keeps its sign. */
static int slips_go_on(pm_workspace *w, const pm_rest *r)
{
    if (pm_joint_friction_any(w->model)) return 0;
    for (int i = 0; i < w->model->nslot; i++) {
        const int contact = pm_contact_of_slot(w->model, i), mode = w->state.slot[i].mode;
        const int slides = mode == PM_SLIDE_FORWARD || mode == PM_SLIDE_BACKWARD;
        if (!slides &&
            (contact != r->contact || pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB))
            continue;
        const double now = slip_with(w, i, 0, 0);
        const double change =
            fabs(slip_with(w, i, r->time, 0) - now) + fabs(slip_with(w, i, 0, 1) - now) / (1 - r->e);
        if (!slides && fabs(now) <= pm_contact_speed(&w->frame))
            continue; /* each blow ends the slip of its flight */
        if (!(fabs(now) > change)) return 0;
    }
    return 1;
}

/* The struck contact's constraints stay the same, too: then its gap is a parabola, and all of its blows are alike. */
static int contact_is_steady(const pm_workspace *w, int contact)
{
    const int slot = w->model->contact_slot[contact];
    pm_constraint normal, tangent;
    pm_contact_constraint_both(&w->frame, contact, slot, w->state.slot[slot].member, &normal, &tangent);
    return pm_constraint_kind(normal.kind)->steady(&w->frame, &normal, &w->uniform->curve);
}

static int is_slow(pm_workspace *w, const pm_rest *r)
{
    const double earlier = pm_evidence_is_coarse(&w->evidence) ? PM_ZENO_EARLIER : 1;
    double rate;
    const int slot = w->model->contact_slot[r->contact];
    pm_uniform_look(w, 0);
    pm_contact_member_gap(&w->frame, r->contact, w->state.slot[slot].member, &rate);
    return rate <= earlier * PM_ZENO_SLOW * w->numbers.speed || w->uniform->series.alike >= PM_ZENO_ENOUGH;
}

int pm_zeno_may_leap(const pm_uniform *u) { return u->begin == 0 && u->series.alike >= PM_ZENO_ALIKE; }

static int applies(pm_workspace *w, const pm_rest *r, double t_limit)
{
    const pm_uniform *u = w->uniform;
    const int observed = pm_zeno_may_leap(u) && u->series.contact == r->contact &&
                         fabs(r->flight - r->e * u->series.flight) <= PM_ZENO_GEOMETRIC * r->flight;
    const pm_model *m = w->model;
    const int asked = m->programs.watch_counts || m->acts || m->nz_controlled > m->nz_work; /* paths */
    return observed && !asked && !u->curve.levers && r->e > 0 && r->e < 1 && u->t0 + r->time < t_limit &&
           is_slow(w, r) && contact_is_steady(w, r->contact) && stays_over(w, r) && others_stay_open(w, r) &&
           slips_go_on(w, r) && triggers_are_clear(w, r) && observers_are_clear(w, r);
}

/* ---- the leap ---- */
/* Continuous forces: at the mean place of the flights. */
static void add_forces(pm_workspace *w, const pm_rest *r, const double *q_end)
{
    pm_uniform *u = w->uniform;
    const double t = r->time, e3 = r->e * r->e * r->e, factor = 0.5 * t * e3 / (1 - e3);
    for (int i = 0; i < w->model->nq; i++) {
        u->v_look[i] = (q_end[i] - u->q0[i]) / t;
        u->q_look[i] = u->q0[i] + 0.5 * t * (u->v[i] + t * u->a[i] / 3) + factor * u->series.change[i];
    }
    pm_uniform_rates(w, u->rate);
    for (int i = 0; i < w->model->nz; i++) w->state.z[i] += t * u->rate[i];
}

/* All blows: at the means of their places and velocities by the size of their impulses. */
static void add_blows(pm_workspace *w, const pm_rest *r, const double *q_end, const double *v_end)
{
    pm_uniform *u = w->uniform;
    const double t = r->time, e = r->e, sum = e / (1 - e), square = e * e / (1 - e * e),
                 cube = e * e * e / (1 - e * e * e);
    for (int i = 0; i < w->model->nq; i++) {
        const double at = u->a[i] * t, d = u->series.change[i];
        const double linear = -t * (u->v[i] + at + d * sum), quadratic = t * (0.5 * at + d * e / (1 - e * e));
        u->q_look[i] = q_end[i] + (linear * square + quadratic * cube) / sum;
        u->v_look[i] = v_end[i] - (at + 0.5 * d * (1 + e) / (1 - e)) * e / (1 + e);
    }
    pm_frame_look(&w->frame, u->t0, u->q_look, u->v_look, w->state.z, w->state.memory);
    pm_ledger_series(w, sum);
}

int pm_zeno_leap(pm_workspace *w, int contact, double flight, double t_limit, int *taken)
{
    pm_uniform *u = w->uniform;
    const double e = contact == PM_NONE ? 0 : pm_contact_restitution(&w->frame, contact);
    const pm_rest r = {contact, e, flight, flight / (1 - e)};
    *taken = contact != PM_NONE && applies(w, &r, t_limit);
    if (!*taken) return PM_OK;
    double *q = w->state.q, *v = w->state.v;
    count_without_end(w, &r);
    end_of_series(u, w->model->nq, &r, q, v);
    add_forces(w, &r, q);
    add_blows(w, &r, q, v);
    w->state.t = u->t0 + r.time;
    w->firing.jumped = NAN; /* the last of them are too slow to tell before from after */
    pm_integral_series_leap(w, r.time);
    pm_step_set(&w->step, w->state.t, w->state.t);
    w->result.count[PM_COUNT_JUMPS]++;
    pm_trigger_lose_strikes(w, contact, PM_COUNTLESS);
    pm_evidence_leap(&w->evidence, contact, u->series.alike);
    pm_zeno_reset(w->uniform);
    return pm_projection_apply(w, &w->state);
}
