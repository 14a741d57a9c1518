/* turns.c - two contacts that are struck by turns without a loss (wedge.c): many of their blows are passed over at once.
 *
 * It is done where blows and times alone are waited for, nothing is accelerated, nothing is on the way and all that holds stays the
 * same.  Nothing is assumed of a blow: that it mirrors the velocities is seen at those before.  The impulses that are passed over
 * act at their mean places.  The last blow at A is left to the rules of blows, and so are the last pairs. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "elements/joint_friction.h"
#include "elements/trigger.h"
#include "equations/case.h"
#include "equations/ledger.h"
#include "equations/projection.h"
#include "events/ask.h"
#include "events/awaited.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/event_search.h"
#include "events/integral_series.h"
#include "impact/contact_modes.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "routes/uniform/uniform.h"
#include "routes/uniform/wedge.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

void pm_turns_reset(pm_uniform *uniform) { uniform->turns.n = 0; }

/* ---- what is seen ---- */
/* What is struck is one side: a circle, a line, the face of an edge. */
static int is_one_side(const pm_workspace *w, int contact)
{
    const int slot = w->model->contact_slot[contact];
    return pm_contact_is_single(w->model, contact) ||
           (pm_edge_is(w->model, contact) && w->state.slot[slot].member == PM_SEGMENT_FACE);
}

static int is_lossless(const pm_workspace *w, int contact)
{
    const int member = w->state.slot[w->model->contact_slot[contact]].member;
    return is_one_side(w, contact) && pm_contact_restitution(&w->frame, contact) == 1 &&
           pm_contact_modes_of_slip(&w->frame, contact, member) == PM_SMOOTH;
}

/* The last blow, of a phase that ended with the velocities `before`, was at this contact alone, and mirrored them. */
static int mirrors(pm_workspace *w, int contact, const double *before)
{
    const double impulse = w->impulses.slot[2 * w->model->contact_slot[contact]];
    double *change = w->uniform->v_look, size = 0, off = 0;
    w->uniform->looked = NAN;
    pm_frame_look_state(&w->frame, &w->state);
    const pm_constraint normal = pm_wedge_side(w, contact);
    memset(change, 0, (size_t)w->model->nq * sizeof *change);
    pm_wedge_respond(&w->numbers, &normal, impulse, change);
    for (int i = 0; i < w->model->nq; i++) {
        const double length = i % 3 == 2 ? w->numbers.size : 1;
        size = fmax(size, length * (fabs(before[i]) + fabs(w->state.v[i])));
        off = fmax(off, length * fabs(before[i] + change[i] - w->state.v[i]));
    }
    if (!(off <= PM_TURNS_ROUNDING * size)) return 0;
    const double now = pm_constraint_times(&w->frame, &normal, w->state.v),
                 then = pm_constraint_times(&w->frame, &normal, before);
    return fabs(now + then) <= PM_ZENO_GEOMETRIC * now;
}

void pm_turns_follow(pm_workspace *w, int contact, const double *before)
{
    pm_turns *x = &w->uniform->turns;
    if (x->n > 1 && contact != x->contact[1]) x->n = 1;
    if (x->n > 0 && contact == x->contact[0]) x->n = 0;
    if (!is_lossless(w, contact) || (x->n >= PM_TURNS_ALIKE - 2 && !mirrors(w, contact, before))) {
        x->n = 0;
        return;
    }
    x->contact[1] = x->contact[0];
    x->contact[0] = contact;
    memmove(x->time + 1, x->time, 2 * sizeof *x->time);
    x->time[0] = w->state.t;
    x->n++;
}

/* ---- whether nothing else is on the way ---- */
/* What is off by rounding between circles may grow from blow to blow: they lie along an axis of the scene, and stay there. */
static int may_turn(const pm_numbers *numbers, const pm_constraint *c)
{
    for (int p = 0; p < 2; p++)
        if (!numbers->fixed[c->body[p]] && c->j[3 * p] != 0 && c->j[3 * p + 1] != 0) return 1;
    return 0;
}

static int is_same(const pm_numbers *numbers, const pm_constraint *a, const pm_constraint *b)
{
    const int on_line = a->kind == PM_CONSTRAINT_LINE_NORMAL;
    double off = 0;
    for (int p = 0; p < pm_constraint_bodies(a); p++)
        for (int i = 3 * p; i < 3 * p + 3 && !numbers->fixed[a->body[p]]; i++)
            off = pm_max(fabs(a->j[i] - b->j[i]), off);
    return on_line ? off <= PM_STEADY_ROUNDING : off == 0 && !may_turn(numbers, a);
}

static int has_room(const pm_workspace *w, int contact)
{
    return !pm_edge_is(w->model, contact) || pm_edge_room(&w->frame, &w->state, contact, PM_SEGMENT_FACE) > 0;
}

/* The Jacobians of both sides are the same wherever it leads, and no edge ends before. */
static int sides_stay(pm_workspace *w, const pm_wedge *x, double pairs)
{
    for (int side = 0; side < 2; side++) {
        const pm_met at = pm_wedge_met(x, side, 2 * pairs - side);
        pm_wedge_look(w, x, &at);
        for (int k = 0; k < 2; k++) {
            const pm_constraint c = pm_wedge_side(w, x->contact[k]);
            if (!is_same(&w->numbers, &c, &x->normal[k]) || !has_room(w, x->contact[k])) return 0;
        }
    }
    return 1;
}

/* What holds stays the same, too, whatever the velocities in the plane are; nothing begins to rotate. */
static int holds_on(pm_workspace *w, const pm_wedge *x)
{
    const pm_uniform *u = w->uniform;
    pm_constant_motion course = u->curve;
    course.v = u->v_look;
    for (int i = 2; i < w->model->nq; i += 3)
        if (x->along[i] != 0 || x->off[i] != 0) return 0;
    for (int k = 0; k < 2 && w->active.n > 0; k++) {
        pm_wedge_velocity(w, x, k ? x->a : 0, k ? 0 : x->b, u->v_look);
        if (!pm_constraint_all_steady(&w->frame, &w->active, &course)) return 0;
    }
    return 1;
}

/* How far it comes from here along side A, and off it, in how many s. */
typedef struct pm_turns_reach {
    double along, off, time;
} pm_turns_reach;

static pm_turns_reach reach_in_wedge(const pm_wedge *x, double pairs)
{
    const pm_met last = pm_wedge_met(x, 0, 2 * pairs), at = pm_wedge_met(x, 1, 2 * pairs - 1),
                 next = pm_wedge_met(x, 1, 1);
    const double apex = x->far / x->sine, nearest = apex * x->b / hypot(x->a, x->b);
    pm_turns_reach reach = {.along = pm_max(fabs(last.along), pm_max(fabs(at.along), fabs(next.along))),
                            .off = pm_max(next.off, at.off),
                            .time = last.time};
    if (x->cosine < 0)
        reach.along = reach.off = 2 * apex + 2 * fabs(last.along);
    else if (x->a < 0 && last.a > 0)
        reach.along = pm_max(apex - nearest * x->cosine, reach.along);
    return reach;
}

/* How far a body comes from where it is. */
static double reach_of(const pm_workspace *w, const pm_wedge *x, const pm_turns_reach *reach, int body)
{
    if (body == w->model->nbody) return 0;
    const double lever[] = {1, 1, w->numbers.size + pm_contact_reach(w)};
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const int i = 3 * body + k;
        const double rest = w->uniform->v[i] - x->a * x->along[i] - x->b * x->off[i];
        sum += lever[k] *
               (fabs(rest) * reach->time + reach->along * fabs(x->along[i]) + reach->off * fabs(x->off[i]));
    }
    return sum;
}

static int others_stay_open(pm_workspace *w, const pm_wedge *x, double pairs)
{
    const pm_model *m = w->model;
    const pm_turns_reach reach = reach_in_wedge(x, pairs);
    pm_uniform_look(w, 0);
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        int member[2];
        const int n = i == x->contact[0] || i == x->contact[1]
                          ? 0
                          : pm_contact_near(&w->frame, &w->state, i, 2, member);
        for (int k = 0; k < n; k++) {
            pm_constraint c;
            double both = 0;
            pm_contact_constraint_normal(&w->frame, i, m->contact_slot[i], member[k], &c);
            pm_constraint_kind(c.kind)->evaluate(&w->frame, &c);
            for (int p = 0; p < pm_constraint_bodies(&c); p++) both += reach_of(w, x, &reach, c.body[p]);
            if (!(c.g > both)) return 0;
        }
    }
    return 1;
}

/* How often blows of pairs that are passed over fire the event. */
static int64_t firings(const pm_model *m, const pm_wedge *x, int event, int64_t pairs)
{
    int of[2] = {0, 0};
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        for (int k = 0; k < 2 && e[PM_TRIGGER_EVENT] == event; k++)
            of[k] |= e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == x->contact[k];
    }
    return of[0] * (pairs - 1) + of[1] * pairs;
}

static int is_awaited(const pm_workspace *w, const pm_wedge *x, int64_t pairs)
{
    for (int event = 0; event < w->model->rows[PM_TABLE_EVENT]; event++) {
        const int64_t more = firings(w->model, x, event, pairs);
        const int nth = PM_EVENT_ROW(w->model, event)[PM_EVENT_NTH];
        if (more == 0) continue;
        if (nth > w->firing.seen[event] && nth - w->firing.seen[event] <= more) return 1;
        if (nth == 0 && pm_awaited(w->model, &w->firing, event, more)) return 1;
    }
    return 0;
}

static int events_act(const pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_EVENT]; i++)
        if (PM_EVENT_ROW(m, i)[PM_EVENT_EFFECT] != PM_EFFECT_NONE) return 1;
    return m->rows[PM_TABLE_ACTION] > 0;
}

/* Blows and times alone are waited for, and no contact is closed. */
static int watches_motion(const pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < w->event->nfunction; i++) {
        const int kind = w->event->function[i].kind;
        if (kind != FUNCTION_TRIGGER && kind != FUNCTION_GAP) return 1;
    }
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (PM_TRIGGER_ROW(m, i)[PM_TRIGGER_KIND] <= PM_TRIGGER_EVERY && !pm_trigger_on_time(m, i)) return 1;
    return w->ask->nobserver > 0 || m->programs.watch_counts || m->programs.read_impulses || events_act(m) ||
           w->record.history;
}

/* What is not struck goes straight on. */
static int goes_straight(const pm_workspace *w)
{
    for (int i = 0; i < w->model->nq; i++)
        if (w->uniform->a[i] != 0) return 0;
    return w->model->nz_controlled == 0 && !w->numbers.massless && !pm_joint_friction_any(w->model) &&
           w->model->nteeth == 0;
}

/* The last pair of blows took as long as the wedge says. */
static int fits(const pm_workspace *w, const pm_wedge *x)
{
    const double took = w->uniform->turns.time[0] - w->uniform->turns.time[2];
    return fabs(pm_wedge_met(x, 0, -2).time + took) <=
           PM_ZENO_GEOMETRIC * took + PM_TIME_ROUNDING * w->state.t;
}

static int read_wedge(pm_workspace *w, double flight, pm_wedge *x)
{
    pm_uniform *u = w->uniform;
    *x = (pm_wedge){.contact = {u->turns.contact[0], u->turns.contact[1]},
                    .flight = flight,
                    .along = u->turns.along,
                    .off = u->turns.off};
    pm_uniform_look(w, 0);
    for (int k = 0; k < 2; k++) x->normal[k] = pm_wedge_side(w, x->contact[k]);
    return pm_wedge_find(w, x) && fits(w, x) && holds_on(w, x);
}

/* Impulses that are opposite and far from the origin have moments whose rounding the ledger would see. */
static int ledger_sees(const pm_workspace *w, const pm_wedge *x, double pairs)
{
    double sum;
    (void)pm_wedge_mean(x, 0, pairs, &sum);
    const double moment = 2 * sum / x->size[0] * pm_contact_reach(w);
    return !(DBL_EPSILON * moment <= PM_TURNS_LEDGER * w->ledger.momentum_scale * w->numbers.size);
}

/* How many pairs are passed over; 0: none. */
static int64_t pairs_to_pass(pm_workspace *w, const pm_wedge *x, double time)
{
    const double most = pm_wedge_pairs_left(x) - 2;
    for (int64_t pairs = (int64_t)pm_min(most, PM_TURNS_MOST); pairs >= PM_TURNS_FEW; pairs /= 2) {
        const pm_met last = pm_wedge_met(x, 0, 2 * (double)pairs);
        if (last.time < time && !ledger_sees(w, x, (double)pairs) && !is_awaited(w, x, pairs) &&
            sides_stay(w, x, (double)pairs) && others_stay_open(w, x, (double)pairs))
            return pairs;
    }
    return 0;
}

/* ---- the leap ---- */
/* Nothing is accelerated: forces and reactions balance, and their powers, wherever they act. */
static void add_forces(pm_workspace *w, double time)
{
    pm_uniform *u = w->uniform;
    if (u->rests) return;
    pm_uniform_rates_after(w, 0, u->rate);
    for (int i = 0; i < w->model->nz; i++) w->state.z[i] += time * u->rate[i];
}

/* Impulses of n blows at side k, at their mean place. */
static void add_blows(pm_workspace *w, const pm_wedge *x, int k, double n)
{
    double sum;
    const pm_met mean = pm_wedge_mean(x, k, n, &sum);
    pm_wedge_velocity(w, x, 0, 0, w->uniform->v_look); /* on average no blow moves what it acts on */
    pm_wedge_look(w, x, &mean);
    memset(w->impulses.slot, 0, 2 * (size_t)w->model->nslot * sizeof(double));
    w->impulses.slot[2 * w->model->contact_slot[x->contact[k]]] = 2 * sum / x->size[k];
    pm_ledger_series(w, 1);
}

static void count_blows(pm_workspace *w, const pm_wedge *x, int64_t pairs)
{
    const double last = w->uniform->t0 + pm_wedge_met(x, 1, 2 * (double)pairs - 1).time;
    for (int event = 0; event < w->model->rows[PM_TABLE_EVENT]; event++) {
        const int64_t more = firings(w->model, x, event, pairs);
        if (more == 0) continue;
        w->firing.seen[event] += more;
        if (PM_EVENT_ROW(w->model, event)[PM_EVENT_NTH] != 0) continue;
        if (w->firing.count[event] >= 0 && w->firing.count[event] < PM_COUNTLESS - more)
            w->firing.count[event] += more; /* else it has no number */
        w->firing.time[event] = last;
    }
    for (int k = 0; k < 2; k++) {
        pm_bounce_series_forget(w, x->contact[k]);
        pm_integral_series_forget(w, x->contact[k]);
    }
}

/* The gap of A closes at the end of the step, and nothing else happens. */
static void mark_end(pm_workspace *w, const pm_wedge *x, double rate)
{
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        w->event->root[i] = f->kind == FUNCTION_GAP && f->index == x->contact[0];
        if (w->event->root[i]) pm_event_evidence_rate(w, i, rate);
    }
}

/* To right before the last blow at A. */
static int pass(pm_workspace *w, const pm_wedge *x, int64_t pairs)
{
    pm_uniform *u = w->uniform;
    const pm_met last = pm_wedge_met(x, 0, 2 * (double)pairs);
    add_forces(w, last.time);
    add_blows(w, x, 0, (double)(pairs - 1));
    add_blows(w, x, 1, (double)pairs);
    pm_wedge_velocity(w, x, 0, hypot(x->a, x->b),
                      u->v_look); /* as fast as what is struck becomes on the way, or faster */
    pm_case_speed(w->model, &w->numbers, u->v_look);
    count_blows(w, x, pairs);
    pm_wedge_place(w, x, &last, w->state.q);
    pm_wedge_velocity(w, x, last.a, -last.b, w->state.v);
    u->end = last.time;
    w->state.t = u->t0 + u->end;
    pm_step_set(&w->step, w->state.t, w->state.t);
    mark_end(w, x, -last.b * x->size[0]);
    u->turns.n = 1;
    u->turns.contact[0] = x->contact[1];
    pm_zeno_end(w, x->contact[0]);
    return pm_projection_near(w, &w->state);
}

int pm_turns_leap(pm_workspace *w, int contact, double flight, double t_limit, int *taken)
{
    const pm_uniform *u = w->uniform;
    pm_wedge x;
    *taken = 0;
    if (u->turns.n < PM_TURNS_ALIKE || u->begin != 0 || contact != u->turns.contact[1] || watches_motion(w) ||
        !goes_straight(w) || !read_wedge(w, flight, &x))
        return PM_OK;
    const int64_t pairs = pairs_to_pass(w, &x, t_limit - u->t0);
    *taken = pairs > 0;
    return *taken ? pass(w, &x, pairs) : PM_OK;
}
