/* blows_left.c - the blows of a series after the last one that is computed.
 *
 * A contact that bounces is closed at a blow whose rebound is too low (last_bounce.c), and its series ends at a time T that is
 * known (bounce_series.c).  Its flights shrink by a ratio r, so that after a blow at t the next one is at
 *   T - (T - t) r
 * As long as an event of its blows is waited for - the end of the run, an answer at one of them, an action after so many - each is
 * an instant at its own time, as if it were computed: the contact counts as struck, though it stays closed.  When nothing waits any
 * more the blows have been countless; also where the rest of the series is within the rounding of its time, unless so many of them
 * will do.
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
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"

typedef struct pm_left {
    int held;             /* at this instant, and the time of its end is not known yet */
    double next;          /* s; INFINITY: nothing waits */
    double ratio;         /* r */
    int together;         /* blows within the rounding of the end */
    int last;             /* no other comes before the end of the series */
    double struck;        /* s, when it was struck last since it was held */
    double comes, leaves; /* parts of D with which it came then, and left, though it stayed closed */
    double impulse[2];    /* P along the normal and across, N s */
} pm_left;

struct pm_blows_left {
    pm_left *of; /* [ncontact] */
    /* of the contact that was closed last */
    double *change; /* [nq] D */
    double *joint;  /* [njoint_constraint] impulses of joints, N s */
};

int pm_blows_left_create(pm_workspace *w)
{
    if (PM_ARENA_NEW(&w->memory, w->event->left)) return PM_NO_MEMORY;
    struct pm_blows_left *x = w->event->left;
    const pm_array array[] = {
        PM_ARRAY(x->of, w->model->rows[PM_TABLE_CONTACT]),
        PM_ARRAY(x->change, w->model->nq),
        PM_ARRAY(x->joint, w->model->njoint_constraint),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

void pm_blows_left_forget(const pm_workspace *w)
{
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

static int contact_awaits(const pm_workspace *w, int contact, pm_awaits *awaits)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == contact &&
            awaits(m, &w->firing, e[PM_TRIGGER_EVENT]))
            return 1;
    }
    return 0;
}

/* ---- the series ---- */
static void lose(pm_workspace *w, int contact)
{
    w->event->left->of[contact].next = INFINITY;
    pm_trigger_lose_strikes(w, contact,
                            pm_bounce_series_is_endless(w, contact) ? PM_UNCOUNTED : PM_COUNTLESS);
}

void pm_blows_left_hold(pm_workspace *w, int contact, const double *before)
{
    struct pm_blows_left *left = w->event->left;
    pm_left *x = left->of + contact;
    const int waits = PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    if (!waits || !contact_awaits(w, contact, is_awaited)) {
        lose(w, contact);
        return;
    }
    *x = (pm_left){.held = 1, .next = INFINITY, .struck = w->state.t};
    memcpy(x->impulse, w->impulses.slot + 2 * w->model->contact_slot[contact], sizeof x->impulse);
    memcpy(left->joint, w->impulses.joint, (size_t)w->model->njoint_constraint * sizeof *left->joint);
    for (int i = 0; i < w->model->nq; i++) left->change[i] = w->state.v[i] - before[i];
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

void pm_blows_left_begin(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if (!x->held) continue;
        x->held = 0;
        x->ratio = ratio_of(w, i);
        x->leaves = pm_contact_restitution(&w->frame, i);
        const int known =
            isfinite(over(w, i)) && !pm_bounce_series_is_of_several(w, i) && x->ratio > 0 && x->ratio < 1;
        x->next = known ? after(w, i, x, w->state.t) : INFINITY;
        if (!isfinite(x->next)) lose(w, i);
    }
}

double pm_blows_left_next(const pm_workspace *w)
{
    double next = INFINITY;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) next = fmin(w->event->left->of[i].next, next);
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

static void strike(pm_workspace *w, int contact, pm_left *x)
{
    pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STRIKE, contact);
    x->comes = x->leaves;
    x->leaves *= x->ratio;
    put_impulses(w, contact, impulse_of(x));
    x->struck = w->firing.jumped = w->state.t;
    x->next = after(w, contact, x, x->next);
    x->last = !isfinite(x->next);
    if (x->last) x->next = over(w, contact);
}

int pm_blows_left_strike(pm_workspace *w)
{
    int any = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if (x->next > w->state.t) continue;
        any = 1;
        if (!x->last && goes_on(w, i) && contact_awaits(w, i, is_awaited)) {
            strike(w, i, x);
            continue;
        }
        lose(w, i);
        pm_evidence_part(&w->evidence, i);
    }
    return any;
}

/* ---- what is left out ---- */
static double value_with(pm_workspace *w, int program, double factor)
{
    const double *change = w->event->left->change;
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] += factor * change[i];
    const double value = pm_program_run(w, program);
    for (int i = 0; i < w->model->nq; i++) w->frame.velocity[i] = w->state.v[i];
    return value;
}

/* At the closing blow it leaves with more than was computed; a later one is not computed at all. */
static double error_of(pm_workspace *w, int contact, const pm_left *x, int program, int before)
{
    const double value = pm_program_run(w, program);
    if (!before) put_impulses(w, contact, x->comes > 0 ? 0 : 1 + x->leaves);
    const double there = value_with(w, program, before ? -x->comes : x->leaves);
    put_impulses(w, contact, impulse_of(x));
    return fabs(there - value);
}

double pm_blows_left_error(pm_workspace *w, int program, int before)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT] && w->evidence.active; i++) {
        const pm_left *x = w->event->left->of + i;
        if (x->struck == w->state.t) sum += error_of(w, i, x, program, before);
    }
    return isfinite(sum) ? PM_BLOWS_LEFT_SURE * sum : 0;
}
