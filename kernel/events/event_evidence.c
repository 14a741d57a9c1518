/* event_evidence.c - distances of event functions from their zeros at an instant, for the log of decisions. */
#include "events/event_search.h"

#include <math.h>

#include "elements/contact.h"
#include "state/evidence.h"
#include "state/route.h"
#include "state/workspace.h"

/* A trigger's program is measured by its own size, all else by a natural one. */
static int trigger_of(const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER && !f->every ? f->index : PM_NONE;
}

void pm_event_evidence_rate(pm_workspace *w, int function, double rate)
{
    if (!w->evidence.active) return;
    const pm_event_function *f = &w->event->function[function];
    pm_evidence_take(&w->evidence,
                     &(pm_evidence_decision){.kind = PM_EVIDENCE_RATE,
                                             .what = function,
                                             .in_time = w->phase.route->in_time,
                                             .trigger = trigger_of(f),
                                             .distance = rate,
                                             .reach = INFINITY,
                                             .unit = f->natural * w->numbers.speed / w->numbers.size});
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

/* Zero since the phase or the step began; what has fired in the step might have had to wait. */
static int holds(const pm_step *step, const pm_event_function *f)
{
    return f->held && !(f->since > step->begin);
}

static int did_not_fire(const pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    const int known = f->level <= w->frame.level;
    return known && !w->event->hit[i] && !holds(&w->step, f) && !is_beyond(f) &&
           !takes_part(&w->frame, &w->state, f);
}

void pm_event_evidence_instant(pm_workspace *w)
{
    if (!w->evidence.active) return;
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        pm_evidence_decision x = {.kind = PM_EVIDENCE_NEAR,
                                  .what = i,
                                  .trigger = trigger_of(f),
                                  .distance = f->near,
                                  .reach = f->near_reach,
                                  .unit = f->natural};
        if (isfinite(f->near)) pm_evidence_take(&w->evidence, &x);
        f->near = INFINITY;
        if (!did_not_fire(w, i)) continue;
        x.kind = PM_EVIDENCE_VALUE;
        x.distance = distance_of(w, f);
        if (f->kind == FUNCTION_MEETING || f->kind == FUNCTION_STRAND) x.unit = w->numbers.size;
        x.reach = fabs(x.distance);
        pm_evidence_take(&w->evidence, &x);
    }
}

void pm_event_evidence_close(pm_workspace *w)
{
    if (!w->evidence.active) return;
    pm_evidence_log *log = &w->evidence.present->log;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) pm_evidence_mix(log, w->firing.fired[i]);
    for (int i = 0; i < w->model->nfriction; i++) pm_evidence_mix(log, (uint32_t)w->state.friction[i]);
    for (int i = 0; i < w->model->nslot; i++) {
        pm_evidence_mix(log, (uint32_t)w->state.slot[i].mode);
        if (w->state.slot[i].mode != PM_OPEN) pm_evidence_mix(log, (uint32_t)w->state.slot[i].member);
    }
    log->instant++;
}
