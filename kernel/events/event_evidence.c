/* event_evidence.c - distances of event functions from their zeros at an instant, for the log of decisions. */
#include "events/event_evidence.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/trigger.h"
#include "equations/shared_loads.h"
#include "events/last_bounce.h"
#include "events/track.h"
#include "numerics/tolerances.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

/* What is noted after all functions of a phase, and before jumps of triggers (elements/trigger.c). */
#define AFTER_FUNCTIONS (INT32_MAX / 2)

/* A trigger's program is measured by its own size, all else by a natural one. */
static int trigger_of(const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER && !f->every ? f->index : PM_NONE;
}

/* Whose function it is; of triggers the log itself knows that. */
static pm_evidence_decision of_function(const pm_model *m, const pm_event_function *f)
{
    pm_evidence_decision x = {.trigger = trigger_of(f)};
    x.table = pm_event_owner(m, f, &x.row);
    return x;
}

static int is_at_knot(const pm_workspace *w, const pm_event_function *f)
{
    if (f->kind == FUNCTION_TRACK) return !pm_track_is_at_end(&w->frame, f->index);
    return f->kind == FUNCTION_END &&
           pm_contact_curve_is_at_knot(&w->frame, f->index, w->state.slot[f->index].member);
}

/* Where a force switches, or a table or a curve goes on by its next piece, the motion tells all that it decides. */
static int is_of_force(const pm_workspace *w, const pm_event_function *f)
{
    if (f->kind != FUNCTION_TRIGGER) return is_at_knot(w, f);
    return pm_trigger_of_switch(w->model, f->index) || pm_trigger_is_of_piece(w->model, f->index);
}

static int is_on_time(const pm_model *m, const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER && pm_trigger_on_time(m, f->index);
}

/* A time of the scene comes whether the motion turns back there or not. */
static int is_no_decision(const pm_workspace *w, const pm_event_function *f)
{
    return is_of_force(w, f) || is_on_time(w->model, f);
}

void pm_event_evidence_rate(pm_workspace *w, int function, double rate)
{
    const pm_event_function *f = &w->event->function[function];
    if (!w->evidence.active || is_no_decision(w, f)) return;
    pm_evidence_decision x = of_function(w->model, f);
    x.kind = PM_EVIDENCE_RATE;
    x.what = function;
    x.in_time = w->phase.route->in_time;
    x.distance = rate;
    x.reach = INFINITY;
    x.unit = f->natural * w->numbers.speed / w->numbers.size;
    pm_evidence_take(&w->evidence, &x);
}

/* Of a function at the frame from its zero, `every` from the nearest multiple; of points that may meet, from each other. */
static double distance_of(pm_workspace *w, const pm_event_function *f)
{
    int member;
    if (f->kind == FUNCTION_MEETING)
        return fmin(w->numbers.size, pm_contact_gap(&w->frame, &w->state, f->index, &member));
    double nothing;
    if (f->kind == FUNCTION_STRAND) return pm_event_strand_left(w, f->index, &nothing);
    const double x = pm_event_sample(w, f);
    return f->every ? fabs(x - round(x)) : x;
}

/* On the side where its direction leads: it cannot fire however close to zero it comes back.  Where a speed is zero, what
 * watches it to fall does not fire as it rises. */
static int is_beyond(const pm_event_function *f) { return f->side * f->direction > 0; }

/* What touches takes part in a blow whether or not its own zero was found at this instant. */
static int takes_part(const pm_frame *frame, const pm_state *state, const pm_event_function *f)
{
    int member;
    return f->kind == FUNCTION_GAP && pm_contact_touches(frame, state, f->index, &member);
}

/* What stands at the end of an edge leaves it as far beyond as counts as touching: a little later, whatever the errors. */
static int is_at_end(const pm_frame *frame, const pm_event_function *f, double distance)
{
    return f->kind == FUNCTION_END && fabs(distance) <= 2 * pm_contact_length(frame);
}

/* Zero since the phase or the step began; what has fired in the step might have had to wait. */
static int holds(const pm_step *step, const pm_event_function *f)
{
    return f->held && !(f->since > step->begin);
}

/* Late in a series of blows, or at rest beside something: closed or not, the motion is the same. */
static int meets_slowly(const pm_workspace *w, const pm_event_function *f)
{
    int member;
    double rate;
    if (f->kind != FUNCTION_GAP) return 0;
    pm_contact_gap(&w->frame, &w->state, f->index, &member);
    if (member == PM_NONE) return 0;
    pm_contact_member_gap(&w->frame, f->index, member, &rate);
    return pm_last_bounce_is_near(w, f->index, rate);
}

static int did_not_fire(const pm_workspace *w, int i, int marks)
{
    const pm_event_function *f = &w->event->function[i];
    const int known = f->level <= w->frame.level;
    if (is_of_force(w, f)) return 0;
    return known && !w->event->hit[i] && !holds(&w->step, f) && !is_beyond(f) &&
           (marks || !takes_part(&w->frame, &w->state, f));
}

/* ---- times of the scene and jumps ---- */
/* What touches may have been met although its own zero was not found. */
int pm_event_evidence_located(const pm_workspace *w)
{
    if (!w->evidence.active) return 0;
    for (int i = 0; i < w->event->nfunction; i++) {
        const pm_event_function *f = &w->event->function[i];
        if ((w->event->hit[i] && !is_no_decision(w, f)) || takes_part(&w->frame, &w->state, f)) return 1;
    }
    return 0;
}

/* What is answered at a time of the scene depends on whether the last jump came before it: nobody knows where that is rounding. */
static void take_time_since_jump(pm_workspace *w)
{
    const double natural = w->numbers.size / w->numbers.speed;
    if (w->state.t - w->firing.jumped <= PM_TIME_ROUNDING * w->state.t)
        pm_evidence_ties(&w->evidence, w->state.t);
    pm_evidence_take(&w->evidence, &(pm_evidence_decision){.kind = PM_EVIDENCE_VALUE,
                                                           .what = AFTER_FUNCTIONS,
                                                           .trigger = PM_NONE,
                                                           .table = PM_NONE,
                                                           .distance = w->state.t - w->firing.jumped,
                                                           .reach = INFINITY,
                                                           .unit = fmax(natural, fabs(w->state.t))});
}

void pm_event_evidence_jump(pm_workspace *w)
{
    w->firing.jumped = w->state.t;
    if (pm_trigger_time_is_due(w)) pm_evidence_ties(&w->evidence, w->state.t);
}

/* ---- an instant ---- */
/* Next to touching a distance may go with what counts as touching, of which a coarse run takes so many times more; 0 elsewhere. */
static double touching_of(const pm_workspace *w, const pm_event_function *f, double distance)
{
    const int by_length = f->kind == FUNCTION_GAP || f->kind == FUNCTION_END;
    if (!by_length || fabs(distance) > PM_BESIDE_TOUCHING * pm_contact_length(&w->frame)) return 0;
    return w->numbers.coarse;
}

/* How near the function came to zero without firing, since the last instant. */
static void take_nearest(pm_workspace *w, int i)
{
    pm_event_function *f = &w->event->function[i];
    const double near = f->near;
    f->near = INFINITY;
    if (!isfinite(near)) return;
    pm_evidence_decision x = of_function(w->model, f);
    x.kind = PM_EVIDENCE_NEAR;
    x.what = i;
    x.distance = near;
    x.touching = touching_of(w, f, near);
    x.reach = f->near_reach;
    x.unit = f->natural;
    pm_evidence_take(&w->evidence, &x);
}

/* Nothing happens but that the motion reverses: what comes at a time may come before that or after. */
static int only_reverses(const pm_workspace *w)
{
    int any = !w->step.reverses;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) any |= w->firing.fired[i] != 0;
    for (int i = 0; i < w->event->nfunction; i++) any |= w->event->hit[i];
    return !any;
}

/* It has gone through zero in the step unseen: the dense output told the order of two zeros otherwise than exact states do.  Neither
 * the side on which the step began nor the one where it was left since it fired is its side now. */
static int has_passed(const pm_event_function *f, double distance)
{
    if (f->kind != FUNCTION_TRIGGER || f->every || f->held || (f->side == 0 && f->left == 0)) return 0;
    return (f->side == 0 || pm_event_way_crosses(f, f->side, distance)) &&
           (f->left == 0 || pm_event_way_crosses(f, f->left, distance));
}

/* What the error of the time makes of the distance, where the route knows that. */
static double error_of(pm_workspace *w, const pm_event_function *f, double distance)
{
    const pm_route_ops *route = w->phase.route;
    const double by = route->beside ? route->beside(w, f->level, is_on_time(w->model, f)) : 0;
    if (by == 0) return 0;
    const double changed = distance_of(w, f);
    route->back(w);
    return by * fabs(changed - distance);
}

/* What several contacts share pushes them as much as one likes, as between two walls: what is told of it is a measure of forces. */
static int has_no_bound(pm_workspace *w, const pm_event_function *f)
{
    double slack;
    if (f->kind != FUNCTION_NORMAL && f->kind != FUNCTION_STICK) return 0;
    return w->active.nredundant > 0 && pm_shared_slack(w, f->index, &slack) &&
           !pm_shared_is_bounded(w, f->index, &slack);
}

/* How far it is from zero now, if it has not fired. */
static void take_value(pm_workspace *w, int i, int marks)
{
    const pm_event_function *f = &w->event->function[i];
    if (!did_not_fire(w, i, marks) || meets_slowly(w, f) || has_no_bound(w, f)) return;
    if (is_on_time(w->model, f) && only_reverses(w)) return;
    pm_evidence_decision x = of_function(w->model, f);
    x.kind = PM_EVIDENCE_VALUE;
    x.what = i;
    x.distance = distance_of(w, f);
    if (is_at_end(&w->frame, f, x.distance)) return;
    x.unit = f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND ? w->numbers.size : f->natural;
    x.touching = touching_of(w, f, x.distance);
    x.reach = f->every ? 1 : fabs(x.distance); /* a multiple that it is on holds it */
    x.error = error_of(w, f, x.distance);
    if (x.error > 0 && has_passed(f, x.distance)) pm_evidence_ties(&w->evidence, w->state.t);
    pm_evidence_take(&w->evidence, &x);
}

void pm_event_evidence_instant(pm_workspace *w, int marks)
{
    if (!w->evidence.active) return;
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        take_nearest(w, i);
        take_value(w, i, marks);
    }
    if (isfinite(w->firing.jumped) && pm_trigger_time_is_due(w)) take_time_since_jump(w);
}

/* Next to which node a foot on a curve is says nothing; at which end it is does. */
static uint32_t member_that_counts(const pm_workspace *w, int slot)
{
    const int member = w->state.slot[slot].member, contact = pm_contact_of_slot(w->model, slot);
    return (uint32_t)(pm_contact_curve_is(w->model, contact)
                          ? pm_contact_curve_outcome(w->model, contact, member)
                          : member);
}

void pm_event_evidence_close(pm_workspace *w)
{
    if (!w->evidence.active) return;
    pm_evidence_log *log = &w->evidence.present->log;
    pm_evidence_date(log, w->state.t);
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) pm_evidence_mix(log, w->firing.fired[i]);
    for (int i = 0; i < w->model->nfriction; i++) pm_evidence_mix(log, (uint32_t)w->state.friction[i]);
    for (int i = 0; i < w->model->nslot; i++) {
        pm_evidence_mix(log, (uint32_t)w->state.slot[i].mode);
        if (w->state.slot[i].mode != PM_OPEN) pm_evidence_mix(log, member_that_counts(w, i));
    }
    log->instant++;
}

/* ---- what a decision is about ---- */
_Static_assert(PM_DECISION_STRIKES + PM_SITE_SHARES == PM_DECISION_SHARES,
               "sites are decisions in this order");

static pm_where where_of(const pm_model *m, const pm_evidence_decision *x)
{
    const int decision = x->kind == PM_EVIDENCE_RATE ? PM_DECISION_REVERSES : PM_DECISION_HAPPENS;
    if (x->kind == PM_EVIDENCE_SIGN) {
        const int site = x->what % PM_EVIDENCE_SITES, of = x->what / PM_EVIDENCE_SITES;
        const int by_slot = site != PM_SITE_STRIKES && site != PM_SITE_PARTS && site != PM_SITE_MEETS;
        const int contact = by_slot ? pm_contact_of_slot(m, of) : of;
        return (pm_where){PM_TABLE_CONTACT, contact, PM_DECISION_STRIKES + site, 0, 0};
    }
    if (x->trigger != PM_NONE)
        return (pm_where){PM_TABLE_EVENT, PM_TRIGGER_ROW(m, x->trigger)[PM_TRIGGER_EVENT], decision, 0, 0};
    if (x->table == PM_NONE) return (pm_where){PM_NONE, PM_NONE, PM_DECISION_ORDER, 0, 0};
    return (pm_where){x->table, x->row, decision, 0, 0};
}

pm_where pm_event_evidence_where(const pm_model *model, const pm_closest *closest, double *t)
{
    const pm_evidence_decision trigger = {.kind = PM_EVIDENCE_NEAR, .trigger = closest->trigger};
    *t = closest->decision ? closest->decision->t : NAN;
    if (closest->decision) return where_of(model, closest->decision);
    if (closest->trigger != PM_NONE) return where_of(model, &trigger);
    return (pm_where){PM_NONE, PM_NONE, PM_DECISION_OUTCOME, 0, 0};
}
