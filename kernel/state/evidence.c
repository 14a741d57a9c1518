/* evidence.c - the log of decisions, and the margin from two of them.
 *
 * Every decision compares a number x with 0: a function of the phase that did not fire, the rate of one that did, an
 * impulse that must not pull.  Two passes of a case that differ by their errors only give x and x': the margin of the
 * decision is the smaller of both over |x - x'|.  As long as the passes decide alike their logs run in step, which the
 * history proves; near misses are seen by one pass and perhaps not by the other, and are then left out.  Where a series of
 * blows without end is over another part of the run begins, at which the passes are in step again, however many of them
 * each has seen. */
#include "state/evidence.h"

#include <math.h>

#include "elements/contact.h"
#include "events/event.h"
#include "state/route.h"
#include "state/workspace.h"
#include "study/accuracy.h"

#define NOTHING 1e-14 /* of its natural size: zero in both passes, that is by the scene's structure */
#define FIRST 2166136261u
#define PART (1 << 18)   /* numbers of instants, for each part of a run */
#define ROUNDING 2.2e-16 /* least difference, of the natural size */

static uint32_t mix(uint32_t history, uint32_t what) { return (history ^ what) * 16777619u; } /* FNV-1a */

void pm_evidence_begin(pm_evidence_log *log)
{
    log->n = 0;
    log->instant = 0;
    log->stride = 1;
    log->history = FIRST;
}

/* The log is full: from now on only every second instant of those kept so far. */
static void thin_out(pm_evidence_log *log)
{
    int n = 0;
    log->stride *= 2;
    for (int i = 0; i < log->n; i++)
        if (log->entry[i].instant % log->stride == 0) log->entry[n++] = log->entry[i];
    log->n = n;
}

static void take(pm_workspace *w, const pm_evidence_decision *decision)
{
    pm_evidence_log *log = &w->accuracy->present->log;
    while (log->n == PM_DECISIONS && log->instant % log->stride == 0 && log->stride <= log->instant)
        thin_out(log);
    if (log->n == PM_DECISIONS || log->instant % log->stride != 0) return;
    log->entry[log->n] = *decision;
    log->entry[log->n].instant = log->instant;
    log->entry[log->n++].history = log->history;
}

void pm_evidence_sign(pm_workspace *w, int site, int what, double x, double unit)
{
    if (!w->accuracy->active) return;
    take(w, &(pm_evidence_decision){.kind = PM_EVIDENCE_SIGN,
                                    .what = PM_EVIDENCE_SITES * what + site,
                                    .trigger = PM_NONE,
                                    .distance = x,
                                    .reach = fabs(x),
                                    .unit = unit});
}

/* A trigger's program is measured by its own size, all else by a natural one. */
static int trigger_of(const pm_event_function *f)
{
    return f->kind == FUNCTION_TRIGGER && !f->every ? f->index : PM_NONE;
}

void pm_evidence_rate(pm_workspace *w, int function, double rate)
{
    if (!w->accuracy->active) return;
    const pm_event_function *f = &w->event->function[function];
    take(w, &(pm_evidence_decision){.kind = PM_EVIDENCE_RATE,
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
        return fmin(w->numbers.size, pm_contact_gap(w, &w->state, f->index, &member));
    const double x = pm_event_sample(w, f);
    return f->every ? fabs(x - round(x)) : x;
}

/* On the side where its direction leads: it cannot fire however close to zero it comes back.  Where a speed is zero, what
 * watches it to fall does not fire as it rises. */
static int is_beyond(const pm_event_function *f) { return f->side * f->direction > 0; }

/* What touches takes part in a blow whether or not its own zero was found at this instant. */
static int takes_part(pm_workspace *w, const pm_event_function *f)
{
    int member;
    return f->kind == FUNCTION_GAP && pm_contact_touches(w, &w->state, f->index, &member);
}

/* Zero since the phase or the step began; what has fired in the step might have had to wait. */
static int holds(const pm_workspace *w, const pm_event_function *f)
{
    return f->held && !(f->since > w->step.begin);
}

static int did_not_fire(pm_workspace *w, int i)
{
    const pm_event_function *f = &w->event->function[i];
    const int known = f->level <= w->frame.level;
    return known && !w->event->hit[i] && !holds(w, f) && !is_beyond(f) && !takes_part(w, f);
}

void pm_evidence_instant(pm_workspace *w)
{
    if (!w->accuracy->active) return;
    pm_event_set *e = w->event;
    for (int i = 0; i < e->nfunction; i++) {
        pm_event_function *f = &e->function[i];
        pm_evidence_decision x = {.kind = PM_EVIDENCE_NEAR,
                                  .what = i,
                                  .trigger = trigger_of(f),
                                  .distance = f->near,
                                  .reach = f->near_reach,
                                  .unit = f->natural};
        if (isfinite(f->near)) take(w, &x);
        f->near = INFINITY;
        if (!did_not_fire(w, i)) continue;
        x.kind = PM_EVIDENCE_VALUE;
        x.distance = distance_of(w, f);
        if (f->kind == FUNCTION_MEETING) x.unit = w->numbers.size;
        x.reach = fabs(x.distance);
        take(w, &x);
    }
}

static int32_t part_of(const pm_evidence_decision *x) { return x->instant / PART; }

void pm_evidence_part(pm_workspace *w, int contact)
{
    if (!w->accuracy->active) return;
    pm_evidence_log *log = &w->accuracy->present->log;
    const int32_t part = log->instant / PART + 1;
    if (part > INT32_MAX / PART - 1) return;
    log->instant = part * PART;
    log->history = mix(FIRST, (uint32_t)contact);
}

void pm_evidence_close(pm_workspace *w)
{
    if (!w->accuracy->active) return;
    pm_evidence_log *log = &w->accuracy->present->log;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++)
        log->history = mix(log->history, w->event->fired[i]);
    for (int i = 0; i < w->model->nfriction; i++)
        log->history = mix(log->history, (uint32_t)w->state.friction[i]);
    for (int i = 0; i < w->model->nslot; i++) {
        log->history = mix(log->history, (uint32_t)w->state.slot[i].mode);
        if (w->state.slot[i].mode != PM_OPEN)
            log->history = mix(log->history, (uint32_t)w->state.slot[i].member);
    }
    log->instant++;
}

int pm_evidence_is_open(const pm_evidence_decision *x, double unit) { return x->reach > NOTHING * unit; }

static double margin_of(const pm_evidence_decision *x, const pm_evidence_decision *y,
                        const double *trigger_scale)
{
    if (x->kind == PM_EVIDENCE_RATE && x->in_time != y->in_time) return INFINITY;
    const double unit = x->unit * (x->trigger == PM_NONE ? 1 : trigger_scale[x->trigger]);
    const double a = fabs(x->distance), b = fabs(y->distance), apart = fabs(x->distance - y->distance);
    if (!pm_evidence_is_open(x, unit) && !pm_evidence_is_open(y, unit)) return INFINITY;
    return fmin(a, b) / fmax(apart, ROUNDING * unit);
}

static int same(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    return x->instant == y->instant && x->history == y->history && x->kind == y->kind && x->what == y->what;
}

/* Whether a function is still held at its last zero, and whether it is seen to come close, depends on the steps. */
static int may_lack(const pm_evidence_decision *x)
{
    return x->kind == PM_EVIDENCE_VALUE || x->kind == PM_EVIDENCE_NEAR;
}

/* In the order in which pm_evidence_instant takes them. */
static int comes_first(const pm_evidence_decision *x, const pm_evidence_decision *y)
{
    if (x->instant != y->instant) return x->instant < y->instant;
    return x->what != y->what ? x->what < y->what : x->kind == PM_EVIDENCE_NEAR;
}

static int next_instant(const pm_evidence_log *log, int i)
{
    const int32_t instant = log->entry[i].instant;
    while (i < log->n && log->entry[i].instant == instant) i++;
    return i;
}

static int next_part(const pm_evidence_log *log, int i)
{
    const int32_t part = part_of(&log->entry[i]);
    while (i < log->n && part_of(&log->entry[i]) == part) i++;
    return i;
}

double pm_evidence_margin(const pm_evidence_log *a, const pm_evidence_log *b, const double *trigger_scale)
{
    const int32_t stride = a->stride > b->stride ? a->stride : b->stride;
    double margin = INFINITY;
    for (int i = 0, j = 0; i < a->n && j < b->n;) {
        const pm_evidence_decision *x = &a->entry[i], *y = &b->entry[j];
        if (x->instant % stride != 0) {
            i++;
        } else if (y->instant % stride != 0) {
            j++;
        } else if (part_of(x) < part_of(y)) {
            i++;
        } else if (part_of(x) > part_of(y)) {
            j++;
        } else if (same(x, y)) {
            margin = fmin(margin, margin_of(x, y, trigger_scale));
            i++;
            j++;
        } else if (may_lack(x) && (!may_lack(y) || comes_first(x, y))) {
            i++;
        } else if (may_lack(y)) {
            j++;
        } else if (x->instant == y->instant && x->history == y->history) {
            i = next_instant(a, i); /* the same outcome by another way */
            j = next_instant(b, j);
        } else {
            i = next_part(a, i); /* from here on the passes have gone different ways */
            j = next_part(b, j);
        }
    }
    return margin;
}
