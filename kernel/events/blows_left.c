/* blows_left.c - the blows of a series after the last one that is computed.
 *
 * A contact that bounces is closed at a blow whose rebound is too low (last_bounce.c), and its series ends at a time T that is
 * known (bounce_series.c).  Its flights shrink by a ratio r, so that after a blow at t the next one is at
 *   T - (T - t) r
 * What has fired in each of the last flights goes on to do so at the same parts of those to come (flight_firings.c).
 * As long as one of these events is waited for - the end of the run, an answer at one of them, an action after so many - each blow and
 * each firing is an instant at its own time, as if it were computed: the contact counts as struck, though it stays closed.  When
 * nothing waits any more they are counted at the instants that come by the way, and countless when the series is over; also where the
 * rest of it is within the rounding of its time, unless so many of them will do.
 *
 * The closing blow changed velocities by D, and P was its impulse.  It would have left with e D, e the restitution: by that much more
 * than it did.  Those that are left come with what the last one left with, and leave with r times that, which are parts of D; the
 * sum of both is the impulse, as a part of P.  So much is left out of what is asked at such a blow, and is added to its error. */
#include "events/blows_left.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "events/awaited.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "events/flight_firings.h"
#include "events/left_out.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"

typedef struct pm_left {
    int held;            /* at this instant, and the time of its end is not known yet */
    double next;         /* s, of a blow or a firing; INFINITY: none is known */
    int counted;         /* nothing waits for it any more */
    double blow, flight; /* s: the last blow, and how long the flight takes that begins with it */
    int nfiring, at;     /* firings of a flight, and the next one of this flight */
    pm_flight_firing firing[PM_FIRINGS_MOST];
    double ratio;         /* r */
    int together;         /* blows within the rounding of the end */
    int last;             /* no other comes before the end of the series */
    double struck;        /* s, when it was struck last since it was held */
    double comes, leaves; /* parts of D with which it came then, and left, though it stayed closed */
    double impulse[2];    /* P along the normal and across, N s */
} pm_left;

struct pm_blows_left {
    pm_left *of; /* [ncontact] */
    pm_left_out *out;
    double *joint; /* [njoint_constraint] impulses of joints at the blow that closed a contact last, N s */
};

int pm_blows_left_create(pm_workspace *w)
{
    if (PM_ARENA_NEW(&w->memory, w->event->left)) return PM_NO_MEMORY;
    struct pm_blows_left *x = w->event->left;
    const pm_array array[] = {
        PM_ARRAY(x->of, w->model->rows[PM_TABLE_CONTACT]),
        PM_ARRAY(x->joint, w->model->njoint_constraint),
    };
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    return status ? status : pm_left_out_create(w, &x->out);
}

void pm_blows_left_forget(const pm_workspace *w)
{
    pm_left_out_forget(w->event->left->out);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        w->event->left->of[i] = (pm_left){.next = INFINITY, .struck = NAN};
}

/* ---- who waits ---- */
typedef int pm_awaits(const pm_model *model, const pm_firing *firing, int event);

/* So many of the event will do; the n-th of something is an event of its own, which somebody has named. */
static int is_counted_to(const pm_model *m, const pm_firing *firing, int event)
{
    const int nth = PM_EVENT_ROW(m, event)[PM_EVENT_NTH];
    if (firing->count[event] < 0 || firing->count[event] >= PM_COUNTLESS) return 0;
    return nth > 0 ? firing->seen[event] < nth : pm_awaited_nth(m, firing, event, INT64_MAX);
}

/* Or all that can be told; what waits for a condition on counts does not say for how many. */
static int is_awaited(const pm_model *m, const pm_firing *firing, int event)
{
    if (firing->count[event] < 0 || firing->count[event] >= PM_COUNTLESS) return 0;
    return is_counted_to(m, firing, event) || m->programs.wait_for_counts || m->programs.watch_counts ||
           pm_awaited(m, firing, event, INT64_MAX);
}

static int is_strike(const pm_model *m, int trigger, int contact)
{
    const int32_t *e = PM_TRIGGER_ROW(m, trigger);
    return e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == contact;
}

static int event_of(const pm_model *m, int trigger) { return PM_TRIGGER_ROW(m, trigger)[PM_TRIGGER_EVENT]; }

static int contact_awaits(const pm_workspace *w, int contact, pm_awaits *awaits)
{
    const pm_model *m = w->model;
    const pm_left *x = w->event->left->of + contact;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (is_strike(m, i, contact) && awaits(m, &w->firing, event_of(m, i))) return 1;
    for (int i = 0; i < x->nfiring; i++)
        if (awaits(m, &w->firing, event_of(m, x->firing[i].trigger))) return 1;
    return 0;
}

/* ---- the series ---- */
static void lose(pm_workspace *w, int contact)
{
    pm_left *x = w->event->left->of + contact;
    const int endless = pm_bounce_series_is_endless(w, contact);
    x->next = INFINITY;
    x->counted = 0;
    pm_trigger_lose_strikes(w, contact, endless ? PM_UNCOUNTED : PM_COUNTLESS);
    for (int i = 0; i < x->nfiring; i++)
        (endless ? pm_trigger_uncounted : pm_trigger_countless)(
            w->model, &w->firing, event_of(w->model, x->firing[i].trigger), w->state.t);
}

void pm_blows_left_hold(pm_workspace *w, int contact, const double *before)
{
    struct pm_blows_left *left = w->event->left;
    pm_left *x = left->of + contact;
    *x = (pm_left){.held = 1, .next = INFINITY, .struck = w->state.t};
    memcpy(x->impulse, w->impulses.slot + 2 * w->model->contact_slot[contact], sizeof x->impulse);
    memcpy(left->joint, w->impulses.joint, (size_t)w->model->njoint_constraint * sizeof *left->joint);
    pm_left_out_hold(left->out, &w->state, contact, before);
}

/* Where it has not settled the ratio of its last two flights tells, but not less than restitution, as of the time that is left. */
static double ratio_of(const pm_workspace *w, int contact)
{
    const pm_bounce_series *x = &w->event->series[contact];
    const double e = pm_contact_restitution(&w->frame, contact), *t = x->struck;
    if (x->ratio > 0) return x->ratio;
    return x->own > 2 ? fmax(e, (t[0] - t[1]) / (t[1] - t[2])) : e;
}

static double over(const pm_workspace *w, int contact) { return w->event->series[contact].over; }

/* The blow after one at t.  Within the rounding of the end they are at one time: as many as are counted to; INFINITY: none are. */
static double after(const pm_workspace *w, int contact, pm_left *x, double t)
{
    const double left = over(w, contact) - t;
    if (left > PM_TIME_TOGETHER * fabs(t)) return t + left * (1 - x->ratio);
    return contact_awaits(w, contact, is_counted_to) && x->together++ < PM_BLOWS_LEFT_TOGETHER ? t : INFINITY;
}

/* What fires in each flight.  Of what the last ones will not reach nobody knows how often it still fires. */
static void find_firings(pm_workspace *w, int contact, pm_left *x)
{
    pm_flight_firing found[PM_FIRINGS_MOST];
    const int n = pm_flight_firings_find(w, contact, found);
    x->nfiring = 0;
    for (int i = 0; i < n; i++) {
        if (pm_flight_firings_last(w, found[i].trigger))
            x->firing[x->nfiring++] = found[i];
        else
            pm_trigger_uncounted(w->model, &w->firing, event_of(w->model, found[i].trigger), w->state.t);
    }
}

/* What fires as a flight begins. */
static int fires_at_blow(const pm_left *x, int i) { return i < x->nfiring && x->firing[i].phase == 0; }

static void begin_flight(const pm_workspace *w, int contact, pm_left *x, double t)
{
    x->blow = t;
    x->flight = fmax(over(w, contact) - t, 0) * (1 - x->ratio);
    for (x->at = 0; fires_at_blow(x, x->at);) x->at++;
}

/* The next firing of this flight, or the blow that ends it: then all is over where none is known to come. */
static void find_next(const pm_workspace *w, int contact, pm_left *x)
{
    x->next =
        x->at < x->nfiring ? x->blow + x->firing[x->at].phase * x->flight : after(w, contact, x, x->blow);
    x->last = !isfinite(x->next);
}

/* Nothing waits any more: from here on passes are in step that have followed other numbers of blows. */
static void count_only(pm_workspace *w, int contact, pm_left *x)
{
    x->counted = 1;
    pm_evidence_part(&w->evidence, contact);
}

void pm_blows_left_begin(pm_workspace *w)
{
    const int waits = PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if (!x->held) continue;
        x->held = 0;
        x->ratio = ratio_of(w, i);
        x->leaves = pm_contact_restitution(&w->frame, i);
        find_firings(w, i, x);
        const int known = waits && isfinite(over(w, i)) && !pm_bounce_series_is_of_several(w, i) &&
                          x->ratio > 0 && x->ratio < 1;
        if (known) begin_flight(w, i, x, w->state.t);
        if (known) find_next(w, i, x);
        if (!known || x->last) {
            lose(w, i);
            continue;
        }
        for (int k = 0; fires_at_blow(x, k); k++) w->firing.fired[x->firing[k].trigger] = PM_FIRED_NOW;
        if (!contact_awaits(w, i, is_awaited)) count_only(w, i, x);
    }
}

double pm_blows_left_next(const pm_workspace *w)
{
    double next = INFINITY;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++)
        if (!w->event->left->of[i].counted) next = fmin(w->event->left->of[i].next, next);
    return next;
}

/* It still stands closed, and has not been struck otherwise since. */
static int goes_on(const pm_workspace *w, int contact)
{
    return isfinite(over(w, contact)) && w->state.slot[w->model->contact_slot[contact]].mode != PM_OPEN;
}

/* Of this instant's blow, as a part of P. */
static double impulse_of(const pm_left *x) { return x->comes > 0 ? x->comes + x->leaves : 1; }

static void put_impulses(pm_workspace *w, int contact, double part)
{
    const struct pm_blows_left *left = w->event->left;
    double *slot = w->impulses.slot + 2 * w->model->contact_slot[contact];
    for (int k = 0; k < 2; k++) slot[k] = part * left->of[contact].impulse[k];
    for (int i = 0; i < w->model->njoint_constraint; i++) w->impulses.joint[i] = part * left->joint[i];
}

/* What fires in a flight, or at a blow the contact and what fires then. */
static void strike(pm_workspace *w, int contact, pm_left *x)
{
    unsigned char *fired = w->firing.fired;
    if (x->at < x->nfiring) {
        fired[x->firing[x->at++].trigger] = PM_FIRED_NOW;
    } else {
        pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STRIKE, contact);
        x->comes = x->leaves;
        x->leaves *= x->ratio;
        put_impulses(w, contact, impulse_of(x));
        x->struck = w->firing.jumped = w->state.t;
        begin_flight(w, contact, x, x->next);
        for (int k = 0; k < x->at; k++) fired[x->firing[k].trigger] = PM_FIRED_NOW;
    }
    find_next(w, contact, x);
    if (x->last) x->next = over(w, contact);
}

/* ---- those that nothing waits for ---- */
/* An event that several triggers fire at once happens once. */
static void count_firings(pm_workspace *w, const pm_left *x, int first, int last, int other)
{
    for (int k = first; k < last; k++) {
        const int event = event_of(w->model, x->firing[k].trigger);
        int before = other == event;
        for (int i = first; i < k; i++) before |= event_of(w->model, x->firing[i].trigger) == event;
        if (!before) pm_trigger_count_earlier(w->model, &w->firing, event, x->next);
        w->firing.jumped = x->next;
    }
}

static void count_blow(pm_workspace *w, int contact, const pm_left *x)
{
    int strikes = PM_NONE;
    for (int i = 0; i < w->model->rows[PM_TABLE_TRIGGER]; i++) {
        if (!is_strike(w->model, i, contact)) continue;
        strikes = event_of(w->model, i);
        pm_trigger_count_earlier(w->model, &w->firing, strikes, x->next);
        w->firing.jumped = x->next;
    }
    count_firings(w, x, 0, x->at, strikes);
}

/* Where no event counts it nobody asks whether it came before a time of the scene. */
static void count(pm_workspace *w, int contact, pm_left *x)
{
    if (x->at < x->nfiring) {
        count_firings(w, x, x->at, x->at + 1, PM_NONE);
        x->at++;
    } else {
        begin_flight(w, contact, x, x->next);
        count_blow(w, contact, x);
    }
    find_next(w, contact, x);
}

void pm_blows_left_count(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        while (x->counted && goes_on(w, i) && x->next <= w->state.t) count(w, i, x);
    }
}

int pm_blows_left_strike(pm_workspace *w)
{
    int any = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if ((x->counted ? over(w, i) : x->next) > w->state.t) continue;
        any = 1;
        if (!x->counted && !x->last && goes_on(w, i)) {
            if (contact_awaits(w, i, is_awaited))
                strike(w, i, x);
            else
                count_only(w, i, x);
            continue;
        }
        if (!x->counted) pm_evidence_part(&w->evidence, i);
        lose(w, i);
    }
    return any;
}

/* ---- what is left out ---- */
static double value_with(pm_workspace *w, int program, const double *change, double factor)
{
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] += factor * change[i];
    const double value = pm_program_run(w, program);
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] = w->state.v[i];
    return value;
}

/* At the closing blow it leaves with more than was computed; a later one is not computed at all. */
static double error_of(pm_workspace *w, int contact, const pm_left *x, int program, int before)
{
    const double value = pm_program_run(w, program),
                 *change = pm_left_out_change(w->event->left->out, contact);
    if (!change) return 0;
    if (!before) put_impulses(w, contact, x->comes > 0 ? 0 : 1 + x->leaves);
    const double there = value_with(w, program, change, before ? -x->comes : x->leaves);
    put_impulses(w, contact, impulse_of(x));
    return fabs(there - value);
}

double pm_blows_left_error(pm_workspace *w, int program, int before)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT] && w->evidence.active; i++) {
        const pm_left *x = w->event->left->of + i;
        if (x->struck == w->frame.t)
            sum += error_of(w, i, x, program, before);
        else if (goes_on(w, i))
            sum += pm_left_out_error(w, w->event->left->out, i, over(w, i), x->ratio, program);
    }
    return isfinite(sum) ? PM_BLOWS_LEFT_SURE * sum : 0;
}
