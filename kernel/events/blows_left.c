/* blows_left.c - the blows of a series after the last one that is computed.
 *
 * A contact that bounces is closed at a blow whose rebound is too low (last_bounce.c), and its series ends at a time T that is
 * known (bounce_series.c).  Its flights shrink by a ratio r, so that after a blow at t the next one is at
 *   T - (T - t) r
 * As long as an event of its blows is waited for - the end of the run, an answer at one of them, an action after so many - each is
 * an instant at its own time, as if it were computed: the contact counts as struck, though it stays closed.  When nothing waits any
 * more, or the rest of the series is within the rounding of its time, the blows have been countless.
 *
 * What the closing blow changed, D in velocities and P in impulse, is what blow k of those that are left would change to come to
 * rest, times r^k: it comes with -r^k D and leaves with r^(k+1) D, by an impulse r^k (1 + r) P.  That much is left out of what is
 * asked there, and is added to its error. */
#include "events/blows_left.h"

#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "elements/trigger.h"
#include "events/ask.h"
#include "events/bounce_series.h"
#include "events/event.h"
#include "expression/program.h"
#include "numerics/tolerances.h"
#include "state/arena.h"
#include "state/evidence.h"
#include "state/workspace.h"

typedef struct pm_left {
    int held;          /* at this instant, and the time of its end is not known yet */
    double next;       /* s; INFINITY: nothing waits */
    double ratio;      /* r */
    double share;      /* r^k of the blow at `struck` */
    double struck;     /* s, the last of them */
    double impulse[2]; /* P along the normal and across, N s */
} pm_left;

struct pm_blows_left {
    pm_left *of;    /* [ncontact] */
    double *change; /* [nq] D of the contact that was closed last */
};

int pm_blows_left_create(pm_workspace *w)
{
    if (PM_ARENA_NEW(&w->memory, w->event->left)) return PM_NO_MEMORY;
    struct pm_blows_left *x = w->event->left;
    const pm_array array[] = {
        PM_ARRAY(x->of, w->model->rows[PM_TABLE_CONTACT]),
        PM_ARRAY(x->change, w->model->nq),
    };
    return pm_arena_take(&w->memory, PM_ARRAYS(array));
}

static void forget(pm_left *x) { *x = (pm_left){.next = INFINITY, .struck = NAN}; }

void pm_blows_left_forget(const pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) forget(w->event->left->of + i);
}

/* ---- who waits ---- */
/* The n-th of something is an event of its own, which somebody has named; what is told by counts is not known before it is so. */
static int is_awaited(const pm_model *m, const pm_firing *firing, int event)
{
    const int nth = PM_EVENT_ROW(m, event)[PM_EVENT_NTH];
    if (firing->count[event] < 0 || firing->count[event] >= PM_COUNTLESS) return 0;
    if (nth > 0) return firing->seen[event] < nth;
    return m->programs.wait_for_counts || m->programs.watch_counts ||
           pm_ask_awaits(m, firing, event, INT64_MAX);
}

static int contact_is_awaited(const pm_workspace *w, int contact)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (e[PM_TRIGGER_KIND] == PM_TRIGGER_STRIKE && e[PM_TRIGGER_A] == contact &&
            is_awaited(m, &w->firing, e[PM_TRIGGER_EVENT]))
            return 1;
    }
    return 0;
}

/* ---- the series ---- */
static void lose(pm_workspace *w, int contact)
{
    forget(w->event->left->of + contact);
    pm_trigger_lose_strikes(w, contact,
                            pm_bounce_series_is_endless(w, contact) ? PM_UNCOUNTED : PM_COUNTLESS);
}

void pm_blows_left_hold(pm_workspace *w, int contact, const double *before)
{
    struct pm_blows_left *left = w->event->left;
    pm_left *x = left->of + contact;
    const int waits = PM_SETTING(w->model, PM_SETTING_ROUTE) != PM_ROUTE_PATH;
    if (!waits || !contact_is_awaited(w, contact)) {
        lose(w, contact);
        return;
    }
    forget(x);
    x->held = 1;
    memcpy(x->impulse, w->impulses.slot + 2 * w->model->contact_slot[contact], sizeof x->impulse);
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

/* The blow after one at t, if that is not within the rounding of the end. */
static double after(const pm_workspace *w, int contact, double ratio, double t)
{
    const double left = over(w, contact) - t;
    return left > PM_TIME_TOGETHER * fabs(t) ? t + left * (1 - ratio) : INFINITY;
}

void pm_blows_left_begin(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if (!x->held) continue;
        x->held = 0;
        x->share = 1;
        x->ratio = ratio_of(w, i);
        const int known = isfinite(over(w, i)) && !pm_bounce_series_is_of_several(w, i) &&
                          x->ratio > 0 && x->ratio < 1;
        x->next = known ? after(w, i, x->ratio, w->state.t) : INFINITY;
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
    return isfinite(over(w, contact)) &&
           w->state.slot[w->model->contact_slot[contact]].mode != PM_OPEN;
}

static void strike(pm_workspace *w, int contact, pm_left *x)
{
    pm_trigger_mark(w->model, &w->firing, PM_TRIGGER_STRIKE, contact);
    x->share *= x->ratio;
    x->struck = w->firing.jumped = w->state.t;
    x->next = after(w, contact, x->ratio, x->next);
    if (isfinite(x->next)) return;
    x->next = over(w, contact);
    x->ratio = 0;
}

int pm_blows_left_strike(pm_workspace *w)
{
    int any = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        pm_left *x = w->event->left->of + i;
        if (x->next > w->state.t) continue;
        any = 1;
        if (x->ratio > 0 && goes_on(w, i) && contact_is_awaited(w, i)) {
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

static void put_impulse(const pm_workspace *w, int contact, const double impulse[2], double factor)
{
    double *slot = w->impulses.slot + 2 * w->model->contact_slot[contact];
    for (int k = 0; k < 2; k++) slot[k] = factor * impulse[k];
}

static double error_of(pm_workspace *w, int contact, const pm_left *x, int program)
{
    const double kept[2] = {w->impulses.slot[2 * w->model->contact_slot[contact]],
                            w->impulses.slot[2 * w->model->contact_slot[contact] + 1]};
    const double value = pm_program_run(w, program);
    put_impulse(w, contact, x->impulse, x->share * (1 + x->ratio));
    const double comes = value_with(w, program, -x->share), leaves = value_with(w, program, x->share * x->ratio);
    put_impulse(w, contact, kept, 1);
    return fmax(fabs(comes - value), fabs(leaves - value));
}

double pm_blows_left_error(pm_workspace *w, int program)
{
    double sum = 0;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT] && w->evidence.active; i++) {
        const pm_left *x = w->event->left->of + i;
        if (x->struck == w->state.t) sum += error_of(w, i, x, program);
    }
    return isfinite(sum) ? sum : 0;
}
